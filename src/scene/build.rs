//! From the parts of a problem to a scene.

use super::cut::{self, Body};
use super::geometry::Geometry;
use super::mesh_file::MOST_TRIANGLES;
use super::part::BuiltPart;
use super::{SLACK, Scene, Walls};
use crate::printable;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::Part;

impl Scene {
    /// Builds every part.
    ///
    /// # Errors
    /// Every mesh that cannot be read, every cut that cannot be made, and the part from which on there are too many triangles.
    pub fn build(parts: &[Part], walls: Walls) -> Result<Self, Vec<Fault>> {
        let mut faults = Vec::new();
        let (cut_out, standing): (Vec<&Part>, Vec<&Part>) =
            parts.iter().partition(|part| part.is_cut_out(parts));
        let mut tools: Vec<Body> = Vec::new();
        for part in cut_out {
            match Body::of(part, walls) {
                Ok(body) => tools.push(body),
                Err(fault) => faults.push(*fault),
            }
        }
        let mut geometries: Vec<Geometry> = Vec::new();
        let mut triangles = 0;
        for part in &standing {
            let geometry = match part.cut.is_empty() {
                true => Geometry::of(part, walls).map_err(|fault| vec![*fault]),
                false => cut::geometry(part, &tools, walls),
            };
            match geometry {
                Ok(geometry) => {
                    triangles += geometry.mesh.triangles.len();
                    geometries.push(geometry);
                }
                Err(found) => faults.extend(found),
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
        for (part, mut geometry) in standing.into_iter().zip(geometries) {
            let base = scene.number_surfaces(part, &mut geometry);
            scene.warnings.append(&mut geometry.warnings);
            scene.files.append(&mut geometry.files);
            let built = BuiltPart::new(geometry, part, base, SLACK * size);
            scene.parts.push(built);
        }
        for tool in tools {
            scene.warnings.extend(tool.warnings);
            scene.files.extend(tool.file);
        }
        Ok(scene)
    }

    /// Gives the surfaces of a part their numbers; returns what is still to be added to those of its triangles.
    fn number_surfaces(&mut self, part: &Part, geometry: &mut Geometry) -> u32 {
        let names = geometry.mesh.surfaces.iter();
        if !geometry.has_full_names {
            let base = self.surfaces.len() as u32;
            let full = names.map(|name| format!("{}.{}", part.name, printable::line(name)));
            self.surfaces.extend(full);
            return base;
        }
        // What is cut out of two parts has surfaces in both.
        let numbers: Vec<u32> = names
            .map(|name| {
                let name = printable::line(name);
                let known = self.surfaces.iter().position(|it| *it == name);
                let number = known.unwrap_or_else(|| {
                    self.surfaces.push(name.into_owned());
                    self.surfaces.len() - 1
                });
                number as u32
            })
            .collect();
        for triangle in &mut geometry.mesh.triangles {
            triangle.surface = numbers[triangle.surface as usize];
        }
        0
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
