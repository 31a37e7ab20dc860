//! The technique sheet: what to set, whether it passes, what limits it; then the proof.

mod blocked;
mod cause;
mod closing;
mod contacts;
mod coverage;
mod front;
mod headline;
mod model;
mod objective;
mod received;
mod scatter;
pub(super) mod setting;
mod settings;
mod subject;
mod unknowns;
mod verdicts;

use super::layout::Block;
use crate::record::Record;

/// The technique sheet as text.
pub fn sheet(record: &Record) -> String {
    let best = &record.best;
    let blocks: [Option<Block>; 17] = [
        Some(headline::block(record)),
        Some(settings::settings(record)),
        settings::pose(best),
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
