//! Bars that hold needles more closely than boxes and slabs do.
//!
//! Needles that meet in one corner, or lie side by side askew, are all in the boxes of each other, and one
//! that tapers towards its tip leaves room beside it for hundreds of others. A bar is between two planes along
//! the needles' common plane, two pairs of planes upright on that, along the needles turned the most one way
//! and the other, and two planes across their ends.

use nalgebra::Vector3;

use super::oriented_slab::{OrientedSlab, OrientedSlabs, areas};
use super::split::Bounds;
use crate::elementary::extremes;
use crate::scene::lanes::{larger, smaller};

/// Bars are worth a look up to this share of their boxes in width: few triangles but needles lie in so
/// narrow ones.
const NARROW: f64 = 0.06;
/// Or where they taper: half-way along, needles that meet in a tip are together half as wide as at their
/// ends; other triangles, side by side, hardly less than all over.
const TAPERED: f64 = 0.6;
/// Such needles are together narrower than this share of their length.
const SLENDER: f64 = 0.06;

/// What is between the planes round needles.
pub(super) struct Bar {
    flat: OrientedSlab,
    sides: [OrientedSlab; 2],
    ends: OrientedSlab,
}

impl Bar {
    /// The bar round triangles in a box, loosened by `slack`, if they are needles.
    pub fn around(
        triangles: impl Iterator<Item = [Vector3<f64>; 3]> + Clone,
        bounds: &Bounds,
        slack: f64,
    ) -> Option<Self> {
        let upwards = areas(triangles.clone()).try_normalize(0.0)?;
        let needles = triangles.clone().map(longest_edge);
        let sum = needles.clone().reduce(|sum, edge| {
            // Whichever way round their corners are.
            if sum.dot(&edge) < 0.0 {
                sum - edge
            } else {
                sum + edge
            }
        })?;
        let across = upwards.cross(&sum).try_normalize(0.0)?;
        let along = across.cross(&upwards);
        let points = || triangles.clone().flatten();
        let (first, last) = extremes(points().map(|point| point.dot(&along)));
        let (low, high) = extremes(points().map(|point| point.dot(&across)));
        let (length, width) = (last - first, high - low);
        let is_narrow = width < NARROW * across.abs().dot(&bounds.diagonal());
        let is_slender = width < SLENDER * length;
        if !is_narrow && !is_slender {
            return None;
        }
        let turn = |needle: Vector3<f64>| needle.dot(&across) / needle.dot(&along);
        let (least, most) = extremes(needles.map(turn));
        let turns = [least, most].map(|turn: f64| turn.clamp(-1.0, 1.0));
        // Between the sides, half-way along.
        let half_way = turns.map(|turn| {
            let beside = |point: Vector3<f64>| point.dot(&across) - turn * point.dot(&along);
            let (under, over) = extremes(points().map(beside));
            let middle = turn * (first + last) / 2.0;
            [under + middle, over + middle]
        });
        let [[under, over], [other_under, other_over]] = half_way;
        let left = smaller(over, other_over) - larger(under, other_under);
        if !is_narrow && left >= TAPERED * width {
            return None;
        }
        // The sides and the ends are not quite at right angles. Distances from both add up as if they were
        // where each counts for that much less.
        let oblique = larger(least.abs(), most.abs()).min(1.0);
        let less = (1.0 - oblique).sqrt();
        let slab =
            |normal| OrientedSlab::between(normal, triangles.clone(), bounds, slack, f64::INFINITY);
        let side = |turn: f64| slab((across - along * turn).try_normalize(0.0)? * less);
        Some(Self {
            flat: slab(upwards)?,
            sides: [side(turns[0])?, side(turns[1])?],
            ends: slab(along * less)?,
        })
    }
}

fn longest_edge([a, b, c]: [Vector3<f64>; 3]) -> Vector3<f64> {
    let longer = |one: Vector3<f64>, other: Vector3<f64>| {
        if other.norm_squared() > one.norm_squared() {
            other
        } else {
            one
        }
    };
    longer(longer(b - a, c - b), a - c)
}

/// The bars of a node's children.
#[derive(Clone)]
pub(in crate::scene) struct Bars {
    /// Along the needles' common plane.
    pub flat: OrientedSlabs,
    /// Upright on that, along the needles.
    pub sides: [OrientedSlabs; 2],
    /// Across their ends.
    pub ends: OrientedSlabs,
}

impl Bars {
    /// No child has one.
    const NONE: Self = Self {
        flat: OrientedSlabs::ENDLESS,
        sides: [OrientedSlabs::ENDLESS; 2],
        ends: OrientedSlabs::ENDLESS,
    };

    /// Those of children that have one; `None` if none has.
    pub(super) fn of(children: &[Option<Bar>]) -> Option<Self> {
        let mut bars = children.iter().any(Option::is_some).then_some(Self::NONE)?;
        for (lane, bar) in children.iter().enumerate() {
            if let Some(Bar { flat, sides, ends }) = bar {
                bars.flat.set(lane, flat);
                bars.sides[0].set(lane, &sides[0]);
                bars.sides[1].set(lane, &sides[1]);
                bars.ends.set(lane, ends);
            }
        }
        Some(bars)
    }
}
