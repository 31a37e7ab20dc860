//! What is told of four triangles at once is what is true of each.

use nalgebra::{Point3, Vector3};

use super::{LANES, TrianglePacket};
use crate::scene::ray::Ray;
use crate::scene::triangle_mesh::tests::Random;

type Corners = [Point3<f64>; 3];

const SLACK: f64 = 1e-9;
const GRAZING: f64 = 1e-3;

fn normal([a, b, c]: &Corners) -> Vector3<f64> {
    (b - a).cross(&(c - a)).normalize()
}

/// One to four triangles anywhere, of any indices but 0, and the bundle of them.
fn bundle(random: &mut Random) -> (Vec<Corners>, TrianglePacket) {
    let count = 1 + random.bits() as usize % LANES;
    let mut point = || Point3::from(Vector3::from_fn(|_, _| 3.0 * random.symmetric()));
    let triangles: Vec<Corners> = (0..count).map(|_| [point(), point(), point()]).collect();
    let indices: Vec<u32> = (0..count as u32).map(|lane| 7 * lane + 3).collect();
    let bundle = TrianglePacket::new(&indices, |index| triangles[index as usize / 7], normal);
    (triangles, bundle)
}

/// A bit for each triangle of which something is true.
fn bits(triangles: &[Corners], is_true: impl Fn(&Corners) -> bool) -> u32 {
    let lanes = triangles.iter().enumerate();
    lanes
        .map(|(lane, corners)| u32::from(is_true(corners)) << lane)
        .sum()
}

#[test]
fn a_ray_starts_on_the_triangles_whose_planes_hold_its_start() {
    let mut random = Random(3);
    let (mut started, mut left_behind) = (0, 0);
    for _ in 0..4000 {
        let (triangles, bundle) = bundle(&mut random);
        let corners = random.of(&triangles);
        let upwards = normal(corners);
        let place = |height: f64, share: f64| {
            corners[0] + (corners[1] - corners[0]) * share + upwards * (height * SLACK)
        };
        let heights = [0.0, 0.5, -0.5, 2.0, -2.0];
        let origin = place(*random.of(&heights), random.symmetric());
        // Any way, or within the planes, or hardly out of them.
        let along = (corners[2] - corners[0]).normalize();
        let rise = *random.of(&[0.0, 0.5, -0.5, 2.0, -2.0]) * GRAZING;
        let direction = if random.bits().is_multiple_of(2) {
            random.direction()
        } else {
            (along + upwards * rise).normalize()
        };
        let ray = Ray { origin, direction };
        for front in [true, false] {
            let height = |corners: &Corners| normal(corners).dot(&(origin - corners[0]));
            let starts_on = |corners: &Corners| height(corners).abs() <= SLACK;
            // A start beside the plane that flies farther from it, on the side that is left.
            let is_behind = |corners: &Corners| {
                let approach = normal(corners).dot(&direction);
                let farther = height(corners) * approach > 0.0;
                let away = if front { approach } else { -approach };
                starts_on(corners) && farther && away > GRAZING
            };
            let on = bits(&triangles, starts_on);
            let found = bundle.started_on(&ray, front, SLACK, GRAZING);
            assert_eq!(found.0, on);
            // In the plane itself rounding tells the sides.
            let beside = bits(&triangles, |corners| height(corners).abs() > 0.1 * SLACK);
            let behind = bits(&triangles, is_behind);
            assert_eq!(found.1 & beside, behind & beside);
            started += on.count_ones();
            left_behind += (behind & beside).count_ones();
        }
    }
    assert!(started > 4000, "{started}");
    assert!(left_behind > 500, "{left_behind}");
}

#[test]
fn a_triangle_is_found_by_its_index_and_no_other() {
    let mut random = Random(4);
    for _ in 0..20 {
        let (triangles, bundle) = bundle(&mut random);
        for index in 0..30 {
            let lane = (0..triangles.len() as u32).find(|lane| 7 * lane + 3 == index);
            assert_eq!(bundle.lane_of(index), lane.map_or(0, |lane| 1 << lane));
        }
    }
}

#[test]
fn a_point_is_near_the_triangles_whose_boxes_hold_it() {
    let mut random = Random(6);
    for _ in 0..4000 {
        let (triangles, bundle) = bundle(&mut random);
        let [a, b, c] = random.of(&triangles);
        // At a side of a box, inside the slack or outside, or anywhere in the box.
        let (low, high) = (a.inf(b).inf(c), a.sup(b).sup(c));
        let mut point = low + (high - low).map(|side| side * random.share());
        let axis = random.bits() as usize % 3;
        let beyond = *random.of(&[0.5, 2.0]) * SLACK;
        match random.bits() % 3 {
            0 => point[axis] = low[axis] - beyond,
            1 => point[axis] = high[axis] + beyond,
            _ => (),
        }
        let holds = |[a, b, c]: &Corners| {
            (0..3).all(|axis| {
                let places = [a[axis], b[axis], c[axis]];
                places.iter().any(|place| *place <= point[axis] + SLACK)
                    && places.iter().any(|place| *place >= point[axis] - SLACK)
            })
        };
        assert_eq!(bundle.near(&point, SLACK), bits(&triangles, holds));
    }
}
