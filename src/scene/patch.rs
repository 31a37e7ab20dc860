//! The target patch: which hits count as on target, where the jet aims, and the directions there.

use nalgebra::{Point3, Vector3};

use super::nearest::Foot;
use super::ray::Hit;
use super::{SLACK, Scene};
use crate::problem::LengthUnit;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::Target;

/// The target of the scene.
#[derive(Clone, Debug)]
pub struct Patch {
    /// Index of its surface.
    pub surface: u32,
    /// Only this box of it.
    pub within: Option<(Point3<f64>, Point3<f64>)>,
    /// Whether its free side is that in front: a hit from the other one is off target.
    pub front: bool,
    /// Whether it faces the inside of a solid part: then no nozzle is in free space.
    pub in_material: bool,
    /// How far outside its box a place may be by rounding, m.
    slack: f64,
    /// What paths may be off by rounding, m.
    rounding: f64,
    /// Where the settings are measured from.
    pub frame: Frame,
    /// Area of the patch, m2.
    pub area: f64,
}

/// The aim point and the directions there: `along` x `normal` = `across`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The aim point, m.
    pub aim: Point3<f64>,
    /// n: unit normal towards the nozzle.
    pub normal: Vector3<f64>,
    /// a: unit vector of azimuth 0 in the target's plane.
    pub along: Vector3<f64>,
    /// b = a x n: unit vector of azimuth 90 deg.
    pub across: Vector3<f64>,
}

impl Patch {
    /// Whether a hit is on the target.
    #[inline]
    pub fn holds(&self, hit: &Hit) -> bool {
        hit.surface == self.surface && hit.hit_id.front == self.front && self.covers(&hit.point)
    }

    /// Whether a place on its surface belongs to it.
    #[inline]
    pub fn covers(&self, point: &Point3<f64>) -> bool {
        self.reach().is_none_or(|limits| inside(point, &limits))
    }

    /// The box in which hits count: rounding must not lose those in its faces, where a part often ends.
    #[inline]
    pub fn reach(&self) -> Option<(Point3<f64>, Point3<f64>)> {
        self.within.map(|limits| {
            let least = SMALL * shortest_side(&limits);
            widened(limits, self.slack.max(self.rounding.min(least)))
        })
    }

    /// The triangles of its surface, cut along the faces of its box: those that belong to it, and
    /// the others.
    pub fn cut_out(&self, scene: &Scene) -> (Vec<Triangle>, Vec<Triangle>) {
        let triangles = scene.surface_triangles(self.surface);
        let Some(limits) = &self.within else {
            return (triangles.collect(), Vec::new());
        };
        let (mut inside, mut outside) = (Vec::new(), Vec::new());
        for triangle in triangles {
            let (within, beyond) = split(&triangle, limits, self.slack);
            if within.len() < 3 {
                outside.push(triangle);
            } else {
                inside.extend(fan(&within));
                outside.extend(beyond.iter().flat_map(fan));
            }
        }
        (inside, outside)
    }

    /// The point of its surface nearest to a given one, and the unit normal there towards its free side.
    pub fn nearest(&self, scene: &Scene, to: &Point3<f64>) -> Option<(Point3<f64>, Vector3<f64>)> {
        let foot = scene.foot(to, self.surface)?;
        let normal = if self.front { foot.front } else { -foot.front };
        Some((foot.point, normal))
    }

    /// Finds the patch in a scene.
    ///
    /// # Errors
    /// An unknown surface, one that moves with the nozzle, an empty patch, an aim point off the patch, a
    /// free side that cannot be told, or `along` perpendicular to it.
    pub fn find(scene: &Scene, target: &Target) -> Result<Self, Vec<Fault>> {
        let surface = scene.surface_named(&target.surface).map_err(|fault| {
            vec![Fault {
                key: "target.surface".into(),
                ..*fault
            }]
        })?;
        if scene.surface_moves_with_nozzle(surface) {
            let fault = Fault::at_key(
                FaultCode::TargetOnNozzle,
                "target.surface",
                "moves with the nozzle",
            );
            return Err(vec![
                fault.expecting("a surface of a part that stands in the scene"),
            ]);
        }
        let slack = slack(scene, target.within);
        let pieces = scene.surface_triangles(surface);
        let clipped = pieces.map(|corners| match target.within {
            Some(limits) => split(&corners, &limits, slack).0,
            None => corners.to_vec(),
        });
        let (area, centre) = area_and_centre(clipped);
        if area <= 0.0 {
            let fault = Fault::at_key(
                FaultCode::TargetEmpty,
                "target.within",
                format!(
                    "no part of `{}` lies in this box: the target is empty",
                    target.surface
                ),
            );
            return Err(vec![fault.expecting(format!(
                "a box that meets {}",
                extent(scene, surface, target.lengths_in)
            ))]);
        }
        let aim = target
            .aim
            .or_else(|| nearest_to_centre(scene, surface, &centre))
            .unwrap_or(centre);
        let nearest = scene.foot(&aim, surface);
        let on_patch = |p: &Point3<f64>| {
            let limits = target.within;
            limits.is_none_or(|limits| inside(p, &widened(limits, slack.max(1e-9))))
        };
        let is_near = |foot: &Foot| (foot.point - aim).norm() <= near_enough(area);
        let Some(foot) = nearest.filter(|foot| is_near(foot) && on_patch(&aim)) else {
            return Err(vec![aim_fault(target, &aim)]);
        };
        let front = match target.facing {
            Some(facing) => facing.dot(&foot.front) >= 0.0,
            None => scene
                .front_is_free(&foot)
                .map_err(|undecided| vec![undecided.fault(&target.surface)])?,
        };
        let normal = if front { foot.front } else { -foot.front };
        let frame = Frame::new(aim, normal, target.along).ok_or_else(|| {
            let fault = Fault::at_key(
                FaultCode::AlongPerpendicular,
                "target.along",
                "is perpendicular to the target at the aim point",
            );
            vec![fault.expecting("a direction that can be laid into the target's plane")]
        })?;
        Ok(Self {
            surface,
            within: target.within,
            front,
            in_material: !front && scene.is_solid(&foot),
            slack,
            rounding: SLACK * scene.size(),
            frame,
            area,
        })
    }
}

impl Frame {
    /// The frame at an aim point; `None` when `along` has no part in the plane.
    pub fn new(
        aim: Point3<f64>,
        normal: Vector3<f64>,
        along: Option<Vector3<f64>>,
    ) -> Option<Self> {
        let laid = |direction: Vector3<f64>| {
            let flat = direction - normal * direction.dot(&normal);
            flat.try_normalize(1e-6 * direction.norm())
        };
        let along = match along {
            Some(direction) => laid(direction)?,
            // Without a wish: along z, or along x where the target faces along z.
            None if normal.z.abs() < 0.9 => laid(Vector3::z())?,
            None => laid(Vector3::x())?,
        };
        Some(Self {
            aim,
            normal,
            along,
            across: along.cross(&normal),
        })
    }

    /// Whether the directions are those of another frame.
    pub fn is_turned_as(&self, other: &Self) -> bool {
        self.normal == other.normal && self.along == other.along
    }

    /// The same where both of them differ by less than `within`, as unit vectors.
    pub fn is_nearly_turned_as(&self, other: &Self, within: f64) -> bool {
        let [normal, along] = [self.normal - other.normal, self.along - other.along];
        normal.norm() < within && along.norm() < within
    }
}

/// The point of a surface nearest to its centre, which is off it where it is curved; `None` where another one is about as near, as
/// all round a hole.
fn nearest_to_centre(scene: &Scene, surface: u32, centre: &Point3<f64>) -> Option<Point3<f64>> {
    let foot = scene.foot(centre, surface)?.point;
    let way = foot - centre;
    let beyond = scene.foot(&(centre - way * ASIDE), surface)?.point;
    ((beyond - foot).norm() <= 0.5 * way.norm()).then_some(foot)
}

/// By how much of the way to the nearest point a centre is moved away from it, to see whether another one is as near.
const ASIDE: f64 = 0.5;

/// How far from the target a point may be that is on it, m: a mesh's facets lie a little inside the true surface that a
/// drawing's numbers mean.
pub(super) fn near_enough(area: f64) -> f64 {
    1e-5_f64.max(1e-3 * area.sqrt())
}

/// What is wrong with a stroke through a point that is off the target, by this much, m, where that is known.
pub(super) fn stroke_fault(
    target: &Target,
    key: &str,
    point: &Point3<f64>,
    by: Option<f64>,
) -> Fault {
    let unit = target.lengths_in;
    let by = by.map_or(String::new(), |by| {
        format!(": it is {} {} away", unit.text(by), unit.name())
    });
    let message = format!("the stroke leaves the target at {}{by}", unit.point(point));
    Fault::at_key(FaultCode::StrokeOffTarget, key, message).expecting(format!(
        "points on `{}`, inside `target.within` if that is given",
        target.surface
    ))
}

fn aim_fault(target: &Target, aim: &Point3<f64>) -> Fault {
    let place = target.lengths_in.point(aim);
    match target.aim {
        Some(_) if target.aim_key != "target.aim" => {
            stroke_fault(target, target.aim_key, aim, None)
        }
        Some(_) => Fault::at_key(
            FaultCode::AimOffTarget,
            "target.aim",
            format!("the aim point {place} is not on the target"),
        )
        .expecting(format!(
            "a point on `{}`, inside `within` if that is given",
            target.surface
        )),
        None => Fault::at_key(
            FaultCode::CentreOffTarget,
            "target",
            format!("the centre of the target, {place}, does not lie on it"),
        )
        .expecting("`aim: [x, y, z]` with a point on the target"),
    }
}

/// The box round a surface, in words.
fn extent(scene: &Scene, surface: u32, unit: LengthUnit) -> String {
    let corners = || scene.surface_triangles(surface).flatten();
    let low = corners().fold(Vector3::repeat(f64::INFINITY), |low, p| low.inf(&p.coords));
    let high = corners().fold(Vector3::repeat(f64::NEG_INFINITY), |high, p| {
        high.sup(&p.coords)
    });
    let axis =
        |name: &str, at: usize| format!("{name} {} to {}", unit.text(low[at]), unit.text(high[at]));
    format!(
        "{}, {}, {} {}",
        axis("x", 0),
        axis("y", 1),
        axis("z", 2),
        unit.name()
    )
}

/// What rounding takes from coordinates, m: of files with seven digits, where there are meshes; never much of
/// the box itself.
fn slack(scene: &Scene, within: Option<(Point3<f64>, Point3<f64>)>) -> f64 {
    let share = if scene.has_exact_walls() {
        ROUNDING
    } else {
        f64::from(f32::EPSILON)
    };
    let most = within.map_or(f64::INFINITY, |limits| SMALL * shortest_side(&limits));
    most.min(share * scene.size())
}

/// Places of exact walls count as in a face of the box within this share of the scene's size.
const ROUNDING: f64 = 1e-9;
/// What is small against a box.
const SMALL: f64 = 1e-4;

fn shortest_side((low, high): &(Point3<f64>, Point3<f64>)) -> f64 {
    (high - low).min()
}

fn widened((low, high): (Point3<f64>, Point3<f64>), by: f64) -> (Point3<f64>, Point3<f64>) {
    let margin = Vector3::repeat(by);
    (low - margin, high + margin)
}

fn inside(p: &Point3<f64>, (low, high): &(Point3<f64>, Point3<f64>)) -> bool {
    (0..3).all(|i| low[i] <= p[i] && p[i] <= high[i])
}

/// A triangle cut along the faces of a box: the convex polygon inside, which may be empty, and
/// those outside. Corners within the slack of a face lie in it.
fn split(
    corners: &[Point3<f64>; 3],
    (low, high): &(Point3<f64>, Point3<f64>),
    slack: f64,
) -> (Polygon, Vec<Polygon>) {
    let mut inside = corners.to_vec();
    let mut outside = Vec::new();
    for axis in 0..3 {
        for (limit, sign) in [(low[axis], 1.0), (high[axis], -1.0)] {
            let depth = |p: &Point3<f64>| {
                let depth = (p[axis] - limit) * sign;
                if depth.abs() <= slack { 0.0 } else { depth }
            };
            if inside.iter().any(|p| depth(p) < 0.0) {
                outside.push(half(&inside, |p| -depth(p)));
            }
            inside = half(&inside, depth);
        }
    }
    (inside, outside)
}

/// Three corners, m.
pub type Triangle = [Point3<f64>; 3];

/// A convex polygon.
type Polygon = Vec<Point3<f64>>;

/// The part of a convex polygon where the depth is not negative.
fn half(polygon: &Polygon, depth: impl Fn(&Point3<f64>) -> f64) -> Polygon {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (depth(p), depth(q));
        if here >= 0.0 {
            kept.push(*p);
        }
        if (here < 0.0) != (there < 0.0) {
            kept.push(p + (q - p) * (here / (here - there)));
        }
    }
    kept
}

/// A convex polygon as triangles.
fn fan(polygon: &Polygon) -> impl Iterator<Item = Triangle> + '_ {
    let sides = polygon.windows(2).skip(1);
    sides.map(|side| [polygon[0], side[0], side[1]])
}

fn area_and_centre(polygons: impl Iterator<Item = Polygon>) -> (f64, Point3<f64>) {
    let (mut area, mut moment) = (0.0, Vector3::zeros());
    for polygon in polygons {
        for pair in polygon.windows(2).skip(1) {
            let (a, b, c) = (polygon[0], pair[0], pair[1]);
            let piece = (b - a).cross(&(c - a)).norm() / 2.0;
            area += piece;
            moment += (a.coords + b.coords + c.coords) * (piece / 3.0);
        }
    }
    (area, Point3::from(moment / area))
}

#[cfg(test)]
mod tests;
