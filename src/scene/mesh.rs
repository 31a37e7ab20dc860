//! Triangles with named surfaces.

mod faces;
mod groups;
mod pieces;
mod seams;
mod shells;
mod smoothness;
mod topology;
mod winding;

pub use faces::{Form, SHARP, SmoothFace, SmoothFaces};
pub(super) use pieces::tiny_pieces;
pub(super) use seams::rims;
pub(super) use shells::{Shell, Shells};
pub use topology::Topology;
pub(super) use topology::{duplicates, examine, open_edges};
pub(super) use winding::unify;

use nalgebra::{Point3, Vector3};

/// Triangles with named surfaces, in m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners of the triangles; no two are equal in a mesh that was read from a file.
    pub vertices: Vec<Point3<f64>>,
    /// The triangles, in the order of the file.
    pub triangles: Vec<Triangle>,
    /// Names of the surfaces; every one of them has at least one triangle.
    pub surfaces: Vec<String>,
}

/// One triangle of a [`Mesh`]; its front is the side from which the corners run anticlockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Indices into [`Mesh::vertices`].
    pub corners: [u32; 3],
    /// Index into [`Mesh::surfaces`].
    pub surface: u32,
}

impl Mesh {
    /// The three corners of a triangle, m.
    ///
    /// # Panics
    ///
    /// If the triangle belongs to another mesh and names a vertex that is not here.
    pub fn corners(&self, triangle: &Triangle) -> [Point3<f64>; 3] {
        triangle
            .corners
            .map(|corner| self.vertices[corner as usize])
    }

    /// The centre (mean of the corners) of a triangle, m.
    pub fn centre(&self, triangle: &Triangle) -> Point3<f64> {
        let [a, b, c] = self.corners(triangle);
        Point3::from((a.coords + b.coords + c.coords) / 3.0)
    }

    /// Twice the area of a triangle times its unit normal, m2.
    pub fn doubled_area(&self, triangle: &Triangle) -> Vector3<f64> {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a))
    }

    /// Smallest and largest coordinates, m; `None` without vertices.
    pub fn bounds(&self) -> Option<(Point3<f64>, Point3<f64>)> {
        let first = *self.vertices.first()?;
        Some(
            self.vertices
                .iter()
                .fold((first, first), |(low, high), point| {
                    (low.inf(point), high.sup(point))
                }),
        )
    }

    /// How the triangles hang together.
    pub fn topology(&self) -> Topology {
        examine(self).topology
    }

    /// Whether every edge joins exactly two triangles; see [`Topology::is_closed`].
    pub fn is_closed(&self) -> bool {
        self.topology().is_closed()
    }

    /// Index of the surface called `name`, which is added when it is new.
    pub fn surface_index(&mut self, name: &str) -> u32 {
        let known = self.surfaces.iter().position(|surface| surface == name);
        let index = known.unwrap_or_else(|| {
            self.surfaces.push(name.to_owned());
            self.surfaces.len() - 1
        });
        index as u32
    }
}
