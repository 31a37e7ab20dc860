//! How much smaller a nozzle would have to be to fit where it does not.

use crate::jet::Pose;
use crate::problem::equipment::{Body, Nozzle};
use crate::scenario::Scenario;

/// The least radius, m, of the pieces of the body that are too near to the part, once each is made
/// small enough; `None` where none is.
pub(super) fn radius_left(scenario: &Scenario, pose: &Pose) -> Option<f64> {
    let Nozzle { body, clearance } = &scenario.problem.nozzle;
    let left = |piece: &Body| {
        let alone = Nozzle {
            body: vec![*piece],
            clearance: *clearance,
        };
        let scene = &scenario.scene;
        let (gap, _) = scene.clearance(&alone, &pose.exit, &pose.direction, *clearance)?;
        let (Body::Ball { radius } | Body::Capsule { radius, .. }) = piece;
        Some(radius + gap - clearance)
    };
    body.iter().filter_map(left).min_by(f64::total_cmp)
}
