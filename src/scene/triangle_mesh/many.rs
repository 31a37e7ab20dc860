//! Many rays against triangles.
//!
//! What comes before and after the walk through the tree is done for a group of rays at a time, so
//! that processors work on several of them: walks branch as cannot be foreseen.

use arrayvec::ArrayVec;
use multiversion::multiversion;

use super::TriangleMesh;
use super::crossing::{Nearest, PrecomputedRay};
use crate::scene::bvh8::Entered;
use crate::scene::departure::Departure;
use crate::scene::ray::{HitId, Ray};
use crate::scene::rays::{Hits, Rays};

/// Rays of a group.
const GROUP: usize = 32;

/// A ray on its way.
struct Flight {
    index: usize,
    ray: Ray,
    /// How far away it has met something else already, m.
    limit: f64,
    sight: PrecomputedRay,
}

/// Takes the first crossings that are nearer than what the rays have hit so far; `part` is the index
/// of the mesh in the scene. Normals are those on the fronts.
///
/// The same as [`TriangleMesh::first_crossing`] of each ray. (With AVX-512 it takes longer.)
#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+fma"))]
pub fn cross(facets: &TriangleMesh, part: u32, rays: &Rays, hits: &mut Hits) {
    let reached = facets.bounding_box.reached(rays, hits);
    for first in (0..rays.count).step_by(GROUP) {
        let mut flights = ArrayVec::<Flight, GROUP>::new();
        for index in (first..rays.count.min(first + GROUP)).filter(|&it| reached[it]) {
            let ray = rays.at(index);
            flights.push(Flight {
                index,
                ray,
                limit: hits.distance[index],
                sight: facets.sight(&ray),
            });
        }
        let mut entered = ArrayVec::<Entered, GROUP>::new();
        for flight in &flights {
            entered.push(facets.tree.entered(&flight.sight.flat, flight.limit));
        }
        let mut met = ArrayVec::<(&Flight, Nearest), GROUP>::new();
        for (flight, entered) in flights.iter().zip(&entered) {
            let (leaving, on_it) = leaving(rays, flight.index, part);
            let start = Departure::of(leaving, on_it).with_free_side(facets.fronts_are_free);
            let Flight { ray, sight, .. } = flight;
            if let Some(nearest) = facets.nearest(ray, sight, entered, &start, flight.limit) {
                met.push((flight, nearest));
            }
        }
        for (flight, nearest) in &met {
            let (crossing, normal) = facets.told(&flight.ray, nearest);
            hits.set(flight.index, part, &crossing, normal);
        }
    }
}

/// Takes the first contacts of spheres in place of rays, likewise.
#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+fma"))]
pub fn touch(facets: &TriangleMesh, part: u32, rays: &Rays, hits: &mut Hits) {
    let reached = facets.bounding_box.reached(rays, hits);
    for index in (0..rays.count).filter(|&it| reached[it]) {
        let (leaving, on_it) = leaving(rays, index, part);
        let limit = hits.distance[index];
        let radius = rays.radius[index];
        let contact = facets.first_contact(&rays.at(index), radius, leaving, on_it, limit);
        if let Some((crossing, normal)) = contact {
            hits.set(index, part, &crossing, normal);
        }
    }
}

/// The spot that a ray starts from, and whether it is on the part.
#[inline(always)]
fn leaving(rays: &Rays, index: usize, part: u32) -> (Option<HitId>, bool) {
    let leaving = rays.leaving.as_ref().map(|hit_ids| hit_ids.at(index));
    (leaving, leaving.is_some_and(|hit_id| hit_id.part == part))
}
