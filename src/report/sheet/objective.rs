//! The objective: terms that add up to J.

use crate::record::{AnswerRecord, ObjectiveRecord};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{Scale, fixed};

/// The terms with their names.
pub fn terms(objective: &ObjectiveRecord) -> [(&'static str, f64, f64); 4] {
    let [normal, tangential, rebound, miss] = objective.term_standard_errors;
    [
        ("normal_impulse", objective.normal_impulse, normal),
        (
            "tangential_impulse",
            objective.tangential_impulse,
            tangential,
        ),
        ("rebound", objective.rebound, rebound),
        ("miss", objective.miss, miss),
    ]
}

/// The term that makes up most of J, with its share of it.
pub fn dominant(objective: &ObjectiveRecord) -> Option<(&'static str, f64)> {
    let (name, value, _) = terms(objective)
        .into_iter()
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    (objective.total > 0.0).then(|| (name, value / objective.total))
}

/// A row for each term, then the sum; nothing when the nozzle does not fit.
pub fn block(best: &AnswerRecord) -> Option<Block> {
    let objective = best.objective.as_ref()?;
    let scale = Scale::for_error(objective.total, objective.standard_error);
    let mut table = Table::new(&[
        ("OBJECTIVE (weighted)", Align::Left),
        ("value", Align::Right),
        ("std. error", Align::Right),
        ("of J", Align::Right),
    ]);
    let of_total = |value: f64| {
        if objective.total > 0.0 {
            format!("{} %", fixed(value / objective.total * 100.0, 1))
        } else {
            "-".into()
        }
    };
    for (name, value, error) in terms(objective) {
        table.row([
            name.into(),
            scale.text(value),
            scale.error_text(value, error),
            of_total(value),
        ]);
    }
    table.row([
        "J".into(),
        scale.text(objective.total),
        scale.error_text(objective.total, objective.standard_error),
        of_total(objective.total),
    ]);
    let mut block = Block::default();
    block.table(table);
    Some(block)
}
