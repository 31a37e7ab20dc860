//! Rays at edges and vertices of meshes, good ones and bad ones.

use std::fmt::Write as _;

use nalgebra::{Point3, Rotation3, Vector3};
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::Choice;
use peenpose::scene::Walls;
use peenpose::scene::ray::Ray;
use peenpose::setup::Setup;

use crate::{PLATE, Random, edited, held, setup, setup_beside};

type Triangle = [Point3<f64>; 3];

/// Triangles in mm, as an exporter writes them: each with corners of its own.
fn obj(triangles: &[Triangle]) -> String {
    let mut text = String::from("g all\n");
    for corners in triangles {
        for corner in corners {
            writeln!(text, "v {:?} {:?} {:?}", corner.x, corner.y, corner.z).unwrap();
        }
        text.push_str("f -3 -2 -1\n");
    }
    text
}

/// A rectangle cut into cells at the given shares of its sides; front towards u x v.
fn grid(
    corner: Vector3<f64>,
    [u, v]: [Vector3<f64>; 2],
    [at_u, at_v]: [&[f64]; 2],
) -> Vec<Triangle> {
    let point = |i: usize, j: usize| Point3::from(corner + u * at_u[i] + v * at_v[j]);
    let cells = (1..at_u.len()).flat_map(|i| (1..at_v.len()).map(move |j| (i, j)));
    cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [
                point(i - 1, j - 1),
                point(i, j - 1),
                point(i, j),
                point(i - 1, j),
            ];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// A cube of 20 mm seen from inside, turned so that nothing lies along an axis. Each face is cut at
/// its own shares.
fn cube(cuts: [&[f64]; 6]) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for (face, cuts) in cuts.into_iter().enumerate() {
        let axis = |k: usize| Vector3::ith((face + k) % 3, 20.0);
        let low = Vector3::repeat(-10.0);
        let inwards = if face < 3 {
            grid(low, [axis(1), axis(2)], [cuts, cuts])
        } else {
            grid(low + axis(0), [axis(2), axis(1)], [cuts, cuts])
        };
        triangles.extend(inwards);
    }
    let turn = Rotation3::from_euler_angles(0.4, -0.9, 1.7);
    let turned = |corners: Triangle| corners.map(|corner| turn * corner);
    triangles.into_iter().map(turned).collect()
}

/// The plate with a mesh in its place; without settings that depend on its shape.
fn of_mesh(triangles: &[Triangle], aim: &str) -> Setup {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.obj"), obj(triangles)).unwrap();
    let text = edited(
        PLATE,
        &[
            (
                "plate: { box: { min: [-50, -50, -10], max: [50, 50, 0] } }",
                "plate: { mesh: part.obj }",
            ),
            ("plate.z_max, aim: [0, 0, 0], along: [1, 0, 0]", aim),
        ],
    );
    setup_beside(folder.path(), &text, Walls::Exact)
}

/// A setup for the cube; its target matters to nobody.
fn room(cuts: [&[f64]; 6]) -> Setup {
    let triangles = cube(cuts);
    let [a, b, c] = triangles[0];
    let aim = (a.coords + b.coords + c.coords) / 3.0;
    let normal = (b - a).cross(&(c - a)).normalize();
    let target = format!(
        "plate.all, aim: [{:?}, {:?}, {:?}], along: [0.3, 0.5, 0.7], facing: [{:?}, {:?}, {:?}]",
        aim.x, aim.y, aim.z, normal.x, normal.y, normal.z
    );
    of_mesh(&triangles, &target)
}

/// The ray test of Moller and Trumbore (1997), as it is usually written down.
fn moller_trumbore(ray: &Ray, [a, b, c]: &Triangle) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = ray.direction.cross(&ac);
    let determinant = ab.dot(&p);
    if determinant == 0.0 {
        return None;
    }
    let to_origin = ray.origin - a;
    let u = to_origin.dot(&p) / determinant;
    let q = to_origin.cross(&ab);
    let v = ray.direction.dot(&q) / determinant;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    let distance = ac.dot(&q) / determinant;
    (inside && distance > 0.0).then_some(distance)
}

/// Rays from inside the cube at points of the mesh; counts what leaks through for the naive test
/// and asserts that nothing does for ours.
fn naive_leaks(
    setup: &Setup,
    rays: usize,
    aim: impl Fn(&Triangle, &mut Random) -> Point3<f64>,
) -> usize {
    let triangles: Vec<Triangle> = setup.scene.surface_triangles(0).collect();
    let mut random = Random(21);
    let mut leaks = 0;
    for number in 0..rays {
        let origin = Point3::from(random.vector() * 5e-3);
        let at = aim(&triangles[number % triangles.len()], &mut random);
        let ray = Ray {
            origin,
            direction: (at - origin).normalize(),
        };
        let hit = setup.scene.first_hit(&ray, None);
        let hit = hit.unwrap_or_else(|| panic!("{ray:?} leaks at {at}"));
        // As near as the slope of the ray on the wall allows.
        let slope = -hit.normal.dot(&ray.direction);
        let off = (hit.distance - (at - origin).norm()).abs();
        assert!(off * slope < 1e-13, "{off} {slope}");
        let found = |triangle| moller_trumbore(&ray, triangle).is_some();
        leaks += usize::from(!triangles.iter().any(found));
    }
    leaks
}

fn on_an_edge([a, b, c]: &Triangle, random: &mut Random) -> Point3<f64> {
    let edges = [(a, b), (b, c), (c, a)];
    let (from, to) = edges[(3.0 * random.uniform()) as usize];
    from + (to - from) * random.uniform()
}

fn at_a_corner(corners: &Triangle, random: &mut Random) -> Point3<f64> {
    corners[(3.0 * random.uniform()) as usize]
}

const EVEN: &[f64] = &[0.0, 0.25, 0.5, 0.75, 1.0];

#[test]
fn rays_leak_through_edges_of_a_closed_mesh_in_the_naive_test_and_not_in_ours() {
    let room = room([EVEN; 6]);
    assert_eq!(room.scene.warnings(), &[] as &[String]);
    let leaks = naive_leaks(&room, 20_000, on_an_edge);
    assert!(leaks > 20, "{leaks}");
    let leaks = naive_leaks(&room, 20_000, at_a_corner);
    assert!(leaks > 0, "{leaks}");
}

/// Faces whose cuts do not meet: on every edge of the cube lie vertices of one side only, which
/// rounding has moved off the other side's edge.
#[test]
fn rays_do_not_leak_through_t_junctions() {
    const CUTS: [&[f64]; 6] = [
        &[0.0, 1.0],
        &[0.0, 0.3, 1.0],
        &[0.0, 0.1, 0.7, 1.0],
        &[0.0, 0.21, 0.43, 0.77, 1.0],
        &[0.0, 0.6, 1.0],
        &[0.0, 0.11, 0.22, 0.33, 0.44, 0.55, 1.0],
    ];
    let room = room(CUTS);
    assert!(!room.scene.warnings().is_empty());
    let leaks = naive_leaks(&room, 20_000, on_an_edge);
    assert!(leaks > 20, "{leaks}");
    naive_leaks(&room, 20_000, at_a_corner);
}

/// Strips that are far narrower than long, down to 200 times the distance within which points count
/// as one.
#[test]
fn slivers_neither_leak_nor_turn_shots_aside() {
    for width in [1e-4, 1e-7, 1e-10] {
        let cuts: &[f64] = &[0.0, 0.3, 0.3 + width, 0.7 - width, 0.7, 1.0];
        let room = room([cuts; 6]);
        naive_leaks(&room, 5_000, on_an_edge);
        naive_leaks(&room, 5_000, at_a_corner);
        // Rays at the slivers themselves: a normal can be wrong by no more than rounding of the
        // corners over the width.
        let triangles: Vec<Triangle> = room.scene.surface_triangles(0).collect();
        let size = 20e-3;
        let slack = 1e-14 + 8.0 * f64::EPSILON / width;
        let turn = Rotation3::from_euler_angles(0.4, -0.9, 1.7);
        let mut slivers = 0;
        for [a, b, c] in &triangles {
            let area = (b - a).cross(&(c - a)).norm();
            if area > 1.1 * width * size * size {
                continue;
            }
            slivers += 1;
            let centre = Point3::from((a.coords + b.coords + c.coords) / 3.0);
            let direction = centre.coords.normalize();
            let ray = Ray {
                origin: Point3::origin(),
                direction,
            };
            let hit = room.scene.first_hit(&ray, None).unwrap();
            let flat = turn.inverse() * hit.normal;
            let off = (flat.amax() - 1.0)
                .abs()
                .max((flat.norm_squared() - flat.amax().powi(2)).abs().sqrt());
            assert!(off < slack, "{width}: {off} over {slack}");
            assert!((hit.distance / centre.coords.norm() - 1.0).abs() < 1e-12);
        }
        assert!(slivers >= 6 * 2 * 2 * 5, "{slivers}");
    }
}

/// The plate as two triangles, turned so that rounding plays its part.
fn plate(copies: usize, flipped: usize) -> (Setup, Rotation3<f64>) {
    let turn = Rotation3::from_euler_angles(0.4, -0.9, 1.7);
    let flat = grid(
        Vector3::new(-50.0, -50.0, 0.0),
        [Vector3::x() * 100.0, Vector3::y() * 100.0],
        [&[0.0, 1.0], &[0.0, 1.0]],
    );
    let turned: Vec<Triangle> = flat
        .into_iter()
        .map(|corners| corners.map(|corner| turn * corner))
        .collect();
    let mut triangles = Vec::new();
    for _ in 0..copies {
        triangles.extend(&turned);
    }
    for _ in 0..flipped {
        triangles.extend(turned.iter().map(|[a, b, c]| [*a, *c, *b]));
    }
    let (normal, along) = (turn * Vector3::z(), turn * Vector3::x());
    let target = format!(
        "plate.all, aim: [0, 0, 0], along: [{:?}, {:?}, {:?}], facing: [{:?}, {:?}, {:?}]",
        along.x, along.y, along.z, normal.x, normal.y, normal.z
    );
    (of_mesh(&triangles, &target), turn)
}

/// Triangles that are there twice, the wrong way round, or both, count as one surface.
#[test]
fn duplicate_and_flipped_triangles_are_hit_once() {
    let reference = setup(&edited(PLATE, &[("divergence: 0 deg", "divergence: 20 deg")]));
    let choice = Choice {
        incidence: 0.9,
        ..held(&reference)
    };
    let shots = Samples::new(&reference.problem, Stream::Search, 2000).deviates;
    let expected = Tally::trace(&reference, &choice, 10.0, &shots);
    for (copies, flipped) in [(1, 0), (0, 1), (2, 0), (1, 1), (2, 2)] {
        let (plate, _) = plate(copies, flipped);
        let found = Tally::trace(&plate, &choice, 10.0, &shots);
        // One ray to the plate and one away from it.
        assert_eq!(found.rays, expected.rays, "{copies} {flipped}");
        assert_eq!(found.hits.len(), expected.hits.len());
        for (found, expected) in found.hits.iter().zip(expected.hits.iter()) {
            assert!((found.normal / expected.normal - 1.0).abs() < 1e-13);
            assert!((found.tangential / expected.tangential - 1.0).abs() < 1e-12);
        }
    }
}

/// The place of a hit is rounded to either side of its surface: about half of the rebounds start
/// behind it and hit it again, if only a positive distance is asked for.
#[test]
fn rebounds_hit_the_surface_that_they_leave_in_the_naive_test_and_not_in_ours() {
    let (plate, turn) = plate(1, 1);
    let triangles: Vec<Triangle> = plate.scene.surface_triangles(0).collect();
    let mut random = Random(22);
    let mut naive_hits = 0;
    for _ in 0..5000 {
        let at = turn * (random.vector().component_mul(&Vector3::new(0.04, 0.04, 0.0)));
        let origin = Point3::from(turn * (Vector3::z() * 0.02 + random.vector() * 0.01));
        let direction = (at - origin.coords).normalize();
        let ray = Ray { origin, direction };
        let hit = plate.scene.first_hit(&ray, None).unwrap();
        // Elastic, and almost along the surface.
        let normal = hit.normal;
        let mirrored = direction - normal * (2.0 * direction.dot(&normal));
        let grazing = (mirrored - normal * (mirrored.dot(&normal) * (1.0 - 1e-6))).normalize();
        for direction in [mirrored, grazing] {
            let away = Ray {
                origin: hit.point,
                direction,
            };
            assert_eq!(plate.scene.first_hit(&away, Some(hit.spot)), None);
            let naive = Ray {
                origin: ray.origin + ray.direction * hit.distance,
                direction,
            };
            let hits = |triangle| moller_trumbore(&naive, triangle).is_some();
            naive_hits += usize::from(triangles.iter().any(hits));
        }
    }
    assert!(naive_hits > 1000, "{naive_hits}");
}
