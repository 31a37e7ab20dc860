//! Boxes and points that name parts of a mesh.

use nalgebra::{Point3, distance};

use super::cleaning::drop_unused;
use super::defect::Defect;
use crate::problem::part::{Region, RegionPlace};
use crate::scene::mesh::{Mesh, SHARP, SmoothFaces};
use crate::scene::patch::near_enough;

/// How far outside its region a centre may lie, relative to the mesh's diagonal: a box that ends
/// exactly in a flat face still holds it after rounding.
const SLACK: f64 = 1e-9;

/// Gives every triangle of a region to the surface of that name: those whose centre lies in a box, or those of the smooth face of
/// the mesh as it was read that a point lies on. Where regions
/// overlap, the later one wins, as a second coat of paint does; a region named like a surface of the
/// file adds to it. Surfaces that lose all triangles vanish.
pub(super) fn name_triangles(
    mesh: &mut Mesh,
    metres_per_unit: f64,
    regions: &[Region],
) -> Result<(), Defect> {
    let Some((min, max)) = mesh.bounds() else {
        return Ok(());
    };
    let slack = SLACK * distance(&min, &max);
    let has_faces = |region: &Region| matches!(region.place, RegionPlace::Face(_));
    let faces = regions
        .iter()
        .any(has_faces)
        .then(|| mesh.smooth_faces(SHARP));
    for region in regions {
        let members: Vec<usize> = match (region.place, &faces) {
            (RegionPlace::Face(at), Some(faces)) => {
                let face = face_at(mesh, faces, &region.name, &at, slack)?;
                let of = faces.of.iter().enumerate();
                of.filter(|(_, it)| **it == face)
                    .map(|(index, _)| index)
                    .collect()
            }
            (RegionPlace::Box { min, max }, _) => {
                let triangles = mesh.triangles.iter().enumerate();
                let held = triangles.filter(|(_, it)| holds([&min, &max], &mesh.centre(it), slack));
                held.map(|(index, _)| index).collect()
            }
            (RegionPlace::Face(_), None) => Vec::new(),
        };
        if members.is_empty() {
            return Err(Defect::EmptyRegion {
                region: region.name.clone(),
                min: min / metres_per_unit,
                max: max / metres_per_unit,
            });
        }
        let surface = surface_number(mesh, &region.name);
        for index in members {
            mesh.triangles[index].surface = surface;
        }
    }
    drop_unused(mesh);
    match regions
        .iter()
        .find(|region| !mesh.surfaces.contains(&region.name))
    {
        Some(region) => Err(Defect::CoveredRegion {
            region: region.name.clone(),
        }),
        None => Ok(()),
    }
}

fn surface_number(mesh: &mut Mesh, name: &str) -> u32 {
    let position = mesh.surfaces.iter().position(|surface| surface == name);
    let position = position.unwrap_or_else(|| {
        mesh.surfaces.push(name.to_owned());
        mesh.surfaces.len() - 1
    });
    position as u32
}

fn holds([min, max]: [&Point3<f64>; 2], point: &Point3<f64>, slack: f64) -> bool {
    (0..3).all(|axis| point[axis] >= min[axis] - slack && point[axis] <= max[axis] + slack)
}

/// The face that a point lies on: on that of a drawing, of which the facets are a little inside.
fn face_at(
    mesh: &Mesh,
    faces: &SmoothFaces,
    region: &str,
    at: &Point3<f64>,
    slack: f64,
) -> Result<u32, Defect> {
    let (near, distance) = mesh.nearest_triangles(at, slack);
    let mut found: Vec<u32> = near.iter().map(|&index| faces.of[index]).collect();
    found.sort_unstable();
    found.dedup();
    let area = found
        .first()
        .map_or(0.0, |&face| faces.list[face as usize].area);
    let region = region.to_owned();
    match found[..] {
        [face] if distance <= near_enough(area) => Ok(face),
        _ if distance > near_enough(area) => Err(Defect::RegionOffMesh { region, distance }),
        _ => Err(Defect::RegionOnEdge { region }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_holds_a_centre_that_rounding_puts_outside() {
        // A triangle of 300 by 400, whose centre is at (100, 400 / 3).
        let found = |outside: f64| {
            let mut mesh =
                Mesh::joined([[[0.0; 3], [300.0, 0.0, 0.0], [0.0, 400.0, 0.0]].map(Point3::from)]);
            let region = Region {
                name: "lip".to_owned(),
                place: RegionPlace::Box {
                    min: Point3::new(100.0 + outside, 0.0, 0.0),
                    max: Point3::new(500.0, 500.0, 0.0),
                },
            };
            name_triangles(&mut mesh, 1.0, &[region]).is_ok()
        };
        // The diagonal is 500.
        assert!(found(0.0) && found(4e-7));
        assert!(!found(6e-7));
    }
}
