//! A mesh while its file is being read.

use std::collections::HashMap;

use nalgebra::Point3;

use super::defect::Defect;
use super::fault::MeshFault;
use super::mending::Mending;
use super::polygon::{MOST_LOOKS, Polygon};
use super::vertex_index::VertexIndex;
use super::{LARGEST_COORDINATE, MOST_CORNERS, MOST_TRIANGLES};
use crate::scene::mesh::{Mesh, Triangle};

/// Name of the surface of triangles that belong to no group.
pub(super) const ALL: &str = "all";

/// Collects vertices and faces; equal vertices become one.
pub(super) struct Assembly {
    metres_per_unit: f64,
    mesh: Mesh,
    vertex_index: VertexIndex,
    surface_numbers: HashMap<String, u32>,
    polygon: Polygon,
    most_triangles: usize,
    mendings: Vec<Mending>,
    open_fault: Option<MeshFault>,
    deflection: Option<f64>,
}

/// What a file gave.
pub(super) struct Assembled {
    /// Not yet cleaned.
    pub mesh: Mesh,
    /// What was put right.
    pub mendings: Vec<Mending>,
    /// What is wrong with the file, unless the mesh is closed.
    pub open_fault: Option<MeshFault>,
    /// How far its triangles may be from the surface that they approximate, m, where the file says so.
    pub deflection: Option<f64>,
}

impl Assembly {
    pub fn new(metres_per_unit: f64) -> Self {
        Self {
            metres_per_unit,
            mesh: Mesh::default(),
            vertex_index: VertexIndex::new(),
            surface_numbers: HashMap::new(),
            polygon: Polygon::new(MOST_LOOKS),
            most_triangles: MOST_TRIANGLES,
            mendings: Vec::new(),
            open_fault: None,
            deflection: None,
        }
    }

    /// Makes room for a number of triangles that the file is known to hold.
    pub fn expect_triangles(&mut self, count: usize) {
        self.mesh.triangles.reserve_exact(count);
        self.mesh.vertices.reserve(count / 2);
    }

    /// Number of the vertex at these coordinates (in the file's unit).
    pub fn vertex(&mut self, coordinates: [f64; 3]) -> Result<u32, Defect> {
        if !coordinates.iter().all(|value| value.is_finite()) {
            return Err(Defect::NotFinite { coordinates });
        }
        let point = Point3::from(coordinates.map(|value| value * self.metres_per_unit));
        if point.iter().any(|value| value.abs() > LARGEST_COORDINATE) {
            return Err(Defect::TooFarOut { coordinates });
        }
        self.vertex_index
            .find_or_add(&mut self.mesh.vertices, point)
            .ok_or(Defect::TooManyTriangles)
    }

    /// Number of the surface of this name.
    pub fn surface(&mut self, name: &str) -> u32 {
        if let Some(number) = self.surface_numbers.get(name) {
            return *number;
        }
        let number = self.mesh.surfaces.len() as u32; // each takes a line of the file
        self.mesh.surfaces.push(name.to_owned());
        self.surface_numbers.insert(name.to_owned(), number);
        number
    }

    /// Notes what was put right.
    pub fn mended(&mut self, mending: Mending) {
        self.mendings.push(mending);
    }

    /// Notes that the file is cut short if the mesh turns out to be open.
    pub fn must_close(&mut self, fault: MeshFault) {
        self.open_fault = Some(fault);
    }

    /// Notes how far some triangles may be from the surface that they approximate, in the file's unit.
    pub fn deflects_by(&mut self, length: f64) {
        let others = self.deflection.unwrap_or(0.0);
        self.deflection = Some(others.max(length * self.metres_per_unit));
    }

    /// How many triangles there are so far.
    pub fn triangle_count(&self) -> usize {
        self.mesh.triangles.len()
    }

    /// The names of the surfaces so far.
    pub fn surface_names(&self) -> &[String] {
        &self.mesh.surfaces
    }

    /// Gives the surfaces other names; those that come to have the same become one.
    pub fn rename_surfaces(&mut self, mut name_of: impl FnMut(&str) -> String) {
        self.surface_numbers.clear();
        let before = std::mem::take(&mut self.mesh.surfaces);
        let numbers: Vec<u32> = before
            .iter()
            .map(|name| self.surface(&name_of(name)))
            .collect();
        for triangle in &mut self.mesh.triangles {
            triangle.surface = numbers[triangle.surface as usize];
        }
    }

    /// Adds a triangle.
    pub fn triangle(&mut self, corners: [u32; 3], surface: u32) -> Result<(), Defect> {
        if self.mesh.triangles.len() >= self.most_triangles {
            return Err(Defect::TooManyTriangles);
        }
        self.mesh.triangles.push(Triangle { corners, surface });
        Ok(())
    }

    /// Adds a face of three or more corners as triangles.
    pub fn face(&mut self, corners: &[u32], surface: u32) -> Result<(), Defect> {
        if let [a, b, c] = *corners {
            return self.triangle([a, b, c], surface);
        }
        if corners.len() > MOST_CORNERS {
            return Err(Defect::TooManyCorners {
                corners: corners.len(),
            });
        }
        let cut = self.polygon.triangles(corners, &self.mesh.vertices);
        let cut = cut.ok_or(Defect::FacesTooWinding)?;
        if self.mesh.triangles.len() + cut.len() > self.most_triangles {
            return Err(Defect::TooManyTriangles);
        }
        let triangles = cut.iter().map(|&corners| Triangle { corners, surface });
        self.mesh.triangles.extend(triangles);
        Ok(())
    }

    /// The mesh, and what was noticed on the way.
    pub fn finish(self) -> Result<Assembled, Defect> {
        if self.mesh.triangles.is_empty() {
            return Err(Defect::NoTriangles);
        }
        Ok(Assembled {
            mesh: self.mesh,
            mendings: self.mendings,
            open_fault: self.open_fault,
            deflection: self.deflection,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An assembly with the corners of a regular polygon.
    fn polygon(corners: usize) -> (Assembly, Vec<u32>) {
        let mut assembly = Assembly::new(1.0);
        let corner = |index: usize| {
            let (sin, cos) = (std::f64::consts::TAU * index as f64 / corners as f64).sin_cos();
            assembly.vertex([cos, sin, 0.0]).expect("it is near")
        };
        let face = (0..corners).map(corner).collect();
        (assembly, face)
    }

    #[test]
    fn a_mesh_is_full_with_the_triangle_that_reaches_the_limit() {
        // A square is two triangles: of six, two squares and a triangle leave one.
        let (mut assembly, square) = polygon(4);
        assembly.most_triangles = 6;
        let full = Err(Defect::TooManyTriangles);
        assert_eq!(assembly.face(&square[..3], 0), Ok(()));
        assert_eq!(assembly.face(&square, 0), Ok(()));
        assert_eq!(assembly.face(&square, 0), Ok(()));
        assert_eq!(assembly.face(&square, 0), full);
        assert_eq!(assembly.face(&square[..3], 0), Ok(()));
        assert_eq!(assembly.face(&square[..3], 0), full);
        assert_eq!(assembly.finish().map(|it| it.mesh.triangles.len()), Ok(6));
        // The last places may be filled by a square.
        let (mut assembly, square) = polygon(4);
        assembly.most_triangles = 5;
        assert_eq!(assembly.face(&square[..3], 0), Ok(()));
        assert_eq!(assembly.face(&square, 0), Ok(()));
        assert_eq!(assembly.face(&square, 0), Ok(()));
        assert_eq!(assembly.face(&square, 0), full);
    }

    #[test]
    fn faces_have_as_many_corners_as_is_bearable() {
        let (mut assembly, face) = polygon(MOST_CORNERS);
        assert_eq!(assembly.face(&face, 0), Ok(()));
        let count = assembly.finish().map(|it| it.mesh.triangles.len());
        assert_eq!(count, Ok(MOST_CORNERS - 2));
        let (mut assembly, face) = polygon(MOST_CORNERS + 1);
        let corners = MOST_CORNERS + 1;
        assert_eq!(
            assembly.face(&face, 0),
            Err(Defect::TooManyCorners { corners })
        );
    }

    #[test]
    fn coordinates_reach_as_far_as_the_limit() {
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                // In a unit of half a metre.
                let mut assembly = Assembly::new(0.5);
                let mut coordinates = [0.0; 3];
                coordinates[axis] = sign * 2.0 * LARGEST_COORDINATE;
                assert_eq!(assembly.vertex(coordinates), Ok(0));
                coordinates[axis] *= 1.0 + f64::EPSILON;
                assert_eq!(
                    assembly.vertex(coordinates),
                    Err(Defect::TooFarOut { coordinates })
                );
            }
        }
    }
}
