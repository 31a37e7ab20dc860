//! Triangles without shared corners put together, and the angles between neighbours.

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};

use super::{Mesh, Triangle};
use crate::elementary::atan2;

impl Mesh {
    /// A mesh of one surface from the corners of its triangles; corners with equal coordinates
    /// become one vertex.
    pub fn joined(triangles: impl IntoIterator<Item = [Point3<f64>; 3]>) -> Self {
        let mut mesh = Self::default();
        let surface = mesh.surface_index("all");
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        for corners in triangles {
            let corners = corners.map(|point| {
                // Adding 0 makes one zero of the two.
                let bits = [point.x, point.y, point.z].map(|x| (x + 0.0).to_bits());
                *known.entry(bits).or_insert_with(|| {
                    mesh.vertices.push(point);
                    mesh.vertices.len() as u32 - 1
                })
            });
            mesh.triangles.push(Triangle { corners, surface });
        }
        mesh
    }

    /// The largest angle, rad, between the normals of two triangles that share an edge, among those
    /// below `limit`; `None` when no edge is that smooth. Edges of one or of more than two triangles
    /// do not count, nor do triangles without an area.
    pub fn largest_smooth_angle(&self, limit: f64) -> Option<f64> {
        let sides = self.sorted_sides();
        let pairs = sides.chunk_by(|a, b| a.ends == b.ends);
        pairs
            .filter_map(|pair| match pair {
                [a, b] => Some(self.turn(a, b)),
                _ => None,
            })
            .filter(|angle| *angle < limit)
            .max_by(f64::total_cmp)
    }

    /// The three sides of every triangle, those of one edge next to each other.
    pub(super) fn sorted_sides(&self) -> Vec<Side> {
        let mut sides = Vec::with_capacity(3 * self.triangles.len());
        for (number, triangle) in (0..).zip(&self.triangles) {
            let [a, b, c] = triangle.corners;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                sides.push(Side {
                    ends: [from.min(to), from.max(to)],
                    triangle: number,
                    backwards: from > to,
                });
            }
        }
        sides.sort_unstable();
        sides
    }

    /// The angle between the normals on both sides of an edge, whichever way they are wound, rad.
    /// It is not a number below any limit when a triangle has no area.
    pub(super) fn turn(&self, a: &Side, b: &Side) -> f64 {
        let normal = |side: &Side| -> Vector3<f64> {
            self.doubled_area(&self.triangles[side.triangle as usize])
        };
        let (first, second) = (normal(a), normal(b));
        if first == Vector3::zeros() || second == Vector3::zeros() {
            return f64::NAN;
        }
        // Neighbours that agree on their front run along their edge in opposite directions.
        let second = if a.backwards == b.backwards {
            -second
        } else {
            second
        };
        atan2(first.cross(&second).norm(), first.dot(&second))
    }
}

/// One side of a triangle; the order puts those of one edge side by side.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    pub ends: [u32; 2],
    pub triangle: u32,
    backwards: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles along the x axis, the second one raised by 10 deg.
    fn hinge(second_runs_alike: bool) -> Vec<[Point3<f64>; 3]> {
        let (sin, cos) = 10.0_f64.to_radians().sin_cos();
        let (start, end) = (Point3::origin(), Point3::new(1.0, 0.0, 0.0));
        let raised = Point3::new(0.0, cos, sin);
        let second = if second_runs_alike {
            [start, end, raised]
        } else {
            [end, start, raised]
        };
        vec![[end, start, Point3::new(0.0, -1.0, 0.0)], second]
    }

    #[test]
    fn winding_does_not_matter_and_edges_above_the_limit_do_not_count() {
        for runs_alike in [true, false] {
            let mesh = Mesh::joined(hinge(runs_alike));
            assert_eq!(mesh.vertices.len(), 4);
            let angle = mesh.largest_smooth_angle(0.5).unwrap();
            assert!((angle.to_degrees() - 10.0).abs() < 1e-12, "{angle}");
            assert_eq!(mesh.largest_smooth_angle(0.1), None);
        }
    }

    #[test]
    fn the_two_zeros_are_one_corner() {
        let mut triangles = hinge(true);
        triangles[0][1] = Point3::new(-0.0, 0.0, -0.0);
        assert_eq!(Mesh::joined(triangles).vertices.len(), 4);
    }

    #[test]
    fn slivers_and_forks_have_no_angle() {
        let mut triangles = hinge(true);
        let (start, end) = (Point3::origin(), Point3::new(1.0, 0.0, 0.0));
        triangles[0] = [end, start, Point3::new(-0.0, 0.0, 0.0)];
        assert_eq!(Mesh::joined(triangles).largest_smooth_angle(0.5), None);
        let mut fork = hinge(true);
        fork.push([start, end, Point3::new(0.0, 0.0, 1.0)]);
        assert_eq!(Mesh::joined(fork).largest_smooth_angle(0.5), None);
    }
}
