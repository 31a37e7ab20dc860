use nalgebra::{UnitQuaternion, Vector3};

use super::*;
use crate::problem::part::{Ends, Place, RoundSide, Shape};
use crate::scene::ray::Ray;
use crate::scene::{Scene, Walls};
use std::f64::consts::{FRAC_PI_2, PI};

fn part(name: &str, shape: Shape, cut: &[&str]) -> Part {
    Part {
        name: name.to_owned(),
        shape,
        place: Place::default(),
        on_nozzle: false,
        cut: cut.iter().map(ToString::to_string).collect(),
    }
}

fn round(diameter: f64, length: f64, free: RoundSide) -> Shape {
    Shape::Bore {
        diameter,
        length,
        ends: Ends::default(),
        free: Some(free),
    }
}

/// A hole along x, that begins at this x, through z = 0.02.
fn cross_hole(diameter: f64, from: f64, length: f64) -> Part {
    let mut hole = part("hole", round(diameter, length, RoundSide::Inside), &[]);
    hole.place = Place {
        rotation: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), FRAC_PI_2),
        shift: Vector3::new(from, 0.0, 0.02),
    };
    hole
}

fn code(parts: &[Part]) -> FaultCode {
    let faults = Scene::build(parts, Walls::Exact)
        .err()
        .expect("it is refused");
    assert_eq!(faults.len(), 1);
    faults[0].rule
}

fn area(scene: &Scene, name: &str) -> f64 {
    let surface = scene.surface_named(name).expect("it is there");
    let triangles = scene.surface_triangles(surface);
    triangles
        .map(|[a, b, c]| (b - a).cross(&(c - a)).norm() / 2.0)
        .sum()
}

/// What a ray along x hits first at this height, and how far away.
fn hit(scene: &Scene, from: f64, direction: f64, height: f64) -> Option<(String, f64)> {
    let ray = Ray {
        origin: Point3::new(from, 0.1e-3, height),
        direction: Vector3::new(direction, 0.0, 0.0),
    };
    let hit = scene.first_hit(&ray, None)?;
    Some((scene.surfaces()[hit.surface as usize].clone(), hit.distance))
}

/// Of a small hole across a large shaft nothing but two discs is missing of the shaft, and all of its wall is there.
#[test]
fn a_hole_opens_the_shaft_that_it_is_drilled_into() {
    let shaft = part("shaft", round(30e-3, 40e-3, RoundSide::Outside), &["hole"]);
    let hole = cross_hole(4e-3, -20e-3, 40e-3);
    let scene = Scene::build(&[shaft, hole], Walls::Exact).expect("it can be cut");
    assert_eq!(scene.surfaces(), ["shaft.wall", "hole.wall"]);
    // The mouths of a hole of radius r in a shaft of radius R are pi r^2 (1 + r^2 / 8 R^2 ..) large each, and the wall between them is
    // 4 pi r R (1 - r^2 / 4 R^2 ..): elliptic integrals, to the second term.
    let (r, big) = (2e-3, 15e-3);
    let square = (r / big) * (r / big);
    let mouths = 2.0 * PI * r * r * (1.0 + square / 8.0);
    let skin = 2.0 * PI * big * 40e-3 - mouths;
    let wall = 4.0 * PI * r * big * (1.0 - square / 4.0);
    assert!((area(&scene, "shaft.wall") / skin - 1.0).abs() < 2e-5);
    assert!((area(&scene, "hole.wall") / wall - 1.0).abs() < 2e-4);
    // Through the hole, and beside it.
    assert_eq!(hit(&scene, -0.1, 1.0, 0.02), None);
    let (name, distance) = hit(&scene, -0.1, 1.0, 0.03).expect("the skin is there");
    assert_eq!(name, "shaft.wall");
    assert!((distance - 85e-3).abs() < 1e-6);
}

/// Out of a bore, metal is all round it: what is left of the hole is outside.
#[test]
fn a_hole_opens_the_bore_that_it_leads_into() {
    let hub = part("hub", round(30e-3, 40e-3, RoundSide::Inside), &["hole"]);
    let hole = cross_hole(4e-3, 0.0, 25e-3);
    let scene = Scene::build(&[hub, hole], Walls::Exact).expect("it can be cut");
    assert_eq!(hit(&scene, 0.0, 1.0, 0.02), None);
    let (name, _) = hit(&scene, 0.0, -1.0, 0.02).expect("the other side is closed");
    assert_eq!(name, "hub.wall");
    let wall = 2.0 * PI * 2e-3 * 25e-3 - 2.0 * PI * 2e-3 * 15e-3;
    assert!((area(&scene, "hole.wall") / wall - 1.0).abs() < 0.01);
    // Its far end is open, as it says.
    assert_eq!(scene.surfaces(), ["hub.wall", "hole.wall"]);
}

/// A pocket milled into a block, with flat sides all round: nothing of it is an approximation.
#[test]
fn a_pocket_in_a_block_has_a_floor_and_four_sides() {
    let block = |low: [f64; 3], high: [f64; 3]| Shape::Box {
        min: low.into(),
        max: high.into(),
    };
    let solid = part("block", block([0.0; 3], [4.0, 3.0, 2.0]), &["pocket"]);
    let pocket = part("pocket", block([1.0, 1.0, 1.5], [2.0, 2.0, 3.0]), &[]);
    let scene = Scene::build(&[solid.clone(), pocket], Walls::Exact).expect("it can be cut");
    let expected = [
        ("block.x_min", 6.0),
        ("block.z_max", 11.0),
        ("pocket.z_min", 1.0),
        ("pocket.x_max", 0.5),
    ];
    for (name, size) in expected {
        assert!((area(&scene, name) - size).abs() < 1e-12, "{name}");
    }
    // Its own lid is gone.
    assert!(scene.surface_named("pocket.z_max").is_err());
    let apart = part("pocket", block([1.0, 1.0, 2.5], [2.0, 2.0, 3.0]), &[]);
    assert_eq!(code(&[solid.clone(), apart]), FaultCode::CutMisses);
    let all = part("pocket", block([-1.0; 3], [5.0; 3]), &[]);
    assert_eq!(code(&[solid, all]), FaultCode::CutLeavesNothing);
}

/// One hole through two plates, each of which keeps its own piece of the wall.
#[test]
fn a_hole_may_go_through_two_parts() {
    let plate = |name: &str, low: f64| {
        let shape = Shape::Box {
            min: Point3::new(-0.01, -0.01, low),
            max: Point3::new(0.01, 0.01, low + 2e-3),
        };
        part(name, shape, &["hole"])
    };
    let mut hole = part("hole", round(4e-3, 10e-3, RoundSide::Inside), &[]);
    hole.place.shift.z = -1e-3;
    let parts = [plate("lower", 0.0), plate("upper", 4e-3), hole];
    let scene = Scene::build(&parts, Walls::Exact).expect("it can be cut");
    assert_eq!(
        scene
            .surfaces()
            .iter()
            .filter(|it| *it == "hole.wall")
            .count(),
        1
    );
    let wall = 2.0 * PI * 2e-3 * 4e-3;
    assert!((area(&scene, "hole.wall") / wall - 1.0).abs() < 1e-5);
}

#[test]
fn the_same_parts_are_cut_into_the_same_triangles() {
    let build = || {
        let shaft = part("shaft", round(30e-3, 40e-3, RoundSide::Outside), &["hole"]);
        let scene = Scene::build(&[shaft, cross_hole(30e-3, -20e-3, 40e-3)], Walls::Exact);
        let scene = scene.expect("it can be cut");
        let triangles: Vec<[Point3<f64>; 3]> = (0..2)
            .flat_map(|surface| scene.surface_triangles(surface).collect::<Vec<_>>())
            .collect();
        triangles
    };
    assert_eq!(build(), build());
}
