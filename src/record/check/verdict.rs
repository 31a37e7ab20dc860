//! Verdicts: what passes is worked out again from the shares.

use super::super::{AnswerRecord, TargetRecord, VerdictRecord};
use super::place::{Outcome, Place, is_close};

/// Verdicts of one answer.
pub(super) fn all(at: &Place, answer: &AnswerRecord) -> Outcome {
    for (index, verdict) in answer.verdicts.iter().enumerate() {
        let at = at.item(index);
        let same = |other: &VerdictRecord| other.subject == verdict.subject;
        let is_new = !answer.verdicts[..index].iter().any(same);
        at.of("subject").holds(is_new, "has a verdict already")?;
        alone(&at, verdict, answer.shots == 1 || is_of_pose(verdict))?;
        if is_of_pose(verdict) {
            of_pose(&at, verdict, answer)?;
        } else if verdict.at_m.is_none() {
            // What a station of a stroke receives is not what the whole does.
            beside(&at, verdict, answer)?;
        }
    }
    let mut of_pose = answer.verdicts.iter().filter(|it| is_of_pose(it));
    let agrees = of_pose.clone().count() == 0 || of_pose.all(|it| it.passes) == answer.feasible;
    at.holds(agrees, "on the nozzle contradict `feasible`")
}

/// Subjects of the verdicts on the nozzle, which count no shots.
const OF_POSE: [&str; 2] = ["clearance", "free_space"];

/// Whether a verdict is on the nozzle.
pub(super) fn is_of_pose(it: &VerdictRecord) -> bool {
    OF_POSE.contains(&it.subject.as_str())
}

/// A verdict on the nozzle: kept or not, and the clearance tells which.
fn of_pose(at: &Place, it: &VerdictRecord, answer: &AnswerRecord) -> Outcome {
    at.of("counted").holds(it.counted == 1, "is not 1")?;
    at.of("allowed").holds(it.allowed == 0.0, "is not 0")?;
    let is_near = answer.is_too_near();
    let is_hidden = it.subject != "clearance" || !is_near || !it.passes;
    at.of("passes").holds(
        is_hidden,
        "is true, but the nozzle is nearer than it may be",
    )
}

/// A verdict by itself.
pub(super) fn alone(at: &Place, it: &VerdictRecord, is_exact: bool) -> Outcome {
    at.of("share").share(it.share)?;
    at.of("allowed").share(it.allowed)?;
    let counted = it.counted as f64;
    let broken = (it.share * counted).round();
    let is_whole = (it.share * counted - broken).abs() <= 1e-6;
    at.of("share")
        .holds_or(is_whole && (it.counted > 0 || it.share == 0.0), || {
            format!("is {}, which is no share of {} shots", it.share, it.counted)
        })?;
    let [low, high] = it.interval_95;
    let interval = at.of("interval_95");
    interval.within(low, 0.0, 1.0)?;
    interval.within(high, 0.0, 1.0)?;
    interval.holds(low <= high, "is upside down")?;
    interval.holds_or(is_possible(it, is_exact), || {
        format!(
            "is [{low}, {high}], which is no 95 % interval of a share of {} of {} shots",
            it.share, it.counted
        )
    })?;
    let passes = it.counted > 0 && it.share <= it.allowed;
    at.of("passes")
        .concludes(it.passes, passes, "share and allowed share")?;
    let certain = high <= it.allowed || low > it.allowed;
    at.of("certain")
        .concludes(it.certain, certain, "the interval")
}

/// Whether an interval can be one of 95 % of some kind: between those of one and of eight standard errors. Versions
/// compute it in different ways.
fn is_possible(it: &VerdictRecord, is_exact: bool) -> bool {
    let [low, high] = it.interval_95;
    if is_exact {
        return is_close(low, it.share) && is_close(high, it.share);
    }
    if it.counted == 0 {
        return low == 0.0 && high == 1.0;
    }
    let ([least_low, least_high], [most_low, most_high]) = (wilson(it, 1.0), wilson(it, 8.0));
    let slack = 1e-12;
    (most_low - slack..=least_low + slack).contains(&low)
        && (least_high - slack..=most_high + slack).contains(&high)
}

/// Wilson's interval, this many standard errors to both sides.
fn wilson(it: &VerdictRecord, standard_errors: f64) -> [f64; 2] {
    let z2 = standard_errors * standard_errors / it.counted as f64;
    let centre = it.share + z2 / 2.0;
    let half = (z2 * (it.share * (1.0 - it.share) + z2 / 4.0)).sqrt();
    [
        ((centre - half) / (1.0 + z2)).max(0.0),
        ((centre + half) / (1.0 + z2)).min(1.0),
    ]
}

/// A verdict against what target and surfaces received.
fn beside(at: &Place, it: &VerdictRecord, answer: &AnswerRecord) -> Outcome {
    let Some(target) = &answer.target else {
        return Ok(());
    };
    let hits = (target.share_on_target * answer.shots as f64).round() as usize;
    let (counted, share) = match it.subject.as_str() {
        "miss" => (answer.shots, Some(1.0 - target.share_on_target)),
        "normal_impulse" | "tangential_impulse" => (hits, None),
        surface => {
            let receipt = answer.surfaces.get(surface);
            let is_known = receipt.is_some();
            at.of("subject").holds_or(is_known, || {
                format!("is `{surface}`, which is none of `surfaces`")
            })?;
            (answer.shots, receipt.map(|receipt| receipt.share_over))
        }
    };
    at.of("counted").holds_or(it.counted == counted, || {
        format!("is {}, but shots and hits give {counted}", it.counted)
    })?;
    match share {
        Some(share) => at
            .of("share")
            .follows(it.share, share, "what the surface receives"),
        None => Ok(()),
    }
}

/// The goals of the target against the largest impulses: where the largest breaks one, some shot does.
pub(super) fn goals(
    at: &Place,
    answer: &AnswerRecord,
    target: &TargetRecord,
    limits: [Option<f64>; 2],
) -> Outcome {
    let spreads = [&target.normal_impulse, &target.tangential_impulse];
    for ((subject, spread), limit) in ["normal_impulse", "tangential_impulse"]
        .into_iter()
        .zip(spreads)
        .zip(limits)
    {
        let found = answer
            .verdicts
            .iter()
            .position(|verdict| verdict.subject == subject);
        let (Some(index), Some(limit)) = (found, limit) else {
            continue;
        };
        let breaks = spread.largest > limit * (1.0 + 1e-9) && target.share_on_target > 0.0;
        let is_broken = answer.verdicts[index].share > 0.0;
        at.item(index)
            .of("share")
            .holds_or(!breaks || is_broken, || {
                format!(
                    "is 0, but the largest impulse, {} N s, is over {limit} N s",
                    spread.largest
                )
            })?;
    }
    Ok(())
}
