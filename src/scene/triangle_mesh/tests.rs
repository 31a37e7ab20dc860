//! What the tree finds is what a look at every triangle finds, to the last bit.

mod grazing;
mod needles;
mod starts;

use std::f64::consts::TAU;

use nalgebra::{Point3, Vector3};

use super::plane::{GRAZING, Plane, normal};
use super::{TriangleMesh, doubtful_weight};
use crate::problem::part::Ends;
use crate::scene::LIFT;
use crate::scene::departure::Departure;
use crate::scene::mesh::{Mesh, Triangle};
use crate::scene::profile::Profile;
use crate::scene::ray::{Crossing, HitId, Ray};
use crate::scene::tessellate;
use crate::scene::triangle::{Shear, Weights, box_holds, lies_on, passes_over};

/// The first crossing with the lowest index, found without a tree and one triangle at a time.
fn search(
    mesh: &Mesh,
    slack: f64,
    ray: &Ray,
    leaving: Option<HitId>,
    on_this_part: bool,
    limit: f64,
) -> Option<Crossing> {
    let start = Departure::of(leaving, on_this_part);
    let mut best: Option<(f64, Crossing)> = None;
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let piece = index as u32;
        if start.piece == Some(piece) {
            continue;
        }
        let Some((distance, front)) = crossing(mesh, triangle, slack, ray, &start) else {
            continue;
        };
        let behind = distance > 0.0 && !start.sees(front);
        let cost = distance + if behind { slack } else { 0.0 };
        if cost < best.map_or(limit, |(cost, _)| cost) {
            let surface = triangle.surface;
            let crossing = Crossing {
                distance,
                above: 0.0,
                front,
                piece,
                surface,
            };
            best = Some((cost, crossing));
        }
    }
    let (_, crossing) = best?;
    let corners = mesh.corners(&mesh.triangles[crossing.piece as usize]);
    let plane = Plane::new(normal(&corners), corners[0]);
    Some(Crossing {
        above: plane.above(crossing.distance, crossing.front, &ray.origin),
        ..crossing
    })
}

fn crossing(
    mesh: &Mesh,
    triangle: &Triangle,
    slack: f64,
    ray: &Ray,
    start: &Departure,
) -> Option<(f64, bool)> {
    let corners = mesh.corners(triangle);
    let plane = Plane::new(normal(&corners), corners[0]);
    let height = plane.height(&ray.origin);
    let approach = ray.direction.dot(&plane.normal);
    let distance = -height / approach;
    let starts_near = start.front.is_some() && height.abs() <= slack;
    if starts_near && lies_on(&ray.origin, &corners, slack) {
        return start.enters(approach).then_some((0.0, approach < 0.0));
    }
    let leads_away = approach.abs() > GRAZING && distance < 0.0;
    if starts_near && leads_away && !start.enters(approach) {
        return None;
    }
    let shear = Shear::new(ray);
    let weights = weights(&shear, &corners);
    let front = weights.front();
    let margin = if start.sees(front) { LIFT * slack } else { 0.0 };
    let is_near = start.front.is_some() && box_holds(&corners, &ray.origin, slack);
    let is_clear = is_near && distance.is_finite() && distance != 0.0;
    let t = if is_clear {
        distance
    } else {
        weights.distance()
    };
    let doubt = doubtful_weight(mesh, slack);
    if !weights.may_cross(doubt) {
        return None;
    }
    let crosses = weights.crosses(&shear, || corners, margin, doubt);
    let is_seen = margin > 0.0;
    if approach.abs() > GRAZING {
        let t = plane.distance(ray);
        let meets = crosses && t > 0.0;
        let at_edge = !is_seen && weights.is_near_edge();
        return (meets && !(at_edge && slides(mesh, triangle, slack, ray, t)))
            .then_some((t, front));
    }
    let runs_along = Departure::runs_along(approach);
    let may_pass_over = is_seen && !runs_along;
    let passes = (crosses && (is_seen || !runs_along))
        || (may_pass_over && passes_over(ray, &shear, &corners, front, margin));
    let t = plane.over_triangle(t, ray, &corners);
    (passes && t > 0.0).then(|| (plane.refined(t, ray, &corners), front))
}

/// Whether a ray comes to where it crosses a triangle along another one.
fn slides(mesh: &Mesh, triangle: &Triangle, slack: f64, ray: &Ray, t: f64) -> bool {
    let at = ray.origin + ray.direction * t;
    let mut others = mesh.triangles.iter();
    others.any(|other| {
        let corners = mesh.corners(other);
        let least = corners.map(|corner| (corner - at).dot(&ray.direction));
        !std::ptr::eq(other, triangle)
            && Departure::runs_along(ray.direction.dot(&normal(&corners)))
            && least.into_iter().fold(f64::INFINITY, f64::min) < -LIFT * slack
            && lies_on(&at, &corners, LIFT * slack)
    })
}

fn weights(shear: &Shear, corners: &[Point3<f64>; 3]) -> Weights {
    let [x, y, z] = shear.axes;
    let [a, b, c] = corners.map(|corner| {
        let p = corner.coords - shear.origin;
        [
            p[x] - shear.shear[0] * p[z],
            p[y] - shear.shear[1] * p[z],
            shear.shear[2] * p[z],
        ]
    });
    let u = c[0] * b[1] - c[1] * b[0];
    let v = a[0] * c[1] - a[1] * c[0];
    let w = b[0] * a[1] - b[1] * a[0];
    Weights {
        u,
        v,
        w,
        determinant: u + v + w,
        depth: u * a[2] + v * b[2] + w * c[2],
    }
}

/// SplitMix64.
pub(in crate::scene) struct Random(pub u64);

impl Random {
    pub(in crate::scene) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In -1 to 1.
    pub(in crate::scene) fn symmetric(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// In 0 to 1.
    pub(in crate::scene) fn share(&mut self) -> f64 {
        self.symmetric().abs()
    }

    pub(in crate::scene) fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.symmetric())
    }

    pub(in crate::scene) fn direction(&mut self) -> Vector3<f64> {
        self.vector().normalize()
    }

    pub(in crate::scene) fn of<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[self.bits() as usize % items.len()]
    }
}

pub(super) fn room(chord_angle: f64) -> Mesh {
    let ends = Ends {
        near_closed: true,
        far_closed: true,
    };
    tessellate::prism(&Profile::circle(1.0), 1.5, ends, chord_angle)
}

/// Triangles that share no corners, each of a surface of its own.
pub(super) fn apart(triangles: &[[[f64; 3]; 3]]) -> Mesh {
    let triangle = |index: u32| Triangle {
        corners: [0, 1, 2].map(|corner| 3 * index + corner),
        surface: index,
    };
    let corners = triangles.iter().flatten();
    Mesh {
        vertices: corners.map(|&corner| corner.into()).collect(),
        triangles: (0..triangles.len() as u32).map(triangle).collect(),
        ..Mesh::default()
    }
}

/// Triangles of all sizes anywhere, some without an area, some there twice.
pub(super) fn heap(count: usize, random: &mut Random) -> Mesh {
    let mut mesh = Mesh::default();
    for index in 0..count as u32 {
        let centre = random.vector();
        let size = 10_f64.powf(2.0 * random.symmetric() - 2.0);
        for _ in 0..3 {
            mesh.vertices
                .push(Point3::from(centre + random.vector() * size));
        }
        let corners = [3 * index, 3 * index + 1, 3 * index + 2];
        let [a, b, _] = corners;
        let corners = if index % 50 == 7 { [a, b, b] } else { corners };
        let copies = if index % 50 == 9 { 2 } else { 1 };
        let surface = index % 5;
        let triangle = Triangle { corners, surface };
        mesh.triangles.extend([triangle].repeat(copies));
    }
    mesh
}

/// Rays from anywhere, many of them over vertices and edges or along an axis.
pub(super) fn ray(mesh: &Mesh, size: f64, random: &mut Random) -> Ray {
    let [a, b, c] = mesh.corners(random.of(&mesh.triangles));
    let aim = match random.bits() % 4 {
        0 => a,
        1 => nalgebra::center(&a, &b),
        2 => Point3::from((a.coords + b.coords + c.coords) / 3.0),
        _ => Point3::from(random.vector() * size),
    };
    let away = [0.3, 1.0, 3.0, 1000.0][(random.bits() % 4) as usize];
    let mut direction = random.direction();
    if random.bits().is_multiple_of(3) {
        let axis = (random.bits() % 3) as usize;
        direction = Vector3::ith(axis, 1.0_f64.copysign(random.symmetric()));
    }
    Ray {
        origin: aim - direction * (away * size),
        direction,
    }
}

/// Follows rays over a few rebounds; returns how many casts hit.
fn compare(mesh: &Mesh, rays: usize, random: &mut Random) -> usize {
    let corners = mesh.vertices.iter().map(|vertex| vertex.coords.amax());
    let size = corners.fold(0.0, f64::max);
    let slack = 1e-12 * size;
    let facets = TriangleMesh::new(mesh.clone(), 0, slack);
    let mut hits = 0;
    for _ in 0..rays {
        let mut ray = ray(mesh, size, random);
        let mut leaving = None;
        for _ in 0..4 {
            let expected = search(mesh, slack, &ray, leaving, true, f64::INFINITY);
            let found = facets.first_crossing(&ray, leaving, true, f64::INFINITY);
            assert_eq!(
                found.map(|(crossing, _)| crossing),
                expected,
                "{ray:?} {leaving:?}"
            );
            let Some((crossing, front)) = found else {
                break;
            };
            hits += 1;
            let at_limit = facets.first_crossing(&ray, leaving, true, crossing.distance);
            let expected = search(mesh, slack, &ray, leaving, true, crossing.distance);
            assert_eq!(at_limit.map(|(crossing, _)| crossing), expected);
            let normal = if crossing.front { front } else { -front };
            ray = Ray {
                origin: ray.origin + ray.direction * crossing.distance + normal * (LIFT * slack),
                direction: match random.bits() % 3 {
                    0 => (normal + random.direction()).normalize(),
                    1 => (normal * 1e-6 + normal.cross(&random.direction())).normalize(),
                    _ => ray.direction - normal * (2.0 * ray.direction.dot(&normal)),
                },
            };
            leaving = Some(HitId {
                part: 0,
                piece: crossing.piece,
                front: crossing.front,
            });
        }
    }
    hits
}

#[test]
fn rays_in_a_closed_room_find_what_a_search_finds() {
    let mut random = Random(1);
    for (chord_angle, count) in [(0.8, 1500), (0.1, 500), (0.01, 100)] {
        let hits = compare(&room(chord_angle), count, &mut random);
        assert!(hits > count * 4 / 3, "{hits}");
    }
    let block = tessellate::block(Point3::new(-1.0, -0.5, -0.25), Point3::new(1.0, 0.5, 0.25));
    assert!(compare(&block, 3000, &mut random) > 3000);
}

/// Triangles from a tip, where each comes first, to a round rim: a cone, or a disc without height.
fn cone(count: u32, height: f64) -> Mesh {
    let rim = |index: u32| {
        let (y, x) = (TAU * f64::from(index % count) / f64::from(count)).sin_cos();
        [x, y, 0.0]
    };
    let triangles = (0..count).map(|index| [[0.0, 0.0, height], rim(index), rim(index + 1)]);
    apart(&triangles.collect::<Vec<_>>())
}

/// From both sides, and along some of the facets to the tip, where all others begin.
#[test]
fn rays_to_the_tip_of_a_cone_find_what_a_search_finds() {
    let mut random = Random(7);
    for height in [0.0, 1.0, 0.3, 1e-6] {
        let hits = compare(&cone(100, height), 1000, &mut random);
        assert!(hits > 500, "{height}: {hits}");
    }
}

#[test]
fn rays_through_a_heap_find_what_a_search_finds() {
    let mut random = Random(2);
    for count in [1, 2, 5, 9, 33, 400] {
        let hits = compare(&heap(count, &mut random), 1000, &mut random);
        assert!(hits > 200, "{count}: {hits}");
    }
}

/// The tree has single precision inside, which must show nowhere.
#[test]
fn size_and_place_of_a_mesh_do_not_matter() {
    let mut random = Random(3);
    for scale in [1e-9, 1e-3, 1e6] {
        for shift in [0.0, 100.0] {
            let mut mesh = room(0.1);
            for vertex in &mut mesh.vertices {
                *vertex = (*vertex + Vector3::repeat(shift)) * scale;
            }
            assert!(compare(&mesh, 300, &mut random) > 100);
        }
    }
}

/// Every box of such a mesh is the same, so that no plane divides the triangles.
#[test]
fn triangles_in_one_place_can_be_divided() {
    let mut mesh = room(2.0);
    let same = [mesh.triangles[0]].repeat(500);
    mesh.triangles.extend(same);
    let mut random = Random(4);
    assert!(compare(&mesh, 100, &mut random) > 100);
}

#[test]
fn slivers_are_wider_by_a_lift_on_every_side() {
    for size in [0.01, 1.0, 100.0] {
        let slack = 1e-9 * size;
        let (half, height, lift) = (0.5 * size, 1e-6 * size, LIFT * slack);
        let corners = [[-half, 0.0, 0.0], [half, 0.0, 0.0], [0.0, height, 0.0]];
        for turn in 0..3 {
            let place = |point: [f64; 3]| [0, 1, 2].map(|axis| point[(axis + turn) % 3]);
            let facets = TriangleMesh::new(apart(&[corners.map(place)]), 0, slack);
            let is_hit = |y: f64, side: f64| {
                let ray = Ray::of(place([0.0, y, side * size]), place([0.0, 0.0, -side]));
                let found = facets.first_crossing(&ray, None, false, f64::INFINITY);
                found.is_some()
            };
            // A ray from elsewhere sees fronts.
            for (side, seen) in [(1.0, true), (-1.0, false)] {
                let below = [-0.1, 0.9, 1.1].map(|lifts| is_hit(-lifts * lift, side));
                let above = [-0.1, 0.9, 1.1].map(|lifts| is_hit(height + lifts * lift, side));
                let expected = [true, seen, false];
                assert_eq!([below, above], [expected; 2], "{size}, {turn}, {side}");
            }
        }
    }
}

/// Beyond the tip of a needle the lines of its edges are still near each other.
#[test]
fn a_needle_ends_at_its_tip() {
    let needle = [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [2.5e-9, 0.0, 0.0]];
    // Out of the way, but in one box with the needle.
    let other = [[5.0, 5.0, -5.0], [5.0, 6.0, -5.0], [5.0, 5.0, 5.0]];
    for turn in 0..3 {
        let place = |point: [f64; 3]| [0, 1, 2].map(|axis| point[(axis + turn) % 3]);
        let triangles = [needle, other].map(|corners| corners.map(place));
        let facets = TriangleMesh::new(apart(&triangles), 0, 1e-10);
        // Steeply, and so flat that it is grazing.
        for direction in [[0.0, 0.02, -1.0], [0.0, 1.0, -5e-4], [1e-3, 1.0, -1e-4]] {
            let direction = Vector3::from(direction).normalize();
            let is_hit = |y: f64| {
                let aim = Point3::new(0.0, y, 0.0);
                let origin = (aim - direction * 0.01).into();
                let ray = Ray::of(place(origin), place(direction.into()));
                let found = facets.first_crossing(&ray, None, false, f64::INFINITY);
                found.is_some()
            };
            let found = [1e-4, 0.5, 0.9999, 1.0001].map(is_hit);
            assert_eq!(found, [true, true, true, false], "{direction} {turn}");
        }
    }
}

/// Rounding of what a needle weighs is no way through the air.
#[test]
fn a_ray_from_the_edge_of_a_needle_does_not_meet_it_farther_on() {
    let edge = -0.0625;
    let needle = [[edge + 2.5e-9; 3], [edge; 3], [edge, 6.5625, edge]];
    let facets = TriangleMesh::new(apart(&[needle]), 0, 1e-10);
    let direction = [0.40552048104105876, 0.8331602611069782, 0.37602808241989083];
    let ray = Ray::of([edge, 2.4375, edge], direction);
    let found = facets.first_crossing(&ray, None, false, f64::INFINITY);
    assert!(
        found.is_none_or(|(crossing, _)| crossing.distance < 1e-12),
        "{found:?}"
    );
}

#[test]
fn of_triangles_at_one_distance_the_first_is_hit() {
    // In one plane and over one place, side by side in the order of their indices or against it.
    for (count, step) in [(2, 0.0), (13, 0.0), (100, 0.01), (100, -0.01)] {
        let corners = [[-5.0, -5.0], [5.0, -5.0], [0.0, 10.0]];
        let of = |index: u32| {
            let shift = step * f64::from(index);
            corners.map(|[x, y]| [x + shift, y, 0.0])
        };
        let triangles: Vec<_> = (0..count).map(of).collect();
        let facets = TriangleMesh::new(apart(&triangles), 0, 1e-12);
        for side in [1.0, -1.0] {
            let ray = Ray::of([0.0, 0.5, side], [0.0, 0.0, -side]);
            let crossing = facets.first_crossing(&ray, None, false, f64::INFINITY);
            let (crossing, _) = crossing.expect("it is there");
            assert_eq!((crossing.piece, crossing.surface), (0, 0), "{count} {step}");
            let touch = facets.first_touch(&ray, 0.25, None, false, f64::INFINITY);
            let (touch, _) = touch.expect("it is there");
            assert_eq!((touch.distance, touch.piece), (0.75, 0), "{count} {step}");
        }
    }
}

/// Where a ray along a plane meets a triangle of it, rounding decides; what comes before it, it does
/// not.
#[test]
fn a_triangle_across_the_way_comes_before_the_far_corner_of_one_along_it() {
    let edge = -0.0624999975;
    let across = [
        [-0.6875, -5.25, 2.5625],
        [5.4375, 5.4375, edge],
        [edge, -0.0625, edge],
    ];
    let along = [[5.4375; 3], [edge; 3], [2.0, 0.5625, -6.4375]];
    let direction = [
        0.29566326498669354,
        0.08315529327750756,
        -0.9516661341759198,
    ];
    let ray = Ray::of([0.0; 3], direction);
    let first = |triangles: &[[[f64; 3]; 3]]| {
        let facets = TriangleMesh::new(apart(triangles), 0, 1e-11);
        let found = facets.first_crossing(&ray, None, false, f64::INFINITY);
        let (crossing, _) = found.expect("they are in the way");
        (crossing.surface, crossing.distance)
    };
    let (_, alone) = first(&[across]);
    assert!((alone - 0.0582).abs() < 1e-4, "{alone}");
    assert_eq!(first(&[across, along]), (0, alone));
    assert_eq!(first(&[along, across]), (1, alone));
}

#[test]
fn an_empty_mesh_is_never_hit() {
    let facets = TriangleMesh::new(Mesh::default(), 0, 0.0);
    let ray = Ray {
        origin: Point3::origin(),
        direction: Vector3::x(),
    };
    let found = facets.first_crossing(&ray, None, false, f64::INFINITY);
    assert!(found.is_none());
}

#[test]
fn a_ray_that_is_not_a_number_hits_nothing() {
    let facets = TriangleMesh::new(room(0.01), 0, 1e-12);
    for [origin, direction] in [[f64::NAN, 1.0], [0.0, f64::NAN], [f64::NAN, f64::NAN]] {
        let ray = Ray {
            origin: Point3::new(origin, origin, origin),
            direction: Vector3::new(direction, 0.0 * direction, 0.0 * direction),
        };
        assert!(
            facets
                .first_crossing(&ray, None, false, f64::INFINITY)
                .is_none()
        );
        assert!(
            facets
                .first_touch(&ray, 0.1, None, false, f64::INFINITY)
                .is_none()
        );
    }
}
