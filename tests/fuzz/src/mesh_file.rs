//! Mesh files: whatever stands in one, it is refused with a reason or becomes a sound mesh.

use std::collections::HashSet;
use std::io::Write;

use nalgebra::{Point3, Vector3};
use peenpose::problem::part::{Part, Place, Region, RegionPlace, Shape, Target};
use peenpose::scene::mesh::Mesh;
use peenpose::scene::mesh_file::{self, LARGEST_COORDINATE};
use peenpose::scene::patch::Patch;
use peenpose::scene::ray::Ray;
use peenpose::scene::{Scene, Walls};

use super::bytes::Bytes;

/// Longest complaint about a file, its own name included.
const LONGEST_COMPLAINT: usize = 1000;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let first = bytes.byte();
    let ending = [".stl", ".obj", ".ply"][usize::from(first) % 3];
    let metres_per_unit = [1e-6, 1e-3, 0.0254, 1.0][usize::from(first / 3) % 4];
    let regions = regions(usize::from(first / 12) % 3, metres_per_unit);
    let mut file = tempfile::Builder::new()
        .suffix(ending)
        .tempfile()
        .expect("there is room for a file");
    file.write_all(bytes.0)
        .expect("there is room for the input");
    let read = mesh_file::read(file.path(), metres_per_unit, &regions);
    let (mesh, warnings) = match read {
        Ok(read) => read,
        Err(fault) => {
            let complaint = fault.to_string();
            assert!(
                complaint.chars().count() <= LONGEST_COMPLAINT,
                "{complaint}"
            );
            assert!(!complaint.contains(char::is_control), "{complaint:?}");
            return;
        }
    };
    is_sound(&mesh);
    for region in &regions {
        assert!(mesh.surfaces.contains(&region.name));
    }
    for warning in warnings {
        assert!(!warning.to_string().contains("NaN"), "{warning}");
    }
    let part = Part {
        name: "part".into(),
        shape: Shape::Mesh {
            file: file.path().to_owned().into(),
            metres_per_unit,
            regions,
        },
        place: Place::default(),
        on_nozzle: false,
        cut: Vec::new(),
    };
    let scene = Scene::build(&[part], Walls::Exact).expect("it could be read before");
    assert_eq!(scene.triangles(), mesh.triangles.len());
    can_be_used(&scene, &mesh);
}

fn regions(count: usize, metres_per_unit: f64) -> Vec<Region> {
    let region = |index: usize| Region {
        name: format!("region{index}"),
        place: match index {
            // A point that may be anywhere, and boxes.
            0 => RegionPlace::Face(Point3::origin()),
            _ => RegionPlace::Box {
                min: Point3::from(Vector3::repeat(index as f64 - 1.0) * metres_per_unit),
                max: Point3::from(Vector3::repeat(index as f64 + 1.0) * metres_per_unit),
            },
        },
    };
    (0..count).map(region).collect()
}

fn is_sound(mesh: &Mesh) {
    assert!(!mesh.triangles.is_empty());
    let mut seen = HashSet::new();
    let mut surfaces = vec![false; mesh.surfaces.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.corners;
        assert!(a != b && b != c && c != a);
        let mut sorted = triangle.corners;
        sorted.sort_unstable();
        assert!(
            seen.insert(sorted),
            "two triangles with the corners {sorted:?}"
        );
        surfaces[triangle.surface as usize] = true;
        for corner in mesh.corners(triangle) {
            let is_near = |value: &f64| value.abs() <= LARGEST_COORDINATE;
            assert!(corner.iter().all(is_near), "{corner:?}");
        }
    }
    assert!(surfaces.into_iter().all(|is_used| is_used));
    let topology = mesh.topology();
    assert!(topology.signed_volume.is_finite());
}

fn can_be_used(scene: &Scene, mesh: &Mesh) {
    let centre = mesh.centre(&mesh.triangles[0]);
    for direction in [Vector3::x(), -Vector3::y(), Vector3::z()] {
        let ray = Ray {
            origin: centre - direction * (2.0 * scene.size()),
            direction,
        };
        for radius in [0.0, 0.1 * scene.size()] {
            if let Some(hit) = scene.first_contact(&ray, radius, None, None) {
                assert!(hit.distance >= 0.0 && hit.distance.is_finite(), "{hit:?}");
                assert!((hit.normal.norm() - 1.0).abs() < 1e-6, "{hit:?}");
                assert!((hit.surface as usize) < scene.surfaces().len());
            }
        }
    }
    let target = Target {
        lengths_in: Default::default(),
        surface: scene.surfaces()[0].clone(),
        within: None,
        aim: None,
        aim_key: "target.aim",
        along: None,
        facing: None,
    };
    match Patch::find(scene, &target) {
        Ok(patch) => {
            let frame = patch.frame;
            assert!((frame.normal.norm() - 1.0).abs() < 1e-6, "{frame:?}");
            assert!(frame.aim.iter().all(|value| value.is_finite()), "{frame:?}");
        }
        Err(faults) => assert!(!faults.is_empty()),
    }
}
