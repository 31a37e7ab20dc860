use std::f64::consts::PI;

use nalgebra::UnitQuaternion;

use super::*;

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

/// Between two walls, or a wall and a cap, no ray gets out, though rounding puts the edges of each
/// elsewhere.
#[test]
fn rays_to_edges_stay_in_a_closed_shaft() {
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
                let mut rays = Rays::none();
                rays.count = LANES;
                for i in 0..LANES {
                    let share = (i + LANES * round) as f64 / (LANES * 40) as f64;
                    let edge = Vector3::new(x, y, 0.1 + 1.3 * share);
                    let from = Vector3::new(0.2 - 0.3 * share, 0.2 * share, 0.75);
                    let direction = place.rotation * (edge - from).normalize();
                    let origin = place.rotation * from + place.shift;
                    put(&mut rays.origin, i, [origin.x, origin.y, origin.z]);
                    let direction = [direction.x, direction.y, direction.z];
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
