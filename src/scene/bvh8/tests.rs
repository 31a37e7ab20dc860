use std::f64::consts::TAU;
use std::iter;

use nalgebra::{Point3, Rotation3, Vector3};

use super::flat::{FlatRay, Frame, entry, reciprocal};
use super::query_shape::QueryShape;
use super::sphere::Sphere;
use super::walk::{StackEntry, settle_last};
use super::{Bvh8, build};
use crate::scene::ray::Ray;
use crate::scene::triangle_mesh::tests::Random;

#[test]
fn rays_from_afar_enter_the_box_round_the_mesh() {
    let enters = |origin: [f64; 3], direction: [f64; 3]| {
        entry(&origin.into(), &direction.map(reciprocal).into(), 2.0)
    };
    assert_eq!(enters([-5.0, 0.0, 0.0], [1.0, 0.0, 0.0]), 3.0);
    assert_eq!(enters([0.0, 9.0, 1.0], [0.0, -1.0, 0.0]), 7.0);
    assert_eq!(enters([-5.0, 3.0, 0.0], [1.0, 0.0, 0.0]), f64::INFINITY);
    assert_eq!(enters([-5.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), f64::INFINITY);
    // 3-4-5: the first enters at (-2, 1), the second at (-0.5, 2).
    assert_eq!(enters([-5.0, 5.0, 0.0], [0.6, -0.8, 0.0]), 5.0);
    assert_eq!(enters([-5.0, 8.0, 0.0], [0.6, -0.8, 0.0]), 7.5);
    assert_eq!(enters([-5.0, 12.0, 0.0], [0.6, -0.8, 0.0]), f64::INFINITY);
    assert_eq!(enters([0.0, 0.0, 1.0], [0.6, -0.8, 0.0]), 0.0);
}

#[test]
fn the_nearest_stop_is_the_last() {
    let mut stops: Vec<StackEntry> = Vec::new();
    for entry in [3.0, 1.0, 2.0, 5.0, 4.0, 0.5] {
        stops.push(StackEntry::new(7 + entry as u32, entry));
        settle_last(&mut stops);
    }
    let entries: Vec<f32> = stops.iter().map(|stop| stop.entry()).collect();
    assert_eq!(entries, [5.0, 4.0, 3.0, 2.0, 1.0, 0.5]);
    assert!(
        stops
            .iter()
            .all(|stop| stop.child() == 7 + stop.entry() as u32)
    );
}

#[test]
fn reciprocals_stay_finite_and_keep_their_sign() {
    assert_eq!([4.0, -0.5].map(reciprocal), [0.25, -2.0]);
    assert_eq!([0.0, -0.0].map(reciprocal), [1e30, -1e30]);
    assert_eq!([1e-31, -1e-31].map(reciprocal), [1e30, -1e30]);
}

#[test]
fn a_mesh_of_any_size_reaches_from_minus_one_to_one() {
    let is_near = |found: [f64; 3], expected: [f64; 3]| {
        let off = Vector3::from(found) - Vector3::from(expected);
        off.amax() < 1e-6
    };
    for size in [1e-6, 0.5, 3e4] {
        let low = Point3::new(1.0, 2.0, 3.0) * size;
        let high = low + Vector3::new(4.0, 2.0, 1.0) * size;
        let frame = Frame::around(low, high, 0.01 * size);
        let corners = [low, high].map(|corner| frame.inside(&corner));
        assert!(is_near(corners[0].into(), [-1.0, -0.5, -0.25]), "{size}");
        assert!(is_near(corners[1].into(), [1.0, 0.5, 0.25]), "{size}");
        assert!((frame.slack - 0.005).abs() < 1e-9, "{size}");
        // A sphere on its way from the middle gets a radius farther to either side.
        let ray = Ray {
            origin: nalgebra::center(&low, &high),
            direction: Vector3::new(0.6, -0.8, 0.0),
        };
        let flat: FlatRay<Sphere> = frame.ray(&ray, 3.0 * size);
        let [forwards, back] = flat.origins.map(|origin| origin.map(f64::from));
        assert!(is_near(forwards, [1.5, -1.5, 1.5]), "{size}");
        assert!(is_near(back, [-1.5, 1.5, -1.5]), "{size}");
    }
}

/// A round wall of this many strips along z, as those that jets skim.
fn round_wall(strips: u32, length: f64) -> Vec<[Point3<f64>; 3]> {
    let at = |strip: u32, z: f64| {
        let angle = TAU * f64::from(strip) / f64::from(strips);
        Point3::new(angle.cos(), angle.sin(), z)
    };
    let strip = |strip: u32| {
        let [a, b] = [at(strip, 0.0), at(strip, length)];
        let [c, d] = [at(strip + 1, length), at(strip + 1, 0.0)];
        [[a, b, c], [a, c, d]]
    };
    (0..strips).flat_map(strip).collect()
}

fn tree(triangles: &[[Point3<f64>; 3]], slack: f64) -> (Bvh8, Vec<build::Leaf>) {
    Bvh8::new(triangles.len(), |index| triangles[index as usize], slack)
}

/// Where the walk of a ray, or of a sphere, stops within `limit`.
fn visits<'a, B: QueryShape>(
    tree: &'a Bvh8,
    flat: &'a FlatRay<B>,
    limit: f64,
) -> impl Iterator<Item = u32> + 'a {
    let mut walk = tree.walk(flat);
    walk.start(&tree.entered(flat, limit));
    iter::from_fn(move || walk.next().map(|(leaf, _)| leaf))
}

#[test]
fn rays_that_skim_a_curved_wall_visit_few_leaves() {
    const RAYS: u32 = 200;
    for strips in [1000, 30_000, 1_000_000] {
        let triangles = round_wall(strips, 3.0);
        let (tree, _) = tree(&triangles, 1e-12);
        let mut leaves = 0;
        for step in 0..RAYS {
            let (sine, cosine) = (0.7 + 0.01 * f64::from(step)).sin_cos();
            // From just inside the wall, at 1 deg to it and as much along it.
            let inwards = Vector3::new(-cosine, -sine, 0.0);
            let along = Vector3::new(-sine, cosine, 1.0);
            let ray = Ray {
                origin: Point3::new(cosine, sine, 1.0) + inwards * 1e-5,
                direction: (along + inwards * 0.0175).normalize(),
            };
            // The chord of 1 deg to the wall.
            let flat = tree.flat(&ray);
            leaves += visits(&tree, &flat, 0.06).count();
        }
        let mean = leaves as f64 / f64::from(RAYS);
        assert!(mean < 3.0, "{strips}: {mean}");
    }
}

/// Under each sphere are one in a hundred of all leaves.
#[test]
fn spheres_much_wider_than_facets_visit_few_leaves() {
    const SPHERES: u32 = 200;
    const RADIUS: f64 = 0.05;
    for (strips, most) in [(1000, 3.0), (30_000, 6.0), (1_000_000, 120.0)] {
        let triangles = round_wall(strips, 3.0);
        let (tree, _) = tree(&triangles, 1e-12);
        let (mut coming, mut leaving) = (0, 0);
        for step in 0..SPHERES {
            let (sine, cosine) = (0.7 + 0.01 * f64::from(step)).sin_cos();
            let outwards = Vector3::new(cosine, sine, 0.0);
            let along = Vector3::new(-sine, cosine, 1.0);
            let direction = (along + outwards).normalize();
            let touch = Point3::from(outwards * (1.0 - RADIUS)) + Vector3::z();
            let ray = Ray {
                origin: touch - direction * 0.3,
                direction,
            };
            let flat = tree.flat_sphere(&ray, RADIUS);
            coming += visits(&tree, &flat, 0.3).count();
            let ray = Ray {
                origin: touch,
                direction: (along - outwards).normalize(),
            };
            let flat = tree.flat_sphere(&ray, RADIUS);
            leaving += visits(&tree, &flat, 0.3).count();
        }
        for (count, way) in [(coming, "coming"), (leaving, "leaving")] {
            let mean = f64::from(count as u32) / f64::from(SPHERES);
            assert!(mean < most, "{strips}: {mean} when {way}");
        }
    }
}

/// Needles from a tip to a circle of radius 1 round the z axis.
fn fan(needles: u32, tip: [f64; 3]) -> Vec<[Point3<f64>; 3]> {
    let rim = |needle: u32| {
        let angle = TAU * f64::from(needle) / f64::from(needles);
        Point3::new(angle.cos(), angle.sin(), 0.0)
    };
    let needle = |needle: u32| [tip.into(), rim(needle), rim(needle + 1)];
    (0..needles).map(needle).collect()
}

/// A square of slivers that reach from side to side.
fn sheaf(slivers: u32) -> Vec<[Point3<f64>; 3]> {
    let at = |sliver: u32, y: f64| {
        let x = 2.0 * f64::from(sliver) / f64::from(slivers) - 1.0;
        Point3::new(x, y, 0.0)
    };
    let pair = |sliver: u32| {
        let [a, b] = [at(sliver, -1.0), at(sliver, 1.0)];
        let [c, d] = [at(sliver + 1, 1.0), at(sliver + 1, -1.0)];
        [[a, d, c], [a, c, b]]
    };
    (0..slivers).flat_map(pair).collect()
}

/// How many leaves rays and spheres visit on average that come to surfaces of needles anywhere, or leave them.
#[test]
fn needles_are_visited_few_at_a_time() {
    const SHOTS: u32 = 300;
    const LENGTH: f64 = 0.3;
    let shapes = [
        ("disc", fan(30_000, [0.0; 3])),
        ("disc with its tip aside", fan(30_000, [0.35, 0.1, 0.0])),
        ("flat cone", fan(30_000, [0.0, 0.0, 1e-3])),
        ("cone", fan(30_000, [0.0, 0.0, 0.7])),
        ("sheaf", sheaf(15_000)),
    ];
    let lean = Rotation3::from_euler_angles(0.5, 0.3, 0.8);
    let mut random = Random(11);
    for (name, shape) in shapes {
        let triangles: Vec<_> = shape
            .iter()
            .map(|it| it.map(|corner| lean * corner))
            .collect();
        let (tree, _) = tree(&triangles, 1e-12);
        // Anywhere on the needles, or near their tip.
        for (radius, share, most) in [
            (0.0, 1.0, 350.0),
            (0.005, 1.0, 5.0),
            (0.05, 1.0, 5.0),
            (0.05, 0.02, 150.0),
        ] {
            let (mut coming, mut leaving) = (0, 0);
            for _ in 0..SHOTS {
                let [a, b, c] = triangles[random.bits() as usize % triangles.len()];
                // Uniform over the triangle.
                let root = random.share().sqrt() * share;
                let point = a + (b - a) * root + (c - b) * (root * random.share());
                let normal = (b - a).cross(&(c - a)).normalize();
                let direction = (random.direction() * 0.9 - normal).normalize();
                let touch = point + normal * radius;
                let from = touch - direction * LENGTH;
                let back = direction - normal * (2.0 * direction.dot(&normal));
                let count = |origin: Point3<f64>, direction: Vector3<f64>, limit: f64| {
                    let ray = Ray { origin, direction };
                    if radius > 0.0 {
                        visits(&tree, &tree.flat_sphere(&ray, radius), limit).count()
                    } else {
                        visits(&tree, &tree.flat(&ray), limit).count()
                    }
                };
                coming += count(from, direction, LENGTH);
                leaving += count(touch, back, LENGTH);
            }
            let [coming, leaving] = [coming, leaving].map(|it| it as f64 / f64::from(SHOTS));
            for (count, way) in [(coming, "coming"), (leaving, "leaving")] {
                assert!(
                    count < most,
                    "{name}, {radius}, {share}: {count} when {way}"
                );
            }
        }
    }
}

/// Where a ray only touches the corner of a box, it is in it along one axis no sooner than out of it
/// along another: rounding must not turn them round.
#[test]
fn rays_that_touch_the_corner_of_a_box_far_away_enter_it() {
    const SIZE: f64 = 1e-3;
    let mut random = Random(9);
    // Seen from above, the first corner of each triangle is on the lower left of its box, and rays from
    // the upper left just touch it.
    let triangle = |at: Vector3<f64>| {
        [[0.0, 0.0, 0.0], [SIZE, 0.0, 0.0], [0.0, SIZE, SIZE]]
            .map(|offset| Point3::from(at + Vector3::from(offset)))
    };
    let far = Vector3::new(0.9, -0.9, 0.0);
    let ends = [-1.0, 1.0].map(Vector3::repeat).into_iter();
    let places = ends.chain((0..200).map(|_| far + random.vector() * 0.1));
    // As many in one place as fill a leaf.
    let triangles: Vec<_> = places.flat_map(|at| [triangle(at); 4]).collect();
    let (tree, leaves) = tree(&triangles, 1e-12);
    for _ in 0..200_000 {
        let index = random.bits() as usize % triangles.len();
        let aim = triangles[index][0];
        let direction = Vector3::new(1.0, -1.0 - 0.1 * random.symmetric(), 0.0).normalize();
        let ray = Ray {
            origin: aim - direction * (2.0 + random.share()),
            direction,
        };
        let flat = tree.flat(&ray);
        let mut met = visits(&tree, &flat, f64::INFINITY).map(|leaf| &leaves[leaf as usize]);
        assert!(met.any(|leaf| leaf.contains(&(index as u32))), "{ray:?}");
    }
}

/// However many boxes lie one behind the other.
#[test]
fn a_walk_gets_to_all_leaves_on_its_way() {
    let sheet = |index: u32| {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        corners.map(|[x, y]| Point3::new(x, y, f64::from(index)))
    };
    let triangles: Vec<_> = (0..1 << 20).map(sheet).collect();
    let (tree, leaves) = tree(&triangles, 1e-9);
    let ray = Ray::of([0.2, 0.2, -1.0], [0.0, 0.0, 1.0]);
    let flat = tree.flat(&ray);
    assert_eq!(visits(&tree, &flat, f64::INFINITY).count(), leaves.len());
}

#[test]
fn rays_and_spheres_visit_the_leaf_of_what_they_meet() {
    let mut random = Random(5);
    let lean = Rotation3::from_euler_angles(0.5, 0.3, 0.1);
    let turned = |triangle: [Point3<f64>; 3]| triangle.map(|corner| lean * (corner * 0.2));
    let finer = round_wall(5000, 1.0).into_iter().map(turned);
    let needles = [0.0, 0.01, 0.7].map(|height| fan(2000, [0.2, 0.0, height]));
    let needles = needles.into_iter().flatten().map(turned);
    let mut walls: Vec<_> = round_wall(500, 3.0).into_iter().chain(finer).collect();
    walls.extend(needles.chain(sheaf(1000).into_iter().map(turned)));
    for (scale, shift) in [(1.0, 0.0), (1e-6, 0.0), (1e3, 1e6)] {
        let placed = |point: Point3<f64>| point * scale + Vector3::repeat(shift);
        let triangles: Vec<_> = walls.iter().map(|corners| corners.map(placed)).collect();
        let slack = 1e-9 * (scale + shift);
        let (tree, leaves) = tree(&triangles, slack);
        let holds = |leaf: u32, index: usize| leaves[leaf as usize].contains(&(index as u32));
        for _ in 0..2000 {
            let index = random.bits() as usize % triangles.len();
            let [a, b, c] = triangles[index];
            let [along, up] = [b - a, c - a].map(|edge| edge * random.share());
            let point = a + match random.bits() % 4 {
                0 => Vector3::zeros(),
                1 => along,
                _ => along + (up - along) * random.share(),
            };
            let point = point + random.direction() * (0.9 * slack * random.share());
            // Any way, or almost along the triangle.
            let skims = (b - a) * random.symmetric() + (c - a) * random.symmetric();
            let off = 0.1_f64.powi((random.bits() % 8) as i32);
            let direction = (skims.normalize() + random.direction() * off).normalize();
            let way = scale * 0.1_f64.powi((random.bits() % 5) as i32) * 30.0 * random.share();
            let ray = |aim: Point3<f64>| Ray {
                origin: aim - direction * way,
                direction,
            };
            let flat = tree.flat(&ray(point));
            assert!(
                visits(&tree, &flat, way).any(|leaf| holds(leaf, index)),
                "{scale}: {index}"
            );

            // Of any size, to any side: above the triangle, or as far along an axis as it gets.
            let radius = scale * 0.1_f64.powi((random.bits() % 5) as i32) * 10.0;
            let towards = match random.bits() % 4 {
                0 => (b - a).cross(&(c - a)).normalize(),
                1 => Vector3::ith(random.bits() as usize % 3, 1.0),
                _ => random.direction(),
            };
            let side = random.symmetric().signum();
            let flat = tree.flat_sphere(&ray(point + towards * (side * radius)), radius);
            assert!(
                visits(&tree, &flat, way).any(|leaf| holds(leaf, index)),
                "{scale}: {index}"
            );
        }
    }
}
