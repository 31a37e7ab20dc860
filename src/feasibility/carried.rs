//! Parts that move with the nozzle, such as a deflector pin on a lance, must not meet what stands in the scene.

use nalgebra::Vector3;

use super::{Infeasible, Obstacle, room_for_errors, tolerance};
use crate::jet::Pose;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::carried::CarriedWay;

/// Nearer than this, m, two walls touch.
const TOUCH: f64 = 1e-9;

/// Infeasible because a part that moves with the nozzle meets one that stands in the scene.
pub(super) fn carried_meets(scenario: &Scenario, settings: &Settings) -> Option<Infeasible> {
    if !scenario.scene.moves_with_nozzle() {
        return None;
    }
    let carried = scenario.scene.carried_reach();
    let room = room_for_errors(scenario, settings) + carried * tolerance::turn(scenario);
    let pose = Pose::new(&scenario.target.frame, settings);
    let as_set = as_set(scenario, settings, &pose);
    let (gap, surface) = scenario.scene.distance_to_carried(&as_set, room + TOUCH)?;
    let infeasible = |violation: f64, surface: u32| Infeasible {
        violation,
        obstacle: Obstacle::Carried(surface),
    };
    if gap <= TOUCH {
        return Some(infeasible(room + carried, surface));
    }
    let poses = tolerance::poses(scenario, settings);
    let within = CarriedWay {
        aims: tolerance::aims(scenario, settings, &pose),
        axes: poses.iter().map(axes_of).collect(),
    };
    let sag = tolerance::sag(scenario, settings.standoff + carried);
    let (_, surface) = scenario.scene.distance_to_carried(&within, sag + TOUCH)?;
    Some(infeasible(room - gap + TOUCH, surface))
}

/// How far the parts that move with the nozzle as it is set are from what stands in the scene, less what they may be turned
/// nearer within the tolerance, m; infinite where there are none.
pub(super) fn carried_gap(scenario: &Scenario, settings: &Settings) -> f64 {
    if !scenario.scene.moves_with_nozzle() {
        return f64::INFINITY;
    }
    let pose = Pose::new(&scenario.target.frame, settings);
    let as_set = as_set(scenario, settings, &pose);
    let nearest = scenario.scene.distance_to_carried(&as_set, f64::INFINITY);
    let turned = scenario.scene.carried_reach() * tolerance::turn(scenario);
    nearest.map_or(f64::INFINITY, |(gap, _)| gap - turned)
}

fn as_set(scenario: &Scenario, settings: &Settings, pose: &Pose) -> CarriedWay {
    CarriedWay {
        aims: tolerance::aims_as_set(scenario, settings, pose),
        axes: vec![axes_of(pose)],
    }
}

fn axes_of(pose: &Pose) -> [Vector3<f64>; 3] {
    [pose.up, pose.side, pose.direction]
}
