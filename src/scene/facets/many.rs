//! Many rays against triangles.
//!
//! What comes before and after the walk through the tree is done for a group of rays at a time, so
//! that processors work on several of them: walks branch as cannot be foreseen.

use arrayvec::ArrayVec;
use multiversion::multiversion;

use super::Facets;
use super::crossing::{Nearest, Sight};
use crate::precision::Real;
use crate::scene::ray::Ray;
use crate::scene::rays::{Hits, Rays};
use crate::scene::start::Start;
use crate::scene::wide_tree::Entered;

/// Rays of a group.
const GROUP: usize = 32;

/// A ray on its way.
struct Flight {
    index: usize,
    ray: Ray,
    sight: Sight,
}

/// Takes the first crossings that are nearer than what the rays have hit so far; `part` is the index
/// of the mesh in the scene. Normals are those on the fronts.
///
/// The same as [`Facets::first_crossing`] of each ray. (With AVX-512 it takes longer.)
#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+fma"))]
pub fn cross<R: Real>(facets: &Facets, part: u32, rays: &Rays<R>, hits: &mut Hits<R>) {
    for first in (0..rays.count).step_by(GROUP) {
        let mut flights = ArrayVec::<Flight, GROUP>::new();
        for index in first..rays.count.min(first + GROUP) {
            let ray = rays.at(index);
            let sight = facets.sight(&ray);
            flights.push(Flight { index, ray, sight });
        }
        let mut entered = ArrayVec::<Entered, GROUP>::new();
        for flight in &flights {
            let limit = hits.distance[flight.index].wide();
            entered.push(facets.tree.entered(&flight.sight.flat, limit));
        }
        let mut met = ArrayVec::<(&Flight, Nearest), GROUP>::new();
        for (flight, entered) in flights.iter().zip(&entered) {
            let leaving = rays.leaving.as_ref().map(|spots| spots.at(flight.index));
            let on_it = leaving.is_some_and(|spot| spot.part == part);
            let start = Start::of(leaving, on_it);
            let limit = hits.distance[flight.index].wide();
            if let Some(nearest) =
                facets.nearest(&flight.ray, &flight.sight, entered, &start, limit)
            {
                met.push((flight, nearest));
            }
        }
        for (flight, nearest) in &met {
            let limit = hits.distance[flight.index].wide();
            if let Some((crossing, normal)) = facets.refined(&flight.ray, nearest, limit) {
                hits.set(flight.index, part, &crossing, normal);
            }
        }
    }
}

/// Takes the first contacts of spheres in place of rays, likewise; normals are those from the places
/// of contact to the centres, turned to the front.
#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+fma"))]
pub fn touch<R: Real>(facets: &Facets, part: u32, rays: &Rays<R>, hits: &mut Hits<R>) {
    for index in 0..rays.count {
        let leaving = rays.leaving.as_ref().map(|spots| spots.at(index));
        let on_it = leaving.is_some_and(|spot| spot.part == part);
        let limit = hits.distance[index].wide();
        let radius = rays.radius[index].wide();
        let touch = facets.first_touch(&rays.at(index), radius, leaving, on_it, limit);
        if let Some((crossing, normal)) = touch {
            let normal = if crossing.front { normal } else { -normal };
            hits.set(index, part, &crossing, normal);
        }
    }
}
