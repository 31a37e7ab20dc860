//! Rays in the coordinates of the boxes.

use std::array::from_fn;

use nalgebra::{Point3, Vector3};

use super::query_shape::QueryShape;
use super::tolerances::TOLERANCES;
use crate::scene::ray::Ray;

/// The coordinates of the boxes: the mesh reaches from -1 to 1 along its longest side.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    centre: Point3<f64>,
    /// 1/m.
    scale: f64,
    /// How far the boxes are loosened.
    pub slack: f64,
}

/// A ray in the coordinates of the boxes, on which a point flies or a sphere's centre, for which the
/// boxes are larger by the radius on every side.
pub(in crate::scene) struct FlatRay<B> {
    /// To measure the sides from where the ray enters and leaves: instead of the sides, the origin
    /// is moved by the radius, forwards and back. Without a radius the first stands for both.
    pub origins: [[f32; 3]; 2],
    /// Inverse direction, towards 0 and away from 0 by more than all rounding on the way to a
    /// distance, for the sides where the ray enters and leaves.
    pub inverse: [[f32; 3]; 2],
    /// Which of a node's sides the ray enters and leaves through.
    pub sides: [[usize; 3]; 2],
    /// For a closer look at some of the boxes.
    pub body: B,
    /// How far the origin was moved along the ray; infinite for a ray that passes the mesh, of which
    /// then nothing is within any limit.
    skipped: f64,
}

/// Origins farther out than this along an axis are moved to the box of the mesh first.
const FAR: f64 = 2.0;

impl Frame {
    /// The frame of a mesh between two corners, in boxes that are loosened by `slack` (m).
    pub fn around(low: Point3<f64>, high: Point3<f64>, slack: f64) -> Self {
        let half = ((high - low) / 2.0).max();
        let scale = 1.0 / half.max(f64::MIN_POSITIVE.sqrt());
        Self {
            centre: nalgebra::center(&low, &high),
            scale,
            slack: slack * scale,
        }
    }

    /// How far the boxes reach.
    fn reach(&self) -> f64 {
        1.0 + self.margin() + TOLERANCES.margin
    }

    /// A limit along a ray (m) in the coordinates of the boxes.
    #[inline(always)]
    pub fn limit<B>(&self, limit: f64, ray: &FlatRay<B>) -> f32 {
        let limit = limit * self.scale - ray.skipped;
        (limit + limit.abs() * TOLERANCES.side + TOLERANCES.margin) as f32
    }

    /// How much larger boxes are than the triangles in them.
    pub fn margin(&self) -> f64 {
        TOLERANCES.margin + self.slack
    }

    pub fn inside(&self, point: &Point3<f64>) -> Vector3<f64> {
        (point - self.centre) * self.scale
    }

    /// A ray, `radius` (m) being 0 unless the body has a size.
    #[inline(always)]
    pub fn ray<B: QueryShape>(&self, ray: &Ray, radius: f64) -> FlatRay<B> {
        let grown = if B::HAS_SIZE {
            radius * self.scale * (1.0 + TOLERANCES.radius)
        } else {
            0.0
        };
        let mut origin = self.inside(&ray.origin);
        let inverse = ray.direction.map(reciprocal);
        let mut skipped = 0.0;
        if origin.amax() > FAR + grown {
            skipped = entry(&origin, &inverse, self.reach() + grown);
            origin += ray.direction * skipped;
        }
        let moved = |by: f64| {
            from_fn(|axis| {
                let forwards = if inverse[axis] < 0.0 { -by } else { by };
                let moved = if B::HAS_SIZE {
                    origin[axis] + forwards
                } else {
                    origin[axis]
                };
                moved as f32
            })
        };
        // The sign of the inverse, which tells -0 from 0.
        let backwards: [usize; 3] = from_fn(|axis| usize::from(inverse[axis] < 0.0));
        let inverse_times = |factor: f64| from_fn(|axis| (inverse[axis] * factor) as f32);
        FlatRay {
            origins: [moved(grown), moved(-grown)],
            inverse: [
                inverse_times(1.0 - TOLERANCES.side),
                inverse_times(1.0 + TOLERANCES.side),
            ],
            sides: [
                from_fn(|axis| axis + 3 * backwards[axis]),
                from_fn(|axis| axis + 3 - 3 * backwards[axis]),
            ],
            body: B::new(&origin, &ray.direction, grown, skipped),
            skipped,
        }
    }
}

/// Where a ray from outside enters the box from -`reach` to `reach`; infinite where it does not.
#[cold]
pub(super) fn entry(origin: &Vector3<f64>, inverse: &Vector3<f64>, reach: f64) -> f64 {
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let a = (-reach - origin[axis]) * inverse[axis];
        let b = (reach - origin[axis]) * inverse[axis];
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    if near <= far { near } else { f64::INFINITY }
}

/// 1/x without an infinity in single precision, so that 0 times it stays 0 in the box test.
#[inline(always)]
pub(super) fn reciprocal(x: f64) -> f64 {
    if x.abs() < 1e-30 {
        1e30_f64.copysign(x)
    } else {
        1.0 / x
    }
}
