//! Draws the section of a scene through its target, with the nozzle and a few dozen shots, as SVG.
//!
//! `cargo run --release --example draw_paths -- problems/keyway.yaml docs/keyway.svg`
//!
//! The settings are the best ones; `incidence=80deg` and the like behind the file names change them.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use nalgebra::{Point2, Point3};
use peenpose::jet::{Deviate, Pose, Samples, Stream};
use peenpose::problem::equipment::Body;
use peenpose::problem::setting::{Choice, Setting, Tolerance};
use peenpose::setup::Setup;
use peenpose::solve::{Control, solve};
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
const WALLS: [&str; 3] = ["#f1f3f5", "#dde3e8", "#e8eadf"];
const SHOTS: usize = 48;
/// Longer than any flight in the picture, m.
const FAR: f64 = 1.0;
/// Pixels: width of the section, and the room at its sides, above and below it.
const WIDTH: f64 = 880.0;
const SIDE: f64 = 66.0;
const HEAD: f64 = 78.0;
const FOOT: f64 = 96.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [problem, picture, changes @ ..] = &arguments[..] else {
        return Err("usage: draw_paths PROBLEM.yaml PICTURE.svg [incidence=80deg ...]".into());
    };
    let (mut setup, _) = Setup::load(Path::new(problem)).map_err(|fault| fault.render(false))?;
    let mut choice = solve(&setup, &Control::default()).answers[0].choice;
    for change in changes {
        choice = changed(&choice, change)?;
    }
    // The picture shows the jet of a nozzle that is set exactly.
    setup.problem.tolerance = Tolerance::default();
    std::fs::write(picture, draw(&setup, &choice)?)?;
    Ok(())
}

/// The settings with one of them as `name=value` says.
fn changed(choice: &Choice, text: &str) -> Result<Choice, Box<dyn Error>> {
    let (name, value) = text.split_once('=').ok_or("expected name=value")?;
    let mut all = Setting::OF_THE_NOZZLE.into_iter();
    let setting = all.find(|setting| setting.name() == name);
    let setting = setting.ok_or_else(|| format!("there is no setting `{name}`"))?;
    let dimension = match setting {
        Setting::Incidence | Setting::Azimuth => Dimension::Angle,
        Setting::Speed => Dimension::Speed,
        _ => Dimension::Length,
    };
    Ok(setting.with(choice, parse(dimension, value)?))
}

/// One shot: from the exit over its impacts to where it ends, or on and on if it leaves.
struct Shot {
    corners: Vec<Point3<f64>>,
    impacts: usize,
}

fn fire(setup: &Setup, choice: &Choice, pose: &Pose, shot: &Deviate) -> Shot {
    let [across, up, forward] = shot.cone;
    let mut heading = pose.side * across + pose.up * up + pose.direction * forward;
    let mut corners = vec![pose.exit + pose.side * shot.exit[0] + pose.up * shot.exit[1]];
    let (end, _) = Tracer::new(setup, choice, choice.speed).follow(shot, |impact| {
        corners.push(impact.point);
        heading = impact.velocity.normalize();
    });
    let impacts = corners.len() - 1;
    if end == End::Left {
        corners.push(corners[impacts] + heading * FAR);
    }
    Shot { corners, impacts }
}

/// The plane of the picture: through the aim point, with the target's normal upwards.
struct View<'a> {
    setup: &'a Setup,
    /// Corners of the part that is shown, m.
    low: Point2<f64>,
    high: Point2<f64>,
}

impl View<'_> {
    /// Coordinates in the plane, m: along the target, and out of it.
    fn flat(&self, p: &Point3<f64>) -> Point2<f64> {
        let frame = &self.setup.target.frame;
        Point2::new(p.coords.dot(&frame.along), p.coords.dot(&frame.normal))
    }

    /// Height over the plane, towards the viewer, m.
    fn height(&self, p: &Point3<f64>) -> f64 {
        let frame = &self.setup.target.frame;
        (p - frame.aim).dot(&frame.across)
    }

    /// Shows `near` and what of `all` is not much farther away than that is large.
    fn fit(&mut self, near: &[Point3<f64>], all: &[Point3<f64>]) {
        let bounds = |points: &[Point3<f64>]| {
            let flat = || points.iter().map(|p| self.flat(p));
            let first = self.flat(&near[0]);
            (
                flat().fold(first, |a, b| a.inf(&b)),
                flat().fold(first, |a, b| a.sup(&b)),
            )
        };
        let ((low, high), (least, most)) = (bounds(near), bounds(all));
        let (room, margin) = ((high - low).amax() * 4.0, (high - low).amax() * 0.2);
        let grown = |p: Point2<f64>, by: f64| p.map(|x| x + by);
        self.low = grown(low, -room).sup(&grown(low.inf(&least), -margin));
        self.high = grown(high, room).inf(&grown(high.sup(&most), margin));
    }

    /// Pixels in a metre.
    fn scale(&self) -> f64 {
        WIDTH / (self.high.x - self.low.x)
    }

    fn bottom(&self) -> f64 {
        HEAD + (self.high.y - self.low.y) * self.scale()
    }

    /// Pixels of a point in the plane.
    fn pixels(&self, flat: Point2<f64>) -> Point2<f64> {
        let (x, y) = (flat.x - self.low.x, self.high.y - flat.y);
        Point2::new(SIDE + x * self.scale(), HEAD + y * self.scale())
    }

    /// Pixels of a point of the scene, seen from above the plane.
    fn at(&self, p: &Point3<f64>) -> Point2<f64> {
        self.pixels(self.flat(p))
    }

    /// `x,y x,y ...` for a polyline.
    fn line(&self, corners: &[Point3<f64>]) -> String {
        let pixels = corners.iter().map(|p| self.at(p));
        let text = pixels.map(|p| format!("{:.1},{:.1}", p.x, p.y));
        text.collect::<Vec<_>>().join(" ")
    }

    /// Where a triangle crosses the plane.
    fn cut(&self, corners: &[Point3<f64>; 3]) -> Option<[Point3<f64>; 2]> {
        let edge = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let (from, to) = (self.height(&a), self.height(&b));
            ((from < 0.0) != (to < 0.0)).then(|| a + (b - a) * (from / (from - to)))
        };
        let mut ends = (0..3).filter_map(edge);
        Some([ends.next()?, ends.next()?])
    }

    /// The part of a line that lies on the target patch.
    fn on_patch(&self, [p, q]: [Point3<f64>; 2]) -> Option<[Point3<f64>; 2]> {
        let Some((low, high)) = self.setup.target.within else {
            return Some([p, q]);
        };
        let along = q - p;
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for axis in (0..3).filter(|&axis| along[axis].abs() > 1e-12) {
            let (a, b) = (low[axis] - p[axis], high[axis] - p[axis]);
            let (a, b) = (a / along[axis], b / along[axis]);
            (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
        }
        (from < to).then(|| [p + along * from, p + along * to])
    }
}

fn draw(setup: &Setup, choice: &Choice) -> Result<String, std::fmt::Error> {
    let pose = Pose::new(&setup.target.frame, choice);
    let jet = Samples::new(&setup.problem, Stream::Search, SHOTS);
    let shots: Vec<Shot> = (jet.deviates.iter())
        .map(|shot| fire(setup, choice, &pose, shot))
        .collect();
    let names = setup.scene.surfaces();
    let surfaces: Vec<Vec<[Point3<f64>; 3]>> = (0..names.len() as u32)
        .map(|surface| setup.scene.surface_triangles(surface).collect())
        .collect();

    let mut view = View {
        setup,
        low: Point2::origin(),
        high: Point2::origin(),
    };
    let mut near = vec![pose.exit, pose.exit - pose.direction * 3e-3];
    near.extend(
        shots
            .iter()
            .flat_map(|shot| &shot.corners[1..=shot.impacts]),
    );
    let cuts: Vec<Vec<[Point3<f64>; 2]>> = (surfaces.iter())
        .map(|triangles| triangles.iter().filter_map(|t| view.cut(t)).collect())
        .collect();
    view.fit(&near, &cuts.concat().concat());

    let (right, bottom) = (SIDE + WIDTH, view.bottom());
    let mut svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {w} {h:.0}' font-size='15' \
         font-family='Helvetica, Arial, DejaVu Sans, sans-serif' fill='#222'>\n\
         <rect width='{w}' height='{h:.0}' fill='white'/>\n\
         <clipPath id='frame'><rect x='{SIDE}' y='{HEAD}' width='{WIDTH}' height='{:.1}'/></clipPath>\n\
         <g clip-path='url(#frame)' stroke-linecap='round' stroke-linejoin='round'>\n",
        bottom - HEAD,
        w = right + SIDE / 2.0,
        h = bottom + FOOT,
    );
    draw_walls(&mut svg, &view, &surfaces, &cuts)?;
    draw_nozzle(&mut svg, &view, &pose)?;
    // Later flights first, so that the jet stays on top.
    for (flight, (color, _)) in FLIGHTS.iter().enumerate().rev() {
        writeln!(
            svg,
            "<g fill='none' stroke='{color}' stroke-width='1.3' stroke-opacity='0.75'>"
        )?;
        for Shot { corners, .. } in &shots {
            let last = if flight == FLIGHTS.len() - 1 {
                corners.len()
            } else {
                flight + 2
            };
            if let Some(corners) = corners.get(flight..last.min(corners.len()))
                && corners.len() > 1
            {
                writeln!(svg, "<polyline points='{}'/>", view.line(corners))?;
            }
        }
        writeln!(svg, "</g>")?;
    }
    for (place, impact) in shots
        .iter()
        .flat_map(|s| s.corners[1..=s.impacts].iter().enumerate())
    {
        let (p, color) = (view.at(impact), FLIGHTS[place.min(FLIGHTS.len() - 1)].0);
        writeln!(
            svg,
            "<circle cx='{:.1}' cy='{:.1}' r='2.6' fill='{color}'/>",
            p.x, p.y
        )?;
    }
    draw_angle(&mut svg, &view, &pose, choice)?;
    writeln!(svg, "</g>")?;
    draw_axes(&mut svg, &view)?;
    let most = shots
        .iter()
        .map(|shot| shot.corners.len() - 1)
        .max()
        .unwrap_or(0);
    draw_words(&mut svg, &view, choice, most)?;
    Ok(svg + "</svg>\n")
}

/// What lies behind the plane, farthest first; the section; the target; names at the left ends.
fn draw_walls(
    svg: &mut String,
    view: &View,
    surfaces: &[Vec<[Point3<f64>; 3]>],
    cuts: &[Vec<[Point3<f64>; 2]>],
) -> std::fmt::Result {
    let centre = |t: &[Point3<f64>; 3]| t.iter().map(|p| view.height(p)).sum::<f64>() / 3.0;
    let behind = surfaces.iter().map(|triangles| {
        let behind: Vec<_> = triangles.iter().filter(|t| centre(t) < -1e-9).collect();
        (
            behind.iter().map(|t| centre(t)).sum::<f64>() / behind.len() as f64,
            behind,
        )
    });
    let mut behind: Vec<_> = behind
        .enumerate()
        .filter(|(_, (_, seen))| !seen.is_empty())
        .collect();
    behind.sort_by(|a, b| a.1.0.total_cmp(&b.1.0));
    for (index, (_, triangles)) in &behind {
        let color = WALLS[index % WALLS.len()];
        write!(svg, "<path fill='{color}' stroke='{color}' d='")?;
        for triangle in triangles {
            write!(svg, "M{}Z", view.line(*triangle))?;
        }
        writeln!(svg, "'/>")?;
    }
    for (surface, cuts) in cuts.iter().enumerate() {
        for &cut in cuts {
            let line = view.line(&cut);
            writeln!(
                svg,
                "<polyline points='{line}' stroke='#333' stroke-width='2.2'/>"
            )?;
        }
        let target = surface as u32 == view.setup.target.surface;
        for patch in cuts
            .iter()
            .filter(|_| target)
            .filter_map(|&cut| view.on_patch(cut))
        {
            let line = view.line(&patch);
            writeln!(
                svg,
                "<polyline points='{line}' stroke='{TARGET}' stroke-width='8' stroke-linecap='butt'/>"
            )?;
        }
    }
    for (surface, name) in view.setup.scene.surfaces().iter().enumerate() {
        let seen = behind.iter().filter(|(index, _)| *index == surface);
        let seen = seen.flat_map(|(_, (_, triangles))| triangles.iter().copied().flatten());
        let cut = !cuts[surface].is_empty();
        let points: Vec<_> = match cut {
            true => cuts[surface].iter().flatten().collect(),
            false => seen.collect(),
        };
        let Some(left) = points.iter().map(|p| view.at(p).x).reduce(f64::min) else {
            continue;
        };
        let ends: Vec<f64> = points
            .iter()
            .map(|p| view.at(p))
            .filter(|p| p.x < left + 1.0)
            .map(|p| p.y)
            .collect();
        let y = ends.iter().sum::<f64>() / ends.len() as f64 + if cut { 20.0 } else { 5.0 };
        let x = left.max(SIDE) + 10.0;
        writeln!(
            svg,
            "<text x='{x:.1}' y='{y:.1}' fill='#555' font-size='13'>{name}</text>"
        )?;
    }
    Ok(())
}

fn draw_nozzle(svg: &mut String, view: &View, pose: &Pose) -> std::fmt::Result {
    for body in &view.setup.problem.nozzle.body {
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
        writeln!(
            svg,
            "<polyline points='{}' stroke='#8a94a0' stroke-opacity='0.45' stroke-width='{:.1}'/>",
            view.line(&[pose.exit, end]),
            2.0 * radius * view.scale()
        )?;
    }
    let rim = pose.up * (view.setup.problem.jet.exit_diameter / 2.0);
    let exit = view.line(&[pose.exit - rim, pose.exit + rim]);
    writeln!(
        svg,
        "<polyline points='{exit}' stroke='#222' stroke-width='5' stroke-linecap='butt'/>"
    )
}

/// The axis of the jet and its angle to the target.
fn draw_angle(svg: &mut String, view: &View, pose: &Pose, choice: &Choice) -> std::fmt::Result {
    let aim = pose.exit + pose.direction * choice.standoff;
    let (tip, exit) = (view.at(&aim), view.at(&pose.exit));
    let axis = (exit - tip).normalize();
    let back = view.line(&[aim, pose.exit - pose.direction * 3.5e-3]);
    writeln!(
        svg,
        "<polyline points='{back}' stroke='#222' stroke-width='1.4' stroke-dasharray='9 4 2 4'/>"
    )?;
    let (side, sweep) = if axis.x < 0.0 { (-1.0, 1) } else { (1.0, 0) };
    let r = 0.62 * (exit - tip).norm();
    let (from, to) = (tip.x + side * r, tip + axis * r);
    writeln!(
        svg,
        "<path d='M{:.1},{y:.1} L{from:.1},{y:.1} A{r:.1},{r:.1} 0 0 {sweep} {:.1},{:.1}' fill='none' stroke='#222' stroke-width='1.4'/>",
        tip.x,
        to.x,
        to.y,
        y = tip.y,
    )?;
    let half = 0.5 * axis.y.abs().atan2(axis.x.abs());
    let (x, y) = (
        tip.x + side * (r + 10.0) * half.cos(),
        tip.y - (r + 10.0) * half.sin(),
    );
    let anchor = if side < 0.0 { "end" } else { "start" };
    let degrees = choice.incidence.to_degrees();
    writeln!(
        svg,
        "<text x='{x:.1}' y='{y:.1}' text-anchor='{anchor}' stroke='white' stroke-width='4' paint-order='stroke'>incidence {degrees:.1}\u{b0}</text>"
    )
}

/// The frame with ticks in mm.
fn draw_axes(svg: &mut String, view: &View) -> std::fmt::Result {
    let frame = &view.setup.target.frame;
    let (right, bottom) = (SIDE + WIDTH, view.bottom());
    writeln!(
        svg,
        "<rect x='{SIDE}' y='{HEAD}' width='{WIDTH}' height='{:.1}' fill='none' stroke='#222'/>",
        bottom - HEAD
    )?;
    for (axis, direction) in [frame.along, frame.normal].iter().enumerate() {
        // Where the picture lies along a coordinate of the scene, ticks show that coordinate.
        let scene = (0..3).find(|&i| direction[i].abs() > 1.0 - 1e-9);
        let (name, sign) = match scene {
            Some(i) => (["x", "y", "z"][i], direction[i].signum()),
            None => (["along the target", "out of the target"][axis], 1.0),
        };
        let (low, high) = (view.low[axis] * 1e3, view.high[axis] * 1e3);
        let step = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
        let step = step
            .into_iter()
            .find(|step| (high - low) / step < 12.0)
            .unwrap_or(200.0);
        let mut tick = (low / step).ceil() * step;
        while tick <= high {
            let mut flat = view.low;
            flat[axis] = tick * 1e-3;
            let (p, label) = (view.pixels(flat), tick * sign + 0.0);
            if axis == 0 {
                writeln!(
                    svg,
                    "<path d='M{x:.1},{bottom:.1}v6' stroke='#222'/><text x='{x:.1}' y='{:.1}' text-anchor='middle'>{label}</text>",
                    bottom + 22.0,
                    x = p.x
                )?;
            } else {
                writeln!(
                    svg,
                    "<path d='M{SIDE},{y:.1}h-6' stroke='#222'/><text x='{:.1}' y='{:.1}' text-anchor='end'>{label}</text>",
                    SIDE - 10.0,
                    p.y + 5.0,
                    y = p.y
                )?;
            }
            tick += step;
        }
        if axis == 0 {
            writeln!(
                svg,
                "<text x='{right}' y='{:.1}' text-anchor='end'>{name} in mm</text>",
                bottom + 44.0
            )?;
        } else {
            writeln!(
                svg,
                "<text transform='translate(20 {HEAD}) rotate(-90)' text-anchor='end'>{name} in mm</text>"
            )?;
        }
    }
    Ok(())
}

/// Title, settings and legend.
fn draw_words(svg: &mut String, view: &View, choice: &Choice, flights: usize) -> std::fmt::Result {
    let problem = &view.setup.problem;
    let title = problem.title.replace('&', "&amp;").replace('<', "&lt;");
    writeln!(
        svg,
        "<text x='{SIDE}' y='32' font-size='21' font-weight='bold'>{title}</text>"
    )?;
    writeln!(
        svg,
        "<text x='{SIDE}' y='58'>{SHOTS} shots, {}: incidence {:.1}\u{b0}, azimuth {:.1}\u{b0}, standoff {:.1} mm, {:.1} m/s</text>",
        problem.contacts[choice.contact].name,
        choice.incidence.to_degrees(),
        choice.azimuth.to_degrees(),
        choice.standoff * 1e3,
        choice.speed,
    )?;
    let swatches = [(TARGET, "target", 8.0), ("#c4c9cf", "nozzle", 14.0)];
    let flights = FLIGHTS
        .iter()
        .take(flights)
        .map(|&(color, words)| (color, words, 3.0));
    let (mut x, y) = (SIDE, view.bottom() + 76.0);
    for (color, words, width) in swatches.into_iter().chain(flights) {
        writeln!(
            svg,
            "<path d='M{x:.1},{y:.1}h28' stroke='{color}' stroke-width='{width}'/><text x='{:.1}' y='{:.1}'>{words}</text>",
            x + 35.0,
            y + 5.0
        )?;
        x += 62.0 + 7.6 * words.len() as f64;
    }
    Ok(())
}
