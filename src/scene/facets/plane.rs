//! The plane of a triangle, as well as its corners tell it, and where a ray meets it there.

use nalgebra::{Point3, Vector3};

use crate::scene::ray::Ray;

/// Sine of the angle between ray and facet below which rounding moves the place where they meet by
/// more than it is wide itself.
pub(super) const GRAZING: f64 = 1e-3;

/// The unit normal on the front of a triangle. Its two shorter edges tell it best: in a sliver the two
/// longer ones differ by no more than their rounding.
pub(super) fn normal(corners: &[Point3<f64>; 3]) -> Vector3<f64> {
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
    pub fn new(normal: Vector3<f64>, corners: &[Point3<f64>; 3]) -> Self {
        let point = corners[0];
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

    /// The distance `t` (m) at which a ray crosses a triangle of the plane, rounded as little as the
    /// plane allows. The weights of a sliver are so uncertain that the place may lie off its plane or
    /// beyond its edges, out of sight of the neighbours.
    #[inline(always)]
    pub fn refined(&self, t: f64, ray: &Ray, corners: &[Point3<f64>; 3]) -> f64 {
        if t == 0.0 {
            return t;
        }
        let approach = ray.direction.dot(&self.normal);
        let on_plane = -self.height(&ray.origin) / approach;
        let refined = if approach.abs() > GRAZING {
            on_plane
        } else {
            self.over_triangle(on_plane, ray, corners)
        };
        if refined > 0.0 && refined.is_finite() {
            refined
        } else {
            t
        }
    }

    /// The distance nearest to `t` at which a ray that hardly rises is over the triangle: rounding moves
    /// its crossing with the plane along it, past edges and corners where it meets other triangles.
    pub fn over_triangle(&self, t: f64, ray: &Ray, corners: &[Point3<f64>; 3]) -> f64 {
        let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut nearest, mut farthest) = (f64::INFINITY, f64::NEG_INFINITY);
        for (corner, from) in corners.iter().enumerate() {
            let inwards = self.normal.cross(&(corners[(corner + 1) % 3] - from));
            let speed = ray.direction.dot(&inwards);
            let passes = -(ray.origin - from).dot(&inwards) / speed;
            if speed > 0.0 {
                enters = passes.max(enters);
            } else if speed < 0.0 {
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
