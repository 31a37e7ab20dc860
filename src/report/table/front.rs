//! The table of a trade-off.

use std::io;

use super::{Rows, Table};
use crate::record::FrontRecord;

/// A row for each answer.
pub(super) fn table(front: &[FrontRecord]) -> io::Result<Table> {
    let mut table = Rows::headed(
        "trade_off",
        &[
            "recommended",
            "contact",
            "mu_s",
            "incidence_deg",
            "azimuth_deg",
            "standoff_m",
            "speed_m_s",
            "aim_along_m",
            "aim_across_m",
            "aim_above_m",
            "target_error",
            "target_error_standard_error",
            "tangential",
            "tangential_standard_error",
            "rebound",
            "rebound_standard_error",
            "total",
            "fails",
        ],
    )?;
    for point in front {
        let at = &point.settings;
        let [target, tangential, rebound] = point.objectives();
        table.row(&[
            &point.recommended,
            &point.contact,
            &point.mu_s,
            &at.incidence_deg,
            &at.azimuth_deg,
            &at.standoff_m,
            &at.speed_m_s,
            &at.aim_along_m,
            &at.aim_across_m,
            &at.aim_above_m,
            &target.0,
            &target.1,
            &tangential.0,
            &tangential.1,
            &rebound.0,
            &rebound.1,
            &point.objective.total,
            &point.fails.join(" "),
        ])?;
    }
    table.finish()
}
