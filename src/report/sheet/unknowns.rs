//! What is not known exactly at the ends of its range: which of it moves the result most.

use crate::elementary::extremes;
use crate::record::{
    ContactRecord, OutcomeRecord, QuantityRecord, Record, UnknownRangeRecord, UnknownsRecord,
    VerdictRecord,
};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{decimals_for, fixed, impulse, plain, share, significant};

/// J that moves by less than this part of itself has not moved.
const MOVES: f64 = 0.01;

/// A row for the nominal contact and for each end; nothing where nothing is unknown.
pub fn block(record: &Record) -> Option<Block> {
    let unknowns = record.unknowns.as_ref()?;
    let mut table = Table::new(&[
        ("UNKNOWNS, one at a time", Align::Left),
        ("rebound, deg", Align::Right),
        ("mean N*, uN.s", Align::Right),
        ("J", Align::Right),
        ("violates most", Align::Left),
    ]);
    let verdicts = &record.best.verdicts;
    let decimals = decimals_for(largest_objective(unknowns), 4);
    let mut row = |label: String, effect: &OutcomeRecord| {
        table.row([
            label,
            effect
                .rebound_angle_deg
                .map_or_else(|| "-".into(), |angle| fixed(angle, 1)),
            impulse(effect.normal_impulse),
            fixed(effect.objective, decimals),
            nearest_to_failing(effect, verdicts),
        ]);
    };
    row("as given".into(), &unknowns.nominal);
    for range in &unknowns.ranges {
        for (value, effect) in [(range.low, &range.at_low), (range.high, &range.at_high)] {
            row(
                label(range.quantity, value, &record.best.contact_values),
                effect,
            );
        }
    }
    let mut block = Block::default();
    block.table(table);
    if let Some(sentence) = sentence(unknowns) {
        block.paragraph(&sentence);
    }
    let mut quantities = unknowns.ranges.iter().map(|range| range.quantity);
    if quantities.any(|it| it != QuantityRecord::Walls) {
        block.paragraph(
            "Every shot of a row has the same restitution and friction; in OBJECTIVE each draws its own.",
        );
    }
    Some(block)
}

/// What is unknown, at one end of its range.
fn label(quantity: QuantityRecord, value: f64, contact: &ContactRecord) -> String {
    match quantity {
        QuantityRecord::Restitution => {
            format!("restitution {}{}", plain(value), where_measured(contact))
        }
        QuantityRecord::Friction => format!("mu_s {}", plain(value)),
        QuantityRecord::Walls => {
            let side = if value < 0.0 { "farther" } else { "nearer" };
            format!("walls {} mm {side}", plain(value.abs() * 1e3))
        }
    }
}

/// At which speed a restitution that falls with speed was measured: a tolerance shifts it there.
pub(super) fn where_measured(contact: &ContactRecord) -> String {
    let speed = contact.restitution_at_m_s;
    speed.map_or_else(String::new, |speed| format!(" at {} m/s", plain(speed)))
}

/// The largest J of the table.
fn largest_objective(unknowns: &UnknownsRecord) -> f64 {
    let ends = unknowns
        .ranges
        .iter()
        .flat_map(|range| [&range.at_low, &range.at_high]);
    ends.map(|effect| effect.objective)
        .fold(unknowns.nominal.objective, f64::max)
}

/// The goal that uses most of what it may.
fn nearest_to_failing(effect: &OutcomeRecord, verdicts: &[VerdictRecord]) -> String {
    let allowed = |subject: &str| {
        let verdict = verdicts.iter().find(|verdict| verdict.subject == subject);
        verdict.map_or(0.0, |verdict| verdict.allowed)
    };
    let broken = effect.shares.iter().filter(|one| one.share > 0.0);
    let utilisation = |subject: &str, share: f64| share / allowed(subject).max(f64::MIN_POSITIVE);
    let worst = broken.max_by(|a, b| {
        utilisation(&a.subject, a.share).total_cmp(&utilisation(&b.subject, b.share))
    });
    worst.map_or_else(
        || "nothing".into(),
        |one| {
            let fails = one.share > allowed(&one.subject);
            let word = if fails { " FAIL" } else { "" };
            format!("{} {}{word}", one.subject, share(one.share))
        },
    )
}

/// By how much J differs over the range.
fn movement(range: &UnknownRangeRecord, nominal: &OutcomeRecord) -> f64 {
    let all = [&range.at_low, nominal, &range.at_high].map(|effect| effect.objective);
    let (low, high) = extremes(all.into_iter());
    high - low
}

/// By how much the rebound turns from the low to the high end, deg.
fn turn(range: &UnknownRangeRecord) -> Option<f64> {
    Some((range.at_high.rebound_angle_deg? - range.at_low.rebound_angle_deg?).abs())
}

/// Which one moves J most, and by how far each turns the rebound.
fn sentence(unknowns: &UnknownsRecord) -> Option<String> {
    let nominal = &unknowns.nominal;
    let mut ranges: Vec<&UnknownRangeRecord> = unknowns.ranges.iter().collect();
    ranges.sort_by(|a, b| movement(b, nominal).total_cmp(&movement(a, nominal)));
    let (first, others) = ranges.split_first()?;
    let does = |range: &UnknownRangeRecord| {
        let moves = significant(movement(range, nominal), 2);
        match turn(range) {
            Some(turn) => format!("by {moves} and turns the rebound by {} deg", fixed(turn, 1)),
            None => format!("by {moves}; no rebound from the target was seen"),
        }
    };
    let word = word(first.quantity);
    let text = match others {
        [] => format!("Over its range {word} moves J {}.", does(first)),
        _ if movement(first, nominal) <= MOVES * nominal.objective => format!(
            "None of them moves J by more than {} % of it.",
            plain(MOVES * 100.0)
        ),
        _ => {
            let others = others.iter().map(|other| {
                let word = self::word(other.quantity);
                format!("; {word} moves J {}", does(other))
            });
            let others: String = others.collect();
            format!(
                "Over its range {word} moves J most, {}{others}.",
                does(first)
            )
        }
    };
    Some(text)
}

const fn word(quantity: QuantityRecord) -> &'static str {
    match quantity {
        QuantityRecord::Restitution => "restitution",
        QuantityRecord::Friction => "friction",
        QuantityRecord::Walls => "the place of the walls",
    }
}
