//! One triangle: rays that cross it, and points that lie on it.
//!
//! The crossing is the watertight test of Woop, Benthin and Wald (Journal of Computer Graphics
//! Techniques 2, 2013), in f64: two triangles that share an edge compute the same number for it,
//! with opposite signs, so no ray slips between them.

use nalgebra::{Point3, Vector3};

use super::ray::Ray;
use crate::elementary::square;

/// Whether the box around a triangle, loosened by `slack`, holds a point: beyond a sharp corner the lines
/// of its edges alone hold points far off it.
#[inline]
pub(super) fn box_holds(corners: &[Point3<f64>; 3], point: &Point3<f64>, slack: f64) -> bool {
    let [a, b, c] = corners;
    let along = |axis: usize| {
        let low = a[axis].min(b[axis]).min(c[axis]);
        let high = a[axis].max(b[axis]).max(c[axis]);
        point[axis] >= low - slack && point[axis] <= high + slack
    };
    along(0) && along(1) && along(2)
}

/// Whether a point is within `slack` of a triangle.
#[inline]
pub(super) fn lies_on(point: &Point3<f64>, corners: &[Point3<f64>; 3], slack: f64) -> bool {
    if !box_holds(corners, point, slack) {
        return false;
    }
    let [a, b, c] = *corners;
    let area_normal = (b - a).cross(&(c - a));
    // Squares, which need no roots.
    let margin = slack * slack * area_normal.norm_squared();
    let inside = |from: Point3<f64>, to: Point3<f64>| {
        let edge = to - from;
        let side = edge.cross(&(point - from)).dot(&area_normal);
        side >= 0.0 || side * side <= margin * edge.norm_squared()
    };
    square((point - a).dot(&area_normal)) <= margin && inside(a, b) && inside(b, c) && inside(c, a)
}

/// The change of coordinates that turns a ray into the positive z axis.
pub(super) struct Shear {
    pub origin: Vector3<f64>,
    /// Which coordinates become x, y and z.
    pub axes: [usize; 3],
    pub shear: [f64; 3],
}

impl Shear {
    #[inline(always)]
    pub fn new(ray: &Ray) -> Self {
        let direction = ray.direction;
        let z = direction.iamax();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        let inverse = 1.0 / direction[z];
        Self {
            origin: ray.origin.coords,
            axes: [x, y, z],
            shear: [direction[x] * inverse, direction[y] * inverse, inverse],
        }
    }

    /// Whether the ray's line passes the box around a triangle, both seen along the ray, by at most
    /// twice `margin`. The lines of two edges run apart so slowly beyond a sharp corner that alone they
    /// hold a ray near far off it; twice, as what is a margin in the triangle's plane looks up to half as
    /// long again.
    fn passes_box(&self, corners: &[Point3<f64>; 3], margin: f64) -> bool {
        let [x, y, z] = self.axes;
        let seen = corners.map(|corner| {
            let from = corner.coords - self.origin;
            [
                from[x] - self.shear[0] * from[z],
                from[y] - self.shear[1] * from[z],
            ]
        });
        (0..2).all(|axis| {
            let [a, b, c] = seen.map(|corner| corner[axis]);
            a.min(b).min(c) <= 2.0 * margin && a.max(b).max(c) >= -2.0 * margin
        })
    }
}

/// How a ray's line passes a triangle: how far on the inner side of each edge, in doubled areas of
/// the triangle as the ray sees it.
#[derive(Clone, Copy)]
pub(super) struct Weights {
    pub u: f64,
    pub v: f64,
    pub w: f64,
    /// Their sum.
    pub determinant: f64,
    /// The sum of each corner's distance along the ray times its weight.
    pub depth: f64,
}

impl Weights {
    /// Whether the line crosses the triangle from the front, if at all.
    #[inline(always)]
    pub fn front(&self) -> bool {
        self.determinant > 0.0
    }

    /// The least of the weights, positive on the inner side.
    #[inline(always)]
    fn least(&self) -> f64 {
        if self.front() {
            self.u.min(self.v).min(self.w)
        } else {
            -self.u.max(self.v).max(self.w)
        }
    }

    /// Whether the line crosses the triangle or does not clearly pass it by: weights below 0 by
    /// `doubt` (m²) may be so by rounding.
    #[inline(always)]
    pub fn may_cross(&self, doubt: f64) -> bool {
        self.determinant != 0.0 && self.least() >= CLEARLY_OUTSIDE * self.determinant.abs() - doubt
    }

    /// Whether a line that crosses the triangle does so so near to an edge that it may be within a margin.
    #[inline(always)]
    pub fn is_near_edge(&self) -> bool {
        self.least() <= -CLEARLY_OUTSIDE * self.determinant.abs()
    }

    /// Signed distance to the plane of the triangle along the ray.
    #[inline(always)]
    pub fn distance(&self) -> f64 {
        self.depth / self.determinant
    }

    /// Whether the line, which [may cross](Self::may_cross) the triangle, crosses it or passes its
    /// edges by at most `margin`; `doubt` is that of [`may_cross`](Self::may_cross).
    #[inline]
    pub fn crosses(
        &self,
        shear: &Shear,
        corners: impl FnOnce() -> [Point3<f64>; 3],
        margin: f64,
        doubt: f64,
    ) -> bool {
        let is_sure = self.least() >= 0.0 && self.determinant.abs() > SURE * doubt;
        is_sure || self.crosses_nearly(shear, &corners(), margin)
    }

    /// Whether the line crosses the triangle or passes it by at most `margin`, even where all that the
    /// weights tell is rounding.
    fn crosses_nearly(&self, shear: &Shear, corners: &[Point3<f64>; 3], margin: f64) -> bool {
        let weights = [self.u, self.v, self.w];
        !beyond(corners, weights, self.determinant, margin) && shear.passes_box(corners, margin)
    }
}

/// Barycentric coordinate of a point that lies beyond an edge by more than the margin of any triangle
/// that is higher than a million margins.
pub(super) const CLEARLY_OUTSIDE: f64 = -1e-6;

/// Times the doubt about weights: with a smaller sum, they do not tell where along a needle a ray
/// crosses it, if at all.
const SURE: f64 = 1e6;

/// Whether the line of a ray crosses the triangle or passes its edges by at most `margin`, both
/// seen along the ray.
pub(super) fn passes_over(
    ray: &Ray,
    shear: &Shear,
    corners: &[Point3<f64>; 3],
    is_front: bool,
    margin: f64,
) -> bool {
    let inwards = if is_front { 1.0 } else { -1.0 };
    let passes_edge = |corner: usize| {
        let from = corners[corner];
        let across = (corners[(corner + 1) % 3] - from).cross(&ray.direction) * inwards;
        (ray.origin - from).dot(&across) >= -margin * across.norm()
    };
    (0..3).all(passes_edge) && shear.passes_box(corners, margin)
}

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

/// Sides of 3, 4 and 5 and an area of 6, at z = 1.
#[cfg(test)]
pub(super) const CORNERS: [Point3<f64>; 3] = [
    Point3::new(0.0, 0.0, 1.0),
    Point3::new(4.0, 0.0, 1.0),
    Point3::new(0.0, 3.0, 1.0),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The middle of each side, and the direction that leads out of the triangle there.
    const SIDES: [([f64; 2], [f64; 2]); 3] = [
        ([2.0, 0.0], [0.0, -1.0]),
        ([2.0, 1.5], [0.6, 0.8]),
        ([0.0, 1.5], [-1.0, 0.0]),
    ];

    fn beside(side: usize, outwards: f64, height: f64) -> Point3<f64> {
        let ([x, y], [u, v]) = SIDES[side];
        Point3::new(x + outwards * u, y + outwards * v, 1.0 + height)
    }

    #[test]
    fn points_lie_on_a_triangle_within_the_slack() {
        let [a, b, c] = CORNERS;
        for corners in [CORNERS, [b, c, a], [c, b, a]] {
            for side in 0..3 {
                for (outwards, height, lies) in [
                    (0.09, 0.0, true),
                    (0.11, 0.0, false),
                    (-0.5, 0.09, true),
                    (-0.5, -0.09, true),
                    (-0.5, 0.11, false),
                    (-0.5, -0.11, false),
                ] {
                    let point = beside(side, outwards, height);
                    let found = lies_on(&point, &corners, 0.1);
                    assert_eq!(found, lies, "{side}, {outwards}, {height}");
                }
            }
        }
        // Beyond a sharp corner the sides alone would hold it.
        let sliver = [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        for turn in 0..3 {
            let turned =
                |point: [f64; 3]| Point3::from([0, 1, 2].map(|axis| point[(axis + turn) % 3]));
            let corners = sliver.map(turned);
            let (near, far) = (turned([100.05, 0.0, 0.0]), turned([101.0, 0.0, 0.0]));
            assert!(lies_on(&near, &corners, 0.1));
            assert!(!lies_on(&far, &corners, 0.1));
            let mirrored = corners.map(|corner| -corner);
            assert!(lies_on(&-near, &mirrored, 0.1));
            assert!(!lies_on(&-far, &mirrored, 0.1));
        }
    }

    fn down(origin: Point3<f64>) -> Ray {
        let direction = -Vector3::z();
        Ray { origin, direction }
    }

    /// The weights of a ray straight down at a point, each the doubled area of what it makes with
    /// a side.
    fn weights(point: &Point3<f64>, scale: f64) -> Weights {
        let [x, y] = [point.x, point.y];
        let (v, w) = (3.0 * x * scale, 4.0 * y * scale);
        let determinant = 12.0 * scale;
        Weights {
            u: determinant - v - w,
            v,
            w,
            determinant,
            depth: 0.5 * determinant,
        }
    }

    #[test]
    fn weights_tell_whether_a_line_crosses() {
        // From the front, and from behind.
        for scale in [1.0, -1.0, 7.0] {
            for side in 0..3 {
                let at = |outwards: f64| weights(&beside(side, outwards, 0.0), scale);
                let found = [-0.5, 0.09, 0.11].map(|outwards| {
                    let shear = Shear::new(&down(beside(side, outwards, 8.0)));
                    at(outwards).crosses(&shear, || CORNERS, 0.1, 0.0)
                });
                assert_eq!(found, [true, true, false], "{scale}, {side}");
                // Heights of the triangle over its sides: 3, 2.4 and 4.
                let height = [3.0, 2.4, 4.0][side];
                let millionths = |count: f64| at(count * 1e-6 * height);
                assert!(millionths(0.9).may_cross(0.0), "{scale}, {side}");
                assert!(!millionths(1.1).may_cross(0.0), "{scale}, {side}");
                assert!(
                    millionths(1.1).may_cross(3e-6 * scale.abs()),
                    "{scale}, {side}"
                );
                assert!(millionths(-0.9).is_near_edge(), "{scale}, {side}");
                assert!(!millionths(-1.1).is_near_edge(), "{scale}, {side}");
            }
            let middle = weights(&Point3::new(1.0, 1.0, 1.0), scale);
            assert_eq!(middle.front(), scale > 0.0);
            assert_eq!(middle.distance(), 0.5);
        }
        assert!(!weights(&CORNERS[0], 0.0).may_cross(1.0));
    }

    #[test]
    fn margins_are_measured_across_the_ray() {
        let [a, b, c] = CORNERS;
        for (corners, is_front) in [(CORNERS, true), ([b, c, a], true), ([c, b, a], false)] {
            for side in 0..3 {
                let passes = |outwards: f64| {
                    let ray = down(beside(side, outwards, 8.0));
                    passes_over(&ray, &Shear::new(&ray), &corners, is_front, 0.1)
                };
                let found = [-0.5, 0.09, 0.11].map(passes);
                assert_eq!(found, [true, true, false], "{side}");
            }
        }
        // A ray that comes down at 30 deg sees 0.2 as 0.1.
        let direction = Vector3::new(0.0, 0.75_f64.sqrt(), -0.5);
        let passes = |y: f64| {
            let origin = Point3::new(2.0, y, 1.0) - direction * 8.0;
            let ray = Ray { origin, direction };
            passes_over(&ray, &Shear::new(&ray), &CORNERS, true, 0.1)
        };
        assert!(passes(-0.19) && !passes(-0.21));
    }
}
