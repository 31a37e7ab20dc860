//! Spheres as the boxes of the tree see them: with boxes that have round edges and corners.
//!
//! Boxes that are larger by the radius on every side are entered long before the sphere touches
//! anything in them, and all that are under it at the same time, of which there are many where facets
//! are narrower than the sphere. In double precision, so that what it touches first is among the
//! nearest of them.

use nalgebra::Vector3;
use wide::f32x8;

use super::body::Body;
use super::slab::Slabs;
use super::{Node, WIDTH};
use crate::scene::lanes::larger;

/// A sphere.
pub(in crate::scene) struct Sphere {
    origin: Vector3<f64>,
    direction: Vector3<f64>,
    /// The radius and all rounding.
    reach: f64,
}

/// More than rounding makes of a distance to boxes and slabs, as a share of all lengths that it is
/// computed from.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Takes more off a distance than its rounding to single precision may add.
const SHORTER: f64 = 1.0 - f32::EPSILON as f64;

impl Sphere {
    /// Moves entries on to where the sphere comes to the slabs.
    #[inline(always)]
    fn come_to_slabs(&self, node: &Node, slabs: &Slabs, entries: &mut [f64; WIDTH]) {
        for (lane, entry) in entries.iter_mut().enumerate() {
            let (mut start, mut rise) = (0.0, 0.0);
            for axis in 0..3 {
                let normal = f64::from(slabs.normals[axis][lane]);
                start += normal * (self.origin[axis] - f64::from(node.sides[axis][lane]));
                rise += normal * self.direction[axis];
            }
            let height = start + rise * *entry;
            let over = height - f64::from(slabs.high[lane]);
            let under = f64::from(slabs.low[lane]) - height;
            let closing = if over > under { -rise } else { rise };
            let gap = larger(over, under) - self.reach;
            // What it moves away from it does not come to.
            *entry += larger(gap / larger(closing, f64::MIN_POSITIVE), 0.0);
        }
    }

    /// Moves entries on by how far the sphere is from the boxes there: it does not come to them sooner.
    #[inline(always)]
    fn come_to_boxes(&self, node: &Node, entries: &mut [f64; WIDTH]) {
        for (lane, entry) in entries.iter_mut().enumerate() {
            let mut squares = 0.0;
            for axis in 0..3 {
                let centre = self.origin[axis] + self.direction[axis] * *entry;
                let below = f64::from(node.sides[axis][lane]) - centre;
                let above = centre - f64::from(node.sides[axis + 3][lane]);
                let apart = larger(larger(below, above), 0.0);
                squares += apart * apart;
            }
            *entry += larger(squares.sqrt() - self.reach, 0.0);
        }
    }
}

impl Body for Sphere {
    const HAS_SIZE: bool = true;
    const NOT_LOOKED_AT: u32 = 2;

    #[inline(always)]
    fn new(origin: &Vector3<f64>, direction: &Vector3<f64>, radius: f64, skipped: f64) -> Self {
        let lengths = 1.0 + origin.amax() + radius + skipped;
        Self {
            origin: *origin,
            direction: *direction,
            reach: radius + ROUNDING * lengths,
        }
    }

    #[inline(always)]
    fn meets(
        &self,
        node: &Node,
        slabs: Option<&Slabs>,
        entries: &mut [f32; WIDTH],
        exits: &[f32; WIDTH],
    ) -> u32 {
        let mut exact = entries.map(f64::from);
        if let Some(slabs) = slabs {
            self.come_to_slabs(node, slabs, &mut exact);
        }
        self.come_to_boxes(node, &mut exact);
        *entries = exact.map(|entry| (entry * SHORTER) as f32);
        f32x8::new(*entries)
            .simd_le(f32x8::new(*exits))
            .to_bitmask()
    }
}
