//! Four triangles side by side, met with a ray at once.

use std::array::from_fn;

use nalgebra::{Point3, Vector3};
use wide::f64x4;

use super::lanes::{larger, smaller};
use super::ray::Ray;
use super::triangle::{CLEARLY_OUTSIDE, Shear, Weights};

/// Triangles of a bundle.
const LANES: usize = 4;

/// One number of each triangle.
type Four = [f64; LANES];

/// One to four triangles.
#[derive(Clone)]
#[repr(align(32))]
pub(super) struct TrianglePacket {
    /// By coordinate and corner, m.
    corners: [[Four; 3]; 3],
    /// Unit normals on the fronts, by coordinate.
    normals: [Four; 3],
    triangles: [u32; LANES],
    count: usize,
}

impl TrianglePacket {
    /// The triangles of these indices, of which there are one to four.
    pub fn new(
        indices: &[u32],
        corners: impl Fn(u32) -> [Point3<f64>; 3],
        normal: impl Fn(&[Point3<f64>; 3]) -> Vector3<f64>,
    ) -> Self {
        let mut bundle = Self {
            corners: [[[0.0; LANES]; 3]; 3],
            normals: [[0.0; LANES]; 3],
            triangles: [0; LANES],
            count: indices.len(),
        };
        for (lane, &index) in indices.iter().enumerate() {
            bundle.triangles[lane] = index;
            let corners = corners(index);
            let normal = normal(&corners);
            for axis in 0..3 {
                for (corner, point) in corners.iter().enumerate() {
                    bundle.corners[axis][corner][lane] = point[axis];
                }
                bundle.normals[axis][lane] = normal[axis];
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
        from_fn(|corner| self.corner(lane, corner))
    }

    /// A corner point of one of them.
    #[inline(always)]
    pub fn corner(&self, lane: usize, corner: usize) -> Point3<f64> {
        Point3::from(from_fn::<f64, 3, _>(|axis| {
            self.corners[axis][corner][lane]
        }))
    }

    /// The unit normal on the front of one of them.
    #[inline(always)]
    pub fn normal(&self, lane: usize) -> Vector3<f64> {
        from_fn::<f64, 3, _>(|axis| self.normals[axis][lane]).into()
    }

    /// How a ray's line passes each triangle, and a bit for each that it
    /// [may cross](Weights::may_cross).
    ///
    /// The same arithmetic as [`Weights`] of a single triangle, to the last bit.
    #[inline(always)]
    pub fn weights(&self, shear: &Shear, doubt: f64) -> (WideWeights, u32) {
        let [x, y, z] = shear.axes;
        let [xs, ys, zs] = [&self.corners[x], &self.corners[y], &self.corners[z]];
        let origin = [shear.origin[x], shear.origin[y], shear.origin[z]];
        let mut all = WideWeights([[0.0; LANES]; 5]);
        let (mut inside, mut bound) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let seen = |corner: usize| {
                let z = zs[corner][lane] - origin[2];
                [
                    xs[corner][lane] - origin[0] - shear.shear[0] * z,
                    ys[corner][lane] - origin[1] - shear.shear[1] * z,
                    shear.shear[2] * z,
                ]
            };
            let (a, b, c) = (seen(0), seen(1), seen(2));
            let u = c[0] * b[1] - c[1] * b[0];
            let v = a[0] * c[1] - a[1] * c[0];
            let w = b[0] * a[1] - b[1] * a[0];
            let determinant = u + v + w;
            let depth = u * a[2] + v * b[2] + w * c[2];
            let (least, most) = (smaller(smaller(u, v), w), larger(larger(u, v), w));
            inside[lane] = if determinant > 0.0 { least } else { -most };
            bound[lane] = determinant.abs() * CLEARLY_OUTSIDE - doubt;
            all.0[0][lane] = u;
            all.0[1][lane] = v;
            all.0[2][lane] = w;
            all.0[3][lane] = determinant;
            all.0[4][lane] = depth;
        }
        let determinant = f64x4::new(all.0[3]);
        let may_cross =
            f64x4::new(inside).simd_ge(f64x4::new(bound)) & determinant.simd_ne(f64x4::ZERO);
        (all, may_cross.to_bitmask() & self.occupied())
    }

    /// A bit for each triangle in whose plane, within `slack`, a ray starts, and for each of those that
    /// it leaves behind at once: more steeply than `grazing`, away from the side that it is on, which
    /// `front` tells.
    #[inline(always)]
    pub fn started_on(&self, ray: &Ray, front: bool, slack: f64, grazing: f64) -> (u32, u32) {
        let (mut heights, mut behind) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let normal = self.normal(lane);
            let height = (ray.origin - self.corner(lane, 0)).dot(&normal);
            let approach = ray.direction.dot(&normal);
            let leaves = (approach.abs() > grazing) & ((approach < 0.0) != front);
            let ahead = if approach > 0.0 { height } else { -height };
            heights[lane] = height.abs();
            behind[lane] = if leaves { ahead } else { 0.0 };
        }
        let on = f64x4::new(heights).simd_le(f64x4::splat(slack));
        let left = on & f64x4::new(behind).simd_gt(f64x4::ZERO);
        (on.to_bitmask() & self.occupied(), left.to_bitmask())
    }

    /// A bit for the triangle of this index, if it is here.
    #[inline(always)]
    pub fn lane_of(&self, index: u32) -> u32 {
        let lanes = self.triangles.iter().enumerate();
        let bits = lanes.map(|(lane, &triangle)| u32::from(triangle == index) << lane);
        bits.sum::<u32>() & self.occupied()
    }

    /// A bit for each triangle whose box, loosened by `slack`, holds a point.
    #[inline(always)]
    pub fn near(&self, point: &Point3<f64>, slack: f64) -> u32 {
        let (mut low, mut high) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3]);
        for axis in 0..3 {
            let [a, b, c] = &self.corners[axis];
            for lane in 0..LANES {
                low[axis][lane] = smaller(smaller(a[lane], b[lane]), c[lane]) - slack;
                high[axis][lane] = larger(larger(a[lane], b[lane]), c[lane]) + slack;
            }
        }
        let holds = |axis: usize| {
            let at = f64x4::splat(point[axis]);
            at.simd_ge(f64x4::new(low[axis])) & at.simd_le(f64x4::new(high[axis]))
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
        let [u, v, w, determinant, depth] = from_fn(|row| self.0[row][lane]);
        Weights {
            u,
            v,
            w,
            determinant,
            depth,
        }
    }
}

#[cfg(test)]
mod tests;
