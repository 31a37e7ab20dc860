//! A nozzle that does not fit: where, by how much, what would cure it.

use super::setting::{SETTINGS, Setting};
use super::subject;
use crate::record::{AnswerRecord, Record, StatusRecord};
use crate::report::layout::Block;
use crate::report::number::{plain, significant};

/// A setting is at the end of its range when it is nearer to it than this part of the range.
const AT_THE_END: f64 = 0.005;

/// Where the body stands against what was asked: `its body reaches 2.0 mm into hub.floor`.
pub fn conflict(answer: &AnswerRecord) -> String {
    let is_near = failed_by_clearance(answer);
    if let Some(reason) = answer.infeasible_because.as_ref().filter(|_| !is_near) {
        return reason.clone();
    }
    let Some((gap, surface)) = worst(answer) else {
        return "the nozzle does not fit".into();
    };
    let errors = match answer.clearance_within_tolerance_m {
        Some(_) => " with the worst errors",
        None => "",
    };
    let wanted = answer.clearance_wanted_m;
    let asked = if wanted > 0.0 {
        format!(", {} mm wanted", plain(wanted * 1e3))
    } else {
        String::new()
    };
    if gap < 0.0 {
        format!(
            "the nozzle body reaches {} mm into {surface}{errors}{asked}",
            millimetres(-gap)
        )
    } else {
        format!(
            "the nozzle body is only {} mm from {surface}{errors}{asked}",
            millimetres(gap)
        )
    }
}

/// What limits the answer: room for the nozzle, or free space for it.
pub fn limit(answer: &AnswerRecord) -> String {
    match (&answer.infeasible_because, failed_by_clearance(answer)) {
        (Some(reason), false) => reason.clone(),
        _ => format!(
            "room for the nozzle body at {}",
            worst(answer).map_or("the part", |(_, surface)| surface)
        ),
    }
}

/// Whether the nozzle is too near to a surface, and not on the wrong side of one.
fn failed_by_clearance(answer: &AnswerRecord) -> bool {
    let mut verdicts = answer.verdicts.iter();
    verdicts.any(|verdict| verdict.subject == subject::CLEARANCE && !verdict.passes)
}

/// How near the nozzle comes to a surface, with the worst errors where there is a tolerance.
fn worst(answer: &AnswerRecord) -> Option<(f64, &str)> {
    let set = answer.clearance_m.zip(answer.clearance_surface.as_deref());
    let errors = answer.clearance_within_tolerance_m;
    let worst = errors.zip(answer.clearance_within_tolerance_surface.as_deref());
    worst.or(set)
}

fn millimetres(metres: f64) -> String {
    significant(metres * 1e3, 2)
}

/// What would make room, as far as the record tells; nothing when the nozzle fits.
pub fn cures(record: &Record) -> Option<Block> {
    let best = &record.best;
    if best.feasible {
        return None;
    }
    let (gap, surface) = worst(best).unwrap_or((0.0, "the part"));
    let is_near = failed_by_clearance(best);
    let mut block = Block::titled("WHAT WOULD CURE IT");
    if is_near {
        block.hanging(
            "- ",
            &format!(
                "a body that is smaller by {} mm on the side of {surface}; or",
                millimetres(best.clearance_wanted_m - gap)
            ),
        );
    }
    if is_near && best.clearance_wanted_m > 0.0 && gap > 0.0 {
        block.hanging(
            "- ",
            &format!(
                "a clearance of {} mm instead of {} mm; or",
                millimetres(gap),
                plain(best.clearance_wanted_m * 1e3)
            ),
        );
    }
    let ends = match record.status {
        // Nobody has searched: the ends of the ranges have nothing to do with it.
        StatusRecord::Evaluated => Vec::new(),
        _ => ends_reached(record),
    };
    for end in &ends {
        block.hanging("- ", end);
    }
    if ends.is_empty() {
        let other = match record.status {
            StatusRecord::Evaluated => "another pose: `peenpose solve` looks for one that fits",
            _ => "wider ranges, or other settings that are held now",
        };
        block.hanging("- ", other);
    }
    Some(block)
}

/// Settings that stand at the end of their range: beyond it there may be room.
fn ends_reached(record: &Record) -> Vec<String> {
    let mut ends = Vec::new();
    // Stepping back is the cure that is tried first.
    let (standoff, others): (Vec<&Setting>, Vec<&Setting>) = SETTINGS
        .iter()
        .partition(|setting| setting.key == "standoff_m");
    for setting in standoff.into_iter().chain(others) {
        let Some(range) = setting.range(record) else {
            continue;
        };
        // Speed moves no body.
        if setting.key == "speed_m_s" {
            continue;
        }
        let unit = setting.unit;
        let [min, max] = [range.min, range.max].map(|end| end * setting.scale());
        let near = AT_THE_END * (max - min);
        let value = setting.value(&record.best.settings);
        if max <= min {
            if setting.is_used(record) {
                ends.push(format!(
                    "{} other than the {} {unit} at which it is held; or",
                    setting.name,
                    plain(min)
                ));
            }
        } else if value >= max - near && !(setting.key == "incidence_deg" && max >= 90.0) {
            ends.push(format!(
                "{} above {} {unit}, where its range ends; or",
                setting.name,
                plain(max)
            ));
        } else if value <= min + near {
            ends.push(format!(
                "{} below {} {unit}, where its range ends; or",
                setting.name,
                plain(min)
            ));
        }
    }
    if let Some(last) = ends.last_mut() {
        *last = last.trim_end_matches("; or").into();
    }
    ends
}
