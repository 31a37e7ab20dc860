use nalgebra::Point2;

use super::*;
use crate::scene::profile::{Curve, Piece};

/// A pipe of inner radius 5 and length 10 along z; free space is inside.
fn pipe(near_closed: bool, far_closed: bool) -> Prism {
    let curve = Curve::Arc {
        centre: Point2::origin(),
        radius: 5.0,
        start: 0.0,
        sweep: std::f64::consts::TAU,
    };
    let profile = Profile {
        pieces: vec![Piece { curve, surface: 0 }],
        surfaces: vec!["wall".to_owned()],
    };
    let ends = Ends {
        near_closed,
        far_closed,
    };
    Prism::new(&profile, 10.0, ends, &Place::default(), 7, 1e-9)
}

fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
    Ray {
        origin: origin.into(),
        direction: direction.into(),
    }
}

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

#[test]
fn caps_are_as_wide_as_the_cross_section() {
    let pot = pipe(true, true);
    let meet = |origin: [f64; 3], direction: [f64; 3]| {
        let found = pot.first_crossing(&ray(origin, direction), None, false, f64::INFINITY);
        found.map(|(crossing, normal)| {
            (
                crossing.distance,
                crossing.surface,
                crossing.front,
                normal.z,
            )
        })
    };
    // Surfaces: the wall, the cap at z = 0, the cap at z = 10.
    for x in [0.0, 4.9, -4.9] {
        assert_eq!(meet([x, 0.0, 3.0], DOWN), Some((3.0, 8, true, 1.0)));
        assert_eq!(meet([x, 0.0, 3.0], UP), Some((7.0, 9, true, -1.0)));
        assert_eq!(meet([x, 0.0, -3.0], UP), Some((3.0, 8, false, 1.0)));
        assert_eq!(meet([x, 0.0, -3.0], DOWN), None);
    }
    for x in [5.1, -5.1, 7.0] {
        assert_eq!(meet([x, 0.0, 3.0], DOWN), None);
        assert_eq!(meet([x, 0.0, 3.0], UP), None);
    }
    let (distance, surface, front, _) = meet([0.0, 0.0, 3.0], [0.6, 0.8, 0.0]).expect("the wall");
    assert!((distance - 5.0).abs() < 1e-12 && surface == 7 && front);
    let open = pipe(false, true);
    let below = open.first_crossing(&ray([0.0, 0.0, 3.0], DOWN), None, false, f64::INFINITY);
    assert!(below.is_none());
    let above = open.first_crossing(&ray([0.0, 0.0, 3.0], UP), None, false, f64::INFINITY);
    assert_eq!(above.expect("it is closed").0.surface, 8);
    let limited = open.first_crossing(&ray([0.0, 0.0, 3.0], UP), None, false, 6.9);
    assert!(limited.is_none());
}

#[test]
fn shots_touch_the_rims_of_a_pipe_from_all_sides() {
    let open = pipe(false, false);
    // A shot of radius 1 whose centre flies 0.6 beside the wall is 0.8 before the end when it
    // touches the rim.
    for (x, across) in [(5.6, 0.6), (4.4, -0.6)] {
        for (z, direction, along) in [(-10.0, UP, -0.8), (20.0, DOWN, 0.8)] {
            let flight = ray([0.0, x, z], direction);
            let found = open.first_touch(&flight, 1.0, None, false, f64::INFINITY);
            let (crossing, normal) = found.expect("the rim");
            assert!((crossing.distance - 9.2).abs() < 1e-9, "{x}, {z}");
            assert!(crossing.front && crossing.surface == 7);
            let expected = Vector3::new(0.0, across, along);
            assert!((normal - expected).norm() < 1e-9, "{normal}");
            let nearer = open.first_touch(&flight, 1.0, None, false, 9.1);
            assert!(nearer.is_none());

            // It leaves the rim that it has touched for good.
            let spot = Spot {
                part: 0,
                piece: crossing.piece,
                front: true,
            };
            let touching = ray([0.0, x, z + 9.2 * direction[2]], direction);
            let at_once = open.first_touch(&touching, 1.0, None, false, f64::INFINITY);
            assert!(at_once.is_some_and(|(crossing, _)| crossing.distance < 1e-9));
            let back = direction.map(|it| -it);
            let away = ray(touching.origin.into(), back);
            let again = open.first_touch(&away, 1.0, Some(spot), true, f64::INFINITY);
            assert!(again.is_none());
        }
    }
    for x in [6.1, 3.9] {
        let passing = ray([0.0, x, -10.0], UP);
        let found = open.first_touch(&passing, 1.0, None, false, f64::INFINITY);
        assert!(found.is_none(), "{x}");
    }
}

#[test]
fn shots_touch_caps_a_radius_before_them() {
    let pot = pipe(true, false);
    let touch = |origin: [f64; 3], direction: [f64; 3]| {
        let found = pot.first_touch(&ray(origin, direction), 1.0, None, false, f64::INFINITY);
        found.map(|(crossing, normal)| {
            (
                crossing.distance,
                crossing.surface,
                crossing.front,
                normal.z,
            )
        })
    };
    assert_eq!(touch([0.0, 0.0, 3.0], DOWN), Some((2.0, 8, true, 1.0)));
    assert_eq!(touch([0.0, 0.0, -3.0], UP), Some((2.0, 8, false, 1.0)));
    assert_eq!(touch([0.0, 0.0, 3.0], UP), None);
    // In contact: at once when it heads into it.
    assert_eq!(touch([0.0, 0.0, 1.0], DOWN), Some((0.0, 8, true, 1.0)));
    assert_eq!(touch([0.0, 0.0, 0.5], DOWN), Some((0.0, 8, true, 1.0)));
    assert_eq!(touch([0.0, 0.0, 1.0], UP), None);
    let (distance, surface, _, _) = touch([0.0, 0.0, 3.0], [1.0, 0.0, 0.0]).expect("the wall");
    assert_eq!((distance, surface), (4.0, 7));
}

#[test]
fn a_ray_is_between_two_heights_from_its_start_at_the_earliest() {
    let between = |z: f64, rate: f64| {
        let flight = ray([0.0, 0.0, z], [0.0, (1.0 - rate * rate).sqrt(), rate]);
        super::touch::between(&flight, 2.0, 4.0)
    };
    assert_eq!(between(0.0, 0.5), Some([4.0, 8.0]));
    assert_eq!(between(3.0, 0.5), Some([0.0, 2.0]));
    assert_eq!(between(5.0, 0.5), None);
    assert_eq!(between(6.0, -0.5), Some([4.0, 8.0]));
    assert_eq!(between(3.0, -0.5), Some([0.0, 2.0]));
    assert_eq!(between(1.0, -0.5), None);
    for (z, found) in [(1.9, None), (2.0, Some(())), (4.0, Some(())), (4.1, None)] {
        let ever = found.map(|()| [0.0, f64::INFINITY]);
        assert_eq!(between(z, 0.0), ever, "{z}");
    }
}
