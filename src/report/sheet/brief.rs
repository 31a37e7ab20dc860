//! The sheet as a terminal shows it at once: the verdict, what to set, what the target gets, what next.

use super::{headline, received, settings};
use crate::record::{Record, StatusRecord};
use crate::report::layout::Block;

/// Lines that a terminal shows at once.
pub const LINES: usize = 25;

/// The head of the sheet in at most [`LINES`] lines; the whole of it is [`sheet`](super::sheet).
pub fn brief(record: &Record) -> String {
    let blocks = [
        Some(headline::block(record)),
        Some(settings::settings(record)),
        received::target(record),
    ];
    let texts: Vec<String> = blocks.into_iter().flatten().map(Block::into_text).collect();
    let mut next = Block::default();
    next.hanging("next         ", next_step(record));
    let next = next.into_text();
    let texts = texts.join("\n");
    let room = LINES - 1 - next.lines().count();
    let shown = texts.lines().take(room).chain([""]).chain(next.lines());
    shown.flat_map(|line| [line, "\n"]).collect()
}

fn next_step(record: &Record) -> &'static str {
    match (record.status, record.passes()) {
        (StatusRecord::NoFeasiblePose, _) => {
            "`--full` says what is in the way and what would make room"
        }
        (StatusRecord::Interrupted, _) | (StatusRecord::BestFound, true) => {
            "`--full` shows the whole sheet; another run with `--checkpoint DIR` goes on from where it ends"
        }
        (_, true) => {
            "`--full` shows the proof; `--out DIR` writes report.html, the pose for a robot and all tables"
        }
        (_, false) => "`--full` says what limits it and what would help",
    }
}
