use super::*;
use crate::scene::rays::HitIds;

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
    let wall = HitId {
        part: 0,
        piece: 0,
        front: true,
    };
    let meet = |z: f64, direction: [f64; 3], leaving: HitId| {
        let ray = Ray::of([5.0, 0.0, z], direction);
        let found = pot.first_crossing(&ray, Some(leaving), true, f64::INFINITY);
        let found = found.map(|(crossing, _)| (crossing.distance, crossing.surface));
        // The same among many.
        let mut rays = Rays::none();
        rays.count = 1;
        put(&mut rays.origin, 0, ray.origin.into());
        put(&mut rays.direction, 0, ray.direction.into());
        let mut hit_ids = HitIds::none();
        hit_ids.set(0, leaving);
        rays.leaving = Some(hit_ids);
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
        let cap = HitId { piece: 1, ..wall };
        assert!(is_near(meet(beside, up, cap), (12.5, 9)));
        assert_eq!(meet(beside, down, cap), None);
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
