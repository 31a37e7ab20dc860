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
                min: Point3::new(100.0 + outside, 0.0, 0.0),
                max: Point3::new(500.0, 500.0, 0.0),
            };
            name_triangles(&mut mesh, 1.0, &[region]).is_ok()
        };
        // The diagonal is 500.
        assert!(found(0.0) && found(4e-7));
        assert!(!found(6e-7));
    }
}
