//! The problem in a record.

use super::super::QuestionRecord;
use super::place::{Outcome, Place, is_close};
use crate::impact::Sphere;
use crate::problem::setting::Setting;

pub(super) fn check(at: &Place, it: &QuestionRecord) -> Outcome {
    for (key, value) in [
        ("shot_radius_m", it.shot_radius_m),
        ("shot_density_kg_m3", it.shot_density_kg_m3),
        ("shot_mass_kg", it.shot_mass_kg),
        ("goals.normal_impulse_N_s", it.goals.normal_impulse),
    ] {
        at.of(key).at_least(value, f64::MIN_POSITIVE)?;
    }
    for (key, value) in [
        ("exit_diameter_m", it.exit_diameter_m),
        ("size_spread", it.size_spread),
        ("divergence_deg", it.divergence_deg),
        ("speed_spread", it.speed_spread),
        ("least_energy", it.least_energy),
        ("accuracy", it.accuracy),
        (
            "goals.normal_impulse_tolerance",
            it.goals.normal_impulse_tolerance,
        ),
        (
            "goals.tangential_impulse_N_s",
            it.goals.tangential_impulse.unwrap_or(0.0),
        ),
        ("goals.rebound_N_s", it.goals.rebound.unwrap_or(0.0)),
        ("tolerance.restitution", it.tolerance.restitution),
    ] {
        at.of(key).at_least(value, 0.0)?;
    }
    for setting in Setting::ALL {
        let half_width = it.tolerance.half_width(setting);
        at.of("tolerance")
            .of(setting.name())
            .at_least(half_width, 0.0)?;
    }
    let ball = Sphere {
        radius: it.shot_radius_m,
        density: it.shot_density_kg_m3,
    };
    let ratio = it.shot_mass_kg / ball.mass();
    at.of("shot_mass_kg").holds(
        is_close(ratio, 1.0),
        "is not the mass of a ball of that radius and density",
    )?;
    for (index, range) in it.ranges.iter().enumerate() {
        let at = at.of("ranges").item(index);
        at.holds(range.min <= range.max, "is upside down")?;
    }
    let rises = |pair: &[super::super::CalibrationRecord]| {
        pair[0].pressure < pair[1].pressure && pair[0].speed_m_s <= pair[1].speed_m_s
    };
    at.of("calibration")
        .holds(it.calibration.windows(2).all(rises), "does not rise")
}
