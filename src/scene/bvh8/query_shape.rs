//! What flies along a ray, as the boxes of the tree see it.

use nalgebra::Vector3;

use super::oriented_slab::Looks;
use super::{Node, WIDTH};

/// What flies along a ray.
pub(in crate::scene) trait QueryShape {
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
        looks: Looks,
        entries: &mut [f32; WIDTH],
        exits: &[f32; WIDTH],
    ) -> u32;
}
