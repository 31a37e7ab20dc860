//! Rays through parry's own casts: the reference for those of this crate, for points alone.
//!
//! parry knows nothing of the surface that a ray leaves: the ray starts a little above it, as all do. Rays that
//! meet an edge exactly may pass (4 to 5 of 100 that are aimed there).

use nalgebra::Vector3;
use parry3d_f64::query::{Ray as ParryRay, RayCast};
use parry3d_f64::shape::{FeatureId, TriMesh, TriMeshBuilderError};

use super::ray::{Crossing, Ray};
use super::rays::{Hits, Rays};
use super::triangle_mesh::TriangleMesh;

/// The triangles of a part as parry holds them.
#[derive(Clone)]
pub(super) struct ParryMesh(TriMesh);

impl ParryMesh {
    /// The same triangles in the same order.
    pub fn new(facets: &TriangleMesh) -> Result<Self, TriMeshBuilderError> {
        let corners = (0..facets.count() as u32).flat_map(|index| facets.corners(index));
        let corners = corners.map(|corner| corner.coords.into()).collect();
        let triangles = (0..facets.count() as u32).map(|index| [0, 1, 2].map(|k| 3 * index + k));
        TriMesh::new(corners, triangles.collect()).map(Self)
    }

    /// The first crossing nearer than `limit` and the unit normal on the front there.
    pub fn first_crossing(
        &self,
        facets: &TriangleMesh,
        ray: &Ray,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let cast = ParryRay::new(ray.origin.coords.into(), ray.direction.into());
        let hit = self
            .0
            .cast_local_ray_and_get_normal(&cast, limit.min(f64::MAX), false)?;
        let FeatureId::Face(face) = hit.feature else {
            return None;
        };
        let piece = face % facets.count() as u32;
        let normal = facets.normal(piece);
        let crossing = Crossing {
            distance: hit.time_of_impact,
            above: 0.0,
            front: normal.dot(&ray.direction) < 0.0,
            piece,
            surface: facets.surface(piece),
        };
        (crossing.distance < limit).then_some((crossing, normal))
    }

    /// The same for many rays; `part` is the index of the mesh in the scene.
    pub fn cross(&self, facets: &TriangleMesh, part: u32, rays: &Rays, hits: &mut Hits) {
        for index in 0..rays.count {
            let found = self.first_crossing(facets, &rays.at(index), hits.distance[index]);
            if let Some((crossing, normal)) = found {
                hits.set(index, part, &crossing, normal);
            }
        }
    }
}
