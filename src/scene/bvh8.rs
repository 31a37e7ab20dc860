//! A bounding volume hierarchy for rays, with eight children to a node.
//!
//! The boxes of a node lie side by side in single precision, rounded outwards, so that eight of
//! them are met with a ray at once, and so are the slabs in the boxes where these are much thinner.
//! What a walk finds does not depend on that: every leaf is visited that a ray may meet before what
//! was found so far.

mod bars;
mod build;
mod flat;
mod marks;
mod oriented_slab;
mod point;
mod query_shape;
mod sphere;
mod split;
mod tolerances;
mod walk;

use std::array::from_fn;

use wide::f32x8;

use super::lanes::{larger, smaller};
use super::ray::Ray;
use bars::Bars;
pub(super) use flat::FlatRay;
use flat::Frame;
pub(super) use marks::Marks;
use oriented_slab::{Looks, OrientedSlabs};
pub(super) use point::Point;
use query_shape::QueryShape;
use sphere::Sphere;
pub(super) use walk::Walk;

/// Children of a node.
const WIDTH: usize = 8;

/// A tree over triangles.
#[derive(Clone)]
pub(super) struct Bvh8 {
    nodes: Vec<Node>,
    /// Those of each node, apart: most rays need none.
    slabs: Vec<OrientedSlabs>,
    /// Those of nodes with needles, and which they are of each of these.
    bars: Vec<Bars>,
    bars_of: Vec<u32>,
    frame: Frame,
}

/// The boxes of a node's children and what is in them.
#[derive(Clone)]
#[repr(align(32))]
pub(super) struct Node {
    /// Lower sides along x, y and z, then upper sides; empty places have them the wrong way round.
    sides: [[f32; WIDTH]; 6],
    children: [u32; WIDTH],
}

/// This bit tells leaves from nodes.
const LEAF: u32 = 1 << 31;
/// This bit tells nodes whose slabs are worth a look from others.
const THIN: u32 = 1 << 30;
/// This bit tells nodes with needles, whose bars are worth a look as well.
const SLIM: u32 = 1 << 29;

impl Node {
    const EMPTY: Self = Self {
        sides: [
            [f32::INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        children: [0; WIDTH],
    };

    /// What it holds of each of its children.
    fn children(&self) -> impl Iterator<Item = u32> + '_ {
        let is_there = |lane: &usize| self.sides[0][*lane] <= self.sides[3][*lane];
        (0..WIDTH).filter(is_there).map(|lane| self.children[lane])
    }

    /// Where the ray enters each child's box, and a bit for each that it enters within `limit`; after
    /// a closer look, where that costs less than to visit what it may rule out.
    #[inline(always)]
    fn entered<B: QueryShape>(&self, looks: Looks, ray: &FlatRay<B>, limit: f32) -> Entered {
        let sides: [[&[f32; WIDTH]; 3]; 2] =
            from_fn(|end| from_fn(|axis| &self.sides[ray.sides[end][axis]]));
        let distance = |end: usize, axis: usize, lane: usize| {
            let origin = ray.origins[if B::HAS_SIZE { end } else { 0 }][axis];
            (sides[end][axis][lane] - origin) * ray.inverse[end][axis]
        };
        let (mut entries, mut exits) = ([0.0; WIDTH], [0.0; WIDTH]);
        for lane in 0..WIDTH {
            let at = |end: usize, axis: usize| distance(end, axis, lane);
            // In this order a ray that is not a number enters nothing.
            entries[lane] = larger(larger(larger(0.0, at(0, 0)), at(0, 1)), at(0, 2));
            exits[lane] = smaller(smaller(smaller(at(1, 0), at(1, 1)), at(1, 2)), limit);
        }
        let enters = f32x8::new(entries).simd_le(f32x8::new(exits));
        let mut lanes = enters.to_bitmask();
        // Few children are soon visited, unless they are crowds of needles.
        let is_crowded = B::HAS_SIZE && looks.bars.is_some();
        if lanes.count_ones() > B::NOT_LOOKED_AT || is_crowded {
            lanes &= ray.body.meets(self, looks, &mut entries, &exits);
        }
        Entered {
            entries: f32x8::new(entries),
            lanes,
            limit,
        }
    }
}

/// Which children of a node a ray enters.
pub(super) struct Entered {
    /// Where it does.
    entries: f32x8,
    /// A bit for each child.
    lanes: u32,
    /// Up to where they were looked for.
    limit: f32,
}

impl Bvh8 {
    /// A ray as the boxes see it.
    #[inline(always)]
    pub fn flat(&self, ray: &Ray) -> FlatRay<Point> {
        self.frame.ray(ray, 0.0)
    }

    /// A sphere of `radius` (m) whose centre moves along a ray, likewise.
    #[inline(always)]
    pub fn flat_sphere(&self, ray: &Ray, radius: f64) -> FlatRay<Sphere> {
        self.frame.ray(ray, radius)
    }

    /// Where a ray enters the tree within `limit` (m).
    #[inline(always)]
    pub fn entered<B: QueryShape>(&self, ray: &FlatRay<B>, limit: f64) -> Entered {
        self.nodes[0].entered(Looks::NONE, ray, self.frame.limit(limit, ray))
    }

    /// A walk to the leaves that a ray may meet, near ones first, which has yet to
    /// [start](Walk::start).
    #[inline(always)]
    pub fn walk<'a, B: QueryShape>(&'a self, ray: &'a FlatRay<B>) -> Walk<'a, B> {
        Walk::new(self, ray)
    }
}

#[cfg(test)]
mod tests;
