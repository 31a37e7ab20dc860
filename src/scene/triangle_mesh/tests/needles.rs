//! Needles, whose edges rounding moves by more than they are wide: what is hit is where it is said to be.

use nalgebra::{Point3, Vector3};

use super::{Random, apart, box_holds, normal};
use crate::scene::ray::{HitId, Ray};
use crate::scene::triangle_mesh::TriangleMesh;

/// m.
const WIDEST: f64 = 1e-4;
/// m.
const SLACK: f64 = 1e-11;
/// What rounding may do, m.
const NEAR: f64 = 1e-6;

/// A point of a lattice, whose coordinates cancel without rounding; or just beside one, or anywhere.
fn place(random: &mut Random) -> Vector3<f64> {
    let anywhere = random.vector() * 8.0;
    let on_lattice = anywhere.map(|coordinate| (coordinate * 16.0).round() / 16.0);
    let beside = on_lattice + Vector3::from_fn(|_, _| *random.of(&[0.0, 2.5e-9]));
    *random.of(&[anywhere, on_lattice, beside])
}

fn needle(random: &mut Random) -> [Point3<f64>; 3] {
    let [tip, end] = [(); 2].map(|()| Point3::from(place(random)));
    let width = WIDEST * 10_f64.powf(-5.0 * random.share());
    let along_axis = Vector3::ith(random.bits() as usize % 3, width);
    let anywhere = random.direction() * width;
    let across = *random.of(&[along_axis, anywhere]);
    let first = random.bits() as usize % 3;
    [0, 1, 2].map(|corner| [tip, end, end + across][(first + corner) % 3])
}

/// A ray that passes a needle's line near the needle or beyond its ends, most of them along its plane.
fn ray(corners: &[Point3<f64>; 3], random: &mut Random) -> Ray {
    let [a, b] = [corners[0], *random.of(&[corners[1], corners[2]])];
    let along = b - a;
    let aim = a + along * (1.5 * random.symmetric() + 0.5);
    let in_plane = normal(corners).cross(&random.vector());
    let rise = *random.of(&[0.0, 1e-12, 1e-9, 1e-6, 5e-4, 2e-3, 0.5]);
    let [way, start] = [(); 2].map(|()| place(random));
    let way = *random.of(&[along, in_plane, way]) + normal(corners) * rise;
    let direction = way.try_normalize(1e-6).unwrap_or_else(Vector3::z);
    let behind_aim = aim - direction * (8.0 * random.share());
    let origin = *random.of(&[behind_aim, aim, start.into()]);
    Ray { origin, direction }
}

/// The shortest of the edges, m, the longest one, and the height over that.
fn measures(corners: &[Point3<f64>; 3]) -> [f64; 3] {
    let edges = [0, 1, 2].map(|from| corners[(from + 1) % 3] - corners[from]);
    let lengths = edges.map(|edge| edge.norm());
    let longest = lengths.into_iter().fold(0.0, f64::max);
    let shortest = lengths.into_iter().fold(longest, f64::min);
    [
        shortest,
        longest,
        edges[0].cross(&edges[1]).norm() / longest,
    ]
}

/// How far from a needle its crossing with a ray may seem to be. Where the ray runs within the plane but
/// for rounding, or rounding tilts the plane, where they cross is as uncertain.
fn uncertainty(corners: &[Point3<f64>; 3], ray: &Ray) -> f64 {
    let [shortest, longest, height] = measures(corners);
    let tilt = f64::EPSILON * longest * shortest / height;
    NEAR + (1e-14 + tilt) / ray.direction.dot(&normal(corners)).abs()
}

fn distance(point: &Point3<f64>, corners: &[Point3<f64>; 3]) -> f64 {
    let edge = |from: usize| corners[(from + 1) % 3] - corners[from];
    let to_edge = |from: usize| {
        let share = (point - corners[from]).dot(&edge(from)) / edge(from).norm_squared();
        (point - corners[from] - edge(from) * share.clamp(0.0, 1.0)).norm()
    };
    let upwards = normal(corners);
    let height = (point - corners[0]).dot(&upwards);
    let foot = point - upwards * height;
    let is_inside = |from: usize| edge(from).cross(&(foot - corners[from])).dot(&upwards) >= 0.0;
    if box_holds(corners, &foot, SLACK) && (0..3).all(is_inside) {
        height.abs()
    } else {
        (0..3).map(to_edge).fold(f64::INFINITY, f64::min)
    }
}

/// Shows needles, with meshes of them alone, to a test.
fn with_needles(count: usize, mut test: impl FnMut(&[Point3<f64>; 3], &TriangleMesh, &mut Random)) {
    let mut random = Random(11);
    for _ in 0..count {
        let corners = needle(&mut random);
        if measures(&corners)[2] > 10.0 * SLACK {
            let facets = TriangleMesh::new(apart(&[corners.map(Point3::into)]), 0, SLACK);
            test(&corners, &facets, &mut random);
        }
    }
}

#[test]
fn rays_meet_needles_where_these_are() {
    let elsewhere = HitId {
        part: 0,
        piece: 1,
        front: true,
    };
    let mut hits = 0;
    with_needles(5_000, |corners, facets, random| {
        for _ in 0..20 {
            let ray = ray(corners, random);
            let leaving = *random.of(&[None, Some(elsewhere)]);
            let on_this_part = random.bits().is_multiple_of(2);
            let found = facets.first_crossing(&ray, leaving, on_this_part, f64::INFINITY);
            let Some((crossing, _)) = found else {
                continue;
            };
            hits += 1;
            let point = ray.origin + ray.direction * crossing.distance;
            let off = distance(&point, corners);
            assert!(
                off < uncertainty(corners, &ray),
                "{ray:?} from {leaving:?} meets {corners:?} {off} beside, at {crossing:?}"
            );
        }
    });
    assert!(hits > 5_000, "{hits}");
}

#[test]
fn rays_aimed_at_needles_meet_them() {
    with_needles(5_000, |corners, facets, random| {
        for _ in 0..20 {
            let shares = [(); 3].map(|()| 0.05 + random.share());
            let inside = [0, 1, 2].map(|corner| corners[corner].coords * shares[corner]);
            let aim = inside.iter().sum::<Vector3<f64>>() / shares.iter().sum::<f64>();
            let direction = random.direction();
            let away = 0.1 + 8.0 * random.share();
            let ray = Ray {
                origin: Point3::from(aim - direction * away),
                direction,
            };
            let steepness = direction.dot(&normal(corners)).abs();
            let found = facets.first_crossing(&ray, None, false, f64::INFINITY);
            let off = found.map(|(crossing, _)| (crossing.distance - away).abs());
            assert!(
                steepness < 0.01 || off.is_some_and(|off| off < uncertainty(corners, &ray)),
                "{ray:?} misses {corners:?} {away} away: {found:?}"
            );
        }
    });
}

#[test]
fn spheres_touch_needles_where_these_are() {
    let mut touches = 0;
    with_needles(2_000, |corners, facets, random| {
        for _ in 0..20 {
            let ray = ray(corners, random);
            let radius = *random.of(&[1e-3, 0.1, 2.0]);
            let apart = |along: f64| distance(&(ray.origin + ray.direction * along), corners);
            if apart(0.0) < radius + NEAR {
                continue;
            }
            let found = facets.first_touch(&ray, radius, None, false, f64::INFINITY);
            let reach = found.map_or(20.0, |(crossing, _)| crossing.distance);
            let least = (0..=50).map(|step| apart(f64::from(step) / 50.0 * reach));
            let enters = least.fold(f64::INFINITY, f64::min) < radius - NEAR;
            let is_off = found.is_some() && (apart(reach) - radius).abs() > NEAR;
            assert!(
                !enters && !is_off,
                "{ray:?} with {radius} meets {corners:?}: {found:?}"
            );
            touches += usize::from(found.is_some());
        }
    });
    assert!(touches > 5_000, "{touches}");
}
