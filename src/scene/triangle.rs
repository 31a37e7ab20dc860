//! One triangle: rays that cross it, and points that lie on it.
//!
//! The crossing is the watertight test of Woop, Benthin and Wald (Journal of Computer Graphics
//! Techniques 2, 2013), in f64: two triangles that share an edge compute the same number for it,
//! with opposite signs, so no ray slips between them.

use nalgebra::{Point3, Vector3};

use super::ray::Ray;

/// Whether a point is within `slack` of a triangle.
#[inline]
pub(super) fn lies_on(point: &Point3<f64>, corners: &[Point3<f64>; 3], slack: f64) -> bool {
    let [a, b, c] = *corners;
    let apart = |axis: usize| {
        let (low, high) = (
            a[axis].min(b[axis]).min(c[axis]),
            a[axis].max(b[axis]).max(c[axis]),
        );
        point[axis] < low - slack || point[axis] > high + slack
    };
    if apart(0) || apart(1) || apart(2) {
        return false;
    }
    let area_normal = (b - a).cross(&(c - a));
    let twice_area = area_normal.norm();
    let inside = |from: Point3<f64>, to: Point3<f64>| {
        let edge = to - from;
        edge.cross(&(point - from)).dot(&area_normal) >= -slack * edge.norm() * twice_area
    };
    (point - a).dot(&area_normal).abs() <= slack * twice_area
        && inside(a, b)
        && inside(b, c)
        && inside(c, a)
}

/// The change of coordinates that turns a ray into the positive z axis.
pub(super) struct Shear {
    origin: Vector3<f64>,
    axes: [usize; 3],
    shear: [f64; 3],
}

impl Shear {
    pub fn new(ray: &Ray) -> Self {
        let direction = ray.direction;
        let z = direction.iamax();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        Self {
            origin: ray.origin.coords,
            axes: [x, y, z],
            shear: [
                direction[x] / direction[z],
                direction[y] / direction[z],
                1.0 / direction[z],
            ],
        }
    }

    /// Signed distance to the plane of the triangle where the ray's line crosses the triangle, or
    /// passes its edges by at most the margin of that side, and whether it crosses from the front.
    #[inline]
    pub fn crossing(
        &self,
        corners: &[Point3<f64>; 3],
        margin: impl Fn(bool) -> f64,
    ) -> Option<(f64, bool)> {
        let [x, y, z] = self.axes;
        let sheared = corners.map(|corner| {
            let p = corner.coords - self.origin;
            [
                p[x] - self.shear[0] * p[z],
                p[y] - self.shear[1] * p[z],
                self.shear[2] * p[z],
            ]
        });
        let [a, b, c] = sheared;
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let determinant = u + v + w;
        if determinant == 0.0 {
            return None;
        }
        let least = if determinant > 0.0 {
            u.min(v).min(w)
        } else {
            -u.max(v).max(w)
        };
        if least < CLEARLY_OUTSIDE * determinant.abs() {
            return None;
        }
        let front = determinant > 0.0;
        if least < 0.0 && beyond(corners, [u, v, w], determinant, margin(front)) {
            return None;
        }
        let t = (u * a[2] + v * b[2] + w * c[2]) / determinant;
        Some((t, front))
    }
}

/// Barycentric coordinate of a point that lies beyond an edge by more than the margin of any triangle
/// that is higher than a million margins.
const CLEARLY_OUTSIDE: f64 = -1e-6;

/// Whether a point of a triangle's plane, given by its barycentric coordinates times
/// `determinant`, lies beyond an edge by more than `margin`.
#[inline]
fn beyond(corners: &[Point3<f64>; 3], weights: [f64; 3], determinant: f64, margin: f64) -> bool {
    let shares = weights.map(|weight| weight / determinant);
    let [a, b, c] = *corners;
    let twice_area = (b - a).cross(&(c - a)).norm();
    let opposite = [c - b, a - c, b - a];
    let mut sides = shares.iter().zip(opposite);
    sides.any(|(share, edge)| share * twice_area < -margin * edge.norm())
}
