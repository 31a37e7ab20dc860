//! The jet must not leave through the nozzle's own body.

use super::{Infeasible, Obstacle};
use crate::elementary::{cos, hypot, tan};
use crate::jet::Pose;
use crate::problem::equipment::Body;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::ray::Ray;

/// Infeasible because the jet leaves through the nozzle's own body.
pub(super) fn through_own_body(
    scenario: &Scenario,
    settings: &Settings,
    pose: &Pose,
) -> Option<Infeasible> {
    let overlap = overlap_with_jet(scenario, settings, pose)?;
    Some(Infeasible {
        violation: scenario.problem.nozzle.clearance + overlap,
        obstacle: Obstacle::Body,
    })
}

/// How far, m, a jet goes along inside a lance of its own beyond the round end at the exit.
///
/// A lance in a fixed direction may have its exit in its side, but a jet that leaves it farther back than
/// half its radius goes through it. A part that moves with the nozzle may turn the jet before.
fn overlap_with_jet(scenario: &Scenario, settings: &Settings, pose: &Pose) -> Option<f64> {
    let tolerance = &scenario.problem.tolerance;
    let errors = hypot(
        tolerance.incidence,
        tolerance.azimuth * cos(settings.incidence),
    );
    let spread = scenario.problem.jet.divergence + errors;
    let bodies = scenario.problem.nozzle.body.iter();
    let overlaps = bodies.filter_map(|body| match *body {
        Body::Capsule {
            length,
            radius,
            direction: Some(direction),
        } => {
            let angle = (pose.direction.angle(&direction) - spread).max(0.0);
            let back = (radius / tan(angle)).min(length);
            let is_through = angle < std::f64::consts::FRAC_PI_2 && back > SIDE_EXIT * radius;
            let is_turned = || is_turned_within(scenario, pose, back / cos(angle));
            (is_through && !is_turned()).then_some(back - SIDE_EXIT * radius)
        }
        _ => None,
    });
    overlaps.reduce(f64::max)
}

/// Whether the axis of the jet meets a part that moves with the nozzle before it has gone so far, m.
fn is_turned_within(scenario: &Scenario, pose: &Pose, distance: f64) -> bool {
    let scene = &scenario.scene;
    let axis = Ray {
        origin: pose.exit,
        direction: pose.direction,
    };
    let hit = scene.first_contact(&axis, 0.0, None, Some(&pose.nozzle_frame()));
    hit.is_some_and(|hit| hit.distance <= distance && scene.surface_moves_with_nozzle(hit.surface))
}

/// An exit in the side of a lance reaches back from its end by up to this share of its radius.
const SIDE_EXIT: f64 = 0.5;
