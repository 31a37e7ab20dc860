//! A bounding volume hierarchy for rays, with eight children to a node.
//!
//! The boxes of a node lie side by side in single precision, rounded outwards, so that eight of
//! them are met with a ray at once. What a walk finds does not depend on that: every leaf is
//! visited that a ray may meet before what was found so far.

mod build;

use arrayvec::ArrayVec;
use nalgebra::{Point3, Vector3};
use wide::f32x8;

use super::ray::Ray;

/// Children of a node.
const WIDTH: usize = 8;

/// A tree over triangles.
#[derive(Clone)]
pub(super) struct WideTree {
    nodes: Vec<Node>,
    frame: Frame,
}

/// The boxes of a node's children and what is in them.
#[derive(Clone)]
struct Node {
    /// Lower sides along x, y and z, then upper sides; empty places have them the wrong way round.
    sides: [f32x8; 6],
    children: [u32; WIDTH],
}

/// This bit tells leaves from nodes.
const LEAF: u32 = 1 << 31;

/// The coordinates of the boxes: the mesh reaches from -1 to 1 along its longest side.
#[derive(Clone, Copy)]
struct Frame {
    centre: Point3<f64>,
    /// 1/m.
    scale: f64,
    /// How far the boxes reach.
    reach: f64,
}

/// A ray in the coordinates of the boxes; `GROWN` where it traces a sphere, for which the boxes
/// are larger by the radius on every side.
struct FlatRay<const GROWN: bool> {
    /// To measure the sides from where the ray enters and leaves: instead of the sides, the origin
    /// is moved by the radius, forwards and back. Without a radius the first stands for both.
    origins: [[f32x8; 3]; 2],
    /// Inverse direction, towards 0 and away from 0 by more than all rounding on the way to a
    /// distance, for the sides where the ray enters and leaves.
    inverse: [[f32x8; 3]; 2],
    /// Which of a node's sides the ray enters and leaves through.
    sides: [[usize; 3]; 2],
    /// How far the origin was moved along the ray.
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
    fn around(low: Point3<f64>, high: Point3<f64>, slack: f64) -> Self {
        let half = ((high - low) / 2.0).max();
        let scale = 1.0 / half.max(f64::MIN_POSITIVE.sqrt());
        Self {
            centre: nalgebra::center(&low, &high),
            scale,
            reach: 1.0 + 2.0 * MARGIN + slack * scale,
        }
    }

    /// How much larger boxes are than the triangles in them.
    fn margin(&self) -> f64 {
        self.reach - 1.0 - MARGIN
    }

    fn inside(&self, point: &Point3<f64>) -> Vector3<f64> {
        (point - self.centre) * self.scale
    }

    /// `None` when the ray passes the mesh, `radius` (m) being 0 unless `GROWN`.
    #[inline(always)]
    fn ray<const GROWN: bool>(&self, ray: &Ray, radius: f64) -> Option<FlatRay<GROWN>> {
        let grown = if GROWN {
            radius * self.scale * (1.0 + GROWN_ROUNDING)
        } else {
            0.0
        };
        let mut origin = self.inside(&ray.origin);
        let inverse = ray.direction.map(reciprocal);
        let mut skipped = 0.0;
        if origin.amax() > FAR + grown {
            skipped = entry(&origin, &inverse, self.reach + grown)?;
            origin += ray.direction * skipped;
        }
        // The sign of the inverse, which tells -0 from 0.
        let backwards = inverse.map(|component| component < 0.0);
        let axes = [0, 1, 2];
        let moved = |by: f64| {
            axes.map(|axis| {
                let forwards = if backwards[axis] { -by } else { by };
                let moved = if GROWN {
                    origin[axis] + forwards
                } else {
                    origin[axis]
                };
                f32x8::splat(moved as f32)
            })
        };
        Some(FlatRay {
            origins: [moved(grown), moved(-grown)],
            inverse: [1.0 - ROUNDING, 1.0 + ROUNDING]
                .map(|factor| axes.map(|axis| f32x8::splat((inverse[axis] * factor) as f32))),
            sides: [
                axes.map(|axis| axis + 3 * usize::from(backwards[axis])),
                axes.map(|axis| axis + 3 * usize::from(!backwards[axis])),
            ],
            skipped,
        })
    }
}

/// Where a ray from outside enters the box from -`reach` to `reach`.
#[cold]
fn entry(origin: &Vector3<f64>, inverse: &Vector3<f64>, reach: f64) -> Option<f64> {
    let (mut near, mut far) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let a = (-reach - origin[axis]) * inverse[axis];
        let b = (reach - origin[axis]) * inverse[axis];
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    (near <= far).then_some(near)
}

/// 1/x without an infinity in single precision, so that 0 times it stays 0 in the box test.
fn reciprocal(x: f64) -> f64 {
    if x.abs() < 1e-30 {
        1e30_f64.copysign(x)
    } else {
        1.0 / x
    }
}

impl Node {
    const EMPTY: Self = Self {
        sides: [
            f32x8::splat(f32::INFINITY),
            f32x8::splat(f32::INFINITY),
            f32x8::splat(f32::INFINITY),
            f32x8::splat(f32::NEG_INFINITY),
            f32x8::splat(f32::NEG_INFINITY),
            f32x8::splat(f32::NEG_INFINITY),
        ],
        children: [0; WIDTH],
    };

    /// Where the ray enters each child's box, and a bit for each that it enters within `limit`.
    #[inline(always)]
    fn entries<const GROWN: bool>(&self, ray: &FlatRay<GROWN>, limit: f32) -> ([f32; WIDTH], u32) {
        let side = |end: usize, axis: usize| {
            let origin = ray.origins[if GROWN { end } else { 0 }][axis];
            (self.sides[ray.sides[end][axis]] - origin) * ray.inverse[end][axis]
        };
        // In this order a ray that is not a number enters nothing.
        let near = f32x8::ZERO.fast_max(side(0, 0));
        let near = near.fast_max(side(0, 1)).fast_max(side(0, 2));
        let far = side(1, 0).fast_min(side(1, 1));
        let far = far.fast_min(side(1, 2)).fast_min(f32x8::splat(limit));
        (near.to_array(), near.simd_le(far).to_bitmask())
    }
}

/// A child and where the ray enters it, in one number that sorts by the latter.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Stop(u64);

impl Stop {
    #[inline(always)]
    fn new(child: u32, entry: f32) -> Self {
        Self(u64::from(entry.to_bits()) << 32 | u64::from(child))
    }

    #[inline(always)]
    fn child(self) -> u32 {
        self.0 as u32
    }

    #[inline(always)]
    fn entry(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }
}

impl WideTree {
    /// Visits the leaves that a ray may meet within `limit` (m), near ones first.
    ///
    /// `visit` gets the leaf and whether the ray may start inside its box, and says what the limit
    /// is from then on.
    #[inline(always)]
    pub fn walk(&self, ray: &Ray, limit: f64, visit: impl FnMut(u32, bool) -> f64) {
        if let Some(flat) = self.frame.ray::<false>(ray, 0.0) {
            self.walk_flat(&flat, limit, visit);
        }
    }

    /// The same for a sphere of `radius` (m) whose centre moves along the ray.
    #[inline(always)]
    pub fn walk_sphere(
        &self,
        ray: &Ray,
        radius: f64,
        limit: f64,
        visit: impl FnMut(u32, bool) -> f64,
    ) {
        if let Some(flat) = self.frame.ray::<true>(ray, radius) {
            self.walk_flat(&flat, limit, visit);
        }
    }

    #[inline(always)]
    fn walk_flat<const GROWN: bool>(
        &self,
        flat: &FlatRay<GROWN>,
        limit: f64,
        mut visit: impl FnMut(u32, bool) -> f64,
    ) {
        let flattened = |limit: f64| {
            let limit = limit * self.frame.scale - flat.skipped;
            (limit + limit.abs() * ROUNDING + MARGIN) as f32
        };
        let mut limit = flattened(limit);
        let mut stack = ArrayVec::<Stop, { build::MOST_STOPS }>::new();
        let mut stop = Stop::new(0, 0.0);
        loop {
            if stop.child() & LEAF != 0 {
                limit = flattened(visit(stop.child() & !LEAF, stop.entry() == 0.0));
            } else {
                let node = &self.nodes[stop.child() as usize];
                let (entries, mut entered) = node.entries(flat, limit);
                let mut next = || {
                    let lane = entered.trailing_zeros() as usize;
                    entered &= entered.wrapping_sub(1);
                    (lane < WIDTH).then(|| Stop::new(node.children[lane], entries[lane]))
                };
                if let Some(first) = next() {
                    stop = first;
                    let bottom = stack.len();
                    while let Some(other) = next() {
                        let (nearer, farther) = if other < stop {
                            (other, stop)
                        } else {
                            (stop, other)
                        };
                        stop = nearer;
                        stack.push(farther);
                        settle_last(&mut stack[bottom..]);
                    }
                    continue;
                }
            }
            stop = loop {
                let Some(next) = stack.pop() else {
                    return;
                };
                if next.entry() <= limit {
                    break next;
                }
            };
        }
    }
}

/// Moves the last stop down to its place among others, of which the nearest is the last.
#[inline(always)]
fn settle_last(stops: &mut [Stop]) {
    let mut place = stops.len() - 1;
    while place > 0 && stops[place - 1] < stops[place] {
        stops.swap(place - 1, place);
        place -= 1;
    }
}

#[cfg(test)]
mod tests;
