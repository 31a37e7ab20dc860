//! Triangles with named surfaces.

use nalgebra::{Point3, Vector3};

/// Triangles with named surfaces, in m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corner points.
    pub vertices: Vec<Point3<f64>>,
    /// Triangles, each on one surface.
    pub triangles: Vec<Triangle>,
    /// Names of the surfaces.
    pub surfaces: Vec<String>,
}

/// One triangle; its front is the side from which its corners run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Indices of the corner points.
    pub corners: [u32; 3],
    /// Index of the surface.
    pub surface: u32,
}

impl Mesh {
    /// The corner points of a triangle.
    pub fn corners(&self, triangle: &Triangle) -> [Point3<f64>; 3] {
        triangle
            .corners
            .map(|corner| self.vertices[corner as usize])
    }

    /// Twice the area times the unit normal on the front.
    pub fn area_normal(&self, triangle: &Triangle) -> Vector3<f64> {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a))
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
