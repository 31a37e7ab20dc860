//! The verdicts: how many shots break each goal, against how many may.

use super::subject;
use crate::record::{AnswerRecord, GoalsRecord, VerdictRecord};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{fixed, plain, share_with_interval};

/// One row for each verdict; nothing when nothing was evaluated.
pub fn block(best: &AnswerRecord, goals: &GoalsRecord) -> Option<Block> {
    if best.verdicts.is_empty() {
        return None;
    }
    let mut table = Table::new(&[
        ("VERDICTS, shares in %", Align::Left),
        ("", Align::Left),
        ("share", Align::Right),
        ("95 % interval", Align::Left),
        ("allowed", Align::Right),
        ("margin", Align::Right),
        ("counted when", Align::Left),
    ]);
    for verdict in &best.verdicts {
        let broken_by = subject::broken_when(&verdict.subject, goals, best);
        if subject::is_of_pose(&verdict.subject) {
            let nothing = || "-".to_owned();
            table.row([
                verdict.subject.clone(),
                word(verdict).into(),
                nothing(),
                nothing(),
                nothing(),
                nothing(),
                broken_by,
            ]);
            continue;
        }
        let (share, interval) = if verdict.counted == 0 {
            ("-".into(), "nothing counted".into())
        } else {
            share_with_interval(verdict.share, verdict.interval_95)
        };
        table.row([
            verdict.subject.clone(),
            word(verdict).into(),
            share,
            interval,
            plain(verdict.allowed * 100.0),
            margin(verdict),
            broken_by,
        ]);
    }
    let mut block = Block::default();
    block.table(table);
    if best.verdicts.iter().any(|verdict| !verdict.certain) {
        block
            .paragraph("near: the interval reaches over what is allowed; more shots would decide.");
    }
    Some(block)
}

/// PASS or FAIL, marked where the shots do not decide it for certain.
pub fn word(verdict: &VerdictRecord) -> &'static str {
    match (verdict.passes, verdict.certain || verdict.counted == 0) {
        (true, true) => "PASS",
        (true, false) => "PASS near",
        (false, true) => "FAIL",
        (false, false) => "FAIL near",
    }
}

/// What is left of the allowed share, in percent of the shots.
fn margin(verdict: &VerdictRecord) -> String {
    if verdict.counted == 0 {
        return "-".into();
    }
    let percent = (verdict.allowed - verdict.share) * 100.0;
    let decimals = if percent.abs() < 1.0 { 2 } else { 1 };
    fixed(percent, decimals)
}
