//! Shots of finite size against distances that are measured in another way.

use std::f64::consts::TAU;

use crate::common::cases::cases;
use nalgebra::{Point3, Vector3};
use peenpose::problem::part::{Ends, Keyway, Part, Place, Segment, Shape};
use peenpose::scene::ray::{Hit, Ray};
use peenpose::scene::{Scene, Walls};
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

/// Distance in the plane from (x, y) to a segment.
fn to_segment([x, y]: [f64; 2], [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (ex, ey) = (bx - ax, by - ay);
    let share = (((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey)).clamp(0.0, 1.0);
    (x - ax - share * ex).hypot(y - ay - share * ey)
}

/// Distance in the plane to the arc of a circle round the origin that lies outside the sector of
/// half-angle `gap` round +y.
fn to_open_circle([x, y]: [f64; 2], radius: f64, gap: f64) -> f64 {
    let from_y = x.abs().atan2(y);
    if from_y >= gap {
        (x.hypot(y) - radius).abs()
    } else {
        let (sin, cos) = gap.sin_cos();
        (x.abs() - radius * sin).hypot(y - radius * cos)
    }
}

/// A keyway and the distance to its walls, all in mm.
const KEYWAY: Keyway = Keyway {
    bore: 30e-3,
    width: 8e-3,
    depth: 3.3e-3,
    length: 40e-3,
    root_radius: 0.0,
};

fn to_keyway(p: &Point3<f64>) -> f64 {
    let (radius, half) = (KEYWAY.bore / 2.0, KEYWAY.width / 2.0);
    let floor = radius + KEYWAY.depth;
    let lip = (radius * radius - half * half).sqrt();
    let at = [p.x, p.y];
    let flat = [
        to_segment(at, [-half, floor], [half, floor]),
        to_segment(at, [half, lip], [half, floor]),
        to_segment(at, [-half, lip], [-half, floor]),
        to_open_circle(at, radius, (half / radius).asin()),
    ];
    let flat = flat.into_iter().fold(f64::INFINITY, f64::min);
    let beyond = (p.z - KEYWAY.length).max(-p.z).max(0.0);
    flat.hypot(beyond)
}

/// Where a sphere first touches what `distance` measures: goes on by what is free for certain.
fn first_touch(
    ray: &Ray,
    radius: f64,
    farthest: f64,
    distance: impl Fn(&Point3<f64>) -> f64,
) -> Option<f64> {
    let mut along = 0.0;
    while along < farthest {
        let free = distance(&(ray.origin + ray.direction * along)) - radius;
        if free < 1e-13 {
            return Some(along);
        }
        along += free;
    }
    None
}

fn scene(shape: Shape, walls: Walls) -> Scene {
    let part = Part {
        name: "part".into(),
        shape,
        place: Place::default(),
        on_nozzle: false,
        cut: Vec::new(),
    };
    Scene::build(&[part], walls).expect("a sound part")
}

fn direction(height: f64, turn: f64) -> Vector3<f64> {
    let flat = (1.0 - height * height).sqrt();
    Vector3::new(flat * turn.cos(), flat * turn.sin(), height)
}

/// Compares what the scene says of a ray with a distance that is known otherwise.
fn agree(
    scene: &Scene,
    ray: &Ray,
    radius: f64,
    distance: impl Fn(&Point3<f64>) -> f64,
) -> Result<(), TestCaseError> {
    let expected = first_touch(ray, radius, 0.2, &distance);
    let found = scene.first_touch(ray, radius, None);
    match (expected, found) {
        (Some(expected), Some(hit)) if (hit.distance - expected).abs() <= 1e-9 * 40e-3 => {
            prop_assert!(distance(&hit.point) <= 1e-12);
            let centre = ray.origin + ray.direction * hit.distance;
            prop_assert!((hit.point + hit.normal * radius - centre).norm() <= 1e-12);
        }
        (None, None) => {}
        // Grazing: the shot passes at its radius, and only one of the two calls that a contact.
        _ => {
            let along = |hit: Option<Hit>| hit.map_or(f64::INFINITY, |hit| hit.distance);
            let first = expected.unwrap_or(f64::INFINITY).min(along(found));
            let gap = |along: f64| distance(&(ray.origin + ray.direction * along)) - radius;
            let deepest = (0..2000).map(|step| gap(first + f64::from(step) * 1e-8));
            let deepest = deepest.fold(f64::INFINITY, f64::min);
            prop_assert!(deepest >= -1e-11, "{expected:?} {found:?} {deepest}");
        }
    }
    Ok(())
}

/// Distance to the surface of a solid pin along z, seen from outside.
fn to_pin(p: &Point3<f64>, radius: f64, length: f64) -> f64 {
    let beside = p.x.hypot(p.y) - radius;
    let beyond = (p.z - length).max(-p.z);
    beside.max(0.0).hypot(beyond.max(0.0))
}

proptest! {
    #![proptest_config(ProptestConfig {
        max_global_rejects: 20_000,
        ..cases(500)
    })]

    #[test]
    fn keyways_are_touched_where_the_distance_is_the_radius(
        x in -15e-3..15e-3_f64,
        y in -15e-3..18.3e-3_f64,
        z in -15e-3..55e-3_f64,
        height in -1.0..1.0_f64,
        turn in 0.0..TAU,
        radius in 0.05e-3..2.5e-3_f64,
    ) {
        let scene = scene(Shape::Keyway(KEYWAY), Walls::Exact);
        let ray = Ray { origin: Point3::new(x, y, z), direction: direction(height, turn) };
        // Behind its walls, in the hub's steel, there is no shot.
        let is_free = x.hypot(y) < 15e-3 || (x.abs() < 4e-3 && y > 0.0);
        prop_assume!(is_free && to_keyway(&ray.origin) > radius * (1.0 + 1e-9));
        agree(&scene, &ray, radius, to_keyway)?;
    }

    #[test]
    fn pins_are_touched_from_outside(
        x in -8e-3..8e-3_f64,
        y in -8e-3..8e-3_f64,
        z in -6e-3..18e-3_f64,
        height in -1.0..1.0_f64,
        turn in 0.0..TAU,
        radius in 0.05e-3..2.5e-3_f64,
    ) {
        let ends = Ends { near_closed: true, far_closed: true };
        let pin = Shape::Bore { diameter: 6e-3, length: 12e-3, ends, free: None };
        let ray = Ray { origin: Point3::new(x, y, z), direction: direction(height, turn) };
        let distance = |p: &Point3<f64>| to_pin(p, 3e-3, 12e-3);
        prop_assume!(distance(&ray.origin) > radius * (1.0 + 1e-9));
        agree(&scene(pin, Walls::Exact), &ray, radius, distance)?;
    }
}

/// A slot with undercuts: a T, closed at both ends.
fn t_slot() -> Shape {
    let outline = [
        [-3.0, 0.0],
        [3.0, 0.0],
        [3.0, 8.0],
        [7.0, 8.0],
        [7.0, 13.0],
        [-7.0, 13.0],
        [-7.0, 8.0],
        [-3.0, 8.0],
    ];
    let corner = |index: usize| {
        let [x, y] = outline[index % outline.len()];
        nalgebra::Point2::new(x * 1e-3, y * 1e-3)
    };
    let segment = |index: usize| Segment {
        from: corner(index),
        to: corner(index + 1),
        via: None,
        surface: format!("wall_{index}"),
    };
    Shape::Extrude {
        profile: (0..outline.len()).map(segment).collect(),
        length: 20e-3,
        ends: Ends {
            near_closed: true,
            far_closed: true,
        },
    }
}

/// Distance from a point in the T to its walls.
fn to_t_slot(p: &Point3<f64>) -> f64 {
    let outline = [
        [-3.0, 0.0],
        [3.0, 0.0],
        [3.0, 8.0],
        [7.0, 8.0],
        [7.0, 13.0],
        [-7.0, 13.0],
        [-7.0, 8.0],
        [-3.0, 8.0],
    ];
    let at = [p.x * 1e3, p.y * 1e3];
    let sides = (0..outline.len())
        .map(|i| to_segment(at, outline[i], outline[(i + 1) % outline.len()]) * 1e-3);
    sides.fold(p.z.min(20e-3 - p.z), f64::min)
}

#[test]
fn shots_that_bounce_for_ever_stay_inside() {
    for (shape, distance) in [
        (t_slot(), to_t_slot as fn(&Point3<f64>) -> f64),
        (
            Shape::Bore {
                diameter: 6e-3,
                length: 20e-3,
                ends: Ends {
                    near_closed: true,
                    far_closed: true,
                },
                free: None,
            },
            |p| (3e-3 - p.x.hypot(p.y)).min(p.z.min(20e-3 - p.z)),
        ),
    ] {
        let scene = scene(shape, Walls::Exact);
        for radius in [1e-6, 0.1e-3, 1.2e-3] {
            let mut ray = Ray {
                origin: Point3::new(0.2e-3, 1.5e-3, 7e-3),
                direction: direction(0.3, 1.1),
            };
            let mut leaving = None;
            for bounce in 0..20_000 {
                let hit = scene.first_touch(&ray, radius, leaving);
                let hit = hit.unwrap_or_else(|| panic!("{bounce}: lost at {ray:?}"));
                let centre = hit.point + hit.normal * radius;
                let gap = distance(&centre) - radius;
                assert!(gap.abs() <= 1e-13, "{bounce}: {gap} at {centre}");
                let along = ray.direction.dot(&hit.normal);
                assert!(along < 0.0);
                let direction = (ray.direction - hit.normal * (2.0 * along)).normalize();
                ray = Ray {
                    origin: centre,
                    direction,
                };
                leaving = Some(hit.hit_id);
            }
        }
    }
}

#[test]
fn a_vanishing_radius_is_a_point() {
    let scene = scene(Shape::Keyway(KEYWAY), Walls::Exact);
    for index in 0..2000 {
        let share = |axis| f64::from(sobol_burley::sample(index, axis, 3));
        let ray = Ray {
            origin: Point3::new(0.0, 10e-3, 20e-3),
            direction: direction(2.0 * share(0) - 1.0, TAU * share(1)),
        };
        let point = scene.first_hit(&ray, None);
        let sphere = scene.first_touch(&ray, 1e-9, None);
        match (point, sphere) {
            (Some(point), Some(sphere)) => {
                let slant = ray.direction.dot(&point.normal).abs();
                let near = 2e-9 / slant;
                assert!(
                    (point.distance - sphere.distance).abs() <= near,
                    "{point:?} {sphere:?}"
                );
            }
            (None, None) => {}
            other => panic!("{ray:?}: {other:?}"),
        }
    }
}
