//! Where a nozzle may stand while its settings err within their tolerance.

use nalgebra::Vector3;

use super::{aim, half_way};
use crate::elementary::hypot;
use crate::jet::Pose;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::swept::Aims;

/// A grid of poses within the tolerance of the angles.
pub(super) fn poses(scenario: &Scenario, asked: &Settings) -> Vec<Pose> {
    let tolerance = &scenario.problem.tolerance;
    let grid = |error: f64| -> Vec<f64> {
        if error == 0.0 {
            return vec![0.0];
        }
        let step = 2.0 * error / (STEPS as f64);
        (0..=STEPS).map(|k| step * k as f64 - error).collect()
    };
    let azimuths = grid(tolerance.azimuth);
    let settings = grid(tolerance.incidence).into_iter();
    let settings = settings.flat_map(|incidence| {
        azimuths.iter().map(move |azimuth| Settings {
            incidence: asked.incidence + incidence,
            azimuth: asked.azimuth + azimuth,
            ..*asked
        })
    });
    settings
        .map(|set| Pose::new(&scenario.target.frame, &set))
        .collect()
}

/// Where the jet of a pose is aimed as it is set; on a stroke that goes straight on, all along it.
pub(super) fn aims_as_set(scenario: &Scenario, settings: &Settings, pose: &Pose) -> Aims {
    Aims {
        centre: aim(pose, settings),
        shifts: [
            half_way(scenario),
            Vector3::zeros(),
            Vector3::zeros(),
            Vector3::zeros(),
        ],
        standoff: [settings.standoff; 2],
    }
}

/// The same with all errors of aim and standoff.
pub(super) fn aims(scenario: &Scenario, settings: &Settings, pose: &Pose) -> Aims {
    let (frame, tolerance) = (&scenario.target.frame, &scenario.problem.tolerance);
    Aims {
        centre: aim(pose, settings),
        shifts: [
            frame.along * tolerance.aim_along,
            frame.across * tolerance.aim_across,
            frame.normal * tolerance.aim_above,
            half_way(scenario),
        ],
        standoff: [
            (settings.standoff - tolerance.standoff).max(0.0),
            settings.standoff + tolerance.standoff,
        ],
    }
}

/// Between two directions of the grid of [`poses`] what is so far from the aim point lies outside the
/// chord by no more than this, m.
pub(super) fn sag(scenario: &Scenario, reach: f64) -> f64 {
    let tolerance = &scenario.problem.tolerance;
    let half_steps = [tolerance.incidence, tolerance.azimuth].map(|it| it / STEPS as f64);
    reach * half_steps.iter().map(|it| it * it / 2.0).sum::<f64>()
}

/// Steps of the grid of directions, each way.
const STEPS: usize = 4;

/// By how much the jet may be turned from where it is set, rad.
pub(super) fn turn(scenario: &Scenario) -> f64 {
    let tolerance = &scenario.problem.tolerance;
    hypot(tolerance.incidence, tolerance.azimuth)
}
