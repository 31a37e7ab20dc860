//! What a verdict is about, in words.

use std::cmp::Ordering;

use crate::record::{AnswerRecord, GoalsRecord, VerdictRecord};
use crate::report::number::{impulse_asked, plain, share, share_asked};

/// The verdict on the distance of the nozzle from every surface.
pub const CLEARANCE: &str = "clearance";
/// The verdict on the side of every surface on which the nozzle is.
const FREE_SPACE: &str = "free_space";

/// Whether a verdict is about the pose of the nozzle: then it counts no shots.
pub fn is_of_pose(subject: &str) -> bool {
    matches!(subject, CLEARANCE | FREE_SPACE)
}

/// What breaks a goal, as it stands behind its name: `N* off 40 uN.s by > 15 %`.
pub fn broken_when(subject: &str, goals: &GoalsRecord, answer: &AnswerRecord) -> String {
    match subject {
        "miss" => "first hit off target".into(),
        CLEARANCE if answer.clearance_wanted_m == 0.0 => "nozzle meets a wall".into(),
        CLEARANCE => format!(
            "nozzle within {} mm of a wall",
            plain(answer.clearance_wanted_m * 1e3)
        ),
        FREE_SPACE => "nozzle in material".into(),
        "normal_impulse" => format!(
            "N* off {} +- {}",
            impulse_asked(goals.normal_impulse),
            share_asked(goals.normal_impulse_tolerance)
        ),
        "tangential_impulse" => goals.tangential_impulse.map_or_else(
            || "f* over its limit".into(),
            |limit| format!("f* over {}", impulse_asked(limit)),
        ),
        surface => answer
            .surfaces
            .get(surface)
            .and_then(|receipt| receipt.allow)
            .map_or_else(
                || "over what it may take".into(),
                |allow| {
                    let is_target = answer.target.as_ref().is_some_and(|t| t.surface == surface);
                    let place = if is_target { " off target" } else { "" };
                    format!("over {}{place}", impulse_asked(allow))
                },
            ),
    }
}

/// Whose share a verdict counts: the goals on impulses count first hits on target only.
pub fn counted(subject: &str) -> &'static str {
    match subject {
        "normal_impulse" | "tangential_impulse" => "of the hits on target",
        _ => "of the shots",
    }
}

/// `2.01 % of the hits on target violate it; 5 % is allowed`.
pub fn share_against_allowed(verdict: &VerdictRecord) -> String {
    let counted = counted(&verdict.subject);
    let allowed = match verdict.allowed {
        0.0 => "none".into(),
        allowed => share_asked(allowed),
    };
    if verdict.counted == 0 {
        return "no shot hits the target first, so it is not met".into();
    }
    if verdict.share > 0.0 {
        format!(
            "{} {counted} violate it; {allowed} is allowed",
            share(verdict.share)
        )
    } else {
        format!("none {counted} violates it; {allowed} is allowed")
    }
}

/// The target that no shot hits first, where there were any.
pub fn missed_target(answer: &AnswerRecord) -> Option<&str> {
    let target = answer.target.as_ref()?;
    let is_missed = answer.shots > 0 && target.share_on_target <= 0.0;
    is_missed.then_some(target.surface.as_str())
}

/// Utilisation: the share of shots over the allowed share; 1 is the limit.
pub fn utilisation(verdict: &VerdictRecord) -> f64 {
    if verdict.counted == 0 {
        f64::INFINITY
    } else if verdict.allowed > 0.0 {
        verdict.share / verdict.allowed
    } else if verdict.share > 0.0 {
        f64::INFINITY
    } else {
        0.0
    }
}

/// Orders verdicts by how urgent they are: those that fail are more so than those that pass, then
/// by how much of what is allowed is used up. What had nothing to count fails for the reason of
/// another.
pub fn by_urgency(a: &VerdictRecord, b: &VerdictRecord) -> Ordering {
    let kind = |verdict: &VerdictRecord| (!verdict.passes, verdict.counted > 0);
    kind(a)
        .cmp(&kind(b))
        .then(utilisation(a).total_cmp(&utilisation(b)))
}

/// The verdicts on shots that fail, worst first.
pub fn failing(answer: &AnswerRecord) -> Vec<&VerdictRecord> {
    let mut failing: Vec<&VerdictRecord> = answer
        .verdicts
        .iter()
        .filter(|verdict| !verdict.passes && !is_of_pose(&verdict.subject))
        .collect();
    failing.sort_by(|a, b| by_urgency(b, a));
    failing
}
