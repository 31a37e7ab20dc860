//! Targets that no setting can hit, and nozzles that fit nowhere.

use rayon::prelude::*;

use crate::feasibility::infeasibility;
use crate::jet::{Samples, Stream};
use crate::objective::Tally;
use crate::problem::setting::Choice;
use crate::problem::warning::{Doubt, Warning};
use crate::setup::Setup;
use crate::solve::spread_choices;

/// Settings that are tried.
const PLACES: usize = 512;
/// Shots at each.
const SHOTS: usize = 8;

pub(super) fn warning(setup: &Setup) -> Option<Warning> {
    let contact = setup.problem.settings.contact.first().copied()?;
    let choices = spread_choices(setup, contact, PLACES);
    let fits = |choice: &&Choice| infeasibility(setup, choice).is_none();
    let shots = Samples::new(&setup.problem, Stream::Search, SHOTS).deviates;
    let hits = |choice: &Choice| {
        let tally = Tally::trace(setup, choice, choice.speed, &shots);
        !tally.hits.is_empty()
    };
    if choices.par_iter().filter(fits).any(hits) {
        return None;
    }
    let tried = match choices.len() {
        1 => "the given settings".into(),
        count => format!("any of {count} settings all over the ranges"),
    };
    let fits_somewhere = choices.par_iter().any(|choice| fits(&choice));
    Some(if fits_somewhere {
        Warning::new(
            Doubt::TargetOutOfSight,
            "target",
            format!("no shot hits it first with {tried}"),
            "compare `aim`, `along`, `facing` and the ranges of the settings",
        )
    } else {
        Warning::new(
            Doubt::NozzleFitsNowhere,
            "settings",
            format!("the nozzle does not fit with {tried}"),
            "compare `nozzle.body`, `nozzle.clearance` and the range of `standoff`",
        )
    })
}
