//! Which side of a surface is free: where the nozzle may be, and where shots come from.
//!
//! Sound solids and parametric parts know it. Where a mesh has holes, how far it wraps round the two sides
//! of the target tells, as long as that does not contradict how much each side is enclosed; what cannot be
//! decided is left to `facing`.

use nalgebra::{Point3, Vector3};

use super::Scene;
use super::nearest::Foot;
use super::part::{BuiltPart, FreeSide};
use super::patch::Patch;
use super::ray::{HitId, Ray};
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;

/// A side that an open mesh wraps round this far is nearly closed: it may be the inside of a solid with a
/// hole in it.
const NEARLY_CLOSED: f64 = 0.85;
/// Holes of a nearly closed mesh up to this share of its area are damage if its normals say the same.
const SMALL_HOLES: f64 = 0.02;
/// Openings up to this share of the area may be holes in a solid as well as the mouth of a pocket.
const LARGE_HOLES: f64 = 0.05;

/// Why nobody can tell which side of a target is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Undecided {
    /// How often its mesh wraps round a point in front of the target, and round one behind it.
    pub winding: [f64; 2],
    /// Whether neighbours disagree on which side is the front.
    pub disagrees: bool,
}

impl Undecided {
    /// The fault of a target on such a surface.
    pub fn fault(&self, surface: &str) -> Fault {
        let [before, behind] = self.winding;
        let why = if self.disagrees {
            "the normals of its triangles cannot be made to agree".into()
        } else {
            format!(
                "its mesh has holes, and wraps {before:.2} times round a point in front of the target and \
                 {behind:.2} times round one behind it"
            )
        };
        let message = format!("which side of `{surface}` is free cannot be told: {why}");
        Fault::at_key(FaultCode::FreeSideUnclear, "target", message)
            .expecting("`facing: [x, y, z]`, a direction from the target towards the nozzle")
    }
}

impl Scene {
    /// Whether free space is in front of the target at a place on it.
    pub(super) fn front_is_free(&self, foot: &Foot) -> Result<bool, Undecided> {
        let part = &self.parts[foot.part as usize];
        let Some(shell) = part.shell(foot.triangle) else {
            return Ok(part.free != FreeSide::Back);
        };
        if shell.is_solid {
            return Ok(true);
        }
        let height = 1e-6 * self.reach;
        let [before, behind] =
            [1.0, -1.0].map(|side| foot.point + foot.facet_normal * (side * height));
        let winding = part.winding_of_shell(foot.triangle, [&before, &behind]);
        let undecided = Undecided {
            winding,
            disagrees: !shell.agrees,
        };
        if !shell.agrees {
            return Err(undecided);
        }
        let holes = shell.hole_area / shell.area;
        let enclosed = self.enclosed_side(&foot.point, &foot.facet_normal);
        let [before, behind] = winding;
        // The normals of the mesh and its winding agree that it is a solid with a little missing.
        if behind >= NEARLY_CLOSED && before.abs() <= 1.0 - NEARLY_CLOSED && holes <= SMALL_HOLES {
            return Ok(true);
        }
        let is_nearly_closed = before.abs().max(behind.abs()) >= NEARLY_CLOSED;
        match enclosed {
            // A deep pocket, or a solid inside out with a hole in it.
            Some(true) if is_nearly_closed && holes <= LARGE_HOLES => Err(undecided),
            Some(true) => Ok(true),
            // A pocket whose triangles run the wrong way, or a solid with a large hole.
            Some(false) | None => Err(undecided),
        }
    }

    /// Whether there is material behind a place on a surface beyond doubt. Of a body that is inside out in
    /// its file nobody knows whether it is a cavity.
    pub(super) fn is_solid(&self, foot: &Foot) -> bool {
        let part = &self.parts[foot.part as usize];
        match part.shell(foot.triangle) {
            Some(shell) => shell.is_solid && !shell.was_inside_out,
            None => !part.is_skin(),
        }
    }

    /// Whether the side in front of a surface is the one from which more directions meet the scene;
    /// `None` where neither has clearly more.
    pub(super) fn enclosed_side(&self, point: &Point3<f64>, front: &Vector3<f64>) -> Option<bool> {
        const DIRECTIONS: usize = 256;
        let height = 1e-4 * self.reach;
        let met = |side: Vector3<f64>| {
            let origin = point + side * height;
            let hits = (0..DIRECTIONS).filter(|&index| {
                let direction = super::nearest::spiral_direction(index, DIRECTIONS);
                let direction = direction * direction.dot(&side).signum();
                self.first_hit(&Ray { origin, direction }, None).is_some()
            });
            hits.count()
        };
        let (before, behind) = (met(*front), met(-front));
        if before > behind + DIRECTIONS / 8 {
            Some(true)
        } else if behind > before + DIRECTIONS / 8 {
            Some(false)
        } else {
            None
        }
    }

    /// Settles which side of each part is free, once the target is known.
    pub fn settle(&mut self, target: &Patch) {
        let anchor = target.frame.aim + target.frame.normal * (1e-6 * self.reach);
        let is_targets =
            |part: &BuiltPart| !part.on_nozzle && part.facets.has_surface(target.surface);
        for part in &mut self.parts {
            if is_targets(part) {
                part.free = if target.front || target.in_material {
                    FreeSide::Front
                } else {
                    FreeSide::Back
                };
                part.facets.fronts_are_free = part.free == FreeSide::Front;
            } else if part.free == FreeSide::Round {
                // A hole if the target is inside, a pin if it is beside, and if it is beyond an end either.
                part.free = part.side_of_axis(&anchor);
            }
            part.settle_anchor(&anchor);
        }
    }

    /// Whether a spot is on the side of its part that is free: the back of a hollow.
    pub fn is_free_side(&self, hit_id: &HitId) -> bool {
        hit_id.front == (self.parts[hit_id.part as usize].free != FreeSide::Back)
    }

    /// Distance of a point from the surfaces of a part, m.
    pub fn distance_to_part(&self, part: usize, from: &Point3<f64>) -> f64 {
        let nearest = self.parts[part].facets.nearest_point(from, |_| true);
        nearest.map_or(0.0, |nearest| nearest.distance)
    }

    /// The part whose material a point is in, or comes from on its way to another one: the line of fire
    /// of a nozzle at that place.
    pub fn in_material(&self, from: &Point3<f64>, to: &Point3<f64>) -> Option<usize> {
        let way = to - from;
        let length = way.norm();
        let ray = Ray {
            origin: *from,
            direction: way / f64::max(length, f64::MIN_POSITIVE),
        };
        let limit = length * (1.0 + 1e-9);
        self.parts.iter().position(|part| {
            if part.on_nozzle {
                return false;
            }
            part.holds_on_its_way(from)
                || part.is_skin() && length > 0.0 && {
                    let crossing = part.first_crossing(&ray, None, false, limit);
                    let free = part.free;
                    crossing.is_some_and(|(crossing, _)| match free {
                        FreeSide::Front => !crossing.front,
                        FreeSide::Back => crossing.front,
                        FreeSide::Round | FreeSide::Either => false,
                    })
                }
        })
    }
}
