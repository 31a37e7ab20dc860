//! What a nozzle sweeps while its settings err within their tolerance, and how near that comes to a part.
//!
//! The exit lies at `aim - standoff d`. Aim points fill a box, standoffs a range, and directions d a patch
//! of the unit sphere, given by a grid. What the body sweeps is taken to be the convex hull of the bodies at
//! all of them: exact along the walls of a bore, and too large towards the aim point by no more than a
//! direction's patch bulges.

use nalgebra::{Point3, Vector3};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::gjk::{self, CsoPoint, GJKResult, VoronoiSimplex};
use parry3d_f64::shape::{Segment, SupportMap, Triangle};
use wide::f64x4;

use super::Scene;
use super::clearance::Convex;
use super::triangle_mesh::TriangleMesh;

/// What of the nozzle must not touch a wall, round the exit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Core {
    /// The centre of the exit.
    Exit,
    /// A line from there, m, in a fixed direction or back along the jet.
    Line {
        /// m.
        length: f64,
        /// Unit vector; back along the jet when absent.
        direction: Option<Vector3<f64>>,
    },
    /// The disc of the exit.
    Disc {
        /// m.
        radius: f64,
    },
}

impl Core {
    /// How far it reaches from the exit, m.
    pub fn length(&self) -> f64 {
        match *self {
            Self::Exit => 0.0,
            Self::Line { length, .. } => length,
            Self::Disc { radius } => radius,
        }
    }
}

/// Where the jets of a nozzle are aimed within the tolerance of its settings, and from how far.
#[derive(Clone, Copy, Debug)]
pub struct Aims {
    /// Centre of the aim points, m.
    pub centre: Point3<f64>,
    /// Half the edges of their box, m, and half the way of a stroke.
    pub shifts: [Vector3<f64>; 4],
    /// Smallest and largest standoff, m.
    pub standoff: [f64; 2],
}

impl Aims {
    /// The aim point that is farthest in a direction, m.
    pub(super) fn farthest(&self, toward: &Vector3<f64>) -> Vector3<f64> {
        let shifts = self.shifts.iter().map(|shift| {
            if shift.dot(toward) < 0.0 {
                -shift
            } else {
                *shift
            }
        });
        self.centre.coords + shifts.sum::<Vector3<f64>>()
    }

    /// The standoff in the middle, m.
    pub(super) fn middle_standoff(&self) -> f64 {
        (self.standoff[0] + self.standoff[1]) / 2.0
    }
}

/// All places of the core of a nozzle's body within the tolerance of its settings.
#[derive(Clone, Debug)]
pub struct Swept {
    /// Where the jets are aimed.
    pub aims: Aims,
    /// Directions of the jet.
    pub directions: Directions,
    /// What is swept.
    pub core: Core,
}

/// Unit vectors, four to a lane: most of the work of a distance is to find the one that reaches farthest.
#[derive(Clone, Debug)]
pub struct Directions {
    /// Coordinates of four at a time; the last one fills up what is left.
    lanes: Vec<[f64x4; 3]>,
}

impl Directions {
    /// Of at least one unit vector.
    pub fn new(directions: &[Vector3<f64>]) -> Self {
        let lane = |four: &[Vector3<f64>]| {
            let at = |index: usize| four[index.min(four.len() - 1)];
            [0, 1, 2].map(|axis| f64x4::from([0, 1, 2, 3].map(|index| at(index)[axis])))
        };
        Self {
            lanes: directions.chunks(4).map(lane).collect(),
        }
    }

    /// The unit vector in the middle of them.
    fn mean(&self) -> Vector3<f64> {
        let lanes = self.lanes.iter();
        let sum = lanes.map(|lane| Vector3::from(lane.map(|it| it.reduce_add())));
        sum.sum::<Vector3<f64>>().normalize()
    }

    /// The largest `height`, given how far each goes ahead in a direction.
    #[inline(always)]
    fn highest(&self, toward: &Vector3<f64>, height: impl Fn(f64x4) -> f64x4) -> f64 {
        let [x, y, z] = [toward.x, toward.y, toward.z].map(f64x4::splat);
        let heights = self
            .lanes
            .iter()
            .map(|[a, b, c]| height(*a * x + *b * y + *c * z));
        let most = heights.fold(f64x4::splat(f64::NEG_INFINITY), f64x4::fast_max);
        most.to_array()
            .into_iter()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// The first one of those for which `height` is largest, given how far each goes ahead in a direction.
    fn farthest(&self, toward: &Vector3<f64>, height: impl Fn(f64x4) -> f64x4) -> Vector3<f64> {
        let [x, y, z] = [toward.x, toward.y, toward.z].map(f64x4::splat);
        let heights = |[a, b, c]: &[f64x4; 3]| height(*a * x + *b * y + *c * z);
        let (mut most, mut lanes) = (f64x4::splat(f64::NEG_INFINITY), [f64x4::ZERO; 3]);
        for lane in &self.lanes {
            let here = heights(lane);
            let is_more = here.simd_gt(most);
            most = is_more.select(here, most);
            for (kept, lane) in lanes.iter_mut().zip(lane) {
                *kept = is_more.select(*lane, *kept);
            }
        }
        let most = most.to_array();
        let index = (1..4).fold(0, |best, it| if most[it] > most[best] { it } else { best });
        Vector3::from(lanes.map(|lane| lane.to_array()[index]))
    }
}

impl SupportMap for Swept {
    fn local_support_point(&self, dir: Vector) -> Vector {
        let toward: Vector3<f64> = dir.into();
        let jet = self.directions.farthest(&toward, self.heights(&toward));
        (self.farthest_point(&jet, &toward) + self.aims.farthest(&toward)).into()
    }
}

/// Something convex that parts keep a distance from.
pub(super) trait SweptBody: SupportMap {
    /// A line somewhere in the middle of it.
    fn middle(&self) -> Segment;

    /// How far it reaches in a direction, m: less work than the point where it does.
    fn height(&self, toward: Vector) -> f64;
}

impl SweptBody for Swept {
    fn middle(&self) -> Segment {
        let jet = self.directions.mean();
        let exit = self.aims.centre.coords - jet * self.aims.middle_standoff();
        let end = match self.core {
            Core::Line { length, direction } => exit + direction.unwrap_or(-jet) * length,
            Core::Exit | Core::Disc { .. } => exit,
        };
        Segment::new(exit.into(), end.into())
    }

    fn height(&self, toward: Vector) -> f64 {
        let toward: Vector3<f64> = toward.into();
        let beyond = match self.core {
            Core::Line {
                length,
                direction: Some(direction),
            } => (direction.dot(&toward) * length).max(0.0),
            _ => 0.0,
        };
        let highest = self.directions.highest(&toward, self.heights(&toward));
        highest + beyond + self.aims.farthest(&toward).dot(&toward)
    }
}

impl Swept {
    /// How far the cores of jets reach in a direction from where they are aimed, given how far each jet goes ahead in
    /// it; a line in a fixed direction from its exit.
    #[inline(always)]
    fn heights(&self, toward: &Vector3<f64>) -> impl Fn(f64x4) -> f64x4 {
        let [near, far] = self.aims.standoff.map(f64x4::splat);
        let back = move |ahead: f64x4| ahead.simd_gt(f64x4::ZERO).select(near, far) * ahead;
        let square = f64x4::splat(toward.norm_squared());
        let (length, disc) = match self.core {
            Core::Exit
            | Core::Line {
                direction: Some(_), ..
            } => (0.0, None),
            Core::Line { length, .. } => (length, None),
            Core::Disc { radius } => (0.0, Some(radius)),
        };
        move |ahead| {
            let reach = match disc {
                Some(radius) => (square - ahead * ahead).fast_max(f64x4::ZERO).sqrt() * radius,
                None => (-ahead * length).fast_max(f64x4::ZERO),
            };
            reach - back(ahead)
        }
    }

    /// The point of the core of a jet that is farthest in a direction, from where it is aimed.
    fn farthest_point(&self, jet: &Vector3<f64>, toward: &Vector3<f64>) -> Vector3<f64> {
        let ahead = jet.dot(toward);
        let beyond = match self.core {
            Core::Exit => Vector3::zeros(),
            Core::Line { length, direction } => {
                let end = direction.unwrap_or(-jet) * length;
                if end.dot(toward) > 0.0 {
                    end
                } else {
                    Vector3::zeros()
                }
            }
            Core::Disc { radius } => {
                let across = toward - jet * ahead;
                across.try_normalize(0.0).unwrap_or_default() * radius
            }
        };
        let [near, far] = self.aims.standoff;
        beyond - jet * if ahead > 0.0 { near } else { far }
    }
}

impl Scene {
    /// Distance between all places of a nozzle's core and the nearest surface of the parts that stand in
    /// the scene, and that surface; 0 where they meet, `None` when everything is farther than `limit`.
    pub fn distance_to_swept(&self, swept: &Swept, limit: f64) -> Option<(f64, u32)> {
        self.distance_to_convex(swept, limit)
    }

    /// The same for anything convex.
    pub(super) fn distance_to_convex(
        &self,
        convex: &impl SweptBody,
        limit: f64,
    ) -> Option<(f64, u32)> {
        let mut nearest: Option<(f64, u32)> = None;
        for part in self.parts.iter().filter(|part| !part.on_nozzle) {
            let bound = nearest.map_or(limit, |(gap, _)| gap);
            let found = part.facets.distance_to_convex(convex, bound);
            if let Some((distance, triangle)) = found {
                nearest = Some((distance, part.facets.surface(triangle)));
            }
        }
        nearest
    }
}

impl TriangleMesh {
    /// Distance between something convex and the nearest triangle, and that triangle; 0 where they meet, `None` where
    /// everything is farther than `limit`.
    fn distance_to_convex(&self, swept: &impl SweptBody, limit: f64) -> Option<(f64, u32)> {
        let axes = [Vector::X, Vector::Y, Vector::Z];
        let reach = |sign: f64| axes.map(|axis| sign * swept.height(axis * sign));
        let (low, high) = (
            Vector::from_array(reach(-1.0)),
            Vector::from_array(reach(1.0)),
        );
        let convex = Convex {
            low,
            high,
            line: swept.middle(),
            height: |toward| swept.height(toward),
        };
        self.nearest_triangle(limit, &convex, |triangle, way, limit| {
            distance(swept, triangle, way, limit)
        })
    }
}

/// Distance between what is swept and a triangle, as far as it is below a limit; the search starts along a way between
/// them.
fn distance(swept: &impl SupportMap, triangle: &Triangle, way: Vector, limit: f64) -> f64 {
    let there = Pose::IDENTITY;
    let mut simplex = VoronoiSimplex::new();
    let start = if way == Vector::ZERO { Vector::X } else { way };
    simplex.reset(CsoPoint::from_shapes(&there, swept, triangle, start));
    let found = gjk::closest_points(&there, swept, triangle, limit, true, &mut simplex);
    match found {
        GJKResult::ClosestPoints(a, b, _) => (a - b).length(),
        GJKResult::NoIntersection(_) => f64::INFINITY,
        GJKResult::Intersection | GJKResult::Proximity(_) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::part::{Part, Place, Shape};
    use crate::scene::Walls;

    fn block() -> Scene {
        let part = Part {
            name: "block".into(),
            shape: Shape::Box {
                min: Point3::new(-1.0, -1.0, -1.0),
                max: Point3::new(1.0, 1.0, 0.0),
            },
            place: Place::default(),
            on_nozzle: false,
            cut: Vec::new(),
        };
        Scene::build(&[part], Walls::Exact).expect("it is sound")
    }

    fn swept(core: Core, direction: Vector3<f64>, shifts: [f64; 3]) -> Swept {
        let [x, y, z] = shifts;
        Swept {
            aims: Aims {
                centre: Point3::origin(),
                shifts: [
                    Vector3::x() * x,
                    Vector3::y() * y,
                    Vector3::z() * z,
                    Vector3::zeros(),
                ],
                standoff: [2.0, 3.0],
            },
            directions: Directions::new(&[direction.normalize()]),
            core,
        }
    }

    #[test]
    fn distances_are_those_of_the_nearest_place() {
        let scene = block();
        let down = -Vector3::z();
        for (core, direction, shifts, expected) in [
            (Core::Exit, down, [0.0; 3], 2.0),
            (Core::Exit, down, [0.0, 0.0, 0.5], 1.5),
            (Core::Disc { radius: 0.3 }, down, [0.0; 3], 2.0),
            // Upright beside the block: the rim is nearest.
            (
                Core::Disc { radius: 0.3 },
                -Vector3::x(),
                [0.1, 0.0, 0.0],
                0.9_f64,
            ),
            (
                Core::Line {
                    length: 1.5,
                    direction: Some(down),
                },
                down,
                [0.0; 3],
                0.5,
            ),
            (
                Core::Line {
                    length: 9.0,
                    direction: None,
                },
                down,
                [0.0; 3],
                2.0,
            ),
        ] {
            let swept = swept(core, direction, shifts);
            let (found, _) = scene.distance_to_swept(&swept, 9.0).expect("it is near");
            assert!(
                (found - expected).abs() < 1e-9,
                "{core:?}: {found} {expected}"
            );
        }
    }

    /// The nearest of many places on a grid is never nearer, and hardly farther.
    #[test]
    fn the_hull_is_as_near_as_the_nearest_of_many_places() {
        let scene = block();
        let tilt = |a: f64, b: f64| Vector3::new(a.sin() * b.cos(), a.sin() * b.sin(), -a.cos());
        let step = |k: i32, half: f64| half * f64::from(k) / 8.0;
        for (polar, turn) in [(0.4, 0.3), (0.9, 2.0), (1.4, 4.0)] {
            let mut directions = Vec::new();
            for i in -2..=2 {
                for j in -2..=2 {
                    directions.push(tilt(
                        polar + 0.035 * f64::from(i) / 2.0,
                        turn + 0.035 * f64::from(j) / 2.0,
                    ));
                }
            }
            let swept = Swept {
                aims: Aims {
                    centre: Point3::new(1.05, 0.0, 0.1),
                    shifts: [
                        Vector3::x() * 0.02,
                        Vector3::y() * 0.02,
                        Vector3::zeros(),
                        Vector3::zeros(),
                    ],
                    standoff: [0.9, 1.1],
                },
                directions: Directions::new(&directions),
                core: Core::Line {
                    length: 1.0,
                    direction: Some(Vector3::new(-0.6, 0.0, 0.8)),
                },
            };
            let (found, _) = scene.distance_to_swept(&swept, 9.0).expect("it is near");
            let mut least = f64::INFINITY;
            for i in -8..=8 {
                for j in -8..=8 {
                    let jet = tilt(polar + step(i, 0.035), turn + step(j, 0.035));
                    for standoff in [0.9, 0.95, 1.0, 1.05, 1.1] {
                        for (x, y) in [(-0.02, -0.02), (-0.02, 0.02), (0.02, -0.02), (0.02, 0.02)] {
                            let from = swept.aims.centre + Vector3::new(x, y, 0.0) - jet * standoff;
                            let to = from + Vector3::new(-0.6, 0.0, 0.8);
                            let facets = &scene.parts[0].facets;
                            let near = facets.distance_to_segment(&from, &to, 9.0);
                            least = least.min(near.expect("it is near").0);
                        }
                    }
                }
            }
            let bulge = 1.1 * 0.035 * 0.035;
            assert!(found < least + 0.1 * bulge, "{found} {least}");
            assert!(found > least - bulge, "{found} {least}");
        }
    }
}
