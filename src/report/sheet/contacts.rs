//! The contacts ranked, and where the choice between them makes no difference.

use super::setting::SETTINGS;
use super::subject;
use crate::elementary::hypot;
use crate::record::{AnswerRecord, Record};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{Scale, impulse, share, share_asked, significant};
use crate::solve::is_tie;

/// A row for each contact, best first, and what ties; nothing when there was no choice.
pub fn block(record: &Record) -> Option<Block> {
    let choices = &record.choices;
    if choices.len() < 2 {
        return None;
    }
    let mut columns = vec![("CONTACTS", Align::Left)];
    columns.extend([
        ("", Align::Left),
        ("incid. deg", Align::Right),
        ("az. deg", Align::Right),
        ("standoff mm", Align::Right),
        ("m/s", Align::Right),
        ("grip", Align::Right),
        ("J +- std. error", Align::Right),
    ]);
    let mut table = Table::new(&columns);
    let (total, error) = total(&choices[0]).unwrap_or_default();
    let scale = Scale::for_error(total, error);
    for answer in choices {
        let mut cells = vec![answer.contact.clone(), verdict(answer)];
        cells.extend(SETTINGS[..4].iter().map(|s| s.text(&answer.settings)));
        let hit = answer.target.as_ref();
        let hit = hit.filter(|target| target.share_on_target > 0.0);
        cells.push(hit.map_or_else(|| "-".into(), |target| share(target.share_sticking)));
        cells.push(answer.objective.map_or_else(
            || "-".into(),
            |objective| {
                let (total, error) = (objective.total, objective.standard_error);
                scale.with_error(total, error)
            },
        ));

        table.row(cells);
    }
    let mut block = Block::default();
    block.table(table);
    for sentence in sentences(record) {
        block.paragraph(&sentence);
    }
    Some(block)
}

fn verdict(answer: &AnswerRecord) -> String {
    let failing = subject::failing(answer);
    if !answer.feasible {
        "NO ROOM".into()
    } else if failing.is_empty() {
        "PASS".into()
    } else {
        format!("FAIL {}", failing.len())
    }
}

/// Whether two values are equal within their standard errors.
fn equal((a, a_error): (f64, f64), (b, b_error): (f64, f64)) -> bool {
    (a - b).abs() <= hypot(a_error, b_error).max(1e-9 * a.abs())
}

/// J with its standard error.
fn total(answer: &AnswerRecord) -> Option<(f64, f64)> {
    let objective = answer.objective?;
    Some((objective.total, objective.standard_error))
}

fn rebound(answer: &AnswerRecord) -> Option<(f64, f64)> {
    let objective = answer.objective?;
    Some((objective.rebound, objective.term_standard_errors[2]))
}

fn sticks(answer: &AnswerRecord) -> bool {
    let target = answer.target.as_ref();
    target.is_some_and(|target| target.share_on_target > 0.0 && target.share_sticking >= 1.0)
}

fn names(choices: &[&AnswerRecord]) -> String {
    let names: Vec<&str> = choices.iter().map(|c| c.contact.as_str()).collect();
    match names.split_last() {
        Some((last, [])) => (*last).into(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

fn sentences(record: &Record) -> Vec<String> {
    let mut sentences = Vec::new();
    let feasible: Vec<&AnswerRecord> = record
        .choices
        .iter()
        .filter(|answer| answer.feasible)
        .collect();
    let Some((best, best_total)) = feasible
        .first()
        .and_then(|best| Some((*best, total(best)?)))
    else {
        return sentences;
    };
    let totals = feasible.iter().filter_map(|answer| total(answer));
    let least = totals.fold(best_total, |a, b| if b.0 < a.0 { b } else { a });
    let accuracy = record.problem.accuracy;
    let ties =
        |answer: &AnswerRecord| total(answer).is_some_and(|other| is_tie(least, other, accuracy));
    let (tied, behind): (Vec<&AnswerRecord>, Vec<&AnswerRecord>) =
        feasible.into_iter().partition(|answer| ties(answer));
    if tied.len() > 1 {
        let first = if best_total.0 > least.0 {
            format!(" {} stands first as the file names it first.", best.contact)
        } else {
            String::new()
        };
        sentences.push(format!(
            "{} tie: J is equal within its standard error or the accuracy asked for ({}).{first}",
            names(&tied),
            share_asked(accuracy)
        ));
        sentences.extend(sticking(&tied));
    }
    for answer in behind {
        if let (Some((other, _)), true) = (total(answer), best_total.0 > 0.0) {
            sentences.push(format!(
                "{} costs {} times the J of {}.",
                answer.contact,
                significant(other / best_total.0, 3),
                best.contact
            ));
        }
    }
    sentences
}

/// What sticking says about contacts that tie.
fn sticking(tied: &[&AnswerRecord]) -> Vec<String> {
    let (sticking, sliding): (Vec<&AnswerRecord>, Vec<&AnswerRecord>) =
        tied.iter().partition(|answer| sticks(answer));
    let mut sentences = Vec::new();
    if let [first, others @ ..] = &sticking[..]
        && !others.is_empty()
    {
        let with = if sliding.is_empty() {
            "Every shot grips on first impact".to_owned()
        } else {
            format!("With {} every shot grips on first impact", names(&sticking))
        };
        let same = |other: &&AnswerRecord| match (rebound(first), rebound(other)) {
            (Some(a), Some(b)) => equal(a, b),
            _ => false,
        };
        let rebounds = if others.iter().all(same) {
            "rebounds cost the same within their standard errors"
        } else {
            "rebounds differ, because later impacts may slide"
        };
        sentences.push(format!(
            "{with}: friction makes no difference to the target; {rebounds}."
        ));
    }
    for answer in &sliding {
        let Some(target) = &answer.target else {
            continue;
        };
        if target.share_on_target > 0.0 {
            sentences.push(format!(
                "With {} {}; mean f* is {} uN.s{}.",
                answer.contact,
                match target.share_sticking {
                    0.0 => "every first impact slides".into(),
                    sticking => format!("{} of the first impacts grip", share(sticking)),
                },
                impulse(target.tangential_impulse.mean),
                compared(&sticking)
            ));
        }
    }
    sentences
}

/// The mean f* of the contacts that stick, to compare with.
fn compared(sticking: &[&AnswerRecord]) -> String {
    sticking
        .first()
        .and_then(|answer| {
            let target = answer.target.as_ref()?;
            Some(format!(
                ", with {} {}",
                answer.contact,
                impulse(target.tangential_impulse.mean)
            ))
        })
        .unwrap_or_default()
}
