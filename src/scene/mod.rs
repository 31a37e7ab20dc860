//! What is there: parts, surfaces, the target patch; rays against them and distances to them.
//!
//! Prismatic parts are traced against their exact walls, other parts against their triangles.
//! Surfaces are two-sided. This module is the only one that knows parry.

mod build;
mod bvh8;
pub(crate) mod carried;
mod clearance;
mod convex_body;
mod cut;
mod departure;
mod free_side;
mod geometry;
pub mod lanes;
pub mod mesh;
pub mod mesh_file;
mod moving;
mod nearest;
pub mod nozzle_frame;
mod parry_rays;
mod part;
pub mod patch;
mod primitive;
mod prism;
pub mod profile;
pub mod ray;
pub mod rays;
pub mod swept;
pub mod tessellate;
pub mod traverse;
mod triangle;
mod triangle_mesh;
mod triangle_packet;
mod winding;

use nalgebra::{Point3, Vector3};

use crate::printable;
use crate::problem::equipment::{Body, Nozzle};
use crate::problem::fault::{Fault, one_of};
use crate::problem::fault_code::FaultCode;
use crate::triple::{along, scaled, unit};
pub use geometry::MeshSource;
use lanes::{components, padded, put};
use nozzle_frame::NozzleFrame;
use part::BuiltPart;
use ray::{Hit, HitId, Ray};
use rays::{Hits, Rays};

/// Two points nearer than this share of the scene's size count as one.
const SLACK: f64 = 1e-12;

/// Hits are reported by this share of the slack above their surface, on the side that the ray
/// comes from: far more than rounding errors, so that rays which leave a hit start on that side of
/// the facets next to it, and far less than the slack. What starts there already stays where it is:
/// else a shot that bounces about in the tip of a spike would be lifted out through a wall.
const LIFT: f64 = 1.0 / 16.0;

/// The parts of a problem, ready for rays and distances.
#[derive(Clone)]
pub struct Scene {
    parts: Vec<BuiltPart>,
    surfaces: Vec<String>,
    warnings: Vec<String>,
    files: Vec<MeshSource>,
    size: f64,
    /// By shares of this it is felt what lies beside a surface, m.
    reach: f64,
}

/// How prismatic parts are traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Walls {
    /// As planes and cylinders.
    Exact,
    /// As triangles whose chords turn by at most this angle, rad.
    TriangleMesh {
        /// rad.
        chord_angle: f64,
    },
    /// As such triangles, at which parry casts the rays of points: the reference.
    Parry {
        /// rad.
        chord_angle: f64,
    },
}

impl Scene {
    /// Full names of all surfaces, `part.surface`; their positions are their indices.
    pub fn surfaces(&self) -> &[String] {
        &self.surfaces
    }

    /// Index of the surface with this full name.
    ///
    /// # Errors
    /// A fault (without a key) that names the nearest surface and lists all of them.
    pub fn surface_named(&self, name: &str) -> Result<u32, Box<Fault>> {
        // Names in mesh files may hold what cannot be shown.
        let name = &*printable::line(name);
        let found = self.surfaces.iter().position(|surface| surface == name);
        found.map(|index| index as u32).ok_or_else(|| {
            let known: Vec<&str> = self.surfaces.iter().map(String::as_str).collect();
            let message = format!("there is no surface `{name}`");
            let fault =
                Fault::at_key(FaultCode::UnknownSurface, "", message).expecting(one_of(&known));
            Box::new(fault.nearest(name, known))
        })
    }

    /// What was noticed while the mesh files were read.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The mesh files behind it, in the order of the parts.
    pub fn mesh_files(&self) -> &[MeshSource] {
        &self.files
    }

    /// How far walls may be from the surfaces that their meshes approximate, m; 0 where no file says so.
    pub fn deflection(&self) -> f64 {
        let told = self.files.iter().filter_map(|file| file.deflection);
        told.fold(0.0, f64::max)
    }

    /// Largest coordinate of any corner, m: the scale of rounding errors.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Whether no ray is cast at a mesh.
    pub fn has_exact_walls(&self) -> bool {
        self.parts.iter().all(BuiltPart::has_exact_walls)
    }

    /// Whether parry casts its rays.
    pub fn has_parry_rays(&self) -> bool {
        self.parts.iter().any(BuiltPart::has_parry_rays)
    }

    /// Number of triangles of all parts.
    pub fn triangles(&self) -> usize {
        self.parts.iter().map(|part| part.facets.count()).sum()
    }

    /// Whether parts of it move with the nozzle.
    pub fn moves_with_nozzle(&self) -> bool {
        self.parts.iter().any(|part| part.on_nozzle)
    }

    /// Whether a surface does.
    pub fn surface_moves_with_nozzle(&self, surface: u32) -> bool {
        let mut moving = self.parts.iter().filter(|part| part.on_nozzle);
        moving.any(|part| part.facets.has_surface(surface))
    }

    /// What a ray meets first in a scene without a nozzle. `leaving` is the spot that it starts
    /// from, if any: it is not hit again at distance 0.
    #[inline]
    pub fn first_hit(&self, ray: &Ray, leaving: Option<HitId>) -> Option<Hit> {
        self.first_contact(ray, 0.0, leaving, None)
    }

    /// What a shot of some radius touches first when its centre moves along a ray, in a scene
    /// without a nozzle; the distance is that of the centre, the place that of the contact.
    /// `leaving` is the spot that it touches at the start, if any.
    #[inline]
    pub fn first_touch(&self, ray: &Ray, radius: f64, leaving: Option<HitId>) -> Option<Hit> {
        self.first_contact(ray, radius, leaving, None)
    }

    /// What a shot meets first, of some radius, or a point where that is 0. Parts that move with
    /// the nozzle are where its stand takes them, and nowhere without one.
    #[inline]
    pub fn first_contact(
        &self,
        ray: &Ray,
        radius: f64,
        leaving: Option<HitId>,
        nozzle_frame: Option<&NozzleFrame>,
    ) -> Option<Hit> {
        let is_sphere = radius > 0.0;
        let lift = LIFT * SLACK * self.size;
        let mut nearest = f64::INFINITY;
        let mut hit = None;
        for (index, part) in (0..).zip(&self.parts) {
            let on_it = leaving.is_some_and(|hit_id| hit_id.part == index);
            let contact = |ray: &Ray| part.first_contact(ray, radius, leaving, on_it, nearest);
            let found = match (part.on_nozzle, nozzle_frame) {
                (false, _) => contact(ray),
                (true, Some(nozzle_frame)) => {
                    contact(&nozzle_frame.ray_there(ray)).map(|(crossing, normal)| {
                        (crossing, nozzle_frame.vector_back(normal.into()).into())
                    })
                }
                (true, None) => None,
            };
            let Some((crossing, front)) = found else {
                continue;
            };
            nearest = crossing.distance;
            let normal: Vector3<f64> = if crossing.front { front } else { -front };
            let (normal, above) = if is_sphere {
                (unit(normal.into()).into(), -radius)
            } else {
                (normal, (lift - crossing.above).max(0.0))
            };
            hit = Some(Hit {
                distance: crossing.distance,
                point: ray.origin + ray.direction * crossing.distance + normal * above,
                normal,
                surface: crossing.surface,
                hit_id: HitId {
                    part: index,
                    piece: crossing.piece,
                    front: crossing.front,
                },
            });
        }
        hit
    }

    /// What many rays meet first; the same as [`Self::first_contact`] for each of them.
    #[inline(always)]
    pub fn first_hits(&self, rays: &Rays, hits: &mut Hits) {
        let count = padded(rays.count);
        hits.distance[..count].fill(f64::INFINITY);
        hits.above[..count].fill(0.0);
        for (index, part) in (0..).zip(&self.parts) {
            if !part.on_nozzle {
                part.cross(index, rays, hits);
            } else if let Some(nozzle_frames) = &rays.nozzle_frames {
                moving::cross(part, index, rays, nozzle_frames, hits);
            }
        }
        let lift = LIFT * SLACK * self.size;
        if rays.are_spheres {
            place::<true>(rays, hits, lift);
        } else {
            place::<false>(rays, hits, lift);
        }
    }

    /// Distance between the nozzle's body and the nearest surface of the parts that stand in the
    /// scene, and that surface; negative when they overlap. `None` for a nozzle without a body, or
    /// when everything is farther than `limit`.
    pub fn clearance(
        &self,
        nozzle: &Nozzle,
        exit: &Point3<f64>,
        jet: &Vector3<f64>,
        limit: f64,
    ) -> Option<(f64, u32)> {
        let mut nearest: Option<(f64, u32)> = None;
        for body in &nozzle.body {
            let (end, radius) = match *body {
                Body::Ball { radius } => (*exit, radius),
                Body::Capsule {
                    length,
                    radius,
                    direction,
                } => (exit + direction.unwrap_or(-jet) * length, radius),
            };
            for part in self.parts.iter().filter(|part| !part.on_nozzle) {
                let bound = nearest.map_or(limit, |(gap, _)| gap) + radius;
                if let Some((distance, triangle)) =
                    part.facets.distance_to_segment(exit, &end, bound)
                {
                    nearest = Some((distance - radius, part.facets.surface(triangle)));
                }
            }
        }
        nearest
    }

    /// Corner points of all triangles of a surface, in the frame of the nozzle where it moves with
    /// that.
    pub fn surface_triangles(&self, surface: u32) -> impl Iterator<Item = [Point3<f64>; 3]> + '_ {
        self.parts.iter().flat_map(move |part| {
            let indices = 0..part.facets.count() as u32;
            let of_surface = indices.filter(move |&index| part.facets.surface(index) == surface);
            of_surface.map(|index| part.facets.corners(index))
        })
    }
}

/// Turns normals to the side that the rays come from, and finds the places of contact.
#[inline(always)]
fn place<const BALLS: bool>(rays: &Rays, hits: &mut Hits, lift: f64) {
    for i in 0..padded(rays.count) {
        let side = if hits.hit_ids.front[i] { 1.0 } else { -1.0 };
        let mut normal = scaled(components(&hits.normal, i), side);
        let missing = lift - hits.above[i];
        let mut above = if missing > 0.0 { missing } else { 0.0 };
        if BALLS {
            normal = unit(normal);
            above = -rays.radius[i];
        }
        let (origin, direction) = (components(&rays.origin, i), components(&rays.direction, i));
        let point = along(along(origin, direction, hits.distance[i]), normal, above);
        put(&mut hits.normal, i, normal);
        put(&mut hits.point, i, point);
    }
}

#[cfg(test)]
mod tests;
