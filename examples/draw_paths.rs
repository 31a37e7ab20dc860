//! Draws the section of a scene through its target, with the nozzle and a few dozen shots, as SVG.
//!
//! `cargo run --release --example draw_paths -- problems/keyway.yaml docs/keyway.svg`
//!
//! The settings are the best ones, or with an angle behind the file names those at that incidence.

use std::error::Error;
use std::path::Path;

use nalgebra::{Point2, Point3};
use peenpose::control::Control;
use peenpose::jet::{Pose, Samples, ShotSample, Stream};
use peenpose::problem::equipment::Body;
use peenpose::problem::setting::{Settings, Tolerance};
use peenpose::scenario::Scenario;
use peenpose::solve::solve;
use peenpose::trace::{End, Tracer};
use peenpose::units::{Dimension, parse};

/// Okabe and Ito's colours, which colour-blind people can tell apart.
const FLIGHTS: [(&str, &str); 4] = [
    ("#0072B2", "to the first hit"),
    ("#E69F00", "after the first hit"),
    ("#009E73", "after the second"),
    ("#CC79A7", "later"),
];
const TARGET: &str = "#D55E00";
const NOZZLE: &str = "#c2c9d0";
const WALLS: [&str; 3] = ["#f1f3f5", "#dde3e8", "#e8eadf"];
const SHOTS: usize = 48;
/// Longer than any flight in the picture, m.
const FAR: f64 = 1.0;
/// Pixels: width of the section, and the room at its sides, above and below it.
const WIDTH: f64 = 880.0;
const SIDE: f64 = 66.0;
const HEAD: f64 = 78.0;
const FOOT: f64 = 96.0;

type Triangle = [Point3<f64>; 3];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (problem, picture, incidence) = match &arguments[..] {
        [problem, picture] => (problem, picture, None),
        [problem, picture, angle] => (problem, picture, Some(parse(Dimension::Angle, angle)?)),
        _ => return Err("usage: draw_paths PROBLEM.yaml PICTURE.svg [INCIDENCE]".into()),
    };
    let (mut scenario, _) = Scenario::load(Path::new(problem))?;
    let mut settings = solve(&scenario, &Control::default()).answers[0].settings;
    settings.incidence = incidence.unwrap_or(settings.incidence);
    // The picture shows the jet of a nozzle that is set exactly, and every hit of it.
    scenario.problem.tolerance = Tolerance::default();
    for surface in &mut scenario.surfaces {
        surface.deflector = false;
    }
    std::fs::write(picture, draw(&scenario, &settings))?;
    Ok(())
}

/// One shot: from the exit over its impacts to where it ends, or on and on if it leaves.
struct Shot {
    corners: Vec<Point3<f64>>,
    impacts: usize,
}

fn fire(scenario: &Scenario, settings: &Settings, pose: &Pose, shot: &ShotSample) -> Shot {
    let [across, up, forward] = shot.cone;
    let mut heading = pose.side * across + pose.up * up + pose.direction * forward;
    let mut corners = vec![pose.exit + pose.side * shot.exit[0] + pose.up * shot.exit[1]];
    let (end, _) = Tracer::new(scenario, settings, settings.speed).follow(shot, |impact| {
        corners.push(impact.centre);
        heading = impact.velocity.normalize();
    });
    let impacts = corners.len() - 1;
    if end == End::Left {
        corners.push(corners[impacts] + heading * FAR);
    }
    Shot { corners, impacts }
}

/// A surface as it is when the nozzle stands at a pose.
fn surface_at(scenario: &Scenario, pose: &Pose, surface: u32) -> Vec<Triangle> {
    let triangles = scenario.scene.surface_triangles(surface);
    if !scenario.scene.surface_moves_with_nozzle(surface) {
        return triangles.collect();
    }
    let nozzle_frame = pose.nozzle_frame();
    let in_scene = |corners: Triangle| corners.map(|corner| nozzle_frame.point_back(&corner));
    triangles.map(in_scene).collect()
}

fn draw(scenario: &Scenario, settings: &Settings) -> String {
    let pose = Pose::new(&scenario.target.frame, settings);
    let jet = Samples::new(&scenario.problem, Stream::Search, SHOTS);
    let fire = |shot| fire(scenario, settings, &pose, shot);
    let shots: Vec<Shot> = jet.shots.iter().map(fire).collect();
    let triangles = |surface| surface_at(scenario, &pose, surface);
    let surfaces: Vec<Vec<Triangle>> = (0..scenario.surfaces.len() as u32).map(triangles).collect();
    let view = View::new(scenario, &pose.exit, &surfaces);
    let mut svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {w} {h:.0}' font-size='15' \
         font-family='Helvetica, Arial, DejaVu Sans, sans-serif' fill='#222'>\n\
         <rect width='{w}' height='{h:.0}' fill='white'/>\n<clipPath id='frame'>\
         <rect x='{SIDE}' y='{HEAD}' width='{WIDTH}' height='{:.1}'/></clipPath>\n\
         <g clip-path='url(#frame)' fill='none' stroke-linejoin='round'>\n",
        view.bottom() - HEAD,
        w = WIDTH + 1.5 * SIDE,
        h = view.bottom() + FOOT,
    );
    svg += &view.walls(&surfaces);
    svg += &view.nozzle(&pose);
    // Later flights first, so that the jet stays on top.
    for (flight, (color, _)) in FLIGHTS.iter().enumerate().rev() {
        for Shot { corners, impacts } in &shots {
            let last = flight + 1 == FLIGHTS.len();
            let end = corners
                .len()
                .min(if last { usize::MAX } else { flight + 2 });
            if flight + 1 < end {
                let style = format!("stroke='{color}' stroke-width='1.3' stroke-opacity='0.75'");
                svg += &view.line(&corners[flight..end], &style);
            }
            if (1..=*impacts).contains(&(flight + 1)) {
                let Point2 { coords: p } = view.at(&corners[flight + 1]);
                svg += &format!(
                    "<circle cx='{:.1}' cy='{:.1}' r='2.6' fill='{color}'/>\n",
                    p.x, p.y
                );
            }
        }
    }
    let most = shots.iter().map(|shot| shot.corners.len() - 1).max();
    svg + &view.angle(&pose, settings)
        + "</g>\n"
        + &view.axes()
        + &view.words(settings, most.unwrap_or(0))
        + "</svg>\n"
}

fn text(x: f64, y: f64, style: &str, words: &str) -> String {
    format!("<text x='{x:.1}' y='{y:.1}' {style}>{words}</text>\n")
}

/// The plane of the picture: through the aim point, with the target's normal upwards.
struct View<'a> {
    scenario: &'a Scenario,
    /// Corners of the part that is shown, m.
    low: Point2<f64>,
    high: Point2<f64>,
}

impl<'a> View<'a> {
    /// Shows the whole section and the exit.
    fn new(scenario: &'a Scenario, exit: &Point3<f64>, surfaces: &[Vec<Triangle>]) -> Self {
        let (low, high) = (Point2::origin(), Point2::origin());
        let mut view = Self {
            scenario,
            low,
            high,
        };
        let section = surfaces.iter().flatten().filter_map(|t| view.cut(t));
        let flat = section.flatten().map(|p| view.flat(&p));
        let exit = view.flat(exit);
        let (low, high) = flat.fold((exit, exit), |(low, high), p| (low.inf(&p), high.sup(&p)));
        let margin = 0.07 * (high - low).amax();
        view.low = low.map(|x| x - margin);
        view.high = high.map(|x| x + margin);
        view
    }

    /// Coordinates in the plane, m: along the target, and out of it.
    fn flat(&self, p: &Point3<f64>) -> Point2<f64> {
        let frame = &self.scenario.target.frame;
        Point2::new(p.coords.dot(&frame.along), p.coords.dot(&frame.normal))
    }

    /// Height over the plane, towards the viewer, m.
    fn height(&self, p: &Point3<f64>) -> f64 {
        let frame = &self.scenario.target.frame;
        (p - frame.aim).dot(&frame.across)
    }

    fn scale(&self) -> f64 {
        WIDTH / (self.high.x - self.low.x)
    }

    fn bottom(&self) -> f64 {
        HEAD + (self.high.y - self.low.y) * self.scale()
    }

    /// Pixels.
    fn at(&self, p: &Point3<f64>) -> Point2<f64> {
        let p = self.flat(p);
        let (x, y) = (p.x - self.low.x, self.high.y - p.y);
        Point2::new(SIDE + x * self.scale(), HEAD + y * self.scale())
    }

    fn line(&self, corners: &[Point3<f64>], style: &str) -> String {
        let pixels = corners.iter().map(|p| self.at(p));
        let list: Vec<String> = pixels.map(|p| format!("{:.1},{:.1}", p.x, p.y)).collect();
        format!("<polyline points='{}' {style}/>\n", list.join(" "))
    }

    /// Where a triangle crosses the plane.
    fn cut(&self, corners: &Triangle) -> Option<[Point3<f64>; 2]> {
        let mut ends = (0..3).filter_map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let (from, to) = (self.height(&a), self.height(&b));
            ((from < 0.0) != (to < 0.0)).then(|| a + (b - a) * (from / (from - to)))
        });
        Some([ends.next()?, ends.next()?])
    }

    /// The part of a line that lies on the target patch.
    fn on_patch(&self, [p, q]: [Point3<f64>; 2]) -> Option<[Point3<f64>; 2]> {
        let Some((low, high)) = self.scenario.target.within else {
            return Some([p, q]);
        };
        let (along, mut from, mut to) = (q - p, 0.0_f64, 1.0_f64);
        for axis in (0..3).filter(|&axis| along[axis].abs() > 1e-12) {
            let a = (low[axis] - p[axis]) / along[axis];
            let b = (high[axis] - p[axis]) / along[axis];
            (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
        }
        (from < to).then(|| [p + along * from, p + along * to])
    }

    /// What lies behind the plane, farthest first; the section with its names; the target.
    fn walls(&self, surfaces: &[Vec<Triangle>]) -> String {
        let height = |t: &Triangle| t.iter().map(|p| self.height(p)).sum::<f64>() / 3.0;
        let mut behind: Vec<(f64, &str, &Triangle)> = Vec::new();
        for (index, triangles) in surfaces.iter().enumerate() {
            let seen = triangles
                .iter()
                .map(|t| (height(t), WALLS[index % WALLS.len()], t));
            behind.extend(seen.filter(|(height, ..)| *height < -1e-9));
        }
        behind.sort_by(|a, b| a.0.total_cmp(&b.0));
        let shade = |(_, color, t): &(f64, &str, &Triangle)| {
            self.line(
                &[t[0], t[1], t[2], t[0]],
                &format!("fill='{color}' stroke='{color}'"),
            )
        };
        let mut svg: String = behind.iter().map(shade).collect();
        for (index, triangles) in surfaces.iter().enumerate() {
            let cuts: Vec<_> = triangles.iter().filter_map(|t| self.cut(t)).collect();
            for cut in &cuts {
                svg += &self.line(
                    cut,
                    "stroke='#333' stroke-width='2.2' stroke-linecap='round'",
                );
            }
            if index == self.scenario.target.surface as usize {
                for patch in cuts.iter().filter_map(|&cut| self.on_patch(cut)) {
                    svg += &self.line(&patch, &format!("stroke='{TARGET}' stroke-width='8'"));
                }
            }
            let ends = cuts.iter().flatten().map(|p| self.at(p));
            if let Some(p) = ends.min_by(|a, b| a.x.total_cmp(&b.x)) {
                let name = &self.scenario.scene.surfaces()[index];
                svg += &text(
                    p.x.max(SIDE) + 10.0,
                    p.y + 20.0,
                    "fill='#555' font-size='13'",
                    name,
                );
            }
        }
        svg
    }

    /// The nozzle's body, its exit and the axis of the jet.
    fn nozzle(&self, pose: &Pose) -> String {
        let mut svg = String::new();
        for body in &self.scenario.problem.nozzle.body {
            let (end, radius) = match *body {
                Body::Ball { radius } => (pose.exit, radius),
                Body::Capsule {
                    length,
                    radius,
                    direction,
                } => (
                    pose.exit + direction.unwrap_or(-pose.direction) * length,
                    radius,
                ),
            };
            let width = 2.0 * radius * self.scale();
            let style =
                format!("stroke='{NOZZLE}' stroke-width='{width:.1}' stroke-linecap='round'");
            svg += &self.line(&[pose.exit, end], &style);
        }
        let boundary = pose.up * (self.scenario.problem.jet.exit_diameter / 2.0);
        svg + &self.line(
            &[pose.exit - boundary, pose.exit + boundary],
            "stroke='#222' stroke-width='5'",
        )
    }

    /// The axis of the jet and its angle to the target.
    fn angle(&self, pose: &Pose, settings: &Settings) -> String {
        let aim = pose.exit + pose.direction * settings.standoff;
        let back = pose.exit - pose.direction * (0.5 * settings.standoff);
        let (tip, exit) = (self.at(&aim), self.at(&pose.exit));
        let (axis, r) = ((exit - tip).normalize(), 0.62 * (exit - tip).norm());
        let (side, sweep, anchor) = if axis.x < 0.0 {
            (-1.0, 1, "end")
        } else {
            (1.0, 0, "start")
        };
        let (from, to) = (tip.x + side * r, tip + axis * r);
        let half = 0.5 * axis.y.abs().atan2(axis.x.abs());
        let (x, y) = (
            tip.x + side * (r + 10.0) * half.cos(),
            tip.y - (r + 10.0) * half.sin(),
        );
        let words = format!("incidence {:.1}\u{b0}", settings.incidence.to_degrees());
        let halo = "fill='#222' stroke='white' stroke-width='4' paint-order='stroke'";
        self.line(
            &[aim, back],
            "stroke='#222' stroke-width='1.4' stroke-dasharray='9 4 2 4'",
        ) + &format!(
            "<path d='M{:.1},{y:.1} L{from:.1},{y:.1} A{r:.1},{r:.1} 0 0 {sweep} {:.1},{:.1}' \
                 stroke='#222' stroke-width='1.4'/>\n",
            tip.x,
            to.x,
            to.y,
            y = tip.y,
        ) + &text(x, y, &format!("{halo} text-anchor='{anchor}'"), &words)
    }

    /// The frame with ticks in mm.
    fn axes(&self) -> String {
        let frame = &self.scenario.target.frame;
        let bottom = self.bottom();
        let mut svg = format!(
            "<rect x='{SIDE}' y='{HEAD}' width='{WIDTH}' height='{:.1}' fill='none' stroke='#222'/>\n",
            bottom - HEAD
        );
        for (axis, direction) in [frame.along, frame.normal].iter().enumerate() {
            // Where the picture lies along a coordinate of the scene, ticks show that coordinate.
            let (name, sign) = match (0..3).find(|&i| direction[i].abs() > 1.0 - 1e-9) {
                Some(i) => (["x", "y", "z"][i], direction[i].signum()),
                None => (["along the target", "out of the target"][axis], 1.0),
            };
            let (low, high) = (self.low[axis] * 1e3, self.high[axis] * 1e3);
            let steps = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
            let step = steps
                .into_iter()
                .find(|step| (high - low) / step < 12.0)
                .unwrap_or(200.0);
            for tick in (low / step).ceil() as i64..=(high / step).floor() as i64 {
                let value = tick as f64 * step;
                let label = format!("{}", value * sign + 0.0);
                let along = (value - low) * 1e-3 * self.scale();
                svg += &if axis == 0 {
                    let x = SIDE + along;
                    format!("<path d='M{x:.1},{bottom:.1}v6' stroke='#222'/>")
                        + &text(x, bottom + 22.0, "text-anchor='middle'", &label)
                } else {
                    let y = bottom - along;
                    format!("<path d='M{SIDE},{y:.1}h-6' stroke='#222'/>")
                        + &text(SIDE - 10.0, y + 5.0, "text-anchor='end'", &label)
                };
            }
            let turn = format!("text-anchor='end' transform='rotate(-90 20 {HEAD})'");
            svg += &match axis {
                0 => text(
                    SIDE + WIDTH,
                    bottom + 44.0,
                    "text-anchor='end'",
                    &format!("{name} in mm"),
                ),
                _ => text(20.0, HEAD, &turn, &format!("{name} in mm")),
            };
        }
        svg
    }

    /// Title, settings and legend.
    fn words(&self, settings: &Settings, flights: usize) -> String {
        let problem = &self.scenario.problem;
        let title = problem.title.replace('&', "&amp;").replace('<', "&lt;");
        let settings = format!(
            "{SHOTS} shots, {}: incidence {:.1}\u{b0}, azimuth {:.1}\u{b0}, standoff {:.1} mm, {:.1} m/s",
            problem.contacts[settings.contact].name,
            settings.incidence.to_degrees(),
            settings.azimuth.to_degrees(),
            settings.standoff * 1e3,
            settings.speed,
        );
        let mut svg = text(SIDE, 32.0, "font-size='21' font-weight='bold'", &title)
            + &text(SIDE, 58.0, "", &settings);
        let swatches = [(TARGET, "target", 8.0), (NOZZLE, "nozzle", 14.0)];
        let flights = FLIGHTS
            .iter()
            .take(flights)
            .map(|&(color, words)| (color, words, 3.0));
        let (mut x, y) = (SIDE, self.bottom() + 76.0);
        for (color, words, width) in swatches.into_iter().chain(flights) {
            svg +=
                &format!("<path d='M{x:.1},{y:.1}h28' stroke='{color}' stroke-width='{width}'/>");
            svg += &text(x + 35.0, y + 5.0, "", words);
            x += 62.0 + 7.6 * words.len() as f64;
        }
        svg
    }
}
