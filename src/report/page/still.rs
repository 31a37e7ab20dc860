//! The scene cut through the aim point, as a still picture for where nothing moves.

use askama::Template;
use nalgebra::{Point3, Vector3};

use super::look::{Colour, LOOK, Look};
use crate::record::{
    BodyRecord, EvidenceRecord, PathRecord, Record, RoleRecord, SurfaceShapeRecord,
};
use crate::report::number::{count, plain};

/// Units of the drawing: its width, the height of the scene in it, and that of the whole.
const WIDTH: f64 = 1000.0;
const PICTURE: f64 = 600.0;
const HEIGHT: f64 = 664.0;
/// How much more is seen than target and exit, and the room round that, as factors.
const SURROUNDINGS: f64 = 2.0;
const ROOM: f64 = 1.06;
/// The body of the nozzle, which one sees through, on white.
const NOZZLE_ON_WHITE: Colour = Colour(165, 170, 176);
/// How many shades a surface has.
const SHADES: f64 = 5.0;

/// The picture.
#[derive(Template)]
#[template(path = "still.svg")]
pub struct Still {
    look: Look,
    width: f64,
    height: f64,
    picture: f64,
    /// What lies behind the section, farthest first.
    behind: Vec<Area>,
    cuts: Vec<String>,
    target_cut: String,
    nozzle: Vec<Piece>,
    axis: String,
    exit: String,
    flights: Vec<Flight>,
    breaks: String,
    labels: Vec<Label>,
    strips: Vec<Label>,
    bar_from: f64,
    bar_to: f64,
    bar_height: f64,
    bar_length: String,
    legend: Vec<Entry>,
    legend_height: f64,
    caption: String,
}

struct Area {
    path: String,
    colour: Colour,
}

struct Piece {
    path: String,
    width: String,
}

struct Flight {
    path: String,
    colour: Colour,
}

struct Label {
    x: String,
    y: String,
    anchor: &'static str,
    text: String,
}

struct Entry {
    x: f64,
    colour: Colour,
    width: f64,
    is_dashed: bool,
    text: &'static str,
}

impl Still {
    /// The section of a record's scene.
    pub fn new(record: &Record, evidence: &EvidenceRecord) -> Self {
        let view = View::new(record, evidence);
        let direction = Vector3::from(record.best.pose.direction);
        let exit = Point3::from(record.best.pose.exit_m);
        let tip = exit + direction * (exit - view.aim).norm();
        let rim = view.right.cross(&view.up).cross(&direction);
        let rim = rim.try_normalize(1e-9).unwrap_or(view.up) * record.problem.exit_diameter_m / 2.0;
        let is_target = |shape: &&SurfaceShapeRecord| shape.role == RoleRecord::Target;
        let (targets, others): (Vec<_>, Vec<_>) = evidence.surfaces.iter().partition(is_target);
        let shown = evidence.paths.iter().filter(|path| !path.picked);
        let (breaking, kept): (Vec<_>, Vec<_>) = shown.partition(|path| path.breaks);
        let (bar, bar_length) = view.scale_bar();
        Self {
            look: LOOK,
            width: WIDTH,
            height: HEIGHT,
            picture: PICTURE,
            behind: view.behind(&evidence.surfaces),
            cuts: others.iter().map(|shape| view.cut_path(shape)).collect(),
            target_cut: targets.iter().map(|shape| view.cut_path(shape)).collect(),
            nozzle: evidence
                .nozzle
                .iter()
                .map(|body| view.body(exit, body))
                .collect(),
            axis: view.line(&[exit, tip]),
            exit: view.line(&[exit - rim, exit + rim]),
            flights: flights(&view, &kept),
            breaks: breaking
                .iter()
                .map(|path| view.line(&points(path)))
                .collect(),
            labels: view.labels(&evidence.surfaces),
            strips: view.strips(evidence),
            bar_from: 20.0,
            bar_to: 20.0 + bar,
            bar_height: PICTURE - 18.0,
            bar_length: plain(bar_length),
            legend: legend(&kept, !breaking.is_empty()),
            legend_height: PICTURE + 20.0,
            caption: format!(
                "{}; cut through the aim point{}, seen against {}.",
                match breaking.len() + kept.len() {
                    1 => "1 shot".into(),
                    shots => format!("{} shots as they come", count(shots)),
                },
                if evidence.places.is_empty() {
                    ""
                } else {
                    ", numbers are test strips"
                },
                view.seen_against,
            ),
        }
    }
}

fn points(path: &PathRecord) -> Vec<Point3<f64>> {
    let point = |at: &[f32; 3]| Point3::from(at.map(f64::from));
    path.points_m.iter().map(point).collect()
}

/// The flights of all paths by bounce, the last ones first so that the jet stays on top.
fn flights(view: &View, paths: &[&PathRecord]) -> Vec<Flight> {
    let mut drawn = LOOK.flights.map(|flight| Flight {
        path: String::new(),
        colour: flight.colour,
    });
    for path in paths {
        for (flight, ends) in points(path).windows(2).enumerate() {
            drawn[flight.min(LOOK.flights.len() - 1)].path += &view.line(ends);
        }
    }
    let mut drawn = Vec::from(drawn);
    drawn.reverse();
    drawn
}

fn legend(kept: &[&PathRecord], any_breaks: bool) -> Vec<Entry> {
    let most = kept
        .iter()
        .map(|path| path.points_m.len().saturating_sub(1))
        .max();
    let entry = |colour, width, is_dashed, text| Entry {
        x: 0.0,
        colour,
        width,
        is_dashed,
        text,
    };
    let mut entries = vec![
        entry(LOOK.target_cut, 6.0, false, "target"),
        entry(NOZZLE_ON_WHITE, 12.0, false, "nozzle"),
    ];
    for flight in LOOK.flights.into_iter().take(most.unwrap_or(0)) {
        entries.push(entry(flight.colour, 2.5, false, flight.name));
    }
    if any_breaks {
        entries.push(entry(LOOK.breaks, 3.0, true, "breaks a limit"));
    }
    let mut x = 16.0;
    for entry in &mut entries {
        entry.x = x;
        x += 56.0 + 6.9 * entry.text.len() as f64;
    }
    entries
}

/// The plane of the picture: through the aim point, with the target's normal upwards.
struct View {
    aim: Point3<f64>,
    right: Vector3<f64>,
    up: Vector3<f64>,
    /// Towards the viewer.
    out: Vector3<f64>,
    /// What is looked at.
    middle: Point3<f64>,
    /// Units of the drawing per metre.
    scale: f64,
    seen_against: &'static str,
}

type Corner = Point3<f64>;

impl View {
    /// Looks across the jet, as the 3-D view does at first.
    fn new(record: &Record, evidence: &EvidenceRecord) -> Self {
        let frame = &evidence.frame;
        let [along, across, up] = [frame.along, frame.across, frame.normal].map(Vector3::from);
        let direction = Vector3::from(record.best.pose.direction);
        let is_along = direction.dot(&along).abs() >= direction.dot(&across).abs();
        let (out, right) = if is_along {
            (across, along)
        } else {
            (along, -across)
        };
        let aim = Point3::from(frame.aim_m);
        let exit = Point3::from(record.best.pose.exit_m);
        let middle = nalgebra::center(&aim, &exit);
        let distance = |at: &[f32; 3]| (Point3::from(at.map(f64::from)) - middle).norm();
        let farthest = |of: &dyn Fn(&&SurfaceShapeRecord) -> bool| {
            let points = evidence
                .surfaces
                .iter()
                .filter(of)
                .flat_map(|shape| &shape.points_m);
            points.map(distance).fold((exit - aim).norm(), f64::max)
        };
        let reach = SURROUNDINGS * farthest(&|shape| shape.role == RoleRecord::Target);
        let reach = reach.min(farthest(&|_| true));
        let mut view = Self {
            aim,
            right,
            up,
            out,
            middle,
            scale: PICTURE / (2.0 * ROOM * reach.max(1e-6)),
            seen_against: if is_along {
                "azimuth 90 deg"
            } else {
                "azimuth 0"
            },
        };
        view.centre(&evidence.surfaces, &exit);
        view
    }

    /// Moves up or down so that what can be seen stands in the middle.
    fn centre(&mut self, shapes: &[SurfaceShapeRecord], exit: &Corner) {
        let points = shapes.iter().flat_map(|shape| &shape.points_m);
        let corners = points.map(|at| Point3::from(at.map(f64::from)));
        let all = corners.chain([self.aim, *exit]);
        let ends = all.map(|corner| self.at(&corner)[1].clamp(0.0, PICTURE));
        let (top, bottom) = ends.fold((PICTURE, 0.0_f64), |(top, bottom), y| {
            (top.min(y), bottom.max(y))
        });
        let shift = f64::midpoint(top, bottom) - PICTURE / 2.0;
        self.middle -= self.up * (shift / self.scale);
    }

    /// Units of the drawing.
    fn at(&self, point: &Corner) -> [f64; 2] {
        let from = point - self.middle;
        [
            WIDTH / 2.0 + from.dot(&self.right) * self.scale,
            PICTURE / 2.0 - from.dot(&self.up) * self.scale,
        ]
    }

    /// Height over the section, towards the viewer, m.
    fn height(&self, point: &Corner) -> f64 {
        (point - self.aim).dot(&self.out)
    }

    fn line(&self, corners: &[Corner]) -> String {
        let pen = |index: usize| if index == 0 { 'M' } else { 'L' };
        let step = |(index, corner): (usize, &Corner)| {
            let [x, y] = self.at(corner);
            format!("{}{x:.1},{y:.1}", pen(index))
        };
        corners.iter().enumerate().map(step).collect()
    }

    /// Whether any of it can be seen.
    fn is_in_view(&self, corners: &[Corner]) -> bool {
        let places = || corners.iter().map(|corner| self.at(corner));
        let reaches = |axis: usize, most: f64| {
            places().any(|at| at[axis] > 0.0) && places().any(|at| at[axis] < most)
        };
        reaches(0, WIDTH) && reaches(1, PICTURE)
    }

    /// What lies behind the section, farthest first; neighbours of one colour together.
    fn behind(&self, shapes: &[SurfaceShapeRecord]) -> Vec<Area> {
        let mut pieces: Vec<(f64, Colour, Vec<Corner>)> = Vec::new();
        let mut secondary = 0;
        for shape in shapes {
            let colour = match shape.role {
                RoleRecord::Target => LOOK.target,
                RoleRecord::Deflector => LOOK.deflector,
                RoleRecord::Secondary => {
                    secondary += 1;
                    LOOK.surfaces[(secondary - 1) % LOOK.surfaces.len()]
                }
            };
            for corners in triangles(shape) {
                let behind = self.part_behind(&corners);
                if behind.len() > 2 && self.is_in_view(&behind) {
                    let heights = behind.iter().map(|corner| self.height(corner));
                    let depth = heights.sum::<f64>() / behind.len() as f64;
                    pieces.push((depth, self.shaded(colour, &corners), behind));
                }
            }
        }
        pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut areas: Vec<Area> = Vec::new();
        for (_, colour, corners) in pieces {
            let path = self.line(&corners) + "Z";
            match areas.last_mut() {
                Some(area) if area.colour == colour => area.path += &path,
                _ => areas.push(Area { path, colour }),
            }
        }
        areas
    }

    /// The part of a triangle that lies behind the section.
    fn part_behind(&self, corners: &[Corner; 3]) -> Vec<Corner> {
        let mut part = Vec::with_capacity(4);
        for index in 0..3 {
            let (here, next) = (corners[index], corners[(index + 1) % 3]);
            let (from, to) = (self.height(&here), self.height(&next));
            if from <= 0.0 {
                part.push(here);
            }
            if (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0) {
                part.push(here + (next - here) * (from / (from - to)));
            }
        }
        part
    }

    /// What faces the viewer is lighter.
    fn shaded(&self, colour: Colour, [a, b, c]: &[Corner; 3]) -> Colour {
        let normal = (b - a).cross(&(c - a));
        let light = self.out + self.up * 0.5 - self.right * 0.3;
        let facing = normal.angle(&light).cos().abs();
        colour.darker(0.72 + 0.28 * (facing * SHADES).round() / SHADES)
    }

    /// Where a surface crosses the section.
    fn cut(&self, shape: &SurfaceShapeRecord) -> Vec<[Corner; 2]> {
        let across = |corners: [Corner; 3]| {
            let mut ends = (0..3).filter_map(|index| {
                let (a, b) = (corners[index], corners[(index + 1) % 3]);
                let (from, to) = (self.height(&a), self.height(&b));
                ((from < 0.0) != (to < 0.0)).then(|| a + (b - a) * (from / (from - to)))
            });
            Some([ends.next()?, ends.next()?])
        };
        let cuts = triangles(shape).filter_map(across);
        cuts.filter(|cut| self.is_in_view(cut)).collect()
    }

    fn cut_path(&self, shape: &SurfaceShapeRecord) -> String {
        self.cut(shape).iter().map(|cut| self.line(cut)).collect()
    }

    fn body(&self, exit: Corner, body: &BodyRecord) -> Piece {
        let (end, radius) = match *body {
            BodyRecord::Ball { radius_m } => (exit, radius_m),
            BodyRecord::Capsule {
                length_m,
                radius_m,
                direction,
            } => (exit + Vector3::from(direction) * length_m, radius_m),
        };
        Piece {
            path: self.line(&[exit, end]),
            width: format!("{:.1}", 2.0 * radius * self.scale),
        }
    }

    /// Names beside the longest cut of each surface, where there is room.
    fn labels(&self, shapes: &[SurfaceShapeRecord]) -> Vec<Label> {
        let mut taken: Vec<[f64; 2]> = Vec::new();
        let mut labels = Vec::new();
        for shape in shapes {
            let middles = self.cut(shape).into_iter().map(|[a, b]| {
                let at = self.at(&nalgebra::center(&a, &b));
                ((b - a).norm() * self.scale, at)
            });
            let inside = |&(_, [x, y]): &(f64, [f64; 2])| {
                (20.0..WIDTH - 20.0).contains(&x) && (30.0..PICTURE - 50.0).contains(&y)
            };
            let is_free = |&(_, [x, y]): &(f64, [f64; 2])| {
                let mut others = taken.iter();
                others.all(|at| (at[0] - x).abs() > 110.0 || (at[1] - y).abs() > 18.0)
            };
            let longest = middles
                .filter(|middle| inside(middle) && is_free(middle))
                .max_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, [x, y])) = longest {
                taken.push([x, y]);
                let is_left = x < WIDTH / 2.0;
                labels.push(Label {
                    x: format!("{:.1}", if is_left { x + 8.0 } else { x - 8.0 }),
                    y: format!("{:.1}", y + 18.0),
                    anchor: if is_left { "start" } else { "end" },
                    text: shape.name.clone(),
                });
            }
        }
        labels
    }

    fn strips(&self, evidence: &EvidenceRecord) -> Vec<Label> {
        let strips = evidence.places.iter().enumerate().map(|(index, place)| {
            let [x, y] = self.at(&Point3::from(place.point_m));
            Label {
                x: format!("{x:.1}"),
                y: format!("{y:.1}"),
                anchor: "middle",
                text: (index + 1).to_string(),
            }
        });
        strips.collect()
    }

    /// A round length in the drawing, and in mm.
    fn scale_bar(&self) -> (f64, f64) {
        let per_millimetre = self.scale * 1e-3;
        let lengths = (-3..5).flat_map(|power| [1.0, 2.0, 5.0].map(|m| m * 10_f64.powi(power)));
        let fits = |length: &f64| length * per_millimetre <= WIDTH / 6.0;
        let length = lengths.filter(fits).fold(1e-3, f64::max);
        (length * per_millimetre, length)
    }
}

fn triangles(shape: &SurfaceShapeRecord) -> impl Iterator<Item = [Corner; 3]> {
    let corner = |index: u32| {
        let at = shape.points_m.get(index as usize)?;
        Some(Point3::from(at.map(f64::from)))
    };
    shape
        .triangles
        .iter()
        .filter_map(move |&[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?]))
}
