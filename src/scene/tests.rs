use std::f64::consts::PI;

use super::*;
use crate::problem::part::{Place, Shape};

#[test]
fn directions_on_a_spiral_are_even() {
    let directions: Vec<_> = (0..256).map(|index| spiral_direction(index, 256)).collect();
    let mean = directions.iter().sum::<Vector3<f64>>() / 256.0;
    assert!(mean.norm() < 1e-3, "{mean}");
    let squares = directions.iter().map(|it| it.component_mul(it));
    let squares = squares.sum::<Vector3<f64>>() / 256.0;
    assert!(
        (squares - Vector3::repeat(1.0 / 3.0)).norm() < 1e-3,
        "{squares}"
    );
    for (index, one) in directions.iter().enumerate() {
        assert!((one.norm() - 1.0).abs() < 1e-12);
        // Each has about a 256th of the sphere, a cap of 0.125 rad, to itself.
        let apart = |other: &Vector3<f64>| one.angle(other);
        let nearest = directions[..index].iter().map(apart).fold(PI, f64::min);
        assert!(nearest > 0.15, "{index}: {nearest}");
    }
}

#[test]
fn a_scene_is_as_large_as_its_farthest_coordinate() {
    let block = |min: Point3<f64>, max: Point3<f64>| Part {
        name: "block".into(),
        shape: Shape::Box { min, max },
        place: Place::default(),
        on_nozzle: false,
    };
    let near = block(Point3::origin(), Point3::new(0.1, 0.2, 0.3));
    let far = block(Point3::new(-0.1, -0.7, 0.1), Point3::new(0.0, 0.0, 0.2));
    let scene = Scene::build(&[near, far], Walls::Exact).expect("it is sound");
    assert_eq!(scene.size(), 0.7);
    // Two for each face of a block.
    assert_eq!(scene.triangles(), 24);
    assert!(!scene.moves_with_nozzle());
}

#[test]
fn a_scene_has_no_more_triangles_than_one_mesh_may_have() {
    let part = Part {
        name: "hub".into(),
        shape: Shape::Box {
            min: Point3::origin(),
            max: Point3::new(1.0, 1.0, 1.0),
        },
        place: Place::default(),
        on_nozzle: false,
    };
    assert_eq!(too_many_triangles(&part, MOST_TRIANGLES), None);
    let fault = too_many_triangles(&part, MOST_TRIANGLES + 1).expect("one too many");
    assert_eq!(
        fault.to_string(),
        "scene.hub: up to this part the scene has more than 20000000 triangles; expected \
         fewer or coarser meshes, at most so many triangles together"
    );
}
