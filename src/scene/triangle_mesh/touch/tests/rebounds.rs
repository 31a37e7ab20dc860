//! Spheres that start in contact.

use nalgebra::{Point3, Vector3};

use super::super::super::tests::{Random, room};
use super::{Found, facets, hit_id, mirrored, size};
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
            leaving = Some(hit_id(&crossing));
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
    let (wall, normal) = touch(0.5, -1.0, Some(hit_id(&wall))).unwrap();
    assert_eq!((wall.distance, normal), (0.0, Vector3::y()));
    let (wall, normal) = touch(1.0, 0.5, Some(hit_id(&wall))).unwrap();
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

/// Shots come to rest against a wall nearer or farther by rounding.
#[test]
fn a_sphere_within_the_slack_of_a_wall_touches_it_at_once() {
    let block = tessellate::block(Point3::origin(), Point3::new(1.0, 1.0, 1.0));
    let slack = size(&block) * 1e-12;
    let facets = facets(&block);
    for share in [-1.5, -0.9, -0.5, 0.0, 0.5, 0.9] {
        for x in [-1.0, 1.0] {
            let ray = Ray {
                origin: Point3::new(0.25 + share * slack, 0.45, 0.5),
                direction: Vector3::new(x * 0.6, 0.0, 0.8),
            };
            let found = facets.first_touch(&ray, 0.25, None, false, f64::INFINITY);
            let (crossing, normal) = found.expect("it is closed");
            if x < 0.0 {
                assert_eq!((crossing.distance, normal), (0.0, Vector3::x()), "{share}");
            } else {
                // 0.25 up to the lid at 0.8 a step.
                assert!((crossing.distance - 0.3125).abs() < 1e-12, "{share}");
            }
        }
    }
}

#[test]
fn of_walls_that_are_touched_at_once_the_first_is_told() {
    let unit = tessellate::block(Point3::origin(), Point3::new(1.0, 1.0, 1.0));
    let radius = 0.25;
    // Whichever triangles a walk comes to before others.
    for (corner, shift) in (0..8).flat_map(|corner| (0..12).map(move |shift| (corner, shift))) {
        let mut block = unit.clone();
        block.triangles.rotate_left(shift);
        if corner % 2 == 1 {
            block.triangles.reverse();
        }
        let facets = facets(&block);
        let inwards = [0, 1, 2].map(|axis| if corner >> axis & 1 == 1 { -1.0 } else { 1.0 });
        let inwards = Vector3::from(inwards);
        let corner = inwards.map(|x| if x > 0.0 { 0.0 } else { 1.0 });
        let ray = Ray {
            origin: (corner + inwards * radius).into(),
            direction: -inwards.normalize(),
        };
        // The triangles whose faces the sphere touches, not their edges.
        let touched = (0..facets.count() as u32).filter(|&index| {
            let single = Mesh {
                triangles: vec![block.triangles[index as usize]],
                ..block.clone()
            };
            let alone = super::facets(&single);
            let found = alone.first_touch(&ray, radius, None, false, 0.1);
            found.is_some_and(|(crossing, _)| crossing.distance == 0.0)
        });
        let touched: Vec<u32> = touched.collect();
        assert!(touched.len() >= 3, "{touched:?}");
        let found = facets.first_touch(&ray, radius, None, false, f64::INFINITY);
        let (crossing, _) = found.expect("at once");
        assert_eq!(crossing.distance, 0.0);
        assert_eq!(
            Some(&crossing.piece),
            touched.first(),
            "{corner}: {touched:?}"
        );
    }
}
