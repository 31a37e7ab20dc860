//! Rays at edges and vertices of meshes, good ones and bad ones.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::{Point3, Rotation3, Vector3};
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::scene::ray::Ray;

use crate::common::held::held;
use crate::stability::{PLATE, Random, edited, scenario, setup_beside};

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

/// So that nothing lies along an axis.
fn turn() -> Rotation3<f64> {
    Rotation3::from_euler_angles(0.4, -0.9, 1.7)
}

/// A cube of 20 mm seen from inside. Each face is cut at
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
    let turned = |corners: Triangle| corners.map(|corner| turn() * corner);
    triangles.into_iter().map(turned).collect()
}

/// The plate with a mesh in its place; without settings that depend on its shape.
fn of_mesh(triangles: &[Triangle], aim: &str) -> Scenario {
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
fn room(cuts: [&[f64]; 6]) -> Scenario {
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
/// and asserts that nothing does for ours, and that the wall is where it should be to within `slack`.
fn naive_leaks(
    scenario: &Scenario,
    rays: usize,
    slack: f64,
    aim: impl Fn(&Triangle, &mut Random) -> Point3<f64>,
) -> usize {
    let triangles: Vec<Triangle> = scenario.scene.surface_triangles(0).collect();
    let mut random = Random(21);
    let mut leaks = 0;
    for number in 0..rays {
        let origin = Point3::from(random.vector() * 5e-3);
        let at = aim(&triangles[number % triangles.len()], &mut random);
        let ray = Ray {
            origin,
            direction: (at - origin).normalize(),
        };
        let hit = scenario.scene.first_hit(&ray, None);
        let hit = hit.unwrap_or_else(|| panic!("{ray:?} leaks at {at}"));
        // As near as the slope of the ray on the wall allows.
        let slope = -hit.normal.dot(&ray.direction);
        let off = (hit.distance - (at - origin).norm()).abs();
        assert!(off * slope < slack, "{off} {slope}");
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

/// What the reader of the mesh noticed about edges that do not join two triangles.
fn open_edges(scenario: &Scenario) -> Option<&String> {
    let mut warnings = scenario.scene.warnings().iter();
    warnings.find(|warning| warning.contains("edge"))
}

/// Rounding in a part of this size, m.
const EXACT: f64 = 1e-13;

const EVEN: &[f64] = &[0.0, 0.25, 0.5, 0.75, 1.0];

#[test]
fn rays_leak_through_edges_of_a_closed_mesh_in_the_naive_test_and_not_in_ours() {
    let room = room([EVEN; 6]);
    assert!(open_edges(&room).is_none());
    let leaks = naive_leaks(&room, 20_000, EXACT, on_an_edge);
    assert!(leaks > 500, "{leaks}");
    let leaks = naive_leaks(&room, 20_000, EXACT, at_a_corner);
    assert!(leaks > 500, "{leaks}");
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
    assert!(open_edges(&room).is_some());
    let leaks = naive_leaks(&room, 20_000, EXACT, on_an_edge);
    assert!(leaks > 500, "{leaks}");
    naive_leaks(&room, 20_000, EXACT, at_a_corner);
}

/// Strips that are far narrower than long. The narrowest are 10 times as far apart as points that
/// count as one, and thinner than an atom: rays still do not leak.
#[test]
fn rays_do_not_leak_through_slivers() {
    for width in [1e-4, 1e-6, 1e-8, 1e-10, 1e-11] {
        let room = room([&with_strips(width); 6]);
        // Rounding over the width decides where on a sliver a ray meets it.
        let slack = EXACT + f64::EPSILON * 20e-3 / width;
        naive_leaks(&room, 2_000, slack, on_an_edge);
        naive_leaks(&room, 2_000, slack, at_a_corner);
        naive_leaks(&room, 2_000, slack, somewhere);
    }
}

fn with_strips(width: f64) -> [f64; 6] {
    [0.0, 0.3, 0.3 + width, 0.7 - width, 0.7, 1.0]
}

fn somewhere([a, b, c]: &Triangle, random: &mut Random) -> Point3<f64> {
    let (s, t) = (random.uniform(), random.uniform());
    let (s, t) = if s + t > 1.0 {
        (1.0 - s, 1.0 - t)
    } else {
        (s, t)
    };
    a + (b - a) * s + (c - a) * t
}

/// Rebounds off slivers down to the width that files in single precision can hold: the normal is off
/// by no more than rounding over the width, and no neighbour is hit from behind. (Below 1e-8 of the
/// part a sliver is thinner than rounding lets its hits lie off its plane, and one of some thousand
/// rebounds off it meets a neighbour at once.)
#[test]
fn slivers_do_not_turn_shots_aside() {
    let size = 20e-3;
    for width in [1e-4, 1e-6, 1e-7] {
        let room = room([&with_strips(width); 6]);
        let triangles: Vec<Triangle> = room.scene.surface_triangles(0).collect();
        let is_sliver =
            |[a, b, c]: &&Triangle| (b - a).cross(&(c - a)).norm() < 1.1 * width * size * size;
        let slivers: Vec<&Triangle> = triangles.iter().filter(is_sliver).collect();
        // In each face two strips across either way, less where they cross.
        assert_eq!(slivers.len(), 6 * (2 * 5 + 2 * 5 - 4) * 2);
        let mut random = Random(23);
        for number in 0..10_000 {
            // Away from the ends, which lie at the edges of the cube.
            let [a, b, c] = slivers[number % slivers.len()];
            let inner = 0.25 * (random.uniform() + 0.2);
            let at = a + (b - a) * (0.5 - inner) + (c - a) * inner;
            let origin = Point3::from(random.vector() * 5e-3);
            let direction = (at - origin).normalize();
            let hit = room
                .scene
                .first_hit(&Ray { origin, direction }, None)
                .unwrap();
            let flat = turn().inverse() * hit.normal;
            let aside = (flat - Vector3::ith(flat.iamax(), flat[flat.iamax()].signum())).norm();
            assert!(
                aside < 1e-14 + 8.0 * f64::EPSILON / width,
                "{width}: {aside}"
            );
            let away = Ray {
                origin: hit.point,
                direction: direction - hit.normal * (2.0 * direction.dot(&hit.normal)),
            };
            let next = room.scene.first_hit(&away, Some(hit.hit_id)).unwrap();
            assert!(next.distance > 1e-4, "{width}: {}", next.distance);
        }
    }
}

/// Directions with zeros of either sign, and with numbers so small that their inverse is infinite:
/// the same hits as with plain zeros, on exact walls, on facets and on boxes.
#[test]
fn the_sign_of_a_zero_makes_no_difference() {
    let shapes = [
        "plate: { box: { min: [-10, -10, -10], max: [10, 10, 10] } }",
        "plate: { bore: { diameter: 20 mm, length: 30 mm, ends: closed }, place: { at: [0, 0, -10] } }",
        "plate: { keyway: { bore: 20 mm, width: 6 mm, depth: 2.5 mm, length: 20 mm }, place: { at: [0, 0, -10] } }",
    ];
    let targets = [
        "plate.z_max, aim: [0, 0, 10]",
        "plate.far, aim: [0, 0, 20]",
        "plate.floor, aim: [0, 12.5, 0]",
    ];
    let tiny = f64::MIN_POSITIVE * f64::EPSILON;
    for (shape, target) in shapes.into_iter().zip(targets) {
        for walls in [Walls::Exact, Walls::TriangleMesh { chord_angle: 0.1 }] {
            let text = edited(
                PLATE,
                &[
                    (
                        "plate: { box: { min: [-50, -50, -10], max: [50, 50, 0] } }",
                        shape,
                    ),
                    ("plate.z_max, aim: [0, 0, 0], along: [1, 0, 0]", target),
                ],
            );
            let scene = setup_beside(Path::new("."), &text, walls).scene;
            for origin in [Point3::origin(), Point3::new(1e-3, 2e-3, 3e-3)] {
                for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
                    let distance = |zeros: [f64; 2]| {
                        let mut direction = Vector3::ith(axis, sign);
                        direction[(axis + 1) % 3] = zeros[0];
                        direction[(axis + 2) % 3] = zeros[1];
                        let hit = scene.first_hit(&Ray { origin, direction }, None);
                        hit.map(|hit| hit.distance)
                    };
                    let plain = distance([0.0, 0.0]);
                    let zeros = [0.0, -0.0, tiny, -tiny, 1e-300, -1e-300];
                    for pair in zeros.iter().flat_map(|&x| zeros.map(|y| [x, y])) {
                        assert_eq!(distance(pair), plain, "{shape} {walls:?} {axis} {pair:?}");
                    }
                }
            }
        }
    }
}

/// The plate as two triangles, turned so that rounding plays its part.
fn plate(copies: usize, flipped: usize) -> Scenario {
    let flat = grid(
        Vector3::new(-50.0, -50.0, 0.0),
        [Vector3::x() * 100.0, Vector3::y() * 100.0],
        [&[0.0, 1.0], &[0.0, 1.0]],
    );
    let turned: Vec<Triangle> = flat
        .into_iter()
        .map(|corners| corners.map(|corner| turn() * corner))
        .collect();
    let mut triangles = Vec::new();
    for _ in 0..copies {
        triangles.extend(&turned);
    }
    for _ in 0..flipped {
        triangles.extend(turned.iter().map(|[a, b, c]| [*a, *c, *b]));
    }
    let (normal, along) = (turn() * Vector3::z(), turn() * Vector3::x());
    let target = format!(
        "plate.all, aim: [0, 0, 0], along: [{:?}, {:?}, {:?}], facing: [{:?}, {:?}, {:?}]",
        along.x, along.y, along.z, normal.x, normal.y, normal.z
    );
    of_mesh(&triangles, &target)
}

/// Triangles that are there twice, the wrong way round, or both, count as one surface.
#[test]
fn duplicate_and_flipped_triangles_are_hit_once() {
    let reference = scenario(&edited(
        PLATE,
        &[("divergence: 0 deg", "divergence: 20 deg")],
    ));
    let settings = Settings {
        incidence: 0.9,
        ..held(&reference)
    };
    let shots = Samples::new(&reference.problem, Stream::Search, 2000).shots;
    let expected = Tally::trace(&reference, &settings, 10.0, &shots);
    for (copies, flipped) in [(1, 0), (0, 1), (2, 0), (1, 1), (2, 2)] {
        let plate = plate(copies, flipped);
        let found = Tally::trace(&plate, &settings, 10.0, &shots);
        // One ray to the plate and one away from it.
        assert_eq!(found.rays, expected.rays, "{copies} {flipped}");
        assert_eq!(found.hits.len(), expected.hits.len());
        for (found, expected) in found.hits.iter().zip(expected.hits.iter()) {
            assert!((found.normal / expected.normal - 1.0).abs() < 1e-13);
            assert!((found.tangential / expected.tangential - 1.0).abs() < 1e-12);
        }
    }
}

/// The place of a hit is rounded to either side of its surface: many rebounds start behind it and hit
/// it again, if only a positive distance is asked for.
#[test]
fn rebounds_hit_the_surface_that_they_leave_in_the_naive_test_and_not_in_ours() {
    let plate = plate(1, 1);
    let triangles: Vec<Triangle> = plate.scene.surface_triangles(0).collect();
    let mut random = Random(22);
    let mut naive_hits = 0;
    for _ in 0..5000 {
        let at = turn()
            * (random
                .vector()
                .component_mul(&Vector3::new(0.04, 0.04, 0.0)));
        let origin = Point3::from(turn() * (Vector3::z() * 0.02 + random.vector() * 0.01));
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
            assert_eq!(plate.scene.first_hit(&away, Some(hit.hit_id)), None);
            let naive = Ray {
                origin: ray.origin + ray.direction * hit.distance,
                direction,
            };
            let hits = |triangle| moller_trumbore(&naive, triangle).is_some();
            naive_hits += usize::from(triangles.iter().any(hits));
        }
    }
    assert!(naive_hits > 300, "{naive_hits}");
}
