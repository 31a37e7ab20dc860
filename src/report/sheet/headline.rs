//! The head of the sheet: what it is about, the overall verdict, what takes the ground from under it, what
//! limits it.

use super::{blocked, cause, subject};
use crate::record::{AnswerRecord, Record, StatusRecord, VerdictRecord};
use crate::report::layout::Block;
use crate::report::number::{plural, share_asked, significant};
use crate::validity::STRONG_INTERFERENCE;

/// Failing verdicts that the headline spells out.
const SPELT_OUT: usize = 3;

/// Title, file, overall verdict, what limits it, how the search ended.
pub fn block(record: &Record) -> Block {
    let mut block = Block::titled("TECHNIQUE SHEET");
    block.paragraph(&record.problem.title);
    block.paragraph(&record.problem.file);
    block.gap();
    for (index, line) in verdict(record).iter().enumerate() {
        let label = if index == 0 {
            "verdict      "
        } else {
            "             "
        };
        block.hanging(label, line);
    }
    if let Some(reason) = beware(record) {
        block.hanging("beware       ", reason);
    }
    block.hanging("limited by   ", &cause::headline(record));
    block.hanging("search       ", &status(record));
    block
}

/// The overall verdict; what fails stands on lines of its own, worst first.
pub fn verdict(record: &Record) -> Vec<String> {
    let best = &record.best;
    if record.status == StatusRecord::NoFeasiblePose {
        return vec![format!(
            "NO FEASIBLE POSE: {}; nearest miss below",
            blocked::conflict(best)
        )];
    }
    let mut lines = Vec::new();
    if !best.feasible {
        lines.push(format!("FAIL: {}", blocked::conflict(best)));
    }
    let mut failing = subject::failing(best);
    if let (true, Some(surface)) = (best.feasible, subject::missed_target(best)) {
        lines.push(format!("FAIL: no shot hits {surface} first"));
        // What follows from that is not said again.
        failing.retain(|verdict| verdict.counted > 0 && verdict.subject != "miss");
        lines.extend(spelt_out(record, &failing));
    } else if let [only] = failing[..] {
        lines.push(format!("FAIL: {}", failure(record, &only.subject)));
    } else if !failing.is_empty() {
        lines.push(format!(
            "FAIL: {} of {}",
            failing.len(),
            plural(best.verdicts.len(), "verdict")
        ));
        lines.extend(spelt_out(record, &failing));
    }
    if lines.is_empty() {
        lines.push(pass(best));
    } else if let Some(other) = record.choices.iter().find(|answer| answer.passes) {
        lines.push(format!(
            "but {} passes every verdict, with a larger J: see CONTACTS",
            other.contact
        ));
    }
    lines
}

/// What takes the ground from under all figures: shots that meet each other in flight.
pub fn beware(record: &Record) -> Option<&str> {
    let mut notes = record.notes.iter();
    let note = notes.find(|note| note.name == STRONG_INTERFERENCE)?;
    Some(&note.text)
}

fn pass(best: &AnswerRecord) -> String {
    let near: Vec<&str> = best
        .verdicts
        .iter()
        .filter(|verdict| !verdict.certain)
        .map(|verdict| verdict.subject.as_str())
        .collect();
    let all = match best.verdicts.len() {
        1 => "PASS: the only verdict".to_owned(),
        2 => "PASS: both verdicts".to_owned(),
        number => format!("PASS: all {}", plural(number, "verdict")),
    };
    if near.is_empty() {
        all
    } else {
        format!("{all}, but too near to be certain: {}", near.join(", "))
    }
}

/// A line for each of the worst that fail.
fn spelt_out(record: &Record, failing: &[&VerdictRecord]) -> Vec<String> {
    let worst = failing.iter().take(SPELT_OUT);
    let mut lines: Vec<String> = worst
        .map(|verdict| format!("- {}", failure(record, &verdict.subject)))
        .collect();
    if failing.len() > SPELT_OUT {
        lines.push(format!("- and {} more", failing.len() - SPELT_OUT));
    }
    lines
}

/// What fails and by how much.
fn failure(record: &Record, name: &str) -> String {
    let best = &record.best;
    let Some(verdict) = best.verdicts.iter().find(|v| v.subject == name) else {
        return name.into();
    };
    format!(
        "{name}: {} ({})",
        subject::share_against_allowed(verdict),
        subject::broken_when(name, &record.problem.goals, best)
    )
}

/// How the search ended.
pub fn status(record: &Record) -> String {
    let accuracy = share_asked(record.problem.accuracy);
    match record.status {
        StatusRecord::Converged => match error_beyond(record) {
            None => format!("converged to {accuracy} of the score J (lower is better)"),
            Some(error) => format!(
                "converged within the standard error of the score J, {} % ({accuracy} asked for)",
                significant(error * 100.0, 2)
            ),
        },
        StatusRecord::BudgetSpent => format!(
            "BUDGET SPENT before {accuracy} of the score J was reached: better settings may exist"
        ),
        StatusRecord::NoFeasiblePose => "the nozzle fits at no pose that was tried".into(),
        StatusRecord::Interrupted => {
            "INTERRUPTED: the best settings until then; better ones may exist".into()
        }
        StatusRecord::Evaluated => "none: the settings were given".into(),
    }
}

/// The standard error of J, relative to it, where that is larger than the accuracy asked for: better settings
/// cannot be told from these.
fn error_beyond(record: &Record) -> Option<f64> {
    let objective = record.best.objective.as_ref()?;
    let error = objective.standard_error;
    let is_beyond = error > record.problem.accuracy * objective.total && error > ROUNDING;
    is_beyond.then(|| error / objective.total)
}

/// Errors of J below this come from rounding alone, where every goal is reached.
const ROUNDING: f64 = 1e-20;
