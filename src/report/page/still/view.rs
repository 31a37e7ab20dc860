//! The plane of the picture, and what is seen in it.

use nalgebra::{Point3, Vector3};

use super::{Area, Label, PICTURE, Piece, WIDTH};
use crate::elementary::{cos, whole_power};
use crate::record::{BodyRecord, EvidenceRecord, Record, RoleRecord, SurfaceShapeRecord};
use crate::report::page::look::{Colour, LOOK};

/// How much more is seen than target and exit, and the room round that, as factors.
const SURROUNDINGS: f64 = 2.0;
const ROOM: f64 = 1.06;
/// How many shades a surface has.
const SHADES: f64 = 5.0;

/// The plane of the picture: through the aim point, with the target's normal upwards.
pub struct View {
    pub aim: Point3<f64>,
    pub right: Vector3<f64>,
    pub up: Vector3<f64>,
    /// Towards the viewer.
    out: Vector3<f64>,
    /// What is looked at.
    middle: Point3<f64>,
    /// Units of the drawing per metre.
    scale: f64,
    /// What lies behind the section.
    pub seen_against: &'static str,
}

type Corner = Point3<f64>;

impl View {
    /// Looks across the jet, as the 3-D view does at first.
    pub fn new(record: &Record, evidence: &EvidenceRecord) -> Self {
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
                "azimuth 90°"
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

    pub fn line(&self, corners: &[Corner]) -> String {
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
    pub fn behind(&self, shapes: &[SurfaceShapeRecord]) -> Vec<Area> {
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
        let facing = cos(normal.angle(&light)).abs();
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

    pub fn cut_path(&self, shape: &SurfaceShapeRecord) -> String {
        self.cut(shape).iter().map(|cut| self.line(cut)).collect()
    }

    pub fn body(&self, exit: Corner, body: &BodyRecord) -> Piece {
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
    pub fn labels(&self, shapes: &[SurfaceShapeRecord]) -> Vec<Label> {
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

    pub fn strips(&self, evidence: &EvidenceRecord) -> Vec<Label> {
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
    pub fn scale_bar(&self) -> (f64, f64) {
        let per_millimetre = self.scale * 1e-3;
        let lengths =
            (-3..5).flat_map(|power| [1.0, 2.0, 5.0].map(|m| m * whole_power(10.0, power)));
        let fits = |length: &f64| length * per_millimetre <= WIDTH / 6.0;
        let length = lengths.filter(fits).fold(1e-3, f64::max);
        (length * per_millimetre, length)
    }
}

fn triangles(shape: &SurfaceShapeRecord) -> impl Iterator<Item = [Corner; 3]> {
    let corner = |at: [f32; 3]| Point3::from(at.map(f64::from));
    shape.faces().map(move |corners| corners.map(corner))
}
