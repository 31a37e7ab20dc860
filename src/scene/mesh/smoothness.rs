//! Triangles without shared corners put together, and the angles between neighbours.

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};

use super::{Mesh, Triangle};

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
    fn sorted_sides(&self) -> Vec<Side> {
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
    fn turn(&self, a: &Side, b: &Side) -> f64 {
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
        first.cross(&second).norm().atan2(first.dot(&second))
    }
}

/// One side of a triangle; the order puts those of one edge side by side.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    ends: [u32; 2],
    triangle: u32,
    backwards: bool,
}
