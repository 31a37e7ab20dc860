//! Distances of what a nozzle sweeps.

use super::*;
use crate::problem::part::{Part, Place, Shape};
use crate::scene::Walls;

fn block() -> Scene {
    let part = Part {
        name: "block".into(),
        shape: Shape::Box {
            min: Point3::new(-1.0, -1.0, -1.0),
            max: Point3::new(1.0, 1.0, 0.0),
        },
        place: Place::default(),
        on_nozzle: false,
        cut: Vec::new(),
    };
    Scene::build(&[part], Walls::Exact).expect("it is sound")
}

fn swept(core: Core, direction: Vector3<f64>, shifts: [f64; 3]) -> Swept {
    let [x, y, z] = shifts;
    Swept {
        aims: Aims {
            centre: Point3::origin(),
            shifts: [
                Vector3::x() * x,
                Vector3::y() * y,
                Vector3::z() * z,
                Vector3::zeros(),
            ],
            standoff: [2.0, 3.0],
        },
        directions: Directions::new(&[direction.normalize()]),
        core,
    }
}

#[test]
fn distances_are_those_of_the_nearest_place() {
    let scene = block();
    let down = -Vector3::z();
    for (core, direction, shifts, expected) in [
        (Core::Exit, down, [0.0; 3], 2.0),
        (Core::Exit, down, [0.0, 0.0, 0.5], 1.5),
        (Core::Disc { radius: 0.3 }, down, [0.0; 3], 2.0),
        // Upright beside the block: the rim is nearest.
        (
            Core::Disc { radius: 0.3 },
            -Vector3::x(),
            [0.1, 0.0, 0.0],
            0.9_f64,
        ),
        (
            Core::Line {
                length: 1.5,
                direction: Some(down),
            },
            down,
            [0.0; 3],
            0.5,
        ),
        (
            Core::Line {
                length: 9.0,
                direction: None,
            },
            down,
            [0.0; 3],
            2.0,
        ),
    ] {
        let swept = swept(core, direction, shifts);
        let (found, _) = scene.distance_to_swept(&swept, 9.0).expect("it is near");
        assert!(
            (found - expected).abs() < 1e-9,
            "{core:?}: {found} {expected}"
        );
    }
}

/// The nearest of many places on a grid is never nearer, and hardly farther.
#[test]
fn the_hull_is_as_near_as_the_nearest_of_many_places() {
    let scene = block();
    let tilt = |a: f64, b: f64| Vector3::new(a.sin() * b.cos(), a.sin() * b.sin(), -a.cos());
    let step = |k: i32, half: f64| half * f64::from(k) / 8.0;
    for (polar, turn) in [(0.4, 0.3), (0.9, 2.0), (1.4, 4.0)] {
        let mut directions = Vec::new();
        for i in -2..=2 {
            for j in -2..=2 {
                directions.push(tilt(
                    polar + 0.035 * f64::from(i) / 2.0,
                    turn + 0.035 * f64::from(j) / 2.0,
                ));
            }
        }
        let swept = Swept {
            aims: Aims {
                centre: Point3::new(1.05, 0.0, 0.1),
                shifts: [
                    Vector3::x() * 0.02,
                    Vector3::y() * 0.02,
                    Vector3::zeros(),
                    Vector3::zeros(),
                ],
                standoff: [0.9, 1.1],
            },
            directions: Directions::new(&directions),
            core: Core::Line {
                length: 1.0,
                direction: Some(Vector3::new(-0.6, 0.0, 0.8)),
            },
        };
        let (found, _) = scene.distance_to_swept(&swept, 9.0).expect("it is near");
        let mut least = f64::INFINITY;
        for i in -8..=8 {
            for j in -8..=8 {
                let jet = tilt(polar + step(i, 0.035), turn + step(j, 0.035));
                for standoff in [0.9, 0.95, 1.0, 1.05, 1.1] {
                    for (x, y) in [(-0.02, -0.02), (-0.02, 0.02), (0.02, -0.02), (0.02, 0.02)] {
                        let from = swept.aims.centre + Vector3::new(x, y, 0.0) - jet * standoff;
                        let to = from + Vector3::new(-0.6, 0.0, 0.8);
                        let facets = &scene.parts[0].facets;
                        let near = facets.distance_to_segment(&from, &to, 9.0);
                        least = least.min(near.expect("it is near").0);
                    }
                }
            }
        }
        let bulge = 1.1 * 0.035 * 0.035;
        assert!(found < least + 0.1 * bulge, "{found} {least}");
        assert!(found > least - bulge, "{found} {least}");
    }
}
