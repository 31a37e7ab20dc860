//! Rays and spheres against heaps of triangles, compared with a look at every triangle.

use std::fmt::Write as _;

use nalgebra::Point3;
use peenpose::problem::part::{Part, Place, Shape};
use peenpose::scene::ray::{Hit, HitId, Ray};
use peenpose::scene::rays::{Hits, Rays};
use peenpose::scene::{Scene, Walls};

use super::bytes::Bytes;
use super::triangles::{Triangle, distance, least_distance, sure_crossing};

const MOST_TRIANGLES: usize = 40;
const MOST_RAYS: usize = 12;
/// A ray is followed over so many rebounds.
const MOST_REBOUNDS: usize = 4;
/// Everything lies within 16 of everything else.
const FAR: f64 = 100.0;
/// What rounding may do on that scale, thin triangles included.
const OFF: f64 = 1e-6;
/// Rounding of a height over a plane on that scale.
const ROUNDING: f64 = 1e-14;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let Some(scene) = heap(&mut bytes) else {
        return;
    };
    let triangles: Vec<Triangle> = scene.surface_triangles(0).collect();
    for _ in 0..MOST_RAYS {
        if bytes.is_empty() {
            break;
        }
        follow(&scene, &triangles, &mut bytes);
    }
}

/// A scene of any triangles; `None` where none of them is left when the file has been read.
fn heap(bytes: &mut Bytes<'_>) -> Option<Scene> {
    let vertices = 3 + bytes.count(2 * MOST_TRIANGLES);
    let mut text = String::new();
    for _ in 0..vertices {
        let [x, y, z] = [0; 3].map(|_| bytes.lattice());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for _ in 0..=bytes.count(MOST_TRIANGLES - 1) {
        let [a, b, c] = [0; 3].map(|_| 1 + usize::from(bytes.byte()) % vertices);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    let mut file = tempfile::Builder::new()
        .suffix(".obj")
        .tempfile()
        .expect("there is room for a file");
    std::io::Write::write_all(&mut file, text.as_bytes()).expect("there is room for triangles");
    let part = Part {
        name: "heap".into(),
        shape: Shape::Mesh {
            file: file.path().to_owned().into(),
            metres_per_unit: 1.0,
            regions: Vec::new(),
        },
        place: Place::default(),
        on_nozzle: false,
        cut: Vec::new(),
    };
    Scene::build(&[part], Walls::Exact).ok()
}

fn follow(scene: &Scene, triangles: &[Triangle], bytes: &mut Bytes<'_>) {
    let mut ray = Ray {
        origin: Point3::from(bytes.lattice_vector()),
        direction: bytes.direction(),
    };
    let radius = if bytes.yes() {
        bytes.within(1e-3, 2.0)
    } else {
        0.0
    };
    let mut leaving = None;
    for _ in 0..=MOST_REBOUNDS {
        let hit = scene.first_contact(&ray, radius, leaving, None);
        side_by_side(scene, &ray, radius, leaving, hit);
        if radius > 0.0 {
            sphere_is_right(triangles, &ray, radius, hit.as_ref());
        } else {
            ray_is_right(triangles, &ray, hit.as_ref());
        }
        let Some(hit) = hit else {
            return;
        };
        is_sound(scene, &hit, &ray);
        leaving = Some(hit.hit_id);
        let turned = ray.direction - hit.normal * (2.0 * ray.direction.dot(&hit.normal));
        ray = Ray {
            origin: hit.point + hit.normal * radius,
            direction: turned.normalize(),
        };
    }
}

fn is_sound(scene: &Scene, hit: &Hit, ray: &Ray) {
    assert!(hit.distance >= 0.0 && hit.distance <= FAR, "{hit:?}");
    assert!((hit.normal.norm() - 1.0).abs() < OFF, "{hit:?}");
    assert!(hit.point.iter().all(|value| value.is_finite()), "{hit:?}");
    assert!((hit.surface as usize) < scene.surfaces().len());
    assert!(
        ray.direction.dot(&hit.normal) <= OFF,
        "{ray:?} leaves {hit:?}"
    );
}

/// Many rays at once meet what one ray meets.
fn side_by_side(
    scene: &Scene,
    ray: &Ray,
    radius: f64,
    leaving: Option<HitId>,
    expected: Option<Hit>,
) {
    let mut rays = Rays::none();
    rays.count = 1;
    for axis in 0..3 {
        rays.origin[axis][0] = ray.origin[axis];
        rays.direction[axis][0] = ray.direction[axis];
    }
    rays.are_spheres = radius > 0.0;
    rays.radius[0] = radius;
    let mut hits = Hits::none();
    rays.leaving = leaving.map(|hit_id| {
        let mut hit_ids = hits.hit_ids.clone();
        hit_ids.set(0, hit_id);
        hit_ids
    });
    scene.first_hits(&rays, &mut hits);
    let found = hits.distance[0].is_finite().then(|| hits.distance[0]);
    assert_eq!(found, expected.map(|hit| hit.distance), "{ray:?}");
    if let Some(expected) = expected {
        assert_eq!(hits.hit_ids.at(0), expected.hit_id, "{ray:?}");
    }
}

/// The hit is on a triangle, and no crossing that is beyond doubt comes before it.
fn ray_is_right(triangles: &[Triangle], ray: &Ray, hit: Option<&Hit>) {
    let reach = hit.map_or(FAR, |hit| hit.distance);
    for triangle in triangles {
        let crossing = sure_crossing(triangle, &ray.origin, &ray.direction);
        // What the ray starts from is not hit again.
        if let Some(crossing) = crossing.filter(|crossing| *crossing > OFF) {
            assert!(
                crossing > reach - OFF,
                "{ray:?} passes {triangle:?} at {crossing}: {hit:?}"
            );
        }
    }
    if let Some(hit) = hit {
        let [a, b, c] = triangles[hit.hit_id.piece as usize];
        let off = distance(&hit.point, &[a, b, c]);
        // Where a ray runs within a plane but for rounding, where it crosses is as uncertain.
        let height = ROUNDING + height_rounding(&[a, b, c]);
        let along = height / ray.direction.dot(&hit.normal).abs();
        assert!(
            off < OFF + along,
            "{ray:?}: {hit:?} is {off} off {a} {b} {c}"
        );
    }
}

/// How far rounding tilts the plane of a sliver, from one end to the other.
fn height_rounding(triangle: &Triangle) -> f64 {
    let [a, b, c] = triangle;
    let lengths = [b - a, c - b, a - c].map(|edge| edge.norm());
    let doubled_area = (b - a).cross(&(c - a)).norm();
    f64::EPSILON * lengths.iter().product::<f64>() / doubled_area
}

/// The sphere touches a triangle at its hit, and enters none before.
fn sphere_is_right(triangles: &[Triangle], ray: &Ray, radius: f64, hit: Option<&Hit>) {
    let reach = hit.map_or(FAR, |hit| hit.distance);
    for triangle in triangles {
        let first = distance(&ray.origin, triangle);
        // What it touches or overlaps at its start is left without being hit again.
        if first > radius + OFF {
            let least = least_distance(triangle, &ray.origin, &ray.direction, reach);
            assert!(
                least > radius - OFF,
                "{ray:?}, {radius} enters {triangle:?}: {hit:?}"
            );
        }
    }
    if let Some(hit) = hit.filter(|hit| hit.distance > 0.0) {
        let centre = ray.origin + ray.direction * hit.distance;
        let apart = distance(&centre, &triangles[hit.hit_id.piece as usize]);
        assert!(
            (apart - radius).abs() < OFF,
            "{hit:?} at {apart}, not {radius}"
        );
    }
}
