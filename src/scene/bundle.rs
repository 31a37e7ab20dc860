//! Four triangles side by side, met with a ray at once.

use nalgebra::Point3;
use wide::f64x4;

use super::triangle::{CLEARLY_OUTSIDE, Shear, Weights};

/// Triangles of a bundle.
const LANES: usize = 4;

/// One to four triangles.
#[derive(Clone)]
pub(super) struct Bundle {
    /// By coordinate and corner, m.
    corners: [[f64x4; 3]; 3],
    triangles: [u32; LANES],
    count: usize,
}

/// A [`Shear`] for four triangles at once.
pub(super) struct WideShear {
    axes: [usize; 3],
    origin: [f64x4; 3],
    shear: [f64x4; 3],
}

impl WideShear {
    #[inline(always)]
    pub fn new(shear: &Shear) -> Self {
        Self {
            axes: shear.axes,
            origin: shear.axes.map(|axis| f64x4::splat(shear.origin[axis])),
            shear: shear.shear.map(f64x4::splat),
        }
    }

    /// The corners of a bundle as the ray sees them.
    #[inline(always)]
    fn apply(&self, corners: &[[f64x4; 3]; 3]) -> [[f64x4; 3]; 3] {
        let [xs, ys, zs] = self.axes.map(|axis| &corners[axis]);
        [0, 1, 2].map(|corner| {
            let z = zs[corner] - self.origin[2];
            [
                xs[corner] - self.origin[0] - self.shear[0] * z,
                ys[corner] - self.origin[1] - self.shear[1] * z,
                self.shear[2] * z,
            ]
        })
    }
}

impl Bundle {
    /// The triangles of these indices, of which there are one to four.
    pub fn new(indices: &[u32], corners: impl Fn(u32) -> [Point3<f64>; 3]) -> Self {
        let mut bundle = Self {
            corners: [[f64x4::ZERO; 3]; 3],
            triangles: [0; LANES],
            count: indices.len(),
        };
        for (lane, &index) in indices.iter().enumerate() {
            bundle.triangles[lane] = index;
            for (corner, point) in corners(index).iter().enumerate() {
                for axis in 0..3 {
                    bundle.corners[axis][corner].as_mut_array()[lane] = point[axis];
                }
            }
        }
        bundle
    }

    /// The indices of its triangles.
    pub fn triangles(&self) -> &[u32] {
        &self.triangles[..self.count]
    }

    /// The corner points of one of them.
    #[inline(always)]
    pub fn corners(&self, lane: usize) -> [Point3<f64>; 3] {
        let of = |axis: usize, corner: usize| self.corners[axis][corner].as_array()[lane];
        [0, 1, 2].map(|corner| Point3::new(of(0, corner), of(1, corner), of(2, corner)))
    }

    /// How a ray's line passes each triangle, and a bit for each that it
    /// [may cross](Weights::may_cross).
    ///
    /// The same arithmetic as [`Weights`] of a single triangle, to the last bit.
    #[inline(always)]
    pub fn weights(&self, shear: &WideShear, doubt: f64) -> (WideWeights, u32) {
        let [a, b, c] = shear.apply(&self.corners);
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let determinant = u + v + w;
        let depth = u * a[2] + v * b[2] + w * c[2];
        let zero = f64x4::ZERO;
        let least = determinant
            .simd_gt(zero)
            .select(u.fast_min(v).fast_min(w), -u.fast_max(v).fast_max(w));
        let bound = determinant.abs() * f64x4::splat(CLEARLY_OUTSIDE) - f64x4::splat(doubt);
        let may_cross = least.simd_ge(bound) & determinant.simd_ne(zero);
        let weights = WideWeights([u, v, w, determinant, depth].map(f64x4::to_array));
        (weights, may_cross.to_bitmask() & self.occupied())
    }

    /// A bit for each triangle whose box, loosened by `slack`, holds a point.
    #[inline(always)]
    pub fn near(&self, point: &Point3<f64>, slack: f64) -> u32 {
        let slack = f64x4::splat(slack);
        let holds = |axis: usize| {
            let at = f64x4::splat(point[axis]);
            let [a, b, c] = self.corners[axis];
            let low = a.fast_min(b).fast_min(c) - slack;
            let high = a.fast_max(b).fast_max(c) + slack;
            at.simd_ge(low) & at.simd_le(high)
        };
        (holds(0) & holds(1) & holds(2)).to_bitmask() & self.occupied()
    }

    /// A bit for each triangle that there is.
    #[inline(always)]
    pub fn occupied(&self) -> u32 {
        (1 << self.count) - 1
    }
}

/// The [`Weights`] of four triangles.
pub(super) struct WideWeights([[f64; LANES]; 5]);

impl WideWeights {
    #[inline(always)]
    pub fn of(&self, lane: usize) -> Weights {
        let [u, v, w, determinant, depth] = self.0.each_ref().map(|row| row[lane]);
        Weights {
            u,
            v,
            w,
            determinant,
            depth,
        }
    }
}
