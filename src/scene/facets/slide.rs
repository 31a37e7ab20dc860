//! Rays that slide along a facet and off its edge.

use nalgebra::Point3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

use super::{Facets, plane};
use crate::scene::LIFT;
use crate::scene::ray::Ray;
use crate::scene::start::Start;
use crate::scene::triangle::lies_on;

impl Facets {
    /// Whether a ray gets to the edge of a triangle along another one that ends there: then it passes
    /// the edge, and the triangle turns away from it.
    #[cold]
    pub(super) fn slides_off(&self, index: u32, ray: &Ray, t: f64) -> bool {
        let at = ray.origin + ray.direction * t;
        let margin = self.slack * LIFT;
        let around = Aabb::from_points([at.coords.into()]).loosened(margin);
        let leaves = self.distance_tree.intersect_aabb(&around);
        let mut others = leaves.flat_map(|leaf| self.leaf(leaf));
        others.any(|other| {
            let corners = self.corners(other);
            let before = |corner: &Point3<f64>| ray.direction.dot(&(corner - at)) < -margin;
            other != index
                && Start::runs_along(ray.direction.dot(&plane::normal(&corners)))
                && corners.iter().any(before)
                && lies_on(&at, &corners, margin)
        })
    }
}
