//! What flies along a ray, as the boxes of the tree see it.

use nalgebra::Vector3;

use super::slab::{AT_ORIGIN, Slabs};
use super::{Node, WIDTH};
use crate::precision::Triple;

/// What flies along a ray.
pub(in crate::scene) trait Body {
    /// Whether the boxes have to be larger for it.
    const HAS_SIZE: bool;
    /// So many children are as soon visited as looked at more closely.
    const NOT_LOOKED_AT: u32;

    /// From where and whither it flies, how large it is, and how far it was moved there along its way
    /// from outside, in the coordinates of the boxes.
    fn new(origin: &Vector3<f64>, direction: &Vector3<f64>, radius: f64, skipped: f64) -> Self;

    /// A bit for each child of a node that may be met between where its box is entered and left; where
    /// it is not before some way on in the box, that counts as the entry.
    fn meets(
        &self,
        node: &Node,
        slabs: Option<&Slabs>,
        entries: &mut [f32; WIDTH],
        exits: &[f32; WIDTH],
    ) -> u32;
}

/// A point, which meets slabs.
pub(in crate::scene) struct Point {
    pub(super) origin: Triple<f32>,
    pub(super) direction: Triple<f32>,
    /// What rounding makes of heights over slabs because of the origin.
    pub(super) doubt: f32,
}

impl Body for Point {
    const HAS_SIZE: bool = false;
    const NOT_LOOKED_AT: u32 = 1;

    #[inline(always)]
    fn new(origin: &Vector3<f64>, direction: &Vector3<f64>, _: f64, _: f64) -> Self {
        Self {
            origin: origin.map(|component| component as f32).into(),
            direction: direction.map(|component| component as f32).into(),
            doubt: (origin.amax() * AT_ORIGIN) as f32,
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
        slabs.map_or(u32::MAX, |slabs| slabs.met(node, self, entries, exits))
    }
}
