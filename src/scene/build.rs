//! From the parts of a problem to a scene.

use super::mesh_file::MOST_TRIANGLES;
use super::part::Geometry;
use super::{SLACK, Scene, Walls};
use crate::printable;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::Part;

impl Scene {
    /// Builds every part.
    ///
    /// # Errors
    /// Every mesh that cannot be read, and the part from which on there are too many triangles.
    pub fn build(parts: &[Part], walls: Walls) -> Result<Self, Vec<Fault>> {
        let mut faults = Vec::new();
        let mut geometries: Vec<Geometry> = Vec::new();
        let mut triangles = 0;
        for part in parts {
            match Geometry::of(part, walls) {
                Ok(geometry) => {
                    triangles += geometry.mesh.triangles.len();
                    geometries.push(geometry);
                }
                Err(fault) => faults.push(*fault),
            }
            if let Some(fault) = too_many_triangles(part, triangles) {
                faults.push(fault);
                break;
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let size = farthest_coordinate(&geometries);
        let mut scene = Self {
            parts: Vec::new(),
            surfaces: Vec::new(),
            warnings: Vec::new(),
            files: Vec::new(),
            size,
            reach: size.min(longest_side(&geometries)),
        };
        for (part, mut geometry) in parts.iter().zip(geometries) {
            let base = scene.surfaces.len() as u32;
            let names = geometry.mesh.surfaces.iter();
            let full = names.map(|name| format!("{}.{}", part.name, printable::line(name)));
            scene.surfaces.extend(full);
            scene.warnings.append(&mut geometry.warnings);
            scene.files.extend(geometry.file.take());
            scene.parts.push(geometry.build(part, base, SLACK * size));
        }
        Ok(scene)
    }
}

/// The fault of a part with which the scene gets too large.
pub(super) fn too_many_triangles(part: &Part, triangles: usize) -> Option<Fault> {
    let message = format!("up to this part the scene has more than {MOST_TRIANGLES} triangles");
    let fault = Fault::at_key(
        FaultCode::SceneTooLarge,
        format!("scene.{}", part.name),
        message,
    )
    .expecting("fewer or coarser meshes, at most so many triangles together");
    (triangles > MOST_TRIANGLES).then_some(fault)
}

/// Longest side of the box round all corners: the scale of the shapes, wherever the scene stands.
fn longest_side(geometries: &[Geometry]) -> f64 {
    let bounds = geometries
        .iter()
        .filter_map(|geometry| geometry.mesh.bounds());
    let all = bounds.reduce(|(low, high), (a, b)| (low.inf(&a), high.sup(&b)));
    all.map_or(0.0, |(low, high)| (high - low).max())
}

fn farthest_coordinate(geometries: &[Geometry]) -> f64 {
    let vertices = geometries
        .iter()
        .flat_map(|geometry| &geometry.mesh.vertices);
    vertices.fold(0.0, |largest: f64, vertex| {
        largest.max(vertex.coords.amax())
    })
}
