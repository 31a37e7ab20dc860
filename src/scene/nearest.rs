//! The place on a surface that is nearest to a point.

use nalgebra::{Point3, Vector3};

use super::Scene;
use super::part::FreeSide;
use super::ray::Ray;
use crate::elementary::sin_cos;

/// The place on a surface that is nearest to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    /// Index of its part.
    pub part: u32,
    /// Index of its triangle in that part.
    pub triangle: u32,
    /// m.
    pub point: Point3<f64>,
    /// Unit normal of the triangle on its front.
    pub facet_normal: Vector3<f64>,
    /// Unit normal of the surface on its front.
    pub front: Vector3<f64>,
}

impl Scene {
    /// The point of a surface that stands in the scene nearest to a given point, and the unit
    /// normal there towards free space.
    pub fn nearest_on_surface(
        &self,
        to: &Point3<f64>,
        surface: u32,
    ) -> Option<(Point3<f64>, Vector3<f64>)> {
        let foot = self.foot(to, surface)?;
        let normal = match self.parts[foot.part as usize].free {
            FreeSide::Back => -foot.front,
            FreeSide::Front | FreeSide::Round | FreeSide::Either => foot.front,
        };
        Some((foot.point, normal))
    }

    /// The same with the triangle that it is on.
    pub(super) fn foot(&self, to: &Point3<f64>, surface: u32) -> Option<Foot> {
        let standing = self.parts.iter().enumerate();
        let standing = standing.filter(|(_, part)| !part.on_nozzle);
        let candidates = standing.filter_map(|(index, part)| {
            let on_it = |triangle| part.facets.surface(triangle) == surface;
            let nearest = part.facets.nearest_point(to, on_it)?;
            Some((index as u32, nearest))
        });
        let (part, nearest) = candidates.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance))?;
        let facets = &self.parts[part as usize].facets;
        let [a, b, c] = facets.corners(nearest.triangle);
        let facet_normal = (b - a).cross(&(c - a)).normalize();
        // Exact walls know their normal better than the facet that stands in for them.
        let ray = Ray {
            origin: nearest.point + facet_normal * (1e-3 * self.reach),
            direction: -facet_normal,
        };
        let wall = self.parts[part as usize].first_crossing(&ray, None, false, f64::INFINITY);
        let front = match wall {
            Some((crossing, front)) if crossing.surface == surface && crossing.front => front,
            _ => facet_normal,
        };
        Some(Foot {
            part,
            triangle: nearest.triangle,
            point: nearest.point,
            facet_normal,
            front,
        })
    }
}

/// One of `count` directions that are spread evenly over the sphere along a golden spiral.
pub(super) fn spiral_direction(index: usize, count: usize) -> Vector3<f64> {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let z = 1.0 - (2.0 * index as f64 + 1.0) / count as f64;
    let (sin, cos) = sin_cos(GOLDEN_ANGLE * index as f64);
    let radius = (1.0 - z * z).sqrt();
    Vector3::new(radius * cos, radius * sin, z)
}
