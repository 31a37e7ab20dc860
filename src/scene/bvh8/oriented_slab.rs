//! Slabs that hold the triangles of a box more closely than the box does.
//!
//! A ray that skims a curved wall passes through the boxes of all facets on its way, of which there
//! are the more the finer they are, but over their slabs.

use nalgebra::Vector3;

use super::bars::Bars;
use super::split::Bounds;
use super::tolerances::TOLERANCES;
use super::{Node, WIDTH};
use crate::elementary::extremes;

/// Slabs are worth a look up to this share of their boxes in width.
const WIDEST_SHARE: f64 = 0.5;

/// What is between two planes.
pub(super) struct OrientedSlab {
    normal: Vector3<f32>,
    /// Heights over the lower corner of the box.
    low: f32,
    high: f32,
}

impl OrientedSlab {
    /// The slab along triangles in a box, loosened by `slack`, if it is much thinner than the box.
    pub fn along(
        triangles: impl Iterator<Item = [Vector3<f64>; 3]> + Clone,
        bounds: &Bounds,
        slack: f64,
    ) -> Option<Self> {
        let normal = areas(triangles.clone()).try_normalize(0.0)?;
        Self::between(normal, triangles, bounds, slack, WIDEST_SHARE)
    }

    /// The slab at right angles to a normal, which is no longer than 1, if it is no wider than a share of
    /// the box.
    pub fn between(
        normal: Vector3<f64>,
        triangles: impl Iterator<Item = [Vector3<f64>; 3]>,
        bounds: &Bounds,
        slack: f64,
        widest_share: f64,
    ) -> Option<Self> {
        let normal = normal.map(|component| component as f32);
        let exact = normal.map(f64::from);
        let corner = Vector3::from(bounds.low.map(f64::from));
        let points = triangles.flatten();
        let (low, high) = extremes(points.map(|point| (point - corner).dot(&exact)));
        let width = exact.abs().dot(&bounds.diagonal());
        let margin = 2.0 * slack + TOLERANCES.height_across_box * width;
        (high - low < widest_share * width).then_some(Self {
            normal,
            low: (low - margin) as f32,
            high: (high + margin) as f32,
        })
    }
}

pub(super) fn areas(triangles: impl Iterator<Item = [Vector3<f64>; 3]>) -> Vector3<f64> {
    triangles.map(|[a, b, c]| (b - a).cross(&(c - a))).sum()
}

/// The slabs of a node's children.
#[derive(Clone)]
#[repr(align(32))]
pub(in crate::scene) struct OrientedSlabs {
    pub normals: [[f32; WIDTH]; 3],
    /// Heights over the lower corners of their boxes.
    pub low: [f32; WIDTH],
    pub high: [f32; WIDTH],
}

impl OrientedSlabs {
    /// Every ray meets them.
    pub const ENDLESS: Self = Self {
        normals: [[0.0; WIDTH]; 3],
        low: [f32::NEG_INFINITY; WIDTH],
        high: [f32::INFINITY; WIDTH],
    };

    /// Where a body is over the slab of a child, from where it starts and how it rises.
    #[inline(always)]
    pub fn start_and_rise(
        &self,
        node: &Node,
        lane: usize,
        [origin, direction]: [&Vector3<f64>; 2],
    ) -> [f64; 2] {
        let (mut start, mut rise) = (0.0, 0.0);
        for axis in 0..3 {
            let normal = f64::from(self.normals[axis][lane]);
            start += normal * (origin[axis] - f64::from(node.sides[axis][lane]));
            rise += normal * direction[axis];
        }
        [start, rise]
    }

    pub(super) fn set(&mut self, lane: usize, slab: &OrientedSlab) {
        for axis in 0..3 {
            self.normals[axis][lane] = slab.normal[axis];
        }
        self.low[lane] = slab.low;
        self.high[lane] = slab.high;
    }
}

/// The slabs and bars of a node that are worth a look.
#[derive(Clone, Copy)]
pub(in crate::scene) struct Looks<'a> {
    pub slabs: Option<&'a OrientedSlabs>,
    pub bars: Option<&'a Bars>,
}

impl Looks<'_> {
    pub const NONE: Self = Self {
        slabs: None,
        bars: None,
    };
}
