//! Boxes that name parts of a mesh.

use nalgebra::{Point3, distance};

use super::cleaning::drop_unused;
use super::defect::Defect;
use crate::problem::part::Region;
use crate::scene::mesh::Mesh;

/// How far outside its region a centre may lie, relative to the mesh's diagonal: a box that ends
/// exactly in a flat face still holds it after rounding.
const SLACK: f64 = 1e-9;

/// Gives every triangle whose centre lies in a region to the surface of that name. Where regions
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
    for region in regions {
        let surface = surface_number(mesh, &region.name);
        let mut triangles = std::mem::take(&mut mesh.triangles);
        let mut found = false;
        for triangle in &mut triangles {
            if holds(region, &mesh.centre(triangle), slack) {
                triangle.surface = surface;
                found = true;
            }
        }
        mesh.triangles = triangles;
        if !found {
            return Err(Defect::EmptyRegion {
                region: region.name.clone(),
                min: min / metres_per_unit,
                max: max / metres_per_unit,
            });
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

fn holds(region: &Region, point: &Point3<f64>, slack: f64) -> bool {
    (0..3).all(|axis| {
        point[axis] >= region.min[axis] - slack && point[axis] <= region.max[axis] + slack
    })
}
