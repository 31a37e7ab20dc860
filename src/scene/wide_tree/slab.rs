//! Slabs that hold the triangles of a box more closely than the box does.
//!
//! A ray that skims a curved wall passes through the boxes of all facets on its way, of which there
//! are the more the finer they are, but over their slabs.

use nalgebra::Vector3;

use super::WIDTH;
use super::split::Bounds;
use crate::scene::lanes::{larger, smaller};

/// Relative rounding of a single operation.
pub(super) const UNIT: f64 = 0.5 * f32::EPSILON as f64;
/// Rounding of heights over a slab by the width of its box along the normal: 5 in what the ray starts
/// from, and 2 in the height of the planes.
const ACROSS_BOX: f64 = 8.0 * UNIT;
/// Slabs are worth a look up to this share of their boxes in width.
const WIDEST_SHARE: f64 = 0.5;

/// What is between two planes.
pub(super) struct Slab {
    normal: Vector3<f32>,
    /// Heights over the lower corner of the box.
    low: f32,
    high: f32,
}

impl Slab {
    /// The slab along triangles in a box, loosened by `slack`, if it is much thinner than the box.
    pub fn along(
        triangles: impl Iterator<Item = [Vector3<f64>; 3]> + Clone,
        bounds: &Bounds,
        slack: f64,
    ) -> Option<Self> {
        let doubled_area = |[a, b, c]: [Vector3<f64>; 3]| (b - a).cross(&(c - a));
        let areas: Vector3<f64> = triangles.clone().map(doubled_area).sum();
        let normal = areas.try_normalize(0.0)?.map(|component| component as f32);
        let exact = normal.map(f64::from);
        let [corner, opposite] =
            [bounds.low, bounds.high].map(|corner| Vector3::from(corner.map(f64::from)));
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for point in triangles.flatten() {
            let height = (point - corner).dot(&exact);
            low = smaller(height, low);
            high = larger(height, high);
        }
        let width = exact.abs().dot(&(opposite - corner));
        let margin = 2.0 * slack + ACROSS_BOX * width;
        (high - low < WIDEST_SHARE * width).then_some(Self {
            normal,
            low: (low - margin) as f32,
            high: (high + margin) as f32,
        })
    }
}

/// The slabs of a node's children.
#[derive(Clone)]
#[repr(align(32))]
pub(in crate::scene) struct Slabs {
    pub normals: [[f32; WIDTH]; 3],
    /// Heights over the lower corners of their boxes.
    pub low: [f32; WIDTH],
    pub high: [f32; WIDTH],
}

impl Slabs {
    /// Every ray meets them.
    pub const ENDLESS: Self = Self {
        normals: [[0.0; WIDTH]; 3],
        low: [f32::NEG_INFINITY; WIDTH],
        high: [f32::INFINITY; WIDTH],
    };

    pub(super) fn set(&mut self, lane: usize, slab: &Slab) {
        for axis in 0..3 {
            self.normals[axis][lane] = slab.normal[axis];
        }
        self.low[lane] = slab.low;
        self.high[lane] = slab.high;
    }
}
