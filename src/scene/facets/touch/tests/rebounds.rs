//! Spheres that start in contact.

use nalgebra::{Point3, Vector3};

use super::super::super::tests::{Random, room};
use super::{Found, facets, mirrored, size, spot};
use crate::problem::part::{Ends, Keyway};
use crate::scene::mesh::Mesh;
use crate::scene::profile::Profile;
use crate::scene::ray::Ray;
use crate::scene::tessellate;

fn keyway() -> Mesh {
    let profile = Profile::keyway(&Keyway {
        bore: 2.0,
        width: 0.6,
        depth: 0.25,
        length: 2.0,
        root_radius: 0.0,
    });
    let ends = Ends {
        near_closed: true,
        far_closed: true,
    };
    tessellate::prism(&profile, 2.0, ends, 0.05)
}

#[test]
fn no_sphere_leaves_a_closed_mesh() {
    let mut random = Random(18);
    for (mut mesh, radius, bounces) in [
        (keyway(), 0.15, 100_000),
        (room(0.05), 0.01, 20_000),
        (room(0.05), 0.4, 20_000),
    ] {
        // Nothing lies along an axis.
        let turn = nalgebra::Rotation3::new(Vector3::new(0.3, 0.5, 0.7));
        for vertex in &mut mesh.vertices {
            *vertex = turn * *vertex;
        }
        let slack = 1e-12 * size(&mesh);
        let facets = facets(&mesh);
        let mut ray = Ray {
            origin: turn * Point3::new(0.05, -0.03, 0.75),
            direction: random.direction(),
        };
        let mut leaving = None;
        for bounce in 0..bounces {
            let found = facets.first_touch(&ray, radius, leaving, true, f64::INFINITY);
            let (crossing, normal) = found.expect("the mesh is closed");
            ray.origin += ray.direction * crossing.distance;
            let nearest = facets.nearest_point(&ray.origin, |_| true).unwrap();
            assert!(
                (nearest.distance - radius).abs() <= slack,
                "{bounce}: {} at {crossing:?}",
                (nearest.distance - radius) / slack
            );
            assert!(ray.direction.dot(&normal) < 0.0);
            ray.direction = mirrored(&ray.direction, &normal);
            leaving = Some(spot(&crossing));
        }
    }
}

/// A shot that starts in contact with two walls heads into one of them, into both, or into none.
#[test]
fn in_a_corner_the_wall_that_the_sphere_heads_into_is_touched_at_once() {
    let block = tessellate::block(Point3::origin(), Point3::new(1.0, 1.0, 1.0));
    let facets = facets(&block);
    let radius = 0.25;
    let origin = Point3::new(radius, radius, 0.4);
    let touch = |x: f64, y: f64, leaving| -> Found {
        let direction = Vector3::new(x, y, 0.0).normalize();
        let ray = Ray { origin, direction };
        facets.first_touch(&ray, radius, leaving, true, f64::INFINITY)
    };
    let (wall, normal) = touch(-1.0, 1.0, None).unwrap();
    assert_eq!((wall.distance, normal), (0.0, Vector3::x()));
    let (wall, normal) = touch(0.5, -1.0, Some(spot(&wall))).unwrap();
    assert_eq!((wall.distance, normal), (0.0, Vector3::y()));
    let (wall, normal) = touch(1.0, 0.5, Some(spot(&wall))).unwrap();
    assert!((wall.distance - 0.5 * 1.25_f64.sqrt()).abs() < 1e-14);
    assert!((normal + Vector3::x()).norm() < 1e-14);
}

#[test]
fn a_sphere_that_overlaps_a_wall_leaves_it_or_hits_it_at_once() {
    let block = tessellate::block(Point3::origin(), Point3::new(1.0, 1.0, 1.0));
    let facets = facets(&block);
    let touch = |x: f64| {
        let ray = Ray {
            origin: Point3::new(0.1, 0.45, 0.5),
            direction: Vector3::new(x, 0.0, 0.0),
        };
        let found = facets.first_touch(&ray, 0.25, None, false, f64::INFINITY);
        found.unwrap().0.distance
    };
    assert_eq!(touch(-1.0), 0.0);
    assert!((touch(1.0) - 0.65).abs() < 1e-15);
}
