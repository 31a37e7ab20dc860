//! Points as the boxes of the tree see them: with the slabs in the boxes.

use nalgebra::Vector3;
use wide::f32x8;

use super::oriented_slab::{Looks, OrientedSlabs};
use super::query_shape::QueryShape;
use super::tolerances::TOLERANCES;
use super::{Node, WIDTH};
use crate::scene::lanes::{larger, smaller};

/// A point.
pub(in crate::scene) struct Point {
    origin: [f32; 3],
    direction: [f32; 3],
    /// What rounding makes of heights over slabs because of the origin.
    doubt: f32,
}

impl Point {
    /// A bit for each child whose slab it meets between where it enters and leaves its box.
    #[inline(always)]
    fn meets_slabs(
        &self,
        node: &Node,
        slabs: &OrientedSlabs,
        entries: &[f32; WIDTH],
        exits: &[f32; WIDTH],
    ) -> u32 {
        let mut misses = [0.0_f32; WIDTH];
        for lane in 0..WIDTH {
            let (mut start, mut rise) = (0.0, 0.0);
            for axis in 0..3 {
                let normal = slabs.normals[axis][lane];
                start += normal * (self.origin[axis] - node.sides[axis][lane]);
                rise += normal * self.direction[axis];
            }
            let (first, last) = (start + rise * entries[lane], start + rise * exits[lane]);
            let doubt = self.doubt + (TOLERANCES.height_along_ray as f32) * exits[lane];
            let passes_over = smaller(first, last) > slabs.high[lane] + doubt;
            let passes_under = larger(first, last) < slabs.low[lane] - doubt;
            misses[lane] = f32::from(passes_over | passes_under);
        }
        f32x8::new(misses).simd_eq(f32x8::ZERO).to_bitmask()
    }
}

impl QueryShape for Point {
    const HAS_SIZE: bool = false;
    const NOT_LOOKED_AT: u32 = 1;

    #[inline(always)]
    fn new(origin: &Vector3<f64>, direction: &Vector3<f64>, _: f64, _: f64) -> Self {
        Self {
            origin: origin.map(|component| component as f32).into(),
            direction: direction.map(|component| component as f32).into(),
            doubt: (origin.amax() * TOLERANCES.height_at_origin) as f32,
        }
    }

    #[inline(always)]
    fn meets(
        &self,
        node: &Node,
        looks: Looks,
        entries: &mut [f32; WIDTH],
        exits: &[f32; WIDTH],
    ) -> u32 {
        let sides = looks.bars.into_iter().flat_map(|bars| &bars.sides);
        looks
            .slabs
            .into_iter()
            .chain(sides)
            .fold(u32::MAX, |met, slabs| {
                met & self.meets_slabs(node, slabs, entries, exits)
            })
    }
}
