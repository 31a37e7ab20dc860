//! Where the nozzle stands, for the parts that move with it.
//!
//! Such parts are kept in the frame of the nozzle: rays are taken there, and normals back.

use multiversion::multiversion;
use nalgebra::{Point3, Vector3};

use super::lanes::{Hits, LANES, Lane, Rays, Spots, components, padded, put};
use super::part::BuiltPart;
use super::ray::Ray;
use crate::precision::{Real, Triple, along, dot, scaled};

/// The frame of the nozzle in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand<R> {
    axes: [Triple<R>; 3],
    origin: Triple<R>,
}

/// Stands side by side.
pub struct Stands<R> {
    axes: [[Lane<R>; 3]; 3],
    origin: [Lane<R>; 3],
}

impl Stand<f64> {
    /// A frame by its three unit vectors and its origin, m.
    pub fn new(axes: [Vector3<f64>; 3], origin: Point3<f64>) -> Self {
        Self {
            axes: axes.map(Into::into),
            origin: origin.into(),
        }
    }

    /// A point of this frame, as it is in the scene, m.
    pub fn point_back(&self, point: &Point3<f64>) -> Point3<f64> {
        let turned = Point3::from(self.vector_back((*point).into()));
        turned + Vector3::from(self.origin)
    }

    /// A ray of the scene, as it is in this frame.
    pub fn ray_there(&self, ray: &Ray) -> Ray {
        Ray {
            origin: self.point_there(ray.origin.into()).into(),
            direction: self.vector_there(ray.direction.into()).into(),
        }
    }
}

impl<R: Real> Stand<R> {
    #[inline(always)]
    fn point_there(&self, point: Triple<R>) -> Triple<R> {
        self.vector_there(along(point, self.origin, -R::ONE))
    }

    #[inline(always)]
    fn vector_there(&self, vector: Triple<R>) -> Triple<R> {
        let [x, y, z] = self.axes;
        [dot(x, vector), dot(y, vector), dot(z, vector)]
    }

    /// A vector of this frame, as it is in the scene.
    #[inline(always)]
    pub(super) fn vector_back(&self, vector: Triple<R>) -> Triple<R> {
        let [x, y, z] = self.axes;
        along(along(scaled(x, vector[0]), y, vector[1]), z, vector[2])
    }
}

impl<R: Real> Stands<R> {
    /// All where the scene's frame is.
    pub fn none() -> Self {
        let (zero, one) = ([R::ZERO; LANES], [R::ONE; LANES]);
        Self {
            axes: [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
            origin: [zero; 3],
        }
    }

    /// Sets one of them.
    pub fn set(&mut self, index: usize, stand: &Stand<f64>) {
        let narrow = |vector: Triple<f64>| vector.map(R::of);
        for (lanes, axis) in self.axes.iter_mut().zip(stand.axes) {
            put(lanes, index, narrow(axis));
        }
        put(&mut self.origin, index, narrow(stand.origin));
    }

    /// Every number of theirs.
    pub fn lanes_mut(&mut self) -> impl Iterator<Item = &mut Lane<R>> {
        self.axes.iter_mut().flatten().chain(&mut self.origin)
    }

    #[inline(always)]
    fn at(&self, index: usize) -> Stand<R> {
        let [x, y, z] = &self.axes;
        Stand {
            axes: [
                components(x, index),
                components(y, index),
                components(z, index),
            ],
            origin: components(&self.origin, index),
        }
    }

    /// Rays of the scene, each as it is in the frame of its own nozzle.
    #[inline(always)]
    fn rays_there(&self, rays: &Rays<R>) -> Rays<R> {
        let mut there = Rays {
            count: rays.count,
            are_spheres: rays.are_spheres,
            radius: rays.radius,
            leaving: rays.leaving.clone(),
            ..Rays::none()
        };
        for i in 0..padded(rays.count) {
            let stand = self.at(i);
            let origin = stand.point_there(components(&rays.origin, i));
            let direction = stand.vector_there(components(&rays.direction, i));
            put(&mut there.origin, i, origin);
            put(&mut there.direction, i, direction);
        }
        there
    }
}

/// The part of no ray.
const NO_PART: u32 = u32::MAX;

/// Takes the first crossings with a part that moves with the nozzle, where they are nearer than
/// what the rays have hit so far.
///
/// A function of its own, so that scenes without such parts are traced as fast as ever.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+fma",
    "x86_64+avx+avx2+bmi1+bmi2+fma"
))]
pub(super) fn cross<R: Real>(
    part: &BuiltPart,
    index: u32,
    rays: &Rays<R>,
    stands: &Stands<R>,
    hits: &mut Hits<R>,
) {
    let there = stands.rays_there(rays);
    let mut met = Hits {
        distance: hits.distance,
        spots: Spots {
            part: [NO_PART; LANES],
            ..Spots::none()
        },
        ..Hits::none()
    };
    part.cross(index, &there, &mut met);
    for i in (0..rays.count).filter(|&i| met.spots.part[i] == index) {
        let normal = stands.at(i).vector_back(components(&met.normal, i));
        hits.distance[i] = met.distance[i];
        hits.surface[i] = met.surface[i];
        hits.spots.set(i, met.spots.at(i));
        put(&mut hits.normal, i, normal);
    }
}
