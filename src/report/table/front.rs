//! The table of a trade-off.

use std::io;

use super::{Rows, Table};
use crate::record::FrontRecord;
use crate::report::sheet::setting::SETTINGS;

/// A row for each answer.
pub(super) fn table(front: &[FrontRecord]) -> io::Result<Table> {
    let columns = [
        &["recommended", "contact", "mu_s"][..],
        &SETTINGS.map(|setting| setting.key),
        &[
            "target_error",
            "target_error_standard_error",
            "tangential",
            "tangential_standard_error",
            "rebound",
            "rebound_standard_error",
            "total",
            "fails",
        ],
    ];
    let mut table = Rows::headed("trade_off", &columns.concat())?;
    for point in front {
        let settings = SETTINGS.map(|setting| setting.in_record(&point.settings));
        let objectives = point.objectives().map(|(value, error)| [value, error]);
        let numbers = [
            &settings[..],
            &objectives.concat(),
            &[point.objective.total],
        ]
        .concat();
        let names = [
            point.recommended.to_string(),
            point.contact.clone(),
            point.mu_s.to_string(),
        ];
        let numbers = numbers.iter().map(ToString::to_string);
        table.texts(
            names
                .into_iter()
                .chain(numbers)
                .chain([point.fails.join(" ")]),
        )?;
    }
    table.finish()
}
