//! Rays against meshes meet what parry's own ray casts meet.

use nalgebra::{Point3, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::query::{Ray as ParryRay, RayCast};
use parry3d_f64::shape::TriMesh;
use peenpose::problem;
use peenpose::scene::ray::Ray;
use peenpose::scene::{Scene, Walls};

use crate::common::shipped;

/// All triangles of a scene as parry's mesh.
fn parry_mesh(scene: &Scene) -> TriMesh {
    let surfaces = 0..scene.surfaces().len() as u32;
    let corners: Vec<Vector> = surfaces
        .flat_map(|surface| scene.surface_triangles(surface))
        .flatten()
        .map(|corner| corner.coords.into())
        .collect();
    let triangles =
        (0..corners.len() as u32 / 3).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]);
    TriMesh::new(corners, triangles.collect()).expect("a mesh with triangles")
}

/// Rays from points inside the bore in all directions.
fn rays(length: f64) -> impl Iterator<Item = Ray> {
    (0..20_000).map(move |index| {
        let share = |dimension| f64::from(sobol_burley::sample(index, dimension, 9));
        let height = 2.0 * share(0) - 1.0;
        let (sin, cos) = (std::f64::consts::TAU * share(1)).sin_cos();
        let flat = (1.0 - height * height).sqrt();
        Ray {
            origin: Point3::new(
                0.01 * (share(2) - 0.5),
                0.01 * (share(3) - 0.5),
                length * (0.05 + 0.9 * share(4)),
            ),
            direction: Vector3::new(flat * cos, flat * sin, height),
        }
    })
}

fn agrees_with_parry(scene: &Scene, length: f64) {
    let mesh = parry_mesh(scene);
    let (mut met, mut count) = (0, 0);
    for ray in rays(length) {
        let same = ParryRay::new(ray.origin.coords.into(), ray.direction.into());
        let parry = mesh.cast_local_ray(&same, f64::MAX, false);
        let ours = scene.first_hit(&ray, None).map(|hit| hit.distance);
        match (ours, parry) {
            (Some(ours), Some(parry)) => assert!((ours - parry).abs() < 1e-9 * length, "{ray:?}"),
            (None, None) => (),
            // parry lets rays through exactly at edges; none of these is aimed at one.
            differ => panic!("{ray:?}: {differ:?}"),
        }
        met += usize::from(ours.is_some());
        count += 1;
    }
    assert!(
        met > count / 2 && met < count,
        "some leave by the open ends: {met}"
    );
}

#[test]
fn a_keyway_of_facets() {
    for degrees in [15.0_f64, 1.0] {
        let walls = Walls::TriangleMesh {
            chord_angle: degrees.to_radians(),
        };
        let scene = Scene::build(&crate::common::keyway(40e-3).parts, walls).unwrap();
        agrees_with_parry(&scene, 40e-3);
    }
}

#[test]
fn a_mesh_from_cad() {
    let parts = problem::read(&shipped::path("keyway-blind.yaml"))
        .unwrap()
        .problem
        .unwrap()
        .parts;
    let scene = Scene::build(&parts, Walls::Exact).unwrap();
    agrees_with_parry(&scene, 60e-3);
}
