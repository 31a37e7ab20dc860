use std::f64::consts::PI;

use nalgebra::{Point2, UnitQuaternion};

use super::*;
use crate::scene::lanes::{LANES, put};
use crate::scene::profile::{Curve, Piece};
use crate::scene::rays::{Hits, Rays, Spots};

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

/// Of the shots.
const RADIUS: f64 = 0.5;

/// What shots touch first that fly side by side.
fn touched_by_many(prism: &Prism, flights: &[Ray]) -> Hits<f64> {
    let mut rays = Rays::none();
    rays.count = flights.len();
    rays.are_spheres = true;
    rays.radius = [RADIUS; LANES];
    for (i, flight) in flights.iter().enumerate() {
        put(&mut rays.origin, i, flight.origin.into());
        put(&mut rays.direction, i, flight.direction.into());
    }
    let mut hits = Hits::none();
    prism.cross(0, &rays, &mut hits);
    hits
}

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

#[test]
fn caps_are_as_wide_as_the_cross_section() {
    let pot = pipe(true, true);
    let meet = |origin: [f64; 3], direction: [f64; 3]| {
        let found = pot.first_crossing(&Ray::of(origin, direction), None, false, f64::INFINITY);
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
    let below = open.first_crossing(&Ray::of([0.0, 0.0, 3.0], DOWN), None, false, f64::INFINITY);
    assert!(below.is_none());
    let above = open.first_crossing(&Ray::of([0.0, 0.0, 3.0], UP), None, false, f64::INFINITY);
    assert_eq!(above.expect("it is closed").0.surface, 8);
    let limited = open.first_crossing(&Ray::of([0.0, 0.0, 3.0], UP), None, false, 6.9);
    assert!(limited.is_none());
}

#[test]
fn slanted_rays_cross_a_cap_where_they_come_to_its_plane() {
    let pot = pipe(true, true);
    let meet = |origin: [f64; 3], direction: [f64; 3]| {
        let found = pot.first_crossing(&Ray::of(origin, direction), None, false, f64::INFINITY);
        let (crossing, _) = found.expect("it is closed");
        (crossing.distance, crossing.surface, crossing.front)
    };
    let near = |(distance, surface, front): (f64, u32, bool), expected: (f64, u32, bool)| {
        (distance - expected.0).abs() < 1e-12 && (surface, front) == (expected.1, expected.2)
    };
    // 4 along z for 3 across; surfaces: the wall, the cap at z = 0, the cap at z = 10.
    for [u, v] in [[0.6, 0.0], [0.0, 0.6], [-0.6, 0.0], [0.36, -0.48]] {
        // From 3 beside the axis to the middle of the cap.
        let (x, y) = (-5.0 * u, -5.0 * v);
        assert!(near(meet([x, y, 4.0], [u, v, -0.8]), (5.0, 8, true)));
        assert!(near(meet([x, y, 6.0], [u, v, 0.8]), (5.0, 9, true)));
        assert!(near(meet([x, y, -4.0], [u, v, 0.8]), (5.0, 8, false)));
        assert!(near(meet([x, y, 14.0], [u, v, -0.8]), (5.0, 9, false)));
        // Where the wall is nearer: 5 across is 20/3 along z.
        let to_wall = (25.0 / 3.0, 7, true);
        assert!(near(meet([0.0, 0.0, 7.0], [u, v, -0.8]), to_wall));
        assert!(near(meet([0.0, 0.0, 3.0], [u, v, 0.8]), to_wall));
    }
}

#[test]
fn rays_that_start_on_a_cap_meet_it_at_once_or_never() {
    let pot = pipe(true, true);
    let wall = Spot {
        part: 0,
        piece: 0,
        front: true,
    };
    let meet = |z: f64, direction: [f64; 3], leaving: Spot| {
        let ray = Ray::of([5.0, 0.0, z], direction);
        let found = pot.first_crossing(&ray, Some(leaving), true, f64::INFINITY);
        let found = found.map(|(crossing, _)| (crossing.distance, crossing.surface));
        // The same among many.
        let mut rays = Rays::<f64>::none();
        rays.count = 1;
        put(&mut rays.origin, 0, ray.origin.into());
        put(&mut rays.direction, 0, ray.direction.into());
        let mut spots = Spots::none();
        spots.set(0, leaving);
        rays.leaving = Some(spots);
        let mut hits = Hits::none();
        pot.cross(leaving.part, &rays, &mut hits);
        let is_met = hits.distance[0].is_finite();
        let many = is_met.then_some((hits.distance[0], hits.surface[0]));
        assert_eq!(many, found, "{z} {direction:?}");
        found
    };
    // Away from the wall; surfaces: the wall, the cap at z = 0, the cap at z = 10.
    let (down, up) = ([-0.6, 0.0, -0.8], [-0.6, 0.0, 0.8]);
    let is_near = |found: Option<(f64, u32)>, expected: (f64, u32)| {
        let (distance, surface) = found.expect("it is closed");
        (distance - expected.0).abs() < 1e-8 && surface == expected.1
    };
    assert!(is_near(meet(4.0, down, wall), (5.0, 8)));
    assert!(is_near(meet(6.0, up, wall), (5.0, 9)));
    for beside in [-0.5e-9, 0.0, 0.5e-9] {
        assert_eq!(meet(beside, down, wall), Some((0.0, 8)));
        assert!(is_near(meet(beside, up, wall), (12.5, 9)));
        assert_eq!(meet(10.0 + beside, up, wall), Some((0.0, 9)));
        assert!(is_near(meet(10.0 + beside, down, wall), (12.5, 8)));
        // The cap itself is left, whichever way.
        let cap = Spot { piece: 1, ..wall };
        assert!(is_near(meet(beside, up, cap), (12.5, 9)));
        assert_eq!(meet(beside, down, cap), None);
    }
}

#[test]
fn slanted_shots_touch_a_cap_a_radius_before_its_plane() {
    let pot = pipe(true, true);
    let touch = |origin: [f64; 3], direction: [f64; 3]| {
        let found = pot.first_touch(&Ray::of(origin, direction), 1.0, None, false, f64::INFINITY);
        let (crossing, normal) = found.expect("it is closed");
        (crossing.distance, crossing.surface, crossing.front, normal)
    };
    for [u, v] in [[0.6, 0.0], [0.0, 0.6], [-0.6, 0.0], [0.36, -0.48]] {
        for (z, w, surface, front) in [
            (5.0, -0.8, 8, true),
            (5.0, 0.8, 9, true),
            (-5.0, 0.8, 8, false),
            (15.0, -0.8, 9, false),
        ] {
            // Centres stay 1 away from the caps, which is 4 along z and 3 across.
            let (distance, found, is_front, normal) = touch([-5.0 * u, -5.0 * v, z], [u, v, w]);
            assert!((distance - 5.0).abs() < 1e-12, "{z}, {w}: {distance}");
            assert_eq!((found, is_front), (surface, front), "{z}, {w}");
            let towards_inside = if surface == 8 { 1.0 } else { -1.0 };
            assert_eq!(normal, Vector3::new(0.0, 0.0, towards_inside));
        }
    }
}

/// Four walls from corner to corner, each a surface.
fn square(corners: [[f64; 2]; 4]) -> Profile {
    let corners = corners.map(Point2::from);
    let piece = |wall: usize| Piece {
        curve: Curve::Line {
            from: corners[wall],
            to: corners[(wall + 1) % 4],
        },
        surface: wall as u32,
    };
    Profile {
        pieces: (0..4).map(piece).collect(),
        surfaces: (0..4).map(|wall| format!("wall{wall}")).collect(),
    }
}

/// What has left a rim touches the wall beside it like any other shot.
#[test]
fn a_rim_is_another_piece_than_its_wall() {
    let profile = square([[5.0, -5.0], [5.0, 5.0], [-5.0, 5.0], [-5.0, -5.0]]);
    let shaft = |near_closed: bool| {
        let ends = Ends {
            near_closed,
            far_closed: false,
        };
        Prism::new(&profile, 10.0, ends, &Place::default(), 7, 1e-9)
    };
    let sides = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    for prism in [pipe(false, false), shaft(false), shaft(true)] {
        let touch = |flight: &Ray, leaving: Option<Spot>| {
            prism.first_touch(flight, 0.5, leaving, leaving.is_some(), f64::INFINITY)
        };
        // Shots that come down on the far rims, and up on the near ones of an open end.
        let has_cap = !prism.caps.is_empty();
        let from_ends = if has_cap {
            vec![(20.0, DOWN)]
        } else {
            vec![(20.0, DOWN), (-10.0, UP)]
        };
        let mut pieces = Vec::new();
        for ([x, y], (z, towards)) in sides.into_iter().flat_map(|side| {
            let ends = from_ends.iter();
            ends.map(move |end| (side, *end))
        }) {
            let outwards = Vector3::new(x, y, 0.0);
            let inside = Ray::of([0.0, 0.0, 5.0], outwards.into());
            let (wall, _) = touch(&inside, None).expect("the wall");
            let over_rim = Ray::of((outwards * 4.7 + Vector3::z() * z).into(), towards);
            let (rim, normal) = touch(&over_rim, None).expect("the rim");
            assert_eq!(rim.surface, wall.surface);
            assert_ne!(rim.piece, wall.piece);
            pieces.extend([wall.piece, rim.piece]);
            // As if it had got from the rim to the axis.
            let spot = Spot {
                part: 0,
                piece: rim.piece,
                front: true,
            };
            assert_eq!(touch(&inside, Some(spot)), touch(&inside, None));
            // Out over the rim, by rounding a little into it: one that has left it does not touch it.
            let sinking = normal * -1e-9 + outwards * 0.8 - Vector3::z() * 0.6 * towards[2];
            let grazing = Ray {
                origin: over_rim.origin + over_rim.direction * rim.distance,
                direction: sinking.normalize(),
            };
            let at_once = touch(&grazing, None).map(|(it, _)| (it.piece, it.distance));
            assert_eq!(at_once, Some((rim.piece, 0.0)));
            assert_eq!(touch(&grazing, Some(spot)), None);
        }
        pieces.sort_unstable();
        pieces.dedup();
        assert_eq!(pieces.len(), prism.walls.len() * (1 + from_ends.len()));
    }
}

#[test]
fn walls_edges_and_rims_of_a_bar_are_pieces_of_their_own() {
    // Clockwise, so that free space is outside.
    let profile = square([[5.0, 5.0], [5.0, -5.0], [-5.0, -5.0], [-5.0, 5.0]]);
    let bar = Prism::new(&profile, 10.0, Ends::default(), &Place::default(), 7, 1e-9);
    let half = 0.5_f64.sqrt();
    let mut pieces = Vec::new();
    for [x, y] in [[1.0, 0.0], [0.0, -1.0], [-1.0, 0.0], [0.0, 1.0]] {
        // From 9 out at the wall; along the diagonal at the edge beside it; at its rims.
        let (u, v) = (half * (x + y), half * (y - x));
        let flights = [
            (Ray::of([9.0 * x, 9.0 * y, 5.0], [-x, -y, 0.0]), 3.5),
            (
                Ray::of([9.0 * u, 9.0 * v, 5.0], [-u, -v, 0.0]),
                8.5 - 5.0 / half,
            ),
            (Ray::of([5.3 * x, 5.3 * y, 20.0], DOWN), 9.6),
            (Ray::of([5.3 * x, 5.3 * y, -10.0], UP), 9.6),
        ];
        for (flight, distance) in flights {
            let found = bar.first_touch(&flight, 0.5, None, false, f64::INFINITY);
            let (crossing, _) = found.expect("the bar");
            assert!((crossing.distance - distance).abs() < 1e-9, "{flight:?}");
            pieces.push(crossing.piece);
        }
    }
    pieces.sort_unstable();
    pieces.dedup();
    assert_eq!(pieces.len(), 16);
}

#[test]
fn shots_touch_the_rims_of_a_pipe_from_all_sides() {
    let open = pipe(false, false);
    let touch = |flight: &Ray, leaving: Option<Spot>, limit: f64| {
        open.first_touch(flight, 0.5, leaving, leaving.is_some(), limit)
    };
    // A shot of radius 0.5 whose centre flies 0.3 beside the wall is 0.4 before the end when it
    // touches the rim.
    for (y, across) in [(5.3, 0.6), (4.7, -0.6)] {
        for (z, direction, along) in [(-10.0, UP, -0.8), (20.0, DOWN, 0.8)] {
            let from = |distance: f64| Ray::of([0.0, y, z + distance * direction[2]], direction);
            let found = touch(&from(0.0), None, f64::INFINITY);
            let (crossing, normal) = found.expect("the rim");
            assert!((crossing.distance - 9.6).abs() < 1e-9, "{y}, {z}");
            assert!(crossing.front && crossing.surface == 7);
            let expected = Vector3::new(0.0, across, along);
            assert!((normal - expected).norm() < 1e-9, "{normal}");
            assert!(touch(&from(0.0), None, 9.5).is_none());

            // In contact, or deeper, it is met at once; what has left it is gone.
            let at_once = touch(&from(9.6), None, f64::INFINITY);
            assert!(at_once.is_some_and(|(crossing, _)| crossing.distance < 1e-9));
            let at_once = touch(&from(9.65), None, f64::INFINITY);
            assert_eq!(at_once.expect("the rim").0.distance, 0.0);
            let spot = Spot {
                part: 0,
                piece: crossing.piece,
                front: true,
            };
            let mut away = from(9.6);
            away.direction = -away.direction;
            assert!(touch(&away, Some(spot), f64::INFINITY).is_none());
            // Across the pipe it comes to the same rim again.
            if across < 0.0 {
                away.direction = -Vector3::y();
                let again = touch(&away, Some(spot), f64::INFINITY).expect("the other side");
                assert!((again.0.distance - 9.4).abs() < 1e-9);
                assert_eq!(again.0.piece, crossing.piece);
            }
        }
    }
    for y in [5.6, 4.4] {
        let passing = Ray::of([0.0, y, -10.0], UP);
        assert!(touch(&passing, None, f64::INFINITY).is_none(), "{y}");
    }
}

#[test]
fn many_shots_touch_the_rims_of_a_pipe_as_one_does() {
    let open = pipe(false, false);
    let mut flights = Vec::new();
    for z in [-3.0, -0.4, 0.2, 5.0, 9.9, 10.3, 13.0] {
        for step in -30..30 {
            for tilt in -9..=9 {
                let (sin, cos) = (0.16 * f64::from(tilt)).sin_cos();
                let origin = [0.21 * f64::from(step), 0.3, z];
                for upwards in [cos, -cos] {
                    let direction = Vector3::new(sin, 0.02, upwards).normalize();
                    flights.push(Ray::of(origin, direction.into()));
                }
            }
        }
    }
    let (mut entry_rims, mut exit_rims) = (0, 0);
    for some in flights.chunks(LANES) {
        let hits = touched_by_many(&open, some);
        for (i, flight) in some.iter().enumerate() {
            let alone = open.first_touch(flight, RADIUS, None, false, f64::INFINITY);
            let distance = alone.map_or(f64::INFINITY, |(crossing, _)| crossing.distance);
            assert_eq!(hits.distance[i], distance, "{flight:?}");
            let z = flight.origin.z + flight.direction.z * distance;
            let comes_from_outside = !(0.0..=10.0).contains(&flight.origin.z);
            if distance.is_finite() && comes_from_outside && !(0.0..=10.0).contains(&z) {
                let is_entry = (z < 0.0) == (flight.origin.z < 0.0);
                entry_rims += usize::from(is_entry);
                exit_rims += usize::from(!is_entry);
            }
        }
    }
    assert!(
        entry_rims > 100 && exit_rims > 10,
        "{entry_rims}, {exit_rims}"
    );
}

#[test]
fn a_rim_belongs_to_the_surface_of_its_wall() {
    let profile = square([[5.0, -5.0], [5.0, 5.0], [-5.0, 5.0], [-5.0, -5.0]]);
    for far_closed in [false, true] {
        let ends = Ends {
            near_closed: false,
            far_closed,
        };
        let shaft = Prism::new(&profile, 10.0, ends, &Place::default(), 7, 1e-9);
        let outwards = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        for (wall, [x, y]) in outwards.into_iter().enumerate() {
            let open_ends = if far_closed { 1 } else { 2 };
            for (z, direction) in [(-10.0, UP), (20.0, DOWN)].into_iter().take(open_ends) {
                let flight = Ray::of([4.7 * x, 4.7 * y, z], direction);
                let found = shaft.first_touch(&flight, 0.5, None, false, f64::INFINITY);
                let (crossing, normal) = found.expect("the rim");
                assert_eq!(crossing.surface, 7 + wall as u32);
                assert!((crossing.distance - 9.6).abs() < 1e-9);
                let expected = Vector3::new(-0.6 * x, -0.6 * y, -0.8 * direction[2]);
                assert!((normal - expected).norm() < 1e-9, "{normal}");
            }
        }
    }
}

/// In a prism that is turned, too, and for many shots at once as for one.
#[test]
fn an_edge_belongs_to_the_surface_on_whose_side_it_is_touched() {
    // A step down to the right: free space is above the tread, and right of the riser under it.
    let corners = [[-5.0, 0.0], [0.0, 0.0], [0.0, -5.0], [5.0, -5.0]].map(Point2::from);
    let piece = |wall: u32| Piece {
        curve: Curve::Line {
            from: corners[wall as usize],
            to: corners[wall as usize + 1],
        },
        surface: wall,
    };
    let profile = Profile {
        pieces: (0..3).map(piece).collect(),
        surfaces: ["tread", "riser", "foot"].map(str::to_owned).to_vec(),
    };
    let (tread, riser) = (7, 8);
    let places = [0.0, 0.7, 2.0, -1.5].map(|turn| Place {
        rotation: UnitQuaternion::from_euler_angles(0.3 * turn, turn, -turn),
        shift: Vector3::new(turn, 0.0, -3.0 * turn),
    });
    for place in places {
        let step = Prism::new(&profile, 10.0, Ends::default(), &place, tread, 1e-9);
        // Straight at the edge, more and more from above.
        let angles = [0.05, 0.1, 0.15, 0.2, 0.3, 0.35, 0.4, 0.45].map(|half_turns| half_turns * PI);
        let flights = angles.map(|angle| {
            let outwards = Vector3::new(angle.cos(), angle.sin(), 0.0);
            let origin = outwards * 4.0 + Vector3::new(0.0, 0.0, 5.0);
            let origin = place.rotation * origin + place.shift;
            Ray::of(origin.into(), (place.rotation * -outwards).into())
        });
        let hits = touched_by_many(&step, &flights);
        for (i, angle) in angles.iter().enumerate() {
            let expected = if *angle < 0.25 * PI { riser } else { tread };
            let single = step.first_touch(&flights[i], RADIUS, None, false, f64::INFINITY);
            let single = single.expect("the edge").0;
            assert_eq!([single.surface, hits.surface[i]], [expected; 2], "{angle}");
            assert!((single.distance - 3.5).abs() < 1e-12);
            assert!((hits.distance[i] - 3.5).abs() < 1e-12);
        }
    }
}

#[test]
fn shots_touch_caps_a_radius_before_them() {
    let pot = pipe(true, false);
    let touch = |origin: [f64; 3], direction: [f64; 3]| {
        let found = pot.first_touch(&Ray::of(origin, direction), 1.0, None, false, f64::INFINITY);
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

/// Where a wall and a cap meet, a ray or a shot comes to both at once.
#[test]
fn in_the_edge_of_wall_and_cap_it_is_the_wall_that_is_met() {
    let pot = pipe(true, true);
    // 5 across to the wall for 5 along to the cap, as far as numbers tell, and for shots 4 for 4.
    let half = 0.5_f64.sqrt();
    for (origin, direction) in [
        ([0.0, 0.0, 5.0], [half, 0.0, -half]),
        ([0.0, 0.0, 5.0], [0.0, -half, half]),
        ([1.0, 0.0, 3.0], [0.8, 0.0, -0.6]),
        ([2.0, 0.0, 4.0], [0.6, 0.0, -0.8]),
        ([-1.0, 0.0, 7.0], [-0.8, 0.0, 0.6]),
    ] {
        let ray = Ray::of(origin, direction);
        let towards_wall = -Vector3::new(direction[0], direction[1], 0.0).normalize();
        let met = pot.first_crossing(&ray, None, false, f64::INFINITY);
        let touched = pot.first_touch(&ray, 1.0, None, false, f64::INFINITY);
        for found in [met, touched] {
            let (crossing, normal) = found.expect("it is closed");
            let of_cap = Vector3::new(0.0, 0.0, -direction[2].signum());
            let expected = if crossing.surface == 7 {
                towards_wall
            } else {
                of_cap
            };
            // Those of shots have any length.
            let normal = normal.normalize();
            assert!((normal - expected).norm() < 1e-9, "{origin:?}: {normal}");
        }
    }
}

/// An exit may be set on a wall: its shots start there without coming from it.
#[test]
fn what_starts_on_a_cap_without_having_hit_it_flies_off() {
    let pot = pipe(true, true);
    let meet = |z: f64, direction: [f64; 3]| {
        let ray = Ray::of([1.0, 0.0, z], direction);
        let found = pot.first_crossing(&ray, None, false, f64::INFINITY);
        found.map(|(crossing, _)| (crossing.distance, crossing.surface))
    };
    assert_eq!(meet(0.0, UP), Some((10.0, 9)));
    assert_eq!(meet(0.0, DOWN), None);
    assert_eq!(meet(10.0, DOWN), Some((10.0, 8)));
    assert_eq!(meet(10.0, UP), None);
}

/// It is in reach of the rim from the start, but not at it.
#[test]
fn a_shot_that_starts_level_with_a_rim_has_yet_to_get_there() {
    let open = pipe(false, false);
    for (end, height) in [(0.0, -0.3), (10.0, 10.3)] {
        for from in [0.0, 3.0, -2.0, 4.5] {
            let ray = Ray::of([from, 0.0, height], [1.0, 0.0, 0.0]);
            let found = open.first_touch(&ray, 0.5, None, false, f64::INFINITY);
            let (crossing, normal) = found.expect("the rim");
            // 0.3 beyond the end it is 0.4 before the wall.
            let expected = 4.6 - from;
            assert!((crossing.distance - expected).abs() < 1e-9, "{from}");
            let expected = Vector3::new(-0.8, 0.0, (height - end) / 0.5);
            assert!((normal - expected).norm() < 1e-9, "{from}: {normal}");
        }
    }
}

/// Between two walls, or a wall and a cap, no ray gets out, though single precision puts the edges
/// of each elsewhere.
#[test]
fn rays_in_single_precision_stay_in_a_closed_shaft() {
    let profile = square([[0.3, -0.7], [0.9, 0.1], [0.1, 0.7], [-0.5, -0.1]]);
    let ends = Ends {
        near_closed: true,
        far_closed: true,
    };
    let turned = Place {
        rotation: UnitQuaternion::from_euler_angles(0.3, 0.7, -1.1),
        shift: Vector3::new(0.2, -0.4, 0.7),
    };
    let corners = [[0.3, -0.7], [0.9, 0.1], [0.1, 0.7], [-0.5, -0.1]];
    for place in [Place::default(), turned] {
        let shaft = Prism::new(&profile, 1.5, ends, &place, 0, 1e-12);
        for (corner, [x, y]) in corners.into_iter().enumerate() {
            for round in 0..40 {
                let mut rays = Rays::<f32>::none();
                rays.count = LANES;
                for i in 0..LANES {
                    let share = (i + LANES * round) as f64 / (LANES * 40) as f64;
                    let edge = Vector3::new(x, y, 0.1 + 1.3 * share);
                    let from = Vector3::new(0.2 - 0.3 * share, 0.2 * share, 0.75);
                    let direction = place.rotation * (edge - from).normalize();
                    let origin = place.rotation * from + place.shift;
                    put(
                        &mut rays.origin,
                        i,
                        [origin.x, origin.y, origin.z].map(|x| x as f32),
                    );
                    let direction = [direction.x, direction.y, direction.z].map(|x| x as f32);
                    put(&mut rays.direction, i, direction);
                }
                let mut hits = Hits::none();
                shaft.cross(0, &rays, &mut hits);
                let is_met = hits.distance[..LANES]
                    .iter()
                    .all(|distance| distance.is_finite());
                assert!(is_met, "{corner} {round}");
            }
        }
    }
}

#[test]
fn a_ray_is_between_two_heights_from_its_start_at_the_earliest() {
    let between = |z: f64, rate: f64| {
        let flight = Ray::of([0.0, 0.0, z], [0.0, (1.0 - rate * rate).sqrt(), rate]);
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
