//! Targets that no setting can hit, and nozzles that fit nowhere.

use rayon::prelude::*;

use crate::feasibility::infeasibility;
use crate::jet::{Samples, Stream};
use crate::objective::Tally;
use crate::problem::setting::Settings;
use crate::problem::warning::{Warning, WarningCode};
use crate::scenario::Scenario;
use crate::solve::spread_settings;

/// Settings that are tried.
const PLACES: usize = 512;
/// Shots at each.
const SHOTS: usize = 8;

pub(super) fn warning(scenario: &Scenario) -> Option<Warning> {
    let contact = scenario.problem.ranges.contact.first().copied()?;
    let choices = spread_settings(scenario, contact, PLACES);
    let fits = |settings: &&Settings| infeasibility(scenario, settings).is_none();
    let shots = Samples::new(&scenario.problem, Stream::Search, SHOTS).shots;
    let hits = |settings: &Settings| {
        let tally = Tally::trace(scenario, settings, settings.speed, &shots);
        !tally.hits.is_empty()
    };
    if choices.par_iter().filter(fits).any(hits) {
        return None;
    }
    let tried = match choices.len() {
        1 => "the given settings".into(),
        count => format!("any of {count} settings all over the ranges"),
    };
    let fits_somewhere = choices.par_iter().any(|settings| fits(&settings));
    Some(if fits_somewhere {
        Warning::new(
            WarningCode::TargetOutOfSight,
            "target",
            format!("no shot hits it first with {tried}"),
            "compare `aim`, `along`, `facing` and the ranges of the settings",
        )
    } else {
        Warning::new(
            WarningCode::NozzleFitsNowhere,
            "settings",
            format!("the nozzle does not fit with {tried}"),
            "compare `nozzle.body`, `nozzle.clearance` and the range of `standoff`",
        )
    })
}
