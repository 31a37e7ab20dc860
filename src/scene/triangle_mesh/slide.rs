//! Rays that slide along a facet and off its edge.

use nalgebra::Point3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

use super::{TriangleMesh, plane};
use crate::scene::LIFT;
use crate::scene::departure::Departure;
use crate::scene::ray::Ray;
use crate::scene::triangle::lies_on;

/// What is known of a ray where it passes an edge. At the tip of a cone of facets it passes the edges of
/// all of them: each would search all the others.
#[derive(Default)]
pub(super) struct Slide {
    /// Where the ray was looked at last, m.
    last: Option<f64>,
    /// A facet along which the ray has got to an edge.
    along: Option<u32>,
}

impl TriangleMesh {
    /// Whether a ray gets to the edge of a triangle, which it crosses at `t` (m), along another one that
    /// ends there: then it passes the edge, and the triangle turns away from it.
    #[cold]
    pub(super) fn slides_off(&self, ray: &Ray, t: f64, known: &mut Slide) -> bool {
        let at = ray.origin + ray.direction * t;
        let margin = self.slack * LIFT;
        // Never the triangle itself, which the ray crosses more steeply than that.
        let ends_here = |&other: &u32| {
            let corners = self.corners(other);
            let before = |corner: &Point3<f64>| ray.direction.dot(&(corner - at)) < -margin;
            Departure::runs_along(ray.direction.dot(&plane::normal(&corners)))
                && corners.iter().any(before)
                && lies_on(&at, &corners, margin)
        };
        if known.along.as_ref().is_some_and(ends_here) {
            return true;
        }
        if known.last.replace(t) == Some(t) {
            return false;
        }
        let around = Aabb::from_points([at.coords.into()]).loosened(margin);
        let leaves = self.distance_tree.intersect_aabb(&around);
        known.along = leaves
            .flat_map(|leaf| self.meshlet(leaf).triangles().iter().copied())
            .find(ends_here);
        known.along.is_some()
    }
}
