//! The head of the sheet: what it is about, the overall verdict, what takes the ground from under it, what
//! limits it.

use super::{blocked, cause, stroke, subject};
use crate::record::{AnswerRecord, RankingRecord, Record, StatusRecord, VerdictRecord};
use crate::report::layout::Block;
use crate::report::number::{plain, plural, share_asked, significant};
use crate::validity::STRONG_INTERFERENCE;

/// Failing verdicts that the headline spells out.
const SPELT_OUT: usize = 3;

/// Title, file, overall verdict, what limits it, how the search ended.
pub fn block(record: &Record) -> Block {
    let mut block = Block::titled("TECHNIQUE SHEET");
    block.paragraph(&record.problem.title);
    block.paragraph(&record.problem.file);
    block.gap();
    let mut hang = |label: &str, text: &str| block.hanging(&format!("{label:13}"), text);
    for (index, line) in verdict(record).iter().enumerate() {
        hang(if index == 0 { "verdict" } else { "" }, line);
    }
    for (label, text) in below_verdict(record) {
        hang(label, &text);
    }
    block
}

/// What must be known besides the overall verdict, each with its label.
pub fn below_verdict(record: &Record) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    lines.extend(beware(record).map(|reason| ("beware", reason.to_owned())));
    lines.extend(spot(record).map(|spot| ("spot", spot)));
    lines.push(("limited by", cause::headline(record)));
    lines.push(("search", status(record)));
    lines
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
        lines.extend(cost_of_passing(best));
    } else if record.ranking == Some(RankingRecord::LeastViolation) && best.feasible {
        lines.extend(nearest(best));
    } else if let Some(other) = record.choices.iter().find(|answer| answer.passes) {
        lines.push(format!(
            "but {} passes every verdict, with a larger J: see CONTACTS",
            other.contact
        ));
    }
    lines
}

/// What takes the ground from under all figures: shots that meet each other in flight.
fn beware(record: &Record) -> Option<&str> {
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

/// What it costs in J that these settings pass.
fn cost_of_passing(best: &AnswerRecord) -> Option<String> {
    let (least, objective) = (best.least_objective?, best.objective.as_ref()?);
    Some(format!(
        "the least J, {}, fails; passing costs {} times that",
        significant(least, 3),
        significant(objective.total / least, 3)
    ))
}

/// That nothing passes, and which shares would have to be allowed.
fn nearest(best: &AnswerRecord) -> Vec<String> {
    let failing = subject::failing(best);
    let shares = failing.iter().filter(|verdict| verdict.counted > 0);
    let mut shares: Vec<String> = shares
        .map(|verdict| format!("{} {}", verdict.subject, rounded_up(verdict.share)))
        .collect();
    let more = shares.len().saturating_sub(SPELT_OUT);
    shares.truncate(SPELT_OUT);
    if more > 0 {
        shares.push(format!("{more} more"));
    }
    let mut lines = vec!["No settings were found that pass; these are the nearest.".to_owned()];
    if !shares.is_empty() {
        lines.push(format!(
            "They would pass with these shares allowed: {}",
            shares.join(", ")
        ));
    }
    lines
}

/// A share that is surely enough, %.
fn rounded_up(share: f64) -> String {
    let percent = 100.0 * share;
    let (step, digits) = if percent < 10.0 { (0.1, 1) } else { (1.0, 0) };
    let up = ((percent / step).floor() + 1.0) * step;
    format!("{:.digits$} %", up.min(100.0))
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

/// How much of the target a nozzle that stands still reaches, and whether PASS holds for that alone.
fn spot(record: &Record) -> Option<String> {
    let spot = record.spot.as_ref()?;
    let text = stroke::spot(record)?;
    Some(match &record.stroke {
        Some(stroke) => format!("{text}; it travels {} mm", plain(stroke.length_m * 1e3)),
        None if record.passes() && spot.share_of_target < WHOLE => {
            format!("{text}; PASS holds there alone")
        }
        None => text,
    })
}

/// A spot with this share of the target is taken for all of it.
const WHOLE: f64 = 0.5;

/// How the search ended.
pub fn status(record: &Record) -> String {
    let accuracy = share_asked(record.problem.accuracy);
    let passes = record.passes();
    match record.status {
        StatusRecord::Converged if !passes => {
            format!("converged to {accuracy} of the least violation")
        }
        StatusRecord::Converged => match error_beyond(record) {
            None => format!("converged to {accuracy} of the score J (lower is better)"),
            Some(error) => format!(
                "converged within the standard error of the score J, {} % ({accuracy} asked for)",
                significant(error * 100.0, 2)
            ),
        },
        StatusRecord::BestFound => match record.spread {
            Some(spread) if spread > record.problem.accuracy => format!(
                "BEST FOUND: independent searches end {} % apart, {accuracy} is asked for; better settings may exist",
                significant(spread * 100.0, 2)
            ),
            _ => {
                let what = if passes { "score J" } else { "least violation" };
                format!(
                    "BEST FOUND: the search ended before {accuracy} of the {what} was certain; better settings may \
                     exist"
                )
            }
        },
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
