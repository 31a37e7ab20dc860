//! Windows: how far a setting may drift from where it is.

use super::super::{DriftRecord, Record, WindowRecord};
use super::place::{Outcome, Place};
use crate::problem::setting::Setting;

/// Ends of windows are found by halving: they may lie a little on the wrong side of the setting.
const SLACK: f64 = 1e-3;

pub(super) fn check(at: &Place, window: &WindowRecord, record: &Record) -> Outcome {
    let settings = &record.best.settings;
    let is_it = |setting: &Setting| setting.record_key() == window.setting;
    let Some(setting) = Setting::ALL.into_iter().find(is_it) else {
        return at.of("setting").holds(false, "is none of the settings");
    };
    let value = settings
        .get(setting)
        .unwrap_or(record.best.contact_values.mu_s);
    let (down, up) = (&window.down, &window.up);
    let slack = SLACK * value.abs().max(down.to.abs()).max(up.to.abs());
    let lies_within = down.to <= value + slack && value <= up.to + slack;
    at.holds_or(lies_within, || {
        format!(
            "goes from {} to {}, but the setting is {value}",
            down.to, up.to
        )
    })?;
    drift(&at.of("down"), down)?;
    drift(&at.of("up"), up)
}

fn drift(at: &Place, drift: &DriftRecord) -> Outcome {
    at.of("within").at_least(drift.within, 0.0)?;
    let ends = drift.turns.is_some() || drift.within == 0.0;
    at.of("turns")
        .holds(ends, "is absent, but something turns beyond `to`")
}
