//! Rays that start on a facet.

use nalgebra::{Point3, Vector3};

use super::apart;
use crate::scene::lanes::put;
use crate::scene::ray::{HitId, Ray};
use crate::scene::rays::{HitIds, Hits, Rays};
use crate::scene::triangle_mesh::{TriangleMesh, cross};

const SLACK: f64 = 1e-9;

/// Two triangles, one above the other, which both face up.
fn storeys() -> TriangleMesh {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]];
    let storey = |z: f64| corners.map(|[x, y]| [x, y, z]);
    let mesh = apart(&[storey(0.0), storey(-0.5)]);
    TriangleMesh::new(mesh, 0, SLACK)
}

/// Though rounding has put it on the other side, or turned it into the facet.
#[test]
fn a_ray_does_not_meet_the_facet_that_it_leaves() {
    let facets = storeys();
    for height in [-0.5, -1e-3, 0.0, 1e-3, 0.5] {
        for sinks in [1e-12, 1e-6, 0.1, 0.6, 1.0] {
            let ray = Ray {
                origin: Point3::new(0.1, -0.2, height * SLACK),
                direction: Vector3::new(0.0, f64::sqrt(1.0 - sinks * sinks), -sinks),
            };
            let meet = |piece: u32| {
                let leaving = HitId {
                    part: 0,
                    piece,
                    front: true,
                };
                let found = facets.first_crossing(&ray, Some(leaving), true, f64::INFINITY);
                found.map(|(crossing, _)| (crossing.piece, crossing.distance))
            };
            // What has come from elsewhere hits it at once.
            assert_eq!(meet(1), Some((0, 0.0)), "{height} {sinks}");
            // It goes on to what is below, if it does not get past that.
            let gets_past = sinks < 0.5;
            let found = meet(0);
            assert_eq!(found.is_none(), gets_past, "{height} {sinks}");
            if let Some((piece, distance)) = found {
                assert_eq!(piece, 1);
                assert!((distance - 0.5 / sinks).abs() < 1e-8, "{height} {sinks}");
            }
        }
    }
}

#[test]
fn many_rays_start_as_one_does() {
    const COUNT: usize = 40;
    let facets = storeys();
    // From either facet, or from that of another part.
    for (part, piece) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let front = true;
        let leaving = HitId { part, piece, front };
        let mut rays = Rays::none();
        let mut hit_ids = HitIds::none();
        rays.count = COUNT;
        for index in 0..COUNT {
            let height = (index as f64 + 0.5) / 20.0 - 1.0;
            put(&mut rays.origin, index, [0.1, -0.2, height * SLACK]);
            put(&mut rays.direction, index, [0.0, 0.6, -0.8]);
            hit_ids.set(index, leaving);
        }
        rays.leaving = Some(hit_ids);
        let mut hits = Hits::none();
        cross(&facets, 0, &rays, &mut hits);
        let met = if (part, piece) == (0, 0) { 1 } else { 0 };
        for index in 0..COUNT {
            let one =
                facets.first_crossing(&rays.at(index), Some(leaving), part == 0, f64::INFINITY);
            let (crossing, _) = one.expect("one of them is in the way");
            assert_eq!(hits.distance[index], crossing.distance, "{leaving:?}");
            assert_eq!(hits.hit_ids.at(index).piece, crossing.piece, "{leaving:?}");
            assert_eq!(crossing.piece, met, "{leaving:?}");
        }
    }
}
