//! Rays and the parts that move with the nozzle.

use arrayvec::ArrayVec;
use multiversion::multiversion;

use super::lanes::{LANES, components, padded, put};
use super::nozzle_frame::NozzleFrames;
use super::part::BuiltPart;
use super::rays::{HitIds, Hits, Rays};

/// The part of no ray.
const NO_PART: u32 = u32::MAX;

/// Takes the first crossings with a part that moves with the nozzle, where they are nearer than
/// what the rays have hit so far.
///
/// A function of its own, so that scenes without such parts are traced as fast as ever.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+fma",
    "x86_64+avx+avx2+bmi1+bmi2+fma"
))]
pub(super) fn cross(
    part: &BuiltPart,
    index: u32,
    rays: &Rays,
    nozzle_frames: &NozzleFrames,
    hits: &mut Hits,
) {
    let mut there = rays_there(rays, nozzle_frames);
    // Most shots have left the nozzle behind.
    let reached = part.reached(&there, hits);
    let near: ArrayVec<usize, LANES> = (0..rays.count).filter(|&i| reached[i]).collect();
    if near.is_empty() {
        return;
    }
    there.keep(&near);
    let mut met = Hits {
        hit_ids: HitIds {
            part: [NO_PART; LANES],
            ..HitIds::none()
        },
        ..Hits::none()
    };
    for (k, &i) in near.iter().enumerate() {
        met.distance[k] = hits.distance[i];
    }
    part.cross(index, &there, &mut met);
    let each = near.iter().enumerate();
    for (k, &i) in each.filter(|&(k, _)| met.hit_ids.part[k] == index) {
        let normal = nozzle_frames.at(i).vector_back(components(&met.normal, k));
        hits.distance[i] = met.distance[k];
        hits.above[i] = met.above[k];
        hits.surface[i] = met.surface[k];
        hits.hit_ids.set(i, met.hit_ids.at(k));
        put(&mut hits.normal, i, normal);
    }
}

/// Rays of the scene, each as it is in the frame of its own nozzle.
#[inline(always)]
fn rays_there(rays: &Rays, nozzle_frames: &NozzleFrames) -> Rays {
    let mut there = Rays {
        count: rays.count,
        are_spheres: rays.are_spheres,
        radius: rays.radius,
        leaving: rays.leaving.clone(),
        ..Rays::none()
    };
    for i in 0..padded(rays.count) {
        let nozzle_frame = nozzle_frames.at(i);
        let origin = nozzle_frame.point_there(components(&rays.origin, i));
        let direction = nozzle_frame.vector_there(components(&rays.direction, i));
        put(&mut there.origin, i, origin);
        put(&mut there.direction, i, direction);
    }
    there
}
