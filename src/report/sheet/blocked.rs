//! A nozzle that does not fit: where, by how much, what would cure it.

use super::setting::{SETTINGS, Setting};
use super::subject;
use crate::elementary::whole_power;
use crate::record::{AnswerRecord, Record, StatusRecord};
use crate::report::layout::Block;
use crate::report::number::{decimals_for, fixed, plain, significant};

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
    let mut cures: Vec<String> = Vec::new();
    let is_thick_enough = best
        .body_radius_left_m
        .filter(|_| is_near)
        .map(|left| left > 0.5 * record.problem.exit_diameter_m);
    if is_thick_enough == Some(true) {
        cures.push(format!(
            "a body whose radius is smaller by {} mm on the side of {surface}",
            millimetres(best.clearance_wanted_m - gap),
        ));
    }
    if is_near && best.clearance_wanted_m > 0.0 && gap > 0.0 {
        cures.push(format!(
            "a clearance of {} mm instead of {} mm",
            rounded_down(gap),
            plain(best.clearance_wanted_m * 1e3)
        ));
    }
    // Nobody has searched for given settings: the ends of the ranges have nothing to do with them.
    let is_given = record.status == StatusRecord::Evaluated;
    let ends = if is_given {
        Vec::new()
    } else {
        ends_reached(record)
    };
    cures.extend(match () {
        () if !ends.is_empty() => ends,
        () if is_given => {
            vec!["another pose: `peenpose solve` looks for one that fits".into()]
        }
        () => vec![
            "wider ranges: a longer standoff, another direction, or a setting that is held now"
                .into(),
        ],
    });
    let mut block = Block::titled("WHAT WOULD CURE IT");
    let last = cures.len() - 1;
    for (index, cure) in cures.iter().enumerate() {
        let or = if index < last { "; or" } else { "" };
        block.hanging("- ", &format!("{cure}{or}"));
    }
    block.paragraph_if(
        is_thick_enough == Some(false),
        "No smaller body fits there: it would have to be thinner than the exit.",
    );
    Some(block)
}

/// A distance that may be asked for where there is this much room, mm.
fn rounded_down(gap: f64) -> String {
    let shown = millimetres(gap);
    let is_more = shown.parse::<f64>().is_ok_and(|shown| shown > gap * 1e3);
    if is_more {
        let step = whole_power(0.1, decimals_for(gap * 1e3, 2) as i32);
        fixed(gap * 1e3 - step / 2.0, decimals_for(gap * 1e3, 2))
    } else {
        shown
    }
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
        if setting.key == "speed_m_s" || setting.is_any_at(&record.best.settings) {
            continue;
        }
        // Beyond a whole turn are the same directions again.
        if setting.key == "azimuth_deg" && range.max - range.min >= 360.0 {
            continue;
        }
        let unit = setting.unit;
        let [min, max] = [range.min, range.max].map(|end| end * setting.scale());
        let near = AT_THE_END * (max - min);
        let value = setting.value(&record.best.settings);
        if max <= min {
            if setting.is_used(record) {
                ends.push(format!(
                    "{} other than the {} {unit} at which it is held",
                    setting.name,
                    plain(min)
                ));
            }
        } else if value >= max - near && !(setting.key == "incidence_deg" && max >= 90.0) {
            ends.push(format!(
                "{} above {} {unit}, where its range ends",
                setting.name,
                plain(max)
            ));
        } else if value <= min + near {
            ends.push(format!(
                "{} below {} {unit}, where its range ends",
                setting.name,
                plain(min)
            ));
        }
    }
    ends
}
