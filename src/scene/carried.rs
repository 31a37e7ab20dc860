//! Parts that move with the nozzle, as convex pieces that must not meet the parts that stand in the scene.

use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::shape::{Segment, SupportMap};

use super::Scene;
use super::convex_body::ConvexBody;
use super::swept::Aims;
use super::triangle_mesh::TriangleMesh;

/// All places of one piece within the tolerance of the nozzle's settings.
struct SweptPiece<'a> {
    way: &'a CarriedWay,
    /// Its corner points in the frame of the nozzle, m.
    corners: &'a [Vector3<f64>],
}

/// How a nozzle stands within the tolerance of its settings.
#[derive(Clone, Debug)]
pub struct CarriedWay {
    /// Where the jets are aimed.
    pub aims: Aims,
    /// The unit vectors of the nozzle's frame: z along the jet.
    pub axes: Vec<[Vector3<f64>; 3]>,
}

impl SupportMap for SweptPiece<'_> {
    fn local_support_point(&self, dir: Vector) -> Vector {
        let toward: Vector3<f64> = dir.into();
        let mut best = (f64::NEG_INFINITY, Vector3::zeros());
        for axes in &self.way.axes {
            let along = axes.map(|axis| axis.dot(&toward));
            let [near, far] = self.way.aims.standoff;
            let standoff = if along[2] > 0.0 { near } else { far };
            for corner in self.corners {
                let there = corner - Vector3::z() * standoff;
                let height = along[0] * there.x + along[1] * there.y + along[2] * there.z;
                if height > best.0 {
                    let point = axes[0] * there.x + axes[1] * there.y + axes[2] * there.z;
                    best = (height, point);
                }
            }
        }
        (best.1 + self.way.aims.farthest(&toward)).into()
    }
}

impl ConvexBody for SweptPiece<'_> {
    /// A point.
    fn middle(&self) -> Segment {
        let centre = self.corners.iter().sum::<Vector3<f64>>() / self.corners.len() as f64;
        let aims = &self.way.aims;
        let there = centre - Vector3::z() * aims.middle_standoff();
        let each = self.way.axes.iter();
        let each = each.map(|axes| axes[0] * there.x + axes[1] * there.y + axes[2] * there.z);
        let middle = aims.centre.coords + each.sum::<Vector3<f64>>() / self.way.axes.len() as f64;
        Segment::new(middle.into(), middle.into())
    }
}

impl Scene {
    /// Distance between all places of the parts that move with the nozzle and the nearest surface of those that stand in
    /// the scene, and that surface; 0 where they meet, `None` where everything is farther than `limit`.
    pub fn distance_to_carried(&self, way: &CarriedWay, limit: f64) -> Option<(f64, u32)> {
        let nearest_to = |corners: &[Vector3<f64>], limit: f64| {
            let piece = SweptPiece { way, corners };
            self.distance_to_convex(&piece, limit)
        };
        let mut nearest: Option<(f64, u32)> = None;
        for pieces in self.carried() {
            let bound = |nearest: Option<(f64, u32)>| nearest.map_or(limit, |(gap, _)| gap);
            if nearest_to(&pieces.hull, bound(nearest)).is_none() {
                continue;
            }
            for corners in pieces.each() {
                nearest = nearest_to(corners, bound(nearest)).or(nearest);
            }
        }
        nearest
    }

    /// The farthest that a part that moves with the nozzle reaches from the exit, m; 0 where none does.
    pub fn carried_reach(&self) -> f64 {
        self.carried().map(Pieces::reach).fold(0.0, f64::max)
    }

    fn carried(&self) -> impl Iterator<Item = &Pieces> {
        let carried = self.parts.iter().filter(|part| part.on_nozzle);
        carried.map(|part| part.pieces())
    }
}

/// A part as convex pieces.
#[derive(Clone, Debug)]
pub(super) struct Pieces {
    /// Corner points of something convex round the whole, m.
    hull: Vec<Vector3<f64>>,
    /// The triangles, where the part is less than that; none where it is convex.
    triangles: Vec<[Vector3<f64>; 3]>,
}

impl Pieces {
    /// The pieces of a mesh.
    pub fn of(facets: &TriangleMesh) -> Self {
        let all = 0..facets.count() as u32;
        let triangles = all.map(|index| facets.corners(index).map(|it| it.coords));
        let triangles: Vec<[Vector3<f64>; 3]> = triangles.collect();
        let corners: Vec<Vector3<f64>> = facets.vertices().iter().map(|it| it.coords).collect();
        let size = corners.iter().map(Vector3::amax).fold(0.0, f64::max);
        let is_side = |[a, b, c]: &[Vector3<f64>; 3]| {
            let normal = (b - a)
                .cross(&(c - a))
                .try_normalize(0.0)
                .unwrap_or_default();
            let heights = corners.iter().map(|it| (it - a).dot(&normal));
            let [low, high] = heights.fold([0.0_f64; 2], |[low, high], height| {
                [low.min(height), high.max(height)]
            });
            high.min(-low) <= FLAT * size
        };
        if corners.len() > MOST_CORNERS {
            return Self {
                hull: corners_of_box(&corners),
                triangles,
            };
        }
        let is_convex = triangles.iter().all(is_side);
        Self {
            triangles: if is_convex { Vec::new() } else { triangles },
            hull: corners,
        }
    }

    /// Each of those that cover the part and no more.
    fn each(&self) -> impl Iterator<Item = &[Vector3<f64>]> {
        let whole = self.triangles.is_empty().then_some(&self.hull[..]);
        let triangles = self.triangles.iter().map(|corners| &corners[..]);
        whole.into_iter().chain(triangles)
    }

    /// How far it reaches from the origin of its frame at most, m.
    fn reach(&self) -> f64 {
        self.hull.iter().map(Vector3::norm).fold(0.0, f64::max)
    }
}

fn corners_of_box(points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let low = points.iter().fold(points[0], |low, point| low.inf(point));
    let high = points.iter().fold(points[0], |high, point| high.sup(point));
    let corner = |bits: u32| {
        let at = |axis: usize| [low, high][(bits >> axis & 1) as usize][axis];
        Vector3::new(at(0), at(1), at(2))
    };
    (0..8).map(corner).collect()
}

/// Heights over a plane, relative to the size of a part, that are rounding.
const FLAT: f64 = 1e-9;
/// Of more corners a box round them is looked at first.
const MOST_CORNERS: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::part::{Ends, Part, Place, Segment as Piece, Shape};
    use crate::scene::Walls;

    fn block(name: &str, min: [f64; 3], max: [f64; 3], on_nozzle: bool) -> Part {
        Part {
            name: name.into(),
            shape: Shape::Box {
                min: min.into(),
                max: max.into(),
            },
            place: Place::default(),
            on_nozzle,
            cut: Vec::new(),
        }
    }

    /// A nozzle at the origin that shoots along z of the scene.
    fn way() -> CarriedWay {
        aimed([0.0, 0.0, 5.0], [Vector3::zeros(); 4])
    }

    fn aimed(centre: [f64; 3], shifts: [Vector3<f64>; 4]) -> CarriedWay {
        CarriedWay {
            aims: Aims {
                centre: centre.into(),
                shifts,
                standoff: [5.0; 2],
            },
            axes: vec![[Vector3::x(), Vector3::y(), Vector3::z()]],
        }
    }

    #[test]
    fn a_pin_is_as_far_from_a_wall_as_the_nearest_of_its_places() {
        let pin = block("pin", [-1.0, -1.0, 2.0], [1.0, 1.0, 4.0], true);
        let wall = block("wall", [3.0, -9.0, -9.0], [4.0, 9.0, 9.0], false);
        let scene = Scene::build(&[pin, wall], Walls::Exact).expect("it is sound");
        assert!((scene.carried_reach() - 18.0_f64.sqrt()).abs() < 1e-12);
        let distance =
            |way: &CarriedWay| scene.distance_to_carried(way, 9.0).expect("it is near").0;
        assert!((distance(&way()) - 2.0).abs() < 1e-9);
        let shifts = [
            Vector3::x() * 0.5,
            Vector3::y() * 0.3,
            Vector3::zeros(),
            Vector3::zeros(),
        ];
        let shifted = aimed([0.0, 0.0, 5.0], shifts);
        assert!((distance(&shifted) - 1.5).abs() < 1e-9);
        // Turned by 45 degrees about its own axis a corner is nearest, or a side as before.
        let root = 0.5_f64.sqrt();
        let turned = [
            Vector3::new(root, root, 0.0),
            Vector3::new(-root, root, 0.0),
            Vector3::z(),
        ];
        let either = CarriedWay {
            axes: vec![way().axes[0], turned],
            ..way()
        };
        assert!((distance(&either) - (3.0 - 2.0_f64.sqrt())).abs() < 1e-9);
        // From farther back it is the same wall, until it meets it.
        let met = aimed([2.5, 0.0, 5.0], [Vector3::zeros(); 4]);
        assert_eq!(distance(&met), 0.0);
        assert_eq!(scene.distance_to_carried(&way(), 1.9), None);
    }

    /// A fork round a rail: its hull meets the rail, and the fork does not.
    #[test]
    fn what_is_hollow_meets_only_what_meets_its_walls() {
        let corners = [
            [-3.0, 0.0],
            [-3.0, 6.0],
            [-2.0, 6.0],
            [-2.0, 1.0],
            [2.0, 1.0],
            [2.0, 6.0],
            [3.0, 6.0],
            [3.0, 0.0],
        ];
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        let profile = pairs.map(|(&from, &to)| Piece {
            from: from.into(),
            to: to.into(),
            via: None,
            surface: "side".into(),
        });
        let fork = Part {
            shape: Shape::Extrude {
                profile: profile.collect(),
                length: 4.0,
                ends: Ends {
                    near_closed: true,
                    far_closed: true,
                },
            },
            ..block("fork", [0.0; 3], [0.0; 3], true)
        };
        let rail = block("rail", [-1.5, 2.0, -9.0], [1.5, 9.0, 9.0], false);
        let scene = Scene::build(&[fork, rail], Walls::Exact).expect("it is sound");
        assert!(!scene.parts[0].pieces().triangles.is_empty());
        let distance = |aim: [f64; 3]| {
            let way = aimed(aim, [Vector3::zeros(); 4]);
            scene.distance_to_carried(&way, 9.0).expect("it is near").0
        };
        assert!((distance([0.0, 0.0, 5.0]) - 0.5).abs() < 1e-9);
        assert!((distance([0.25, 0.0, 5.0]) - 0.25).abs() < 1e-9);
        assert_eq!(distance([0.75, 0.0, 5.0]), 0.0);
    }
}
