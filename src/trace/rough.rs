//! Rough surfaces: every impact meets a normal that is tilted by chance.

use crate::jet::{ShotSample, normal_pair};
use crate::triple::{Triple, along, cross, dot, unit};

/// The tangents of a normal are laid out from this direction, which no surface that anybody draws
/// is perpendicular to.
const REFERENCE: Triple = [0.361_327, 0.527_151, 0.769_413];

/// Squared length of the cross product with [`REFERENCE`] below which there are no tangents.
const LEAST_SQUARE: f64 = 1e-20;

/// Tangents of the angles by which a shot finds a surface tilted at the end of a flight of its
/// path, about two directions in the surface; the same in every pose.
#[inline]
pub(super) fn tilt(sample: &ShotSample, flight: u32, roughness: f64) -> [f64; 2] {
    let [a, b] = normal_pair(sample.tilts, flight);
    [roughness * a, roughness * b]
}

/// The normal that counts for an impact: the tilted one, or the true one where a shot could not
/// meet the tilted one from in front, or would then leave into the wall. `departure` is the velocity
/// after an impact with some normal.
#[inline]
pub(super) fn normal_of_impact(
    normal: Triple,
    tilt: [f64; 2],
    velocity: Triple,
    departure: impl Fn(Triple) -> Triple,
) -> Triple {
    let Some(tilted) = tilted(normal, tilt) else {
        return normal;
    };
    let is_met = dot(velocity, normal) < 0.0 && dot(velocity, tilted) < 0.0;
    if is_met && dot(departure(tilted), normal) > 0.0 {
        tilted
    } else {
        normal
    }
}

/// unit(n + a t1 + b t2) with two perpendicular tangents of the normal n.
fn tilted(normal: Triple, [a, b]: [f64; 2]) -> Option<Triple> {
    let [x, y, z] = REFERENCE;
    let first = cross(normal, [x, y, z]);
    if dot(first, first) < LEAST_SQUARE {
        return None;
    }
    let first = unit(first);
    let second = cross(normal, first);
    let tilted = along(along(normal, first, a), second, b);
    Some(unit(tilted))
}

#[cfg(test)]
mod tests;
