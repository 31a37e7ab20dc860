use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::*;

const SLACK: f64 = 1e-6;
const EXTENT: Extent = Extent {
    length: 10.0,
    slack: SLACK,
};

/// From (1, 2) for 5 in the direction (3, 4); its front looks to the upper left.
const PLANE: Plane = Plane {
    from: [1.0, 2.0],
    tangent: [0.6, 0.8],
    length: 5.0,
};

/// A circle of radius 5 round (1, 2); of it the arc to the right between (4, -2) and (4, 6).
const ARC: Cylinder = Cylinder {
    centre: [1.0, 2.0],
    radius: 5.0,
    side: 1.0,
    towards: [1.0, 0.0],
    reach: 3.0,
};

const WHOLE: Cylinder = Cylinder {
    centre: [0.0, 0.0],
    reach: f64::MIN,
    ..ARC
};

/// The point of the plane's frame: so far along it, so high over its front.
fn over(along: f64, height: f64) -> [f64; 2] {
    let ([x, y], [u, v]) = (PLANE.from, PLANE.tangent);
    [x + along * u - height * v, y + along * v + height * u]
}

/// A flight in the cross-section at z = 5.
fn flight(origin: [f64; 2], direction: [f64; 2], radius: f64) -> Flight {
    Flight {
        origin: [origin[0], origin[1], 5.0],
        direction: [direction[0], direction[1], 0.0],
        radius,
        from_here: false,
        on_front: true,
    }
}

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

fn are_near(a: [f64; 2], b: [f64; 2]) -> bool {
    is_near(a[0], b[0]) && is_near(a[1], b[1])
}

#[test]
fn distances_to_a_plane_are_those_to_its_piece() {
    let wall = Primitive::Plane(PLANE);
    for (along, height, distance) in [
        (2.0, 3.0, 3.0),
        (2.0, -3.0, 3.0),
        (0.0, 1.0, 1.0),
        (5.0, -1.0, 1.0),
        (-3.0, 4.0, 5.0),
        (8.0, -4.0, 5.0),
    ] {
        let point = over(along, height);
        assert!(is_near(wall.distance(point), distance), "{along}, {height}");
        let nearest = over(along.clamp(0.0, 5.0), 0.0);
        assert!(are_near(wall.nearest(point), nearest), "{along}, {height}");
        let (found, at) = PLANE.place(point);
        assert!(are_near([at, found], [along, height]));
    }
}

#[test]
fn distances_to_a_cylinder_are_those_to_its_arc() {
    let wall = Primitive::Cylinder(ARC);
    // Relative to the centre: a point, the nearest of the arc, and how far it is.
    for (point, nearest, distance) in [
        ([10.0, 0.0], [5.0, 0.0], 5.0),
        ([2.0, 0.0], [5.0, 0.0], 3.0),
        ([6.0, 8.0], [3.0, 4.0], 5.0),
        ([3.0, 9.0], [3.0, 4.0], 5.0),
        ([0.0, 4.0], [3.0, 4.0], 3.0),
        ([0.0, -4.0], [3.0, -4.0], 3.0),
        ([-1.0, 7.0], [3.0, 4.0], 5.0),
        ([-1.0, -7.0], [3.0, -4.0], 5.0),
    ] {
        let from_centre = |[x, y]: [f64; 2]| [x + ARC.centre[0], y + ARC.centre[1]];
        let point = from_centre(point);
        assert!(is_near(wall.distance(point), distance), "{point:?}");
        assert!(are_near(wall.nearest(point), from_centre(nearest)));
    }
    assert!(are_near(wall.nearest(ARC.centre), [6.0, 2.0]));
    // The same arc to the upper right, where its ends are in the directions (0, 1) and (24, -7).
    let turned = Primitive::Cylinder(Cylinder {
        towards: [0.6, 0.8],
        reach: 4.0,
        ..WHOLE
    });
    for (point, nearest) in [
        ([6.0, 8.0], [3.0, 4.0]),
        ([-7.0, 3.0], [0.0, 5.0]),
        ([3.0, -9.0], [4.8, 1.4]),
        ([9.9, 1.0], [4.8, 1.4]),
    ] {
        assert!(are_near(turned.nearest(point), nearest), "{point:?}");
    }
    // More than half a circle: the gap is on the left, between (-3, -4) and (-3, 4).
    let long = Primitive::Cylinder(Cylinder {
        reach: -3.0,
        ..WHOLE
    });
    assert!(is_near(long.distance([-2.0, 4.0]), 5.0 - 20_f64.sqrt()));
    assert!(is_near(long.distance([-6.0, 4.0]), 3.0));
    assert!(is_near(long.distance([-6.0, -4.0]), 3.0));
    let whole = Primitive::Cylinder(WHOLE);
    assert!(is_near(whole.distance([-6.0, 8.0]), 5.0));
    assert!(are_near(whole.nearest([-6.0, 8.0]), [-3.0, 4.0]));
    assert!(is_near(WHOLE.distance_to_whole([0.0, -2.0]), 3.0));
    assert!(is_near(WHOLE.distance_to_whole([0.0, -9.0]), 4.0));
}

#[test]
fn points_lie_on_a_wall_within_the_slack() {
    let plane = Primitive::Plane(PLANE);
    for (along, height, lies) in [
        (0.0, 0.0, true),
        (5.0, 0.9, true),
        (2.0, -0.9, true),
        (2.0, 1.1, false),
        (2.0, -1.1, false),
    ] {
        let point = over(along, height * SLACK);
        assert_eq!(plane.lies_on(point, SLACK), lies, "{along}, {height}");
    }
    for (beyond, lies) in [(0.9, true), (1.1, false)] {
        assert_eq!(plane.lies_on(over(-beyond * SLACK, 0.0), SLACK), lies);
        assert_eq!(plane.lies_on(over(5.0 + beyond * SLACK, 0.0), SLACK), lies);
    }
    let arc = Primitive::Cylinder(ARC);
    for (point, lies) in [
        ([5.0, 0.0], true),
        ([3.0, 4.0], true),
        ([3.0, -4.0], true),
        ([5.0 + 0.9 * SLACK, 0.0], true),
        ([5.0 - 0.9 * SLACK, 0.0], true),
        ([5.0 + 1.1 * SLACK, 0.0], false),
        ([5.0 - 1.1 * SLACK, 0.0], false),
        ([0.0, 5.0], false),
        ([-5.0, 0.0], false),
        ([0.0, 0.0], false),
    ] {
        let [x, y] = point;
        assert_eq!(arc.lies_on([x + 1.0, y + 2.0], SLACK), lies, "{point:?}");
    }
}

#[test]
fn lines_cross_a_wall_ahead_as_often_as_it_is_there() {
    let plane = Primitive::Plane(PLANE);
    let (down, along) = ([0.8, -0.6], PLANE.tangent);
    for (place, direction, count) in [
        (over(2.0, 3.0), down, 1),
        (over(2.0, -3.0), down, 0),
        (over(2.0, 3.0), along, 0),
        (over(-0.1, 3.0), down, 0),
        (over(0.1, 3.0), down, 1),
        (over(4.9, 3.0), down, 1),
        (over(5.1, 3.0), down, 0),
    ] {
        assert_eq!(plane.crossings(place, direction), count, "{place:?}");
    }
    // 3 down and 4 along, either way.
    let (forwards, back) = ([0.96, 0.28], [0.0, -1.0]);
    for (along, direction, count) in [
        (-4.1, forwards, 0),
        (-3.9, forwards, 1),
        (0.9, forwards, 1),
        (1.1, forwards, 0),
        (3.9, back, 0),
        (4.1, back, 1),
        (8.9, back, 1),
        (9.1, back, 0),
    ] {
        let found = plane.crossings(over(along, 3.0), direction);
        assert_eq!(found, count, "{along}, {direction:?}");
    }
    let arc = Primitive::Cylinder(ARC);
    for (origin, direction, count) in [
        ([-9.0, 0.0], [1.0, 0.0], 1),
        ([9.0, 0.0], [-1.0, 0.0], 1),
        ([9.0, 0.0], [1.0, 0.0], 0),
        ([4.0, -9.0], [0.0, 1.0], 2),
        ([4.0, 0.0], [0.0, 1.0], 1),
        ([2.0, -9.0], [0.0, 1.0], 0),
        ([6.0, -9.0], [0.0, 1.0], 0),
    ] {
        let from = [origin[0] + 1.0, origin[1] + 2.0];
        assert_eq!(arc.crossings(from, direction), count, "{origin:?}");
    }
}

#[test]
fn arcs_become_cylinders_with_free_space_on_their_left() {
    let of = |start: f64, sweep: f64| {
        let form = Primitive::of(&Curve::Arc {
            centre: [1.0, 2.0].into(),
            radius: 2.0,
            start,
            sweep,
        });
        let Primitive::Cylinder(cylinder) = form else {
            panic!("an arc is round");
        };
        assert_eq!((cylinder.centre, cylinder.radius), ([1.0, 2.0], 2.0));
        cylinder
    };
    // A quarter to the right: its ends are 45 deg from its middle.
    let quarter = of(-FRAC_PI_2 / 2.0, FRAC_PI_2);
    assert!(are_near(quarter.towards, [1.0, 0.0]));
    assert!(is_near(quarter.reach, 2_f64.sqrt()) && quarter.side == 1.0);
    let reversed = of(FRAC_PI_2 / 2.0, -FRAC_PI_2);
    assert!(are_near(reversed.towards, [1.0, 0.0]));
    assert!(is_near(reversed.reach, 2_f64.sqrt()) && reversed.side == -1.0);
    let half = of(0.0, PI);
    assert!(are_near(half.towards, [0.0, 1.0]) && is_near(half.reach, 0.0));
    let long = of(0.0, 1.5 * PI);
    assert!(is_near(long.reach, -2_f64.sqrt()));
    for sweep in [TAU, -TAU] {
        assert_eq!(of(0.3, sweep).reach, f64::MIN);
    }
}

#[test]
fn rays_meet_a_plane_from_both_sides() {
    let down = [0.8, -0.6];
    let met = PLANE.meet::<false>(&flight(over(2.0, 3.0), down, 0.0), &EXTENT);
    assert!(met.front && is_near(met.distance, 3.0) && is_near(met.rank, 3.0));
    assert!(are_near(met.normal, [-0.8, 0.6]));
    let up = [-0.8, 0.6];
    let met = PLANE.meet::<false>(&flight(over(2.0, -3.0), up, 0.0), &EXTENT);
    assert!(!met.front && is_near(met.distance, 3.0));
    // What is seen from behind yields to what is seen at an edge.
    assert!(is_near(met.rank, 3.0 + SLACK));
    let away = PLANE.meet::<false>(&flight(over(2.0, 3.0), up, 0.0), &EXTENT);
    assert_eq!(away.rank, f64::INFINITY);

    // A little beyond its edges and ends a wall is met where its front is seen, and only there.
    let is_met = |along: f64, height: f64, z: f64| {
        let direction = if height > 0.0 { down } else { up };
        let mut flight = flight(over(along, height), direction, 0.0);
        flight.origin[2] = z;
        PLANE.meet::<false>(&flight, &EXTENT).rank < f64::INFINITY
    };
    for beyond in [-0.5 * SLACK, 0.5 * SLACK, 1.5 * SLACK] {
        let (front, back) = (beyond < SLACK, beyond < 0.0);
        for (along, z) in [
            (-beyond, 5.0),
            (5.0 + beyond, 5.0),
            (2.0, -beyond),
            (2.0, 10.0 + beyond),
        ] {
            assert_eq!(is_met(along, 1.0, z), front, "{along}, {z}");
            assert_eq!(is_met(along, -1.0, z), back, "{along}, {z}");
        }
    }
}

#[test]
fn slanted_rays_meet_a_plane_between_its_edges() {
    // 3 down and 4 along, either way.
    for (along, direction, meets) in [
        (-4.1, [0.96, 0.28], false),
        (-3.9, [0.96, 0.28], true),
        (0.9, [0.96, 0.28], true),
        (1.1, [0.96, 0.28], false),
        (3.9, [0.0, -1.0], false),
        (4.1, [0.0, -1.0], true),
        (8.9, [0.0, -1.0], true),
        (9.1, [0.0, -1.0], false),
    ] {
        let met = PLANE.meet::<false>(&flight(over(along, 3.0), direction, 0.0), &EXTENT);
        assert!(is_near(met.distance, 5.0), "{along}");
        assert_eq!(met.rank < f64::INFINITY, meets, "{along}");
    }
}

#[test]
fn rays_meet_a_wall_as_far_as_it_reaches_along_z() {
    // 3 before the plane, or 4 before the far side of the circle, at 0.6 along z for 0.8 across.
    let met = |z: f64, w: f64| {
        let mut to_plane = flight(over(2.0, 3.0), [0.8 * 0.8, -0.6 * 0.8], 0.0);
        let mut to_circle = flight([1.0, 0.0], [0.8, 0.0], 0.0);
        for flight in [&mut to_plane, &mut to_circle] {
            flight.origin[2] = z;
            flight.direction[2] = w;
        }
        [
            PLANE.meet::<false>(&to_plane, &EXTENT).rank,
            WHOLE.meet::<false>(&to_circle, &EXTENT).rank,
        ]
        .map(|rank| rank < f64::INFINITY)
    };
    for (z, w, expected) in [
        (5.0, 0.6, [true, true]),
        (5.0, -0.6, [true, true]),
        (7.5, 0.6, [true, false]),
        (2.5, -0.6, [true, false]),
        (9.0, 0.6, [false, false]),
        (1.0, -0.6, [false, false]),
        (-2.5, 0.6, [false, true]),
        (12.5, -0.6, [false, true]),
        (-2.0, 0.6, [true, true]),
        (12.0, -0.6, [true, true]),
    ] {
        assert_eq!(met(z, w), expected, "{z}, {w}");
    }
}

#[test]
fn rays_that_start_on_a_plane_meet_it_at_once_or_never() {
    let (down, up) = ([0.8, -0.6], [-0.8, 0.6]);
    let met = |height: f64, direction: [f64; 2], on_front: bool, from_here: bool| {
        let flight = Flight {
            on_front,
            from_here,
            ..flight(over(2.0, height), direction, 0.0)
        };
        let met = PLANE.meet::<true>(&flight, &EXTENT);
        (met.rank < f64::INFINITY).then_some(met.distance)
    };
    for height in [-0.5 * SLACK, 0.0, 0.5 * SLACK] {
        assert_eq!(met(height, down, true, false), Some(0.0));
        assert_eq!(met(height, down, false, false), None);
        assert_eq!(met(height, up, true, false), None);
        assert_eq!(met(height, up, false, false), Some(0.0));
        assert_eq!(met(height, PLANE.tangent, true, false), None);
        assert_eq!(met(height, down, true, true), None);
    }
    assert!(met(2.0, down, true, false).is_some_and(|it| is_near(it, 2.0)));
}

#[test]
fn rays_meet_a_cylinder_where_it_is() {
    let meet = |cylinder: &Cylinder, origin: [f64; 2], direction: [f64; 2]| {
        let met = cylinder.meet::<false>(&flight(origin, direction, 0.0), &EXTENT);
        (met.rank < f64::INFINITY).then_some((met.distance, met.front, met.normal))
    };
    let right = [1.0, 0.0];
    // Free space is inside: the near side is seen from behind, and only the far side is of the arc.
    let (distance, front, normal) = meet(&ARC, [-9.0, 2.0], right).expect("it is there");
    assert!(is_near(distance, 15.0) && front && are_near(normal, [-1.0, 0.0]));
    let (distance, front, normal) = meet(&WHOLE, [-9.0, 0.0], right).expect("it is there");
    assert!(is_near(distance, 4.0) && !front && are_near(normal, [1.0, 0.0]));
    let pin = Cylinder {
        side: -1.0,
        ..WHOLE
    };
    let (distance, front, normal) = meet(&pin, [-9.0, 3.0], right).expect("it is there");
    assert!(is_near(distance, 5.0) && front && are_near(normal, [-0.8, 0.6]));
    let (distance, front, _) = meet(&WHOLE, [0.0, 3.0], right).expect("it is there");
    assert!(is_near(distance, 4.0) && front);
    assert_eq!(meet(&WHOLE, [-9.0, 5.1], right), None);
    assert_eq!(meet(&WHOLE, [9.0, 0.0], right), None);
    assert_eq!(meet(&ARC, [1.0, 2.0], [-1.0, 0.0]), None);
}

/// Seen from its front, and only then.
#[test]
fn a_cylinder_is_met_a_little_beyond_its_edges() {
    // Its upper edge is at (4, 6): straight up from inside, and straight down from outside.
    let (side, height) = (3.0, 4.0);
    for beyond in [-0.5 * SLACK, 0.5 * SLACK, 1.5 * SLACK] {
        let x = 1.0 + side - beyond;
        let inside = flight([x, 2.0], [0.0, 1.0], 0.0);
        let outside = flight([x, 12.0], [0.0, -1.0], 0.0);
        let [from_inside, from_outside] = [inside, outside].map(|flight| {
            let met = ARC.meet::<false>(&flight, &EXTENT);
            (met.rank < f64::INFINITY).then_some(met.distance)
        });
        let near = |found: Option<f64>, expected: f64| {
            found.is_some_and(|distance| (distance - expected).abs() < 2.0 * SLACK)
        };
        assert_eq!(near(from_inside, height), beyond < SLACK, "{beyond}");
        assert_eq!(near(from_outside, 10.0 - height), beyond < 0.0, "{beyond}");
    }
}

#[test]
fn rays_that_start_on_a_cylinder_meet_it_at_once_or_across() {
    let met = |x: f64, direction: [f64; 2], from_here: bool| {
        let flight = Flight {
            from_here,
            ..flight([x, 0.0], direction, 0.0)
        };
        let met = WHOLE.meet::<true>(&flight, &EXTENT);
        (met.rank < f64::INFINITY).then_some(met.distance)
    };
    for x in [5.0 - 0.5 * SLACK, 5.0, 5.0 + 0.5 * SLACK] {
        assert_eq!(met(x, [1.0, 0.0], false), Some(0.0));
        assert_eq!(met(x, [1.0, 0.0], true), None);
        // Back through the middle, or along the chord of 3-4-5.
        for from_here in [false, true] {
            let across = met(x, [-1.0, 0.0], from_here).expect("the other side");
            assert!((across - 10.0).abs() < 2.0 * SLACK);
            let chord = met(x, [-0.6, 0.8], from_here).expect("the other side");
            assert!((chord - 6.0).abs() < 2.0 * SLACK);
        }
    }
}

#[test]
fn shots_touch_a_plane_a_radius_before_it() {
    let touch = |place: [f64; 2], direction: [f64; 2]| {
        let met = PLANE.touch(&flight(place, direction, 1.0), &EXTENT);
        (met.rank < f64::INFINITY).then_some((met.distance, met.front))
    };
    let (down, up) = ([0.8, -0.6], [-0.8, 0.6]);
    let (distance, front) = touch(over(2.0, 3.0), down).expect("ahead");
    assert!(is_near(distance, 2.0) && front);
    let (distance, front) = touch(over(2.0, -3.0), up).expect("ahead");
    assert!(is_near(distance, 2.0) && !front);
    // Down and along in the ratio 4 to 3, so that 2 down are 1.5 along.
    let slanted = [0.8 * 0.8 + 0.6 * 0.6, -0.6 * 0.8 + 0.8 * 0.6];
    let (distance, _) = touch(over(2.0, 3.0), slanted).expect("ahead");
    assert!(is_near(distance, 2.5));
    assert!(touch(over(3.4, 3.0), slanted).is_some());
    assert_eq!(touch(over(3.6, 3.0), slanted), None);
    assert_eq!(touch(over(2.0, 3.0), up), None);
    assert_eq!(touch(over(2.0, 3.0), PLANE.tangent), None);
    // One that touches it meets it at once when it heads into it, however deep it is.
    for height in [0.2, 1.0, 1.0 + 0.5 * SLACK] {
        assert_eq!(touch(over(2.0, height), down), Some((0.0, true)));
        assert_eq!(touch(over(2.0, height), up), None);
        assert_eq!(touch(over(2.0, height), PLANE.tangent), None);
    }
    let leaving = Flight {
        from_here: true,
        ..flight(over(2.0, 1.0), down, 1.0)
    };
    assert_eq!(PLANE.touch(&leaving, &EXTENT).rank, f64::INFINITY);
}

/// Where a shot of radius 1 touches, and the unit normal there.
fn touched(
    wall: &impl Intersect,
    origin: [f64; 2],
    direction: [f64; 2],
    from_here: bool,
) -> Option<(f64, bool, [f64; 2])> {
    let flight = Flight {
        from_here,
        ..flight(origin, direction, 1.0)
    };
    let met = wall.touch(&flight, &EXTENT);
    let length = dot(met.normal, met.normal).sqrt();
    let normal = met.normal.map(|x| x / length);
    (met.rank < f64::INFINITY).then_some((met.distance, met.front, normal))
}

#[test]
fn shots_touch_a_hollow_from_inside() {
    // Their centres stay within a circle of radius 4.
    let right = [1.0, 0.0];
    let (distance, front, normal) = touched(&WHOLE, [0.0, 0.0], right, false).expect("ahead");
    assert!(is_near(distance, 4.0) && front && are_near(normal, [-1.0, 0.0]));
    let (distance, _, normal) = touched(&WHOLE, [-1.0, 2.4], right, false).expect("ahead");
    assert!(is_near(distance, 4.2) && are_near(normal, [-0.8, -0.6]));
    // At the wall: at once when it heads into it, on the other side when it leaves.
    for x in [4.0 - 0.5 * SLACK, 4.0, 4.0 + 0.5 * SLACK, 4.5] {
        let at_once = touched(&WHOLE, [x, 0.0], right, false);
        assert!(at_once.is_some_and(|it| it.0 == 0.0), "{x}");
    }
    for (from_here, x) in [(false, 4.0 + 0.5 * SLACK), (true, 4.0), (true, 4.1)] {
        let (across, _, normal) =
            touched(&WHOLE, [x, 0.0], [-1.0, 0.0], from_here).expect("the other side");
        assert!((across - 2.0 * x).abs() < 2.0 * SLACK, "{x}: {across}");
        assert!(normal[0] > 0.999);
    }
    assert_eq!(touched(&WHOLE, [4.0, 0.0], right, true), None);
    // One that flies along the wall where it touches it does not meet it.
    for x in [4.0 - 0.5 * SLACK, 4.0, 4.0 + 0.5 * SLACK] {
        assert_eq!(touched(&WHOLE, [x, 0.0], [0.0, 1.0], false), None, "{x}");
    }
    // An arc is touched where it is; its ends are at (4, -2) and (4, 6), its centre at (1, 2).
    let (distance, _, _) = touched(&ARC, [1.0, 2.0], right, false).expect("ahead");
    assert!(is_near(distance, 4.0));
    assert!(touched(&ARC, [1.0, 2.0], [0.61, 0.792_401_43], false).is_some());
    assert_eq!(touched(&ARC, [1.0, 2.0], [0.59, 0.807_403_24], false), None);
    assert_eq!(touched(&ARC, [1.0, 2.0], [-1.0, 0.0], false), None);
    // Its end, 3 to the right of the centre, but for the slack.
    for (beyond, is_touched) in [(-0.5, true), (0.5, true), (1.5, false)] {
        let cos = (3.0 - beyond * SLACK) / 5.0;
        let towards_end = [cos, (1.0 - cos * cos).sqrt()];
        let found = touched(&ARC, [1.0, 2.0], towards_end, false);
        assert_eq!(found.is_some(), is_touched, "{beyond}");
    }
    // In a hollow hardly wider than itself it touches at once, however flat it heads into the wall.
    let tight = Cylinder {
        radius: 1.0 + 1e-3,
        ..WHOLE
    };
    for sinking in [1e-3, 1e-6, 1e-9] {
        let found = touched(&tight, [1e-3, 0.0], [sinking, 1.0], false);
        assert!(found.is_some_and(|it| it.0 == 0.0), "{sinking}");
    }
    // A shot that does not fit in touches nothing from inside.
    let narrow = Cylinder {
        radius: 0.9,
        ..WHOLE
    };
    assert_eq!(touched(&narrow, [0.0, 0.0], right, false), None);
}

#[test]
fn shots_touch_a_pin_from_outside() {
    let pin = Cylinder {
        side: -1.0,
        ..WHOLE
    };
    // Their centres stay outside a circle of radius 6.
    let right = [1.0, 0.0];
    let (distance, front, normal) = touched(&pin, [-9.0, 0.0], right, false).expect("ahead");
    assert!(is_near(distance, 3.0) && front && are_near(normal, [-1.0, 0.0]));
    let (distance, _, normal) = touched(&pin, [-9.0, 3.6], right, false).expect("ahead");
    assert!(is_near(distance, 4.2) && are_near(normal, [-0.8, 0.6]));
    assert_eq!(touched(&pin, [-9.0, 6.1], right, false), None);
    let up = [0.0, 1.0];
    let (distance, _, normal) = touched(&pin, [3.6, -9.0], up, false).expect("ahead");
    assert!(is_near(distance, 4.2) && are_near(normal, [0.6, -0.8]));
    assert_eq!(touched(&pin, [9.0, 0.0], right, false), None);
    for x in [-6.0 - 0.5 * SLACK, -6.0, -5.5] {
        let at_once = touched(&pin, [x, 0.0], right, false);
        assert!(at_once.is_some_and(|it| it.0 == 0.0), "{x}");
        for from_here in [false, true] {
            assert_eq!(touched(&pin, [x, 0.0], [-1.0, 0.0], from_here), None);
            assert_eq!(touched(&pin, [x, 0.0], [0.0, 1.0], from_here), None);
        }
    }
    // The back of a hollow is touched from outside too, but not as a front.
    let (distance, front, normal) = touched(&WHOLE, [-9.0, 0.0], right, false).expect("ahead");
    assert!(is_near(distance, 3.0) && !front && are_near(normal, [1.0, 0.0]));
    // Half a circle to the left, and more than half.
    for (reach, meets) in [(0.0, [true, false]), (-3.0, [true, true])] {
        let arc = Cylinder {
            reach,
            towards: [-1.0, 0.0],
            ..pin
        };
        // Through the gap a shot touches the back from inside.
        let from_front = |origin: [f64; 2], direction: [f64; 2]| {
            let (_, front, _) = touched(&arc, origin, direction, false).expect("one side");
            front
        };
        let found = [-1.0, 1.0].map(|x| {
            let [u, v] = [0.5 * x, 0.75_f64.sqrt()];
            from_front([9.0 * u, 9.0 * v], [-u, -v])
        });
        assert_eq!(found, meets, "{reach}");
        assert!(!from_front([9.0, 0.0], [-1.0, 0.0]));
    }
}

#[test]
fn shots_touch_an_edge_as_a_circle_of_their_radius() {
    let edge = Edge {
        point: [1.0, 2.0],
        towards_second: [0.0, 1.0],
    };
    let right = [1.0, 0.0];
    let (distance, front, normal) = touched(&edge, [-2.0, 2.0], right, false).expect("ahead");
    assert!(is_near(distance, 2.0) && front && are_near(normal, [-1.0, 0.0]));
    let (distance, _, normal) = touched(&edge, [-2.0, 2.6], right, false).expect("ahead");
    assert!(is_near(distance, 2.2) && are_near(normal, [-0.8, 0.6]));
    assert!(edge.is_of_second(normal) && !edge.is_of_second([-0.8, -0.6]));
    assert_eq!(touched(&edge, [-2.0, 3.1], right, false), None);
    assert_eq!(touched(&edge, [4.0, 2.0], right, false), None);
    let (distance, _, _) = touched(&edge, [-0.25, 2.0], right, false).expect("ahead");
    assert!(is_near(distance, 0.25));
    for x in [-0.5 * SLACK, 0.0, 0.5] {
        let at_once = touched(&edge, [x, 2.0], right, false);
        assert!(at_once.is_some_and(|it| it.0 == 0.0), "{x}");
        assert_eq!(touched(&edge, [x, 2.0], right, true), None);
        assert_eq!(touched(&edge, [x, 2.0], [-1.0, 0.0], false), None);
        assert_eq!(touched(&edge, [x, 2.0], [0.0, 1.0], false), None);
    }
}
