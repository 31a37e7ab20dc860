//! Rays in the coordinates of the boxes.

use nalgebra::{Point3, Vector3};

use crate::precision::{Triple, along};
use crate::scene::lanes::larger;
use crate::scene::ray::Ray;

/// The coordinates of the boxes: the mesh reaches from -1 to 1 along its longest side.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    centre: Point3<f64>,
    /// 1/m.
    scale: f64,
    /// How far the boxes reach.
    reach: f64,
}

/// A ray in the coordinates of the boxes; `GROWN` where it traces a sphere, for which the boxes
/// are larger by the radius on every side.
pub(in crate::scene) struct FlatRay<const GROWN: bool> {
    /// To measure the sides from where the ray enters and leaves: instead of the sides, the origin
    /// is moved by the radius, forwards and back. Without a radius the first stands for both.
    pub origins: [Triple<f32>; 2],
    /// Inverse direction, towards 0 and away from 0 by more than all rounding on the way to a
    /// distance, for the sides where the ray enters and leaves.
    pub inverse: [Triple<f32>; 2],
    /// Which of a node's sides the ray enters and leaves through.
    pub sides: [[usize; 3]; 2],
    /// How far the origin was moved along the ray; infinite for a ray that passes the mesh, of which
    /// then nothing is within any limit.
    skipped: f64,
}

/// Relative rounding of a distance to the side of a box: of a difference, of an inverse and of
/// their product.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;
/// Boxes are larger than the triangles in them by this, which covers the rounding of a ray's
/// origin and of the sides.
const MARGIN: f64 = 1.5 * f32::EPSILON as f64;
/// Radii are taken larger by this share: origins moved by them have as much more rounding, which
/// the margin does not cover.
const GROWN_ROUNDING: f64 = 2.0 * f32::EPSILON as f64;
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
            reach: 1.0 + 2.0 * MARGIN + slack * scale,
        }
    }

    /// A limit along a ray (m) in the coordinates of the boxes.
    #[inline(always)]
    pub fn limit<const GROWN: bool>(&self, limit: f64, ray: &FlatRay<GROWN>) -> f32 {
        let limit = limit * self.scale - ray.skipped;
        (limit + limit.abs() * ROUNDING + MARGIN) as f32
    }

    /// How much larger boxes are than the triangles in them.
    pub fn margin(&self) -> f64 {
        self.reach - 1.0 - MARGIN
    }

    pub fn inside(&self, point: &Point3<f64>) -> Vector3<f64> {
        (point - self.centre) * self.scale
    }

    /// Where a ray starts and the inverse of its direction, in the coordinates of the boxes.
    #[inline(always)]
    fn line(&self, origin: Triple<f64>, direction: Triple<f64>) -> (Triple<f64>, Triple<f64>) {
        let centre = [self.centre.x, self.centre.y, self.centre.z];
        let start = [
            (origin[0] - centre[0]) * self.scale,
            (origin[1] - centre[1]) * self.scale,
            (origin[2] - centre[2]) * self.scale,
        ];
        let inverse = [
            reciprocal(direction[0]),
            reciprocal(direction[1]),
            reciprocal(direction[2]),
        ];
        (start, inverse)
    }

    /// A ray, `radius` (m) being 0 unless `GROWN`.
    #[inline(always)]
    pub fn ray<const GROWN: bool>(&self, ray: &Ray, radius: f64) -> FlatRay<GROWN> {
        let grown = if GROWN {
            radius * self.scale * (1.0 + GROWN_ROUNDING)
        } else {
            0.0
        };
        let (mut origin, inverse) = self.line(ray.origin.into(), ray.direction.into());
        let mut skipped = 0.0;
        if farthest(origin) > FAR + grown {
            let direction: Triple<f64> = ray.direction.into();
            skipped = entry(origin, inverse, self.reach + grown);
            origin = along(origin, direction, skipped);
        }
        let moved = |by: f64| {
            [0, 1, 2].map(|axis| {
                let forwards = if inverse[axis] < 0.0 { -by } else { by };
                let moved = if GROWN {
                    origin[axis] + forwards
                } else {
                    origin[axis]
                };
                moved as f32
            })
        };
        let origins = [moved(grown), moved(-grown)];
        FlatRay::new(origins, loosened(inverse), skipped)
    }
}

/// Inverse directions towards 0 and away from 0, by more than all rounding on the way to a distance.
#[inline(always)]
fn loosened(inverse: Triple<f64>) -> [Triple<f32>; 2] {
    let rounded = |factor: f64| {
        [
            (inverse[0] * factor) as f32,
            (inverse[1] * factor) as f32,
            (inverse[2] * factor) as f32,
        ]
    };
    [rounded(1.0 - ROUNDING), rounded(1.0 + ROUNDING)]
}

/// The largest coordinate.
#[inline(always)]
fn farthest(origin: Triple<f64>) -> f64 {
    larger(larger(origin[0].abs(), origin[1].abs()), origin[2].abs())
}

impl<const GROWN: bool> FlatRay<GROWN> {
    #[inline(always)]
    fn new(origins: [Triple<f32>; 2], inverse: [Triple<f32>; 2], skipped: f64) -> Self {
        // The sign of the inverse, which tells -0 from 0.
        let backwards = inverse[0].map(|component| usize::from(component < 0.0));
        let axes = [0, 1, 2];
        Self {
            origins,
            inverse,
            sides: [
                axes.map(|axis| axis + 3 * backwards[axis]),
                axes.map(|axis| axis + 3 - 3 * backwards[axis]),
            ],
            skipped,
        }
    }
}

/// Where a ray from outside enters the box from -`reach` to `reach`; infinite where it does not.
#[cold]
pub(super) fn entry(origin: Triple<f64>, inverse: Triple<f64>, reach: f64) -> f64 {
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
