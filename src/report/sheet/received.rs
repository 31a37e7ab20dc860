//! What the target and its neighbours receive.

use crate::record::{AnswerRecord, ReceiptRecord, Record, SpreadRecord};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{
    fixed, impulse, impulse_asked, plural, share, share_asked, significant,
};

/// N* and f* on the target against what was asked.
pub fn target(record: &Record) -> Option<Block> {
    let (best, goals) = (&record.best, &record.problem.goals);
    let target = best.target.as_ref()?;
    let hit = target.share_on_target > 0.0;
    if !hit {
        let mut block = Block::titled("TARGET");
        block.paragraph(&missed(best, &target.surface));
        block.paragraph_if(!best.feasible, AS_IF_FREE);
        return Some(block);
    }
    let mut block = Block::default();
    let mut table = Table::new(&[
        ("TARGET", Align::Left),
        ("mean", Align::Right),
        ("5 %", Align::Right),
        ("95 %", Align::Right),
        ("largest", Align::Right),
        ("wanted", Align::Left),
    ]);
    let row = |name: &str, spread: &SpreadRecord, wanted: String| {
        [
            name.into(),
            impulse(spread.mean),
            impulse(spread.low_5),
            impulse(spread.high_95),
            impulse(spread.largest),
            wanted,
        ]
    };
    let wanted = format!(
        "{} +- {}",
        impulse_asked(goals.normal_impulse),
        share_asked(goals.normal_impulse_tolerance)
    );
    table.row(row("N* normal, uN.s", &target.normal_impulse, wanted));
    let limit = goals.tangential_impulse.map_or_else(
        || "no limit".into(),
        |limit| format!("at most {}", impulse_asked(limit)),
    );
    table.row(row(
        "f* tangential, uN.s",
        &target.tangential_impulse,
        limit,
    ));
    block.table(table);
    if best.shots == 1 {
        let sticking = if target.share_sticking == 0.0 {
            "slide"
        } else {
            "grip"
        };
        block.paragraph(&format!(
            "All shots are the same: they hit {} first and {sticking}.",
            target.surface
        ));
    } else {
        block.paragraph(&format!(
            "{} of {} hit {} first; {}.",
            share(target.share_on_target),
            plural(best.shots, "shot"),
            target.surface,
            match target.share_sticking {
                0.0 => "all of these slide".into(),
                1.0 => "all of these grip, none slides".into(),
                sticking => format!("{} of these grip, the others slide", share(sticking)),
            }
        ));
    }
    block.paragraph_if(!best.feasible, AS_IF_FREE);
    Some(block)
}

const AS_IF_FREE: &str =
    "Figures here and below are those of a jet from there, as if the body were not in the way.";

/// That no shot hits the target.
fn missed(best: &AnswerRecord, surface: &str) -> String {
    match best.shots {
        0 => "No shot was traced.".into(),
        1 => format!("All shots are the same, and none hits {surface} first."),
        shots => format!("NONE of {} hits {surface} first.", plural(shots, "shot")),
    }
}

/// What every secondary surface receives; those that are never hit in one line.
pub fn surfaces(record: &Record) -> Option<Block> {
    let best = &record.best;
    if best.surfaces.is_empty() {
        return None;
    }
    let mut table = Table::new(&[
        ("OTHER SURFACES, N* in uN.s", Align::Left),
        ("shots", Align::Right),
        ("95 %", Align::Right),
        ("largest", Align::Right),
        ("allowed", Align::Right),
        ("utilisation", Align::Right),
        ("hit by", Align::Left),
    ]);
    let mut hit: Vec<(&String, &ReceiptRecord, SpreadRecord)> = Vec::new();
    let mut never: Vec<String> = Vec::new();
    for (name, receipt) in &best.surfaces {
        match receipt.normal_impulse {
            Some(spread) if receipt.share_of_shots > 0.0 => hit.push((name, receipt, spread)),
            _ => never.push(shown_name(record, name)),
        }
    }
    let utilisation = |receipt: &ReceiptRecord, spread: &SpreadRecord| {
        receipt.allow.map(|allow| spread.largest / allow)
    };
    hit.sort_by(|a, b| {
        let key = |(_, receipt, _): &(&String, &ReceiptRecord, SpreadRecord)| {
            (receipt.share_over, receipt.share_of_shots)
        };
        key(b)
            .partial_cmp(&key(a))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    for (name, receipt, spread) in &hit {
        table.row([
            shown_name(record, name),
            share(receipt.share_of_shots),
            impulse(spread.high_95),
            impulse(spread.largest),
            receipt
                .allow
                .map_or_else(|| "any".into(), |allow| significant(allow * 1e6, 3)),
            utilisation(receipt, spread)
                .map_or_else(|| "-".into(), |it| format!("{} %", fixed(it * 100.0, 0))),
            mainly(receipt),
        ]);
    }
    let mut block = if hit.is_empty() {
        Block::titled("OTHER SURFACES")
    } else {
        let mut block = Block::default();
        block.table(table);
        block
    };
    if !never.is_empty() {
        block.hanging(
            "never hit:  ",
            &format!("{} ({})", never.join(", "), never_means(best, never.len())),
        );
    }
    if hit.iter().any(|(_, receipt, _)| receipt.allow.is_some()) {
        block.paragraph(
            "Utilisation is the largest N* over the allowed N*; VERDICTS counts the shots above it.",
        );
    }
    Some(block)
}

/// The target's own surface is secondary outside the patch.
pub fn shown_name(record: &Record, name: &str) -> String {
    match &record.best.target {
        Some(target) if target.surface == name => format!("{name} off target"),
        _ => name.into(),
    }
}

/// What zero hits among this many shots mean.
fn never_means(best: &AnswerRecord, surfaces: usize) -> String {
    if best.shots == 0 {
        return "no shot was traced".into();
    }
    if best.shots == 1 {
        return "all shots are the same, and none does".into();
    }
    let each = if surfaces == 1 { "" } else { "each " };
    format!(
        "{each}by less than {} % of the shots",
        significant((300.0 / best.shots as f64).min(100.0), 2)
    )
}

/// Which impact of a path it mainly is that hits a surface.
pub fn mainly(receipt: &ReceiptRecord) -> String {
    let counts = &receipt.impacts_per_shot_by_number;
    let total: f64 = counts.iter().sum();
    let Some((index, most)) = counts
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)))
    else {
        return String::new();
    };
    let by = match index {
        0 => "direct hit".into(),
        1 => "1st bounce".into(),
        2 => "2nd bounce".into(),
        3 => "3rd bounce".into(),
        later => format!("{later}th bounce"),
    };
    if *most >= total {
        by
    } else {
        format!("{by} {} %", fixed((most / total * 100.0).min(99.0), 0))
    }
}
