//! Spheres as the boxes of the tree see them: with boxes that have round edges and corners.
//!
//! Boxes that are larger by the radius on every side are entered long before the sphere touches
//! anything in them, and all that are under it at the same time, of which there are many where facets
//! are narrower than the sphere. In double precision, so that what it touches first is among the
//! nearest of them.

use std::array::from_fn;

use nalgebra::Vector3;
use wide::f32x8;

use super::bars::Bars;
use super::oriented_slab::{Looks, OrientedSlabs};
use super::query_shape::QueryShape;
use super::tolerances::TOLERANCES;
use super::{Node, WIDTH};
use crate::scene::lanes::larger;

/// A sphere.
pub(in crate::scene) struct Sphere {
    origin: Vector3<f64>,
    direction: Vector3<f64>,
    /// The radius and all rounding.
    reach: f64,
}

/// How far a centre is from a slab.
#[derive(Clone, Copy)]
struct Apart {
    distance: f64,
    /// By how much less with the way.
    closing: f64,
}

/// So many tangents lead to about where a sphere comes to a bar.
const TANGENTS: usize = 3;

impl Sphere {
    fn way(&self) -> [&Vector3<f64>; 2] {
        [&self.origin, &self.direction]
    }

    /// Moves entries on to where the sphere comes to the slabs.
    #[inline(always)]
    fn come_to_slabs(&self, node: &Node, slabs: &OrientedSlabs, entries: &mut [f64; WIDTH]) {
        for (lane, entry) in entries.iter_mut().enumerate() {
            let [start, rise] = slabs.start_and_rise(node, lane, self.way());
            let height = start + rise * *entry;
            let over = height - f64::from(slabs.high[lane]);
            let under = f64::from(slabs.low[lane]) - height;
            let closing = if over > under { -rise } else { rise };
            let gap = larger(over, under) - self.reach;
            // What it moves away from it does not come to.
            *entry += larger(gap / larger(closing, f64::MIN_POSITIVE), 0.0);
        }
    }

    /// Moves entries on to where the sphere, off to one side of needles or beyond their ends, comes to
    /// their rounded bars; or not quite, but never beyond.
    #[inline(always)]
    fn come_to_bars(&self, node: &Node, bars: &Bars, entries: &mut [f64; WIDTH]) {
        for (lane, entry) in entries.iter_mut().enumerate() {
            let apart = |slabs| self.apart(node, slabs, lane, *entry);
            let [one, other] = [apart(&bars.sides[0]), apart(&bars.sides[1])];
            let beside = if one.distance < other.distance {
                other
            } else {
                one
            };
            let (mut square, mut closing) = (0.0, 0.0);
            for from in [apart(&bars.flat), beside, apart(&bars.ends)] {
                square += from.distance * from.distance;
                closing += from.distance * from.closing;
            }
            // How far apart they are is convex along the way: it is no less than on its tangent here.
            let apart = square.sqrt();
            let gap = apart - self.reach * TOLERANCES.oblique;
            *entry += larger(gap * apart / larger(closing, f64::MIN_POSITIVE), 0.0);
        }
    }

    /// How far the centre is from a slab at some way along.
    #[inline(always)]
    fn apart(&self, node: &Node, slabs: &OrientedSlabs, lane: usize, along: f64) -> Apart {
        let [start, rise] = slabs.start_and_rise(node, lane, self.way());
        let height = start + rise * along;
        let over = height - f64::from(slabs.high[lane]);
        let under = f64::from(slabs.low[lane]) - height;
        Apart {
            distance: larger(larger(over, under), 0.0),
            closing: if over > under { -rise } else { rise },
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

impl QueryShape for Sphere {
    const HAS_SIZE: bool = true;
    const NOT_LOOKED_AT: u32 = 2;

    #[inline(always)]
    fn new(origin: &Vector3<f64>, direction: &Vector3<f64>, radius: f64, skipped: f64) -> Self {
        let lengths = 1.0 + origin.amax() + radius + skipped;
        Self {
            origin: *origin,
            direction: *direction,
            reach: radius + TOLERANCES.sphere * lengths,
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
        let mut exact: [f64; WIDTH] = from_fn(|lane| f64::from(entries[lane]));
        if let Some(slabs) = looks.slabs {
            self.come_to_slabs(node, slabs, &mut exact);
        }
        if let Some(bars) = looks.bars {
            for _ in 0..TANGENTS {
                self.come_to_bars(node, bars, &mut exact);
            }
        }
        self.come_to_boxes(node, &mut exact);
        *entries = from_fn(|lane| (exact[lane] * TOLERANCES.shorter) as f32);
        f32x8::new(*entries)
            .simd_le(f32x8::new(*exits))
            .to_bitmask()
    }
}
