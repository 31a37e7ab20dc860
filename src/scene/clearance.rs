//! Distances from points and rods to the facets of a part, over parry's tree.

use std::cell::RefCell;

use nalgebra::{Point3, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{BvhLeafCost, BvhNode};
use parry3d_f64::query::PointQuery;
use parry3d_f64::query::details::closest_points_segment_segment_with_locations_nD;
use parry3d_f64::shape::{Segment, Triangle};

use super::triangle_mesh::{Meshlet, TriangleMesh};

/// The point of a mesh nearest to a given one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NearestPoint {
    pub distance: f64,
    pub triangle: u32,
    pub point: Point3<f64>,
}

/// A triangle at a distance.
struct Neighbour {
    distance: f64,
    triangle: u32,
}

impl BvhLeafCost for Neighbour {
    fn cost(&self) -> f64 {
        self.distance
    }
}

impl Neighbour {
    /// Nothing that is nearer than a limit.
    fn none(limit: f64) -> Self {
        Self {
            distance: limit,
            triangle: u32::MAX,
        }
    }
}

fn nearest_of(candidates: impl Iterator<Item = (f64, u32)>) -> Option<Neighbour> {
    candidates
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(distance, triangle)| Neighbour { distance, triangle })
}

impl TriangleMesh {
    /// The nearest point on the triangles that `counts` lets in.
    pub(super) fn nearest_point(
        &self,
        to: &Point3<f64>,
        counts: impl Fn(u32) -> bool,
    ) -> Option<NearestPoint> {
        let centre: Vector = to.coords.into();
        let point = Convex::of(Segment::new(centre, centre));
        let (_, found) = self.distance_tree().find_best(
            f64::INFINITY,
            |node, _| point.gap(node),
            |leaf, best| {
                let meshlet = self.meshlet(leaf);
                if self.least_distance(meshlet, &point, best) >= best {
                    return None;
                }
                let triangles = meshlet.triangles().iter().copied();
                nearest_of(triangles.filter(|&index| counts(index)).map(|index| {
                    let projection = self.triangle(index).project_local_point(centre, true);
                    ((projection.point - centre).length(), index)
                }))
            },
        )?;
        let triangle = found.triangle;
        let nearest = self.triangle(triangle).project_local_point(centre, true);
        let point: Vector3<f64> = nearest.point.into();
        Some(NearestPoint {
            distance: (point - to.coords).norm(),
            triangle,
            point: Point3::from(point),
        })
    }

    /// Distance from the straight line between two points to the nearest triangle, and its index;
    /// `None` when everything is farther than `limit`. 0 where the line passes through a triangle.
    pub(super) fn distance_to_segment(
        &self,
        from: &Point3<f64>,
        to: &Point3<f64>,
        limit: f64,
    ) -> Option<(f64, u32)> {
        let line = Segment::new(from.coords.into(), to.coords.into());
        self.nearest_triangle(limit, &Convex::of(line), |triangle, _, _| {
            segment_triangle(&line, triangle)
        })
    }

    /// The least distance of something convex from a triangle, by `distance`, which is told nearly the shortest way there
    /// and may stop at the limit that it is given, and the index of that one; `None` when everything is farther than `limit`.
    pub(super) fn nearest_triangle<H: Fn(Vector) -> f64>(
        &self,
        limit: f64,
        convex: &Convex<H>,
        distance: impl Fn(&Triangle, Vector, f64) -> f64,
    ) -> Option<(f64, u32)> {
        let nearer = |nearest: Neighbour, index: u32| {
            let triangle = self.triangle(index);
            let way = convex.way_to(&triangle);
            if convex.is_beyond(&triangle, way, nearest.distance) {
                return nearest;
            }
            let distance = distance(&triangle, way, nearest.distance);
            if distance < nearest.distance {
                let triangle = index;
                Neighbour { distance, triangle }
            } else {
                nearest
            }
        };
        // Of many meshlets that are about as far one triangle each shows well how far the nearest one is at most.
        let reached = RefCell::new(Vec::new());
        let first_look = |leaf, limit| {
            let bound = self.least_distance(self.meshlet(leaf), convex, limit);
            if bound >= limit {
                return None;
            }
            reached.borrow_mut().push((bound, leaf));
            Some(nearer(Neighbour::none(limit), self.meshlet(leaf).middle()))
        };
        let tree = self.distance_tree();
        let seen = tree.find_best(limit, |node, _| convex.gap(node), first_look);
        let seen = seen.map_or(Neighbour::none(limit), |(_, nearest)| nearest);
        let mut reached = reached.into_inner();
        reached.sort_by(|a, b| a.0.total_cmp(&b.0));
        let found = reached.into_iter().fold(seen, |nearest, (bound, leaf)| {
            if bound >= nearest.distance {
                return nearest;
            }
            let triangles = self.meshlet(leaf).triangles().iter().copied();
            triangles.fold(nearest, nearer)
        });
        (found.distance < limit).then_some((found.distance, found.triangle))
    }

    /// How far (m) a meshlet is at least from something convex: its own plane tells that it is beyond `limit`, or else
    /// one across the way between both.
    fn least_distance<H: Fn(Vector) -> f64>(
        &self,
        meshlet: &Meshlet,
        convex: &Convex<H>,
        limit: f64,
    ) -> f64 {
        let (toward, height) = meshlet.plane_from(convex.line.a);
        let bound = height - (convex.height)(toward);
        if bound >= limit {
            return bound;
        }
        let way = convex.way_to(&self.triangle(meshlet.middle()));
        let Some(toward) = way.try_normalize() else {
            return 0.0;
        };
        meshlet.nearest_along(toward) - (convex.height)(toward)
    }

    pub(super) fn triangle(&self, index: u32) -> Triangle {
        let [a, b, c] = self.corners(index).map(|corner| corner.coords.into());
        Triangle::new(a, b, c)
    }
}

/// Something convex, as a walk to the nearest triangle sees it.
pub(super) struct Convex<H> {
    /// Corners of its box, m.
    pub low: Vector,
    pub high: Vector,
    /// A line in the middle of it.
    pub line: Segment,
    /// How far it reaches in a direction.
    pub height: H,
}

impl Convex<()> {
    /// A line, or a point where its ends are the same.
    fn of(line: Segment) -> Convex<impl Fn(Vector) -> f64> {
        Convex {
            low: line.a.min(line.b),
            high: line.a.max(line.b),
            height: move |toward: Vector| line.a.dot(toward).max(line.b.dot(toward)),
            line,
        }
    }
}

impl<H: Fn(Vector) -> f64> Convex<H> {
    /// Distance between its box and that of a tree node.
    fn gap(&self, node: &BvhNode) -> f64 {
        let apart = (node.mins() - self.high).max(self.low - node.maxs());
        apart.max(Vector::ZERO).length()
    }

    /// Whether a plane across the way to a triangle proves that this is at least `limit` away: one look
    /// at how far it reaches along a direction, where a distance takes many.
    fn is_beyond(&self, triangle: &Triangle, way: Vector, limit: f64) -> bool {
        let apart = way.length();
        if apart <= limit {
            return false;
        }
        let toward = way / apart;
        let corners = [triangle.a, triangle.b, triangle.c];
        let nearest = corners.map(|corner| corner.dot(toward));
        nearest.into_iter().fold(f64::INFINITY, f64::min) - (self.height)(toward) >= limit
    }

    /// Nearly the shortest way from its line to a triangle.
    fn way_to(&self, triangle: &Triangle) -> Vector {
        let middle = (triangle.a + triangle.b + triangle.c) / 3.0;
        let from = self.line.project_local_point(middle, true).point;
        let to = triangle.project_local_point(from, true).point;
        to - self.line.project_local_point(to, true).point
    }
}

fn segment_triangle(segment: &Segment, triangle: &Triangle) -> f64 {
    let to_point = |p: Vector| (triangle.project_local_point(p, true).point - p).length();
    if crosses(segment, triangle) {
        return 0.0;
    }
    let edges = triangle.edges();
    let to_edges = edges.iter().map(|edge| {
        let (on_segment, on_edge) = closest_points_segment_segment_with_locations_nD(
            (&segment.a, &segment.b),
            (&edge.a, &edge.b),
        );
        (segment.point_at(&on_segment) - edge.point_at(&on_edge)).length()
    });
    to_edges.fold(to_point(segment.a).min(to_point(segment.b)), f64::min)
}

fn crosses(segment: &Segment, triangle: &Triangle) -> bool {
    let normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
    let (from, to) = (
        (segment.a - triangle.a).dot(normal),
        (segment.b - triangle.a).dot(normal),
    );
    if from * to > 0.0 || from == to {
        return false;
    }
    let point = segment.a + (segment.b - segment.a) * (from / (from - to));
    let side = |p: Vector, q: Vector| (q - p).cross(point - p).dot(normal) >= 0.0;
    side(triangle.a, triangle.b) && side(triangle.b, triangle.c) && side(triangle.c, triangle.a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rod_is_as_far_from_a_triangle_as_its_nearest_point() {
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]].map(Vector::from_array);
        let [a, b, c] = corners;
        let away = Vector::new(7.0, -5.0, 2.5);
        for (triangle, shift) in [
            (Triangle::new(a, b, c), Vector::ZERO),
            (Triangle::new(c, b, a), Vector::ZERO),
            (Triangle::new(a + away, b + away, c + away), away),
            (Triangle::new(b - away, c - away, a - away), -away),
        ] {
            for (from, to, distance) in [
                // Through it, upright and slanted, either way.
                ([1.0, 1.0, -1.0], [1.0, 1.0, 2.0], 0.0),
                ([0.0, 1.0, -1.0], [3.0, 1.0, 2.0], 0.0),
                ([3.0, 1.0, 2.0], [0.0, 1.0, -1.0], 0.0),
                ([1.0, 1.0, -1.0], [1.0, 1.0, 0.0], 0.0),
                // Over it, and beside it.
                ([1.0, 1.0, 1.0], [1.0, 1.0, 2.0], 1.0),
                ([1.0, 1.0, -2.0], [1.0, 1.0, -3.0], 2.0),
                ([2.6, 2.3, -1.0], [2.6, 2.3, 2.0], 1.0),
                ([1.0, -2.0, -1.0], [1.0, -2.0, 2.0], 2.0),
                ([-3.0, 1.0, -1.0], [-3.0, 1.0, 2.0], 3.0),
                // Through its plane beyond the longest side, whose nearest point is (2, 1.5).
                ([2.6, 2.3, 1.0], [2.6, 2.3, -4.0], 1.0),
                // In its plane, and parallel to it.
                ([1.0, 1.0, 0.0], [9.0, 1.0, 0.0], 0.0),
                ([1.0, 1.0, 0.5], [9.0, 1.0, 0.5], 0.5),
                ([5.0, 0.0, 0.0], [9.0, 0.0, 0.0], 1.0),
            ] {
                let ends = [from, to].map(|end| Vector::from_array(end) + shift);
                let segment = Segment::new(ends[0], ends[1]);
                let found = segment_triangle(&segment, &triangle);
                assert!((found - distance).abs() < 1e-12, "{from:?} {to:?}: {found}");
            }
        }
    }

    /// Of rods and points all over a bore with a keyway, on their way through walls, too.
    #[test]
    fn the_nearest_of_all_triangles_is_found() {
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("problems/keyway.yaml");
        let study = crate::study::Study::open(&file).expect("it is sound");
        let facets = &study.scenario().scene.parts[0].facets;
        let (low, high) =
            (0..facets.count() as u32).fold((Vector::MAX, Vector::MIN), |(low, high), index| {
                let triangle = facets.triangle(index);
                let corners = [triangle.a, triangle.b, triangle.c];
                corners
                    .into_iter()
                    .fold((low, high), |(low, high), it| (low.min(it), high.max(it)))
            });
        let mut crossing = 0;
        for number in 0..300 {
            let at = |first: u32| {
                let spread = [0, 1, 2].map(|axis| {
                    f64::from(sobol_burley::sample(number, first + axis, 3)) * 1.4 - 0.2
                });
                let point = low + (high - low) * Vector::from_array(spread);
                Point3::from(Vector3::from(point))
            };
            let (from, to) = (at(0), at(3));
            let segment = Segment::new(from.coords.into(), to.coords.into());
            let all = 0..facets.count() as u32;
            let distances = all.map(|index| segment_triangle(&segment, &facets.triangle(index)));
            let least = distances.fold(f64::INFINITY, f64::min);
            let is_least = |distance: f64| (distance - least).abs() <= 1e-15;
            let found = facets.distance_to_segment(&from, &to, f64::INFINITY);
            let (distance, triangle) = found.expect("there is one");
            let there = segment_triangle(&segment, &facets.triangle(triangle));
            assert!(is_least(distance) && is_least(there), "{from} {to}");
            // A limit leaves out what is no nearer, and nothing else.
            assert_eq!(facets.distance_to_segment(&from, &to, 0.9 * least), None);
            let within = facets.distance_to_segment(&from, &to, 1.1 * least);
            assert_eq!(within.is_some_and(|it| is_least(it.0)), least > 0.0);
            crossing += u32::from(least == 0.0);

            let point = facets.nearest_point(&from, |_| true).expect("there is one");
            let centre: Vector = from.coords.into();
            let all = 0..facets.count() as u32;
            let distances = all.map(|index| {
                let nearest = facets
                    .triangle(index)
                    .project_local_point(centre, true)
                    .point;
                (nearest - centre).length()
            });
            let least = distances.fold(f64::INFINITY, f64::min);
            assert!((point.distance - least).abs() <= 1e-15, "{from}");
        }
        assert!((50..250).contains(&crossing), "{crossing}");
    }
}
