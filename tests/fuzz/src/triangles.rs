//! Triangles one by one: where a line meets one, and how far a point is from one.

use nalgebra::{Point3, Vector3};

pub type Triangle = [Point3<f64>; 3];

/// How deep inside a triangle, in barycentric coordinates, a crossing is sure.
const SURELY_INSIDE: f64 = 1e-6;
/// Triangles lower than this share of their longest edge are too thin to be sure about.
const THIN: f64 = 1e-6;

/// Where a ray surely crosses a triangle well inside it, by Moeller and Trumbore.
pub fn sure_crossing(
    [a, b, c]: &Triangle,
    origin: &Point3<f64>,
    direction: &Vector3<f64>,
) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let across = direction.cross(&ac);
    let determinant = ab.dot(&across);
    let size = ab.norm().max(ac.norm()).max((c - b).norm());
    let height = ab.cross(&ac).norm() / size;
    if height < THIN * size || determinant.abs() < THIN * size * height {
        return None;
    }
    let from_a = origin - a;
    let v = from_a.dot(&across) / determinant;
    let turned = from_a.cross(&ab);
    let w = direction.dot(&turned) / determinant;
    let distance = ac.dot(&turned) / determinant;
    let is_inside = v.min(w).min(1.0 - v - w) > SURELY_INSIDE;
    (is_inside && distance > 0.0).then_some(distance)
}

/// Distance of a point from a triangle.
pub fn distance(point: &Point3<f64>, triangle: &Triangle) -> f64 {
    (point - nearest(point, triangle)).norm()
}

/// The point of a triangle nearest to a point: in its plane, or else on one of its edges.
fn nearest(point: &Point3<f64>, triangle: &Triangle) -> Point3<f64> {
    let [a, b, c] = *triangle;
    let on_edges = [(a, b), (b, c), (c, a)].map(|(from, to)| on_edge(point, from, to));
    let far = |other: &Point3<f64>| (point - other).norm_squared();
    let on_edge = on_edges
        .into_iter()
        .min_by(|one, other| far(one).total_cmp(&far(other)))
        .unwrap_or(a);
    let area_normal = (b - a).cross(&(c - a));
    let Some(normal) = area_normal.try_normalize(0.0) else {
        return on_edge;
    };
    let foot = point - normal * (point - a).dot(&normal);
    let is_inside = [(a, b), (b, c), (c, a)]
        .into_iter()
        .all(|(from, to)| (to - from).cross(&(foot - from)).dot(&area_normal) >= 0.0);
    if is_inside && far(&foot) < far(&on_edge) {
        foot
    } else {
        on_edge
    }
}

fn on_edge(point: &Point3<f64>, from: Point3<f64>, to: Point3<f64>) -> Point3<f64> {
    let edge = to - from;
    let share = (point - from).dot(&edge) / edge.norm_squared();
    from + edge * share.clamp(0.0, 1.0)
}

/// The least distance between a triangle and the first `length` of a ray: along a line the
/// distance from a convex body falls and then rises.
pub fn least_distance(
    triangle: &Triangle,
    origin: &Point3<f64>,
    direction: &Vector3<f64>,
    length: f64,
) -> f64 {
    const NARROWINGS: usize = 80;
    let at = |along: f64| distance(&(origin + direction * along), triangle);
    let (mut low, mut high) = (0.0, length);
    for _ in 0..NARROWINGS {
        let third = (high - low) / 3.0;
        if at(low + third) < at(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    at(0.5 * (low + high)).min(at(0.0)).min(at(length))
}
