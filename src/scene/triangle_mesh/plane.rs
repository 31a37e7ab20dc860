//! The plane of a triangle, as well as its corners tell it, and where a ray meets it there.

use nalgebra::{Point3, Vector3};

use crate::scene::ray::Ray;

/// Sine of the angle between ray and facet below which rounding moves the place where they meet by
/// more than it is wide itself.
pub(super) const GRAZING: f64 = 1e-3;

/// The unit normal on the front of a triangle. Its two shorter edges tell it best: in a sliver the two
/// longer ones differ by no more than their rounding.
pub(in crate::scene) fn normal(corners: &[Point3<f64>; 3]) -> Vector3<f64> {
    let [a, b, c] = *corners;
    let [ab, bc, ca] = [b - a, c - b, a - c];
    let [opposite_a, opposite_b, opposite_c] = [bc, ca, ab].map(|edge| edge.norm_squared());
    let doubled_area = if opposite_a >= opposite_b.max(opposite_c) {
        ca.cross(&ab)
    } else if opposite_b >= opposite_c {
        ab.cross(&bc)
    } else {
        bc.cross(&ca)
    };
    doubled_area.normalize()
}

/// The plane of a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// Unit normal on the front.
    pub normal: Vector3<f64>,
    /// A point of it, m: far from the origin differences have more digits than distances.
    point: Point3<f64>,
}

impl Plane {
    #[inline(always)]
    pub fn new(normal: Vector3<f64>, point: Point3<f64>) -> Self {
        Self { normal, point }
    }

    /// How far a point lies in front of it, m.
    #[inline(always)]
    pub fn height(&self, point: &Point3<f64>) -> f64 {
        (point - self.point).dot(&self.normal)
    }

    /// How far on the side that it sees a ray starts already, m, where it hits at distance 0.
    #[inline(always)]
    pub fn above(&self, distance: f64, front: bool, start: &Point3<f64>) -> f64 {
        match (distance > 0.0, front) {
            (true, _) => 0.0,
            (false, true) => self.height(start),
            (false, false) => -self.height(start),
        }
    }

    /// The distance along a ray at which it crosses the plane, m; less than 0 behind it.
    #[inline(always)]
    pub fn distance(&self, ray: &Ray) -> f64 {
        -self.height(&ray.origin) / ray.direction.dot(&self.normal)
    }

    /// The distance `t` (m) at which a ray that hardly rises crosses a triangle of the plane, rounded as
    /// little as the plane allows. The weights of a sliver are so uncertain that the place may lie off
    /// its plane or beyond its edges, out of sight of the neighbours.
    pub fn refined(&self, t: f64, ray: &Ray, corners: &[Point3<f64>; 3]) -> f64 {
        let refined = self.over_triangle(self.distance(ray), ray, corners);
        if refined > 0.0 && refined.is_finite() {
            refined
        } else {
            t
        }
    }

    /// The distance nearest to `t` at which a ray that hardly rises is over the triangle: rounding moves
    /// its crossing with the plane along it, past edges and corners where it meets other triangles.
    ///
    /// An edge that the ray passes at a smaller angle than the plane does not tell any better where.
    pub fn over_triangle(&self, t: f64, ray: &Ray, corners: &[Point3<f64>; 3]) -> f64 {
        let approach = ray.direction.dot(&self.normal).abs();
        let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut nearest, mut farthest) = (f64::INFINITY, f64::NEG_INFINITY);
        for (corner, from) in corners.iter().enumerate() {
            let inwards = self.normal.cross(&(corners[(corner + 1) % 3] - from));
            let speed = ray.direction.dot(&inwards);
            let passes = -(ray.origin - from).dot(&inwards) / speed;
            let least = approach * inwards.norm();
            if speed > least {
                enters = passes.max(enters);
            } else if speed < -least {
                leaves = passes.min(leaves);
            }
            let along = ray.direction.dot(&(from - ray.origin));
            nearest = along.min(nearest);
            farthest = along.max(farthest);
        }
        // A corner that it passes by less than rounding, it may seem to leave before it gets there. Edges
        // along the ray do not tell well where it crosses them, but the corners do.
        t.max(enters.min(leaves))
            .min(enters.max(leaves))
            .max(nearest)
            .min(farthest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::triangle::CORNERS;

    fn plane() -> Plane {
        Plane::new(normal(&CORNERS), CORNERS[0])
    }

    fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
        Ray::of(origin, Vector3::from(direction).normalize().into())
    }

    #[test]
    fn normals_look_to_the_side_where_corners_run_anticlockwise() {
        let [a, b, c] = CORNERS;
        for corners in [[a, b, c], [b, c, a], [c, a, b]] {
            assert_eq!(normal(&corners), Vector3::z());
        }
        for corners in [[c, b, a], [b, a, c], [a, c, b]] {
            assert_eq!(normal(&corners), -Vector3::z());
        }
    }

    #[test]
    fn normals_of_slivers_lose_no_digits() {
        // Whole numbers, so that edges are exact and an exact product shows how far off a normal is.
        let sliver = [[0, 0, 0], [1_000_000_007, 3, -400_000_009], [3, -2, 5]];
        for turn in 0..6 {
            let [one, other] = if turn < 3 { [1, 2] } else { [2, 1] };
            let order = [turn, turn + one, turn + other].map(|corner| corner % 3);
            let [a, b, c] = order.map(|corner| sliver[corner].map(i128::from));
            let edge = |from: [i128; 3], to: [i128; 3]| [0, 1, 2].map(|axis| to[axis] - from[axis]);
            let ([x, y, z], [u, v, w]) = (edge(a, b), edge(a, c));
            let exact = [y * w - z * v, z * u - x * w, x * v - y * u].map(|it| it as f64);
            let corners = [a, b, c].map(|corner| Point3::from(corner.map(|it| it as f64)));
            let off = normal(&corners) - Vector3::from(exact).normalize();
            assert!(off.norm() < 1e-15, "{order:?}: {off}");
        }
    }

    #[test]
    fn heights_are_measured_from_the_front() {
        let plane = plane();
        assert_eq!(plane.height(&Point3::new(7.0, -5.0, 3.0)), 2.0);
        assert_eq!(plane.height(&Point3::new(7.0, -5.0, 0.5)), -0.5);
        let (over, under) = (Point3::new(1.0, 1.0, 1.25), Point3::new(1.0, 1.0, 0.75));
        // Only of what is hit at once.
        assert_eq!(plane.above(0.0, true, &over), 0.25);
        assert_eq!(plane.above(0.0, false, &under), 0.25);
        assert_eq!(plane.above(0.0, true, &under), -0.25);
        assert_eq!(plane.above(0.5, true, &over), 0.0);
    }

    #[test]
    fn rays_cross_where_the_plane_is() {
        let distance = |origin: [f64; 3], direction: [f64; 3]| {
            let distance = plane().distance(&ray(origin, direction));
            (distance * 1e12).round() / 1e12
        };
        assert_eq!(distance([1.0, 1.0, 3.0], [0.0, 0.0, -1.0]), 2.0);
        assert_eq!(distance([1.0, 1.0, -1.0], [0.0, 0.0, 1.0]), 2.0);
        assert_eq!(distance([1.0, 1.0, 0.5], [0.0, 0.0, -1.0]), -0.5);
        // 4 along for 3 down.
        assert_eq!(distance([-3.0, 1.0, 4.0], [4.0, 0.0, -3.0]), 5.0);
    }

    #[test]
    fn grazing_rays_cross_over_the_triangle() {
        // Along y = 1.5 the triangle reaches from x = 0 to x = 2; the ray comes from x = -1.
        let along = ray([-1.0, 1.5, 1.0], [1.0, 0.0, 0.0]);
        let over = |t: f64| plane().over_triangle(t, &along, &CORNERS);
        let found = [-5.0, 0.5, 1.0, 2.0, 3.0, 3.5, 9.0].map(over);
        assert_eq!(found, [1.0, 1.0, 1.0, 2.0, 3.0, 3.0, 3.0]);
        let back = ray([5.0, 1.5, 1.0], [-1.0, 0.0, 0.0]);
        let over = |t: f64| plane().over_triangle(t, &back, &CORNERS);
        assert_eq!([1.0, 4.0, 9.0].map(over), [3.0, 4.0, 5.0]);

        // Along an edge, and beside it by rounding.
        for y in [0.0, 1e-15, -1e-15] {
            let along = ray([-1.0, y, 1.0], [1.0, 0.0, 0.0]);
            let over = |t: f64| plane().over_triangle(t, &along, &CORNERS);
            let found = [0.5, 1.0, 2.0, 5.0, 9.0].map(over);
            let expected = [1.0, 1.0, 2.0, 5.0, 5.0];
            let is_near = |(found, expected): (f64, f64)| (found - expected).abs() < 1e-14;
            assert!(
                found.into_iter().zip(expected).all(is_near),
                "{y}: {found:?}"
            );
        }

        // Along an edge as seen from above, but down through the plane.
        let corners = [[0.0, 0.0, 0.0], [0.7, 0.1, 0.0], [0.0, 1.0, 0.0]].map(Point3::from);
        let sloping = Plane::new(normal(&corners), corners[0]);
        for rise in [5e-4, -5e-4, 1e-6, -1e-6] {
            let way = Vector3::new(0.7, 0.1, 0.0).normalize() - Vector3::z() * rise;
            let direction = way.normalize();
            let origin = Point3::new(0.35, 0.05, 0.0) - direction * 3.0;
            let ray = Ray { origin, direction };
            let off = sloping.refined(2.5, &ray, &corners) - 3.0;
            assert!(off.abs() < 1e-15 / rise.abs(), "{rise}: {off}");
        }

        // So flat that it meets the plane 1 behind the triangle.
        let flat = ray([-1.0, 1.5, 1.0 + 4e-4], [1.0, 0.0, -1e-4]);
        let found = plane().refined(3.5, &flat, &CORNERS);
        assert!((found - 3.0).abs() < 1e-6, "{found}");

        // What lies behind, or nowhere, is no better than what is known.
        let behind = ray([3.0, 1.5, 1.0 - 1e-7], [1.0, 0.0, -1e-4]);
        assert_eq!(plane().refined(0.1, &behind, &CORNERS), 0.1);
        let nowhere = ray([f64::NAN; 3], [1.0, 0.0, -1e-4]);
        assert_eq!(plane().refined(0.1, &nowhere, &CORNERS), 0.1);
    }
}
