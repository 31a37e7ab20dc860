//! Distances between something convex and the parts that stand in the scene.

use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::gjk::{self, CsoPoint, GJKResult, VoronoiSimplex};
use parry3d_f64::shape::{Segment, SupportMap, Triangle};

use super::Scene;
use super::clearance::Convex;
use super::triangle_mesh::TriangleMesh;

/// Something convex that parts keep a distance from.
pub(super) trait ConvexBody: SupportMap {
    /// A line somewhere in the middle of it.
    fn middle(&self) -> Segment;

    /// How far it reaches in a direction, m; where that is less work than to find the point that does, it is found apart.
    fn height(&self, toward: Vector) -> f64 {
        self.local_support_point(toward).dot(toward)
    }
}

impl Scene {
    /// Distance between something convex and the nearest surface of the parts that stand in the scene, and that surface;
    /// 0 where they meet, `None` when everything is farther than `limit`.
    pub(super) fn distance_to_convex(
        &self,
        body: &impl ConvexBody,
        limit: f64,
    ) -> Option<(f64, u32)> {
        let mut nearest: Option<(f64, u32)> = None;
        for part in self.parts.iter().filter(|part| !part.on_nozzle) {
            let bound = nearest.map_or(limit, |(gap, _)| gap);
            let found = part.facets.distance_to_convex(body, bound);
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
    fn distance_to_convex(&self, body: &impl ConvexBody, limit: f64) -> Option<(f64, u32)> {
        let axes = [Vector::X, Vector::Y, Vector::Z];
        let reach = |sign: f64| axes.map(|axis| sign * body.height(axis * sign));
        let convex = Convex {
            low: Vector::from_array(reach(-1.0)),
            high: Vector::from_array(reach(1.0)),
            line: body.middle(),
            height: |toward| body.height(toward),
        };
        self.nearest_triangle(limit, &convex, |triangle, way, limit| {
            distance(body, triangle, way, limit)
        })
    }
}

/// Distance between something convex and a triangle, as far as it is below a limit; the search starts along a way between
/// them.
fn distance(body: &impl ConvexBody, triangle: &Triangle, way: Vector, limit: f64) -> f64 {
    let there = Pose::IDENTITY;
    let mut simplex = VoronoiSimplex::new();
    let start = if way == Vector::ZERO { Vector::X } else { way };
    simplex.reset(CsoPoint::from_shapes(&there, body, triangle, start));
    let found = gjk::closest_points(&there, body, triangle, limit, true, &mut simplex);
    match found {
        GJKResult::ClosestPoints(a, b, _) => (a - b).length(),
        GJKResult::NoIntersection(_) => f64::INFINITY,
        GJKResult::Intersection | GJKResult::Proximity(_) => 0.0,
    }
}
