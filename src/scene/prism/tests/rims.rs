use super::*;

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
        let touch = |flight: &Ray, leaving: Option<HitId>| {
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
            let hit_id = HitId {
                part: 0,
                piece: rim.piece,
                front: true,
            };
            assert_eq!(touch(&inside, Some(hit_id)), touch(&inside, None));
            // Out over the rim, by rounding a little into it: one that has left it does not touch it.
            let sinking = normal * -1e-9 + outwards * 0.8 - Vector3::z() * 0.6 * towards[2];
            let grazing = Ray {
                origin: over_rim.origin + over_rim.direction * rim.distance,
                direction: sinking.normalize(),
            };
            let at_once = touch(&grazing, None).map(|(it, _)| (it.piece, it.distance));
            assert_eq!(at_once, Some((rim.piece, 0.0)));
            assert_eq!(touch(&grazing, Some(hit_id)), None);
        }
        pieces.sort_unstable();
        pieces.dedup();
        assert_eq!(pieces.len(), prism.walls.len() * (1 + from_ends.len()));
    }
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

#[test]
fn shots_touch_the_rims_of_a_pipe_from_all_sides() {
    let open = pipe(false, false);
    let touch = |flight: &Ray, leaving: Option<HitId>, limit: f64| {
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
            let hit_id = HitId {
                part: 0,
                piece: crossing.piece,
                front: true,
            };
            let mut away = from(9.6);
            away.direction = -away.direction;
            assert!(touch(&away, Some(hit_id), f64::INFINITY).is_none());
            // Across the pipe it comes to the same rim again.
            if across < 0.0 {
                away.direction = -Vector3::y();
                let again = touch(&away, Some(hit_id), f64::INFINITY).expect("the other side");
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

#[test]
fn a_ray_is_between_two_heights_from_its_start_at_the_earliest() {
    let between = |z: f64, rate: f64| {
        let flight = Ray::of([0.0, 0.0, z], [0.0, (1.0 - rate * rate).sqrt(), rate]);
        touch::between(&flight, 2.0, 4.0)
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

/// At the corner of two walls, at both ends, whichever stands first in the list; for many shots as for one.
#[test]
fn a_lip_belongs_to_the_wall_whose_normal_is_nearer() {
    // A bar seen from outside; each list starts with another wall.
    let corners = [[5.0, 5.0], [5.0, -5.0], [-5.0, -5.0], [-5.0, 5.0]];
    for first in 0..4 {
        let turned = [0, 1, 2, 3].map(|index| corners[(index + first) % 4]);
        let profile = square(turned);
        let bar = Prism::new(&profile, 10.0, Ends::default(), &Place::default(), 7, 1e-9);
        // Over the corner at (5, 5): the walls there look along x and along y.
        let outwards = |surface: u32| {
            let index = (surface - 7) as usize;
            let (a, b) = (turned[index], turned[(index + 1) % 4]);
            [(a[1] - b[1]) / 10.0, (b[0] - a[0]) / 10.0]
        };
        let angles =
            [0.02, 0.1, 0.2, 0.24, 0.26, 0.3, 0.4, 0.48].map(|turns| turns * std::f64::consts::PI);
        for (z, direction) in [(-10.0, UP), (20.0, DOWN)] {
            let flights = angles.map(|angle| {
                let (sin, cos) = angle.sin_cos();
                Ray::of([5.0 + 0.3 * cos, 5.0 + 0.3 * sin, z], direction)
            });
            let hits = touched_by_many(&bar, &flights);
            for (i, angle) in angles.iter().enumerate() {
                let alone = bar.first_touch(&flights[i], RADIUS, None, false, f64::INFINITY);
                let (crossing, normal) = alone.expect("the lip");
                assert!((crossing.distance - 9.6).abs() < 1e-9);
                let [x, y] = outwards(crossing.surface);
                let faces_x = *angle < 0.25 * std::f64::consts::PI;
                assert_eq!(
                    [x.abs() > 0.5, y.abs() > 0.5],
                    [faces_x, !faces_x],
                    "{first}, {angle}"
                );
                assert!(x * normal.x + y * normal.y > 0.0);
                assert_eq!(
                    (hits.surface[i], hits.distance[i]),
                    (crossing.surface, crossing.distance)
                );
                // What has left it goes away from both walls.
                let hit_id = HitId {
                    part: 0,
                    piece: crossing.piece,
                    front: true,
                };
                let away = Ray {
                    origin: flights[i].origin + flights[i].direction * crossing.distance,
                    direction: (normal + Vector3::new(-0.4, 0.3, 0.0)).normalize(),
                };
                assert_eq!(
                    bar.first_touch(&away, RADIUS, Some(hit_id), true, f64::INFINITY),
                    None
                );
            }
        }
    }
}

/// From outside, steeply and gently, past either end, with an end closed or none: rims on the way are found, and what
/// passes clear of them is let through.
#[test]
fn many_shots_from_outside_touch_what_each_of_them_touches() {
    let mut rims = 0;
    for (near_closed, far_closed) in [(false, false), (true, false), (false, true)] {
        let pipe = pipe(near_closed, far_closed);
        for round in 0..32 {
            let flight = |i: usize| {
                let number = (round * LANES + i) as u32;
                let spread = |axis| f64::from(sobol_burley::sample(number, axis, 5));
                let outside = if spread(0) < 0.5 { -2.0 } else { 12.0 };
                let origin = Point3::new(14.0 * spread(1) - 7.0, 14.0 * spread(2) - 7.0, outside);
                let into = Point3::new(
                    12.0 * spread(3) - 6.0,
                    12.0 * spread(4) - 6.0,
                    12.0 * spread(5) - 1.0,
                );
                Ray {
                    origin,
                    direction: (into - origin).normalize(),
                }
            };
            let flights: Vec<Ray> = (0..LANES).map(flight).collect();
            let many = touched_by_many(&pipe, &flights);
            for (i, flight) in flights.iter().enumerate() {
                let one = pipe.first_touch(flight, RADIUS, None, false, f64::INFINITY);
                let distance = one.map_or(f64::INFINITY, |(crossing, _)| crossing.distance);
                assert_eq!(many.distance[i], distance, "{flight:?}");
                if let Some((crossing, _)) = one {
                    assert_eq!(many.hit_ids.at(i).piece, crossing.piece, "{flight:?}");
                    rims += usize::from(crossing.piece >= pipe.first_rim());
                }
            }
        }
    }
    assert!(rims > 200, "{rims}");
}
