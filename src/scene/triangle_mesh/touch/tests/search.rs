//! The first touch by following the distance to each triangle.

use nalgebra::{Point3, Vector3};
use parry3d_f64::query::PointQuery;

use super::Found;
use crate::scene::mesh::{Mesh, Triangle};
use crate::scene::ray::{HitId, Ray};

pub(super) struct Search<'a> {
    pub mesh: &'a Mesh,
    pub radius: f64,
    pub slack: f64,
}

impl Search<'_> {
    /// Holds a result against spheres that are a little larger and smaller, which must touch no
    /// later and no earlier.
    pub fn check(&self, ray: &Ray, leaving: Option<HitId>, found: Found) {
        let tolerance = self.slack * (0.5 + ray.origin.coords.norm() * 1e-4 / self.size());
        let larger = self.first(ray, leaving, self.radius + tolerance);
        let smaller = self.first(ray, leaving, self.radius - tolerance);
        let distance = found.map_or(f64::INFINITY, |(crossing, _)| crossing.distance);
        let rounding = 4.0 * f64::EPSILON * distance.min(1e300) + self.slack;
        assert!(
            larger <= distance + rounding && distance <= smaller + rounding,
            "{larger} {distance} {smaller} {found:?} {ray:?} {leaving:?}"
        );
        let Some((crossing, normal)) = found else {
            return;
        };
        let centre = ray.origin + ray.direction * distance;
        let offset = self.offset(crossing.piece as usize, &centre);
        let apart = offset.norm() - self.radius;
        assert!(
            distance == 0.0 || apart.abs() <= tolerance + self.slack,
            "{apart}"
        );
        let size = offset.norm().max(self.slack);
        assert!((offset - normal * offset.norm()).norm() < 1e-6 * size + 10.0 * self.slack);
        assert!(normal.dot(&ray.direction) < 0.0);
        assert!((normal.norm() - 1.0).abs() < 1e-12);
    }

    /// The distance of a point from the mesh.
    pub fn nearest(&self, point: &Point3<f64>) -> f64 {
        let pieces = 0..self.mesh.triangles.len();
        let distances = pieces.map(|piece| self.offset(piece, point).norm());
        distances.fold(f64::INFINITY, f64::min)
    }

    fn size(&self) -> f64 {
        self.slack * 1e12
    }

    /// How far the centre travels until something is nearer than `radius`.
    fn first(&self, ray: &Ray, leaving: Option<HitId>, radius: f64) -> f64 {
        let pieces = (0..self.mesh.triangles.len())
            .filter(|&piece| leaving.is_none_or(|hit_id| hit_id.piece as usize != piece));
        let distances = pieces.map(|piece| self.distance(piece, ray, radius));
        distances.fold(f64::INFINITY, f64::min)
    }

    fn distance(&self, piece: usize, ray: &Ray, radius: f64) -> f64 {
        let offset = self.offset(piece, &ray.origin);
        if offset.norm() <= self.radius + self.slack {
            let heads_in = ray.direction.dot(&offset) < -1e-12 * offset.norm();
            return if heads_in { 0.0 } else { f64::INFINITY };
        }
        // The distance is convex along the ray: steps along its tangent never go too far.
        let mut travelled = 0.0;
        for _ in 0..10_000 {
            let offset = self.offset(piece, &(ray.origin + ray.direction * travelled));
            let sinking = -ray.direction.dot(&offset) / offset.norm();
            let gap = offset.norm() - radius;
            let step = gap / sinking;
            if sinking <= 1e-12 {
                return f64::INFINITY;
            }
            if gap <= 0.0 || travelled + step == travelled {
                break;
            }
            travelled += step;
        }
        travelled
    }

    /// Where a point is from the nearest point of a triangle.
    fn offset(&self, piece: usize, point: &Point3<f64>) -> Vector3<f64> {
        let triangle: &Triangle = &self.mesh.triangles[piece];
        let [a, b, c] = self
            .mesh
            .corners(triangle)
            .map(|corner| (corner - point).into());
        let shape = parry3d_f64::shape::Triangle::new(a, b, c);
        let nearest = shape.project_local_point(parry3d_f64::math::Vector::ZERO, true);
        let nearest: Vector3<f64> = nearest.point.into();
        -nearest
    }
}
