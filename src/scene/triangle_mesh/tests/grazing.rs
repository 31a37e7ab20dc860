//! Rays that hardly rise over a facet, from beside it or from on it.

use nalgebra::{Point3, Unit};

use super::{Random, heap, normal, room, search};
use crate::scene::LIFT;
use crate::scene::mesh::Mesh;
use crate::scene::ray::{HitId, Ray};
use crate::scene::tessellate;
use crate::scene::triangle_mesh::TriangleMesh;

/// A ray that passes a triangle nearly within its plane, over a corner, an edge or its middle, or by
/// about a lift or a slack beside that.
fn skimming(mesh: &Mesh, triangle: usize, slack: f64, random: &mut Random) -> Option<Ray> {
    let corners = mesh.corners(&mesh.triangles[triangle]);
    let first = random.bits() as usize % 3;
    let [a, b, c] = [0, 1, 2].map(|corner| corners[(first + corner) % 3]);
    let upwards = Unit::try_new(normal(&corners), 0.0)?;
    let along = Unit::try_new(b - a, 0.0)?;
    let outwards = along.cross(&upwards);
    let on_edge = a + (b - a) * random.share();
    let inside = on_edge + (c - on_edge) * random.share();
    let aim = *random.of(&[a, on_edge, inside]);
    let little = [0.0, 0.5 * LIFT, 2.0 * LIFT, 0.5, 2.0, 20.0];
    let mut off = || {
        let side = random.symmetric().signum();
        side * random.of(&little) * slack
    };
    let aim = aim + outwards.scale(off()) + upwards.scale(off());
    let rises = [0.0, 1e-16, 3e-15, 1e-14, 1e-12, 1e-9, 1e-6, 5e-4, 2e-3];
    let side = random.symmetric().signum();
    let rise = side * random.of(&rises);
    let way = *random.of(&[b - a, a - b, inside - a, a - inside, c - on_edge]);
    let direction = (Unit::try_new(way, 0.0)?.into_inner() + upwards.scale(rise)).normalize();
    let back = random.of(&[0.0, 1e-9, 0.1, 1.0, 3.0]) * way.norm();
    let origin = aim - direction * back;
    Some(Ray { origin, direction })
}

#[test]
fn rays_that_skim_facets_find_what_a_search_finds() {
    let mut random = Random(7);
    let block = tessellate::block(Point3::new(-1.0, -0.5, -0.25), Point3::new(1.0, 0.5, 0.25));
    let slack = 1e-12;
    for mesh in [block, room(0.8), room(0.1), heap(40, &mut random)] {
        let facets = TriangleMesh::new(mesh.clone(), 0, slack);
        let mut hits = 0;
        for _ in 0..6_000 {
            let triangle = random.bits() as usize % mesh.triangles.len();
            let Some(ray) = skimming(&mesh, triangle, slack, &mut random) else {
                continue;
            };
            let left = (triangle + random.bits() as usize % 3) % mesh.triangles.len();
            let hit_id = HitId {
                part: 0,
                piece: left as u32,
                front: random.bits().is_multiple_of(2),
            };
            let leaving = *random.of(&[None, Some(hit_id)]);
            let on_this_part = random.bits().is_multiple_of(2);
            let expected = search(&mesh, slack, &ray, leaving, on_this_part, f64::INFINITY);
            let found = facets.first_crossing(&ray, leaving, on_this_part, f64::INFINITY);
            let found = found.map(|(crossing, _)| crossing);
            assert_eq!(found, expected, "{ray:?} {leaving:?} {on_this_part}");
            hits += usize::from(found.is_some());
        }
        assert!(hits > 1500, "{hits}");
    }
}
