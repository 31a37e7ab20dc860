//! The technique sheet: what to set, whether it passes, what limits it; then the proof.

pub(super) mod blocked;
mod brief;
pub(super) mod cause;
pub(super) mod closing;
pub(super) mod contacts;
pub(super) mod coverage;
pub(super) mod front;
pub(super) mod headline;
pub(super) mod model;
pub(super) mod objective;
mod origins;
pub(super) mod received;
mod scatter;
pub(crate) mod setting;
pub(super) mod settings;
pub(super) mod stroke;
pub(super) mod subject;
pub(super) mod unknowns;
pub(super) mod verdicts;

pub use brief::{LINES, brief};

use super::layout::Block;
use crate::record::Record;

/// The technique sheet as text.
pub fn sheet(record: &Record) -> String {
    let best = &record.best;
    let blocks: [Option<Block>; 18] = [
        Some(headline::block(record)),
        Some(settings::settings(record)),
        settings::pose(record),
        stroke::block(record),
        blocked::cures(record),
        received::target(record),
        verdicts::block(best, &record.problem.goals),
        received::surfaces(record),
        coverage::block(record),
        cause::block(record),
        unknowns::block(record),
        objective::block(best),
        contacts::block(record),
        front::block(record),
        closing::validity(record),
        model::block(record),
        Some(closing::reproduce(record)),
        Some(closing::work(record)),
    ];
    let texts: Vec<String> = blocks.into_iter().flatten().map(Block::into_text).collect();
    texts.join("\n")
}
