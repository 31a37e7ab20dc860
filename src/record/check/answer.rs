//! One answer: its settings, its pose, what it receives, and whether it passes.

use super::super::{
    AnswerRecord, ContactRecord, ObjectiveRecord, PoseRecord, QuestionRecord, ReceiptRecord,
    Record, SettingsRecord, SpreadRecord, TargetRecord,
};
use super::place::{Outcome, Place, is_close};
use super::verdict;
use crate::problem::equipment::Calibration;
use crate::problem::given;

/// Rounding errors of unit vectors and of places.
const VECTOR_ROUNDING: f64 = 1e-6;

pub(super) fn check(at: &Place, it: &AnswerRecord, record: &Record) -> Outcome {
    contact(&at.of("contact_values"), &it.contact_values)?;
    settings(&at.of("settings"), &it.settings)?;
    pose(&at.of("pose"), &it.pose)?;
    pressure(&at.of("pressure_Pa"), it, &record.problem)?;
    clearance(at, it)?;
    let is_whole =
        it.objective.is_some() == it.target.is_some() && (it.objective.is_some() == (it.shots > 0));
    at.of("objective").holds(
        is_whole,
        "belongs to `target` and `shots`, but not all of them are there",
    )?;
    if let Some(objective) = &it.objective {
        self::objective(&at.of("objective"), objective)?;
    } else {
        let are_of_pose = it.verdicts.iter().all(verdict::is_of_pose);
        at.of("verdicts")
            .holds(are_of_pose, "are given without any shot")?;
    }
    if let Some(target) = &it.target {
        self::target(&at.of("target"), target, it.shots)?;
        let goals = &record.problem.goals;
        let most = goals.normal_impulse * (1.0 + goals.normal_impulse_tolerance);
        let limits = [Some(most), goals.tangential_impulse];
        verdict::goals(&at.of("verdicts"), it, target, limits)?;
    }
    for (name, receipt) in &it.surfaces {
        self::receipt(&at.of("surfaces").of(name), receipt)?;
    }
    verdict::all(&at.of("verdicts"), it)?;
    let passes = it.feasible && it.objective.is_some() && it.verdicts.iter().all(|one| one.passes);
    at.of("passes")
        .concludes(it.passes, passes, "`feasible` with all verdicts")?;
    if let Some(violation) = it.violation {
        let at = at.of("violation");
        at.within(violation, 0.0, f64::MAX)?;
        at.holds(
            (violation <= 1.0) == it.verdicts.iter().all(|one| one.passes),
            "is above 1 where a verdict fails, and only there",
        )?;
    }
    it.least_objective.map_or(Ok(()), |least| {
        at.of("least_objective").within(least, 0.0, f64::MAX)
    })
}

fn contact(at: &Place, it: &ContactRecord) -> Outcome {
    at.of("mu_s").within(it.mu_s, 0.0, 10.0)?;
    at.of("mu_d").within(it.mu_d, 0.0, it.mu_s * (1.0 + 1e-9))?;
    at.of("restitution").within(it.restitution, 0.0, 1.0)?;
    at.of("tangential_restitution")
        .within(it.tangential_restitution, -1.0, 1.0)
}

/// Settings that a problem file could hold.
pub(super) fn settings(at: &Place, it: &SettingsRecord) -> Outcome {
    given::check(&it.settings()).or_else(|fault| at.holds(false, &format!("cannot be: {fault}")))
}

pub(super) fn pose(at: &Place, it: &PoseRecord) -> Outcome {
    let is_unit = |numbers: &[f64]| {
        let length = numbers.iter().map(|x| x * x).sum::<f64>().sqrt();
        (length - 1.0).abs() <= VECTOR_ROUNDING
    };
    at.of("direction")
        .holds(is_unit(&it.direction), "is no unit vector")?;
    at.of("quaternion_xyzw")
        .holds(is_unit(&it.quaternion_xyzw), "is no rotation")?;
    let [x, y, z, w] = it.quaternion_xyzw;
    let axis = [
        2.0 * (x * z + w * y),
        2.0 * (y * z - w * x),
        1.0 - 2.0 * (x * x + y * y),
    ];
    let near = |a: f64, b: f64| (a - b).abs() <= VECTOR_ROUNDING * a.abs().max(b.abs()).max(1.0);
    let leads_along = axis.iter().zip(&it.direction).all(|(&a, &b)| near(a, b));
    at.of("quaternion_xyzw")
        .holds(leads_along, "does not lead along `direction`")?;
    if let Some(rows) = &it.matrix_4x4 {
        let agrees =
            (0..3).all(|i| near(rows[i][2], it.direction[i]) && near(rows[i][3], it.exit_m[i]));
        at.of("matrix_4x4")
            .holds(agrees, "does not lead to `exit_m` along `direction`")?;
    }
    Ok(())
}

/// The pressure is what the calibration gives for the speed.
fn pressure(at: &Place, it: &AnswerRecord, problem: &QuestionRecord) -> Outcome {
    let Some(pressure) = it.pressure else {
        return Ok(());
    };
    let rows = problem.calibration.iter();
    let calibration = Calibration {
        rows: rows.map(|row| (row.pressure, row.speed_m_s)).collect(),
    };
    let expected = calibration.pressure_at(it.settings.speed_m_s);
    let agrees = expected.is_some_and(|expected| is_close(expected / pressure, 1.0));
    at.holds(agrees, "is not what the calibration gives for the speed")
}

fn clearance(at: &Place, it: &AnswerRecord) -> Outcome {
    at.of("clearance_wanted_m")
        .at_least(it.clearance_wanted_m, 0.0)?;
    let is_whole = it.clearance_m.is_some() == it.clearance_surface.is_some();
    at.of("clearance_surface").holds(
        is_whole,
        "belongs to `clearance_m`, but only one of them is there",
    )?;
    at.of("feasible")
        .holds_or(!(it.feasible && it.is_too_near()), || {
            let wanted = it.clearance_wanted_m;
            let gap = it.least_clearance().unwrap_or(wanted);
            format!("is true, but the clearance is {gap} m of {wanted} m")
        })
}

/// J is the sum of its terms.
pub(super) fn objective(at: &Place, it: &ObjectiveRecord) -> Outcome {
    let terms = [
        ("normal_impulse", it.normal_impulse),
        ("tangential_impulse", it.tangential_impulse),
        ("rebound", it.rebound),
        ("miss", it.miss),
    ];
    for (key, term) in terms {
        at.of(key).at_least(term, 0.0)?;
    }
    let sum: f64 = terms.iter().map(|(_, term)| term).sum();
    let is_sum = (it.total - sum).abs() <= 1e-9 * sum;
    at.of("total").holds_or(is_sum, || {
        format!("is {}, but its terms add up to {sum}", it.total)
    })?;
    at.of("standard_error").at_least(it.standard_error, 0.0)?;
    for error in it.term_standard_errors {
        at.of("term_standard_errors").at_least(error, 0.0)?;
    }
    Ok(())
}

fn target(at: &Place, it: &TargetRecord, shots: usize) -> Outcome {
    at.of("share_on_target").share(it.share_on_target)?;
    let hits = it.share_on_target * shots as f64;
    at.of("share_on_target")
        .holds_or((hits - hits.round()).abs() <= 1e-6, || {
            format!(
                "is {}, which is no share of {shots} shots",
                it.share_on_target
            )
        })?;
    at.of("share_sticking").share(it.share_sticking)?;
    spread(&at.of("normal_impulse_N_s"), &it.normal_impulse)?;
    spread(&at.of("tangential_impulse_N_s"), &it.tangential_impulse)
}

fn receipt(at: &Place, it: &ReceiptRecord) -> Outcome {
    at.of("share_of_shots").share(it.share_of_shots)?;
    at.of("share_over").share(it.share_over)?;
    let is_part = it.share_over <= it.share_of_shots;
    at.of("share_over")
        .holds(is_part, "is larger than `share_of_shots`")?;
    let is_whole = it.normal_impulse.is_some() == (it.share_of_shots > 0.0);
    at.of("normal_impulse_N_s")
        .holds(is_whole, "does not belong to `share_of_shots`")?;
    if let Some(impulse) = &it.normal_impulse {
        spread(&at.of("normal_impulse_N_s"), impulse)?;
        let rounding = 1e-9;
        if let Some(allow) = it.allow {
            let is_over = impulse.largest > allow * (1.0 + rounding);
            let is_under = impulse.largest < allow * (1.0 - rounding);
            let agrees = if it.share_over > 0.0 {
                !is_under
            } else {
                !is_over
            };
            at.of("share_over").holds_or(agrees, || {
                format!(
                    "is {}, but the largest impulse is {} N s of {allow} N s",
                    it.share_over, impulse.largest
                )
            })?;
        }
    }
    let numbers = it
        .impacts_per_shot_by_number
        .iter()
        .chain(&it.over_per_shot_by_number);
    for &number in numbers {
        at.of("impacts_per_shot_by_number").at_least(number, 0.0)?;
    }
    Ok(())
}

fn spread(at: &Place, it: &SpreadRecord) -> Outcome {
    at.of("mean").at_least(it.mean, 0.0)?;
    at.of("low_5").at_least(it.low_5, 0.0)?;
    // The mean of equal numbers may be above them by the rounding of their sum.
    let most = it.largest * (1.0 + 1e-9);
    let rises = it.low_5 <= it.high_95 && it.high_95 <= it.largest && it.mean <= most;
    at.holds(
        rises,
        "does not rise from `low_5` over `high_95` to `largest`, with the mean below that",
    )
}
