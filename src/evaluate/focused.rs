//! Evaluations on fresh shots of which a part is drawn from where harm comes from.

use rayon::prelude::*;

use super::harm::importance_of;
use super::ledger::Ledger;
use super::{Evaluation, summed_up};
use crate::jet::{Draw, ImportanceDensity, PendingReplicate, ValidationSample};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// Evaluates `settings` on fresh shots, half of those on the rim drawn [from where harm comes
/// from](super::importance_of) with these settings.
pub fn evaluate_adaptively(
    scenario: &Scenario,
    settings: &Settings,
    validation: &ValidationSample,
) -> Evaluation {
    on_focus(scenario, settings, |importance| {
        let sets = validation.sets.par_iter();
        // Each set is copied when it is fired: all of them together do not fit into a cache.
        sets.map(|set| {
            Ledger::of(
                scenario,
                settings,
                &set.focused(&scenario.problem, importance),
            )
        })
        .collect()
    })
}

/// The same for several choices; a few of them share what it takes to fetch a set from memory.
pub fn evaluate_each_adaptively(
    scenario: &Scenario,
    choices: &[Settings],
    validation: &ValidationSample,
) -> Vec<Evaluation> {
    let few = choices.chunks(MOST_TOGETHER);
    few.flat_map(|few| evaluate_few_adaptively(scenario, few, validation))
        .collect()
}

/// What more shots do than those of so many choices is not kept at the same time.
const MOST_TOGETHER: usize = 4;

fn evaluate_few_adaptively(
    scenario: &Scenario,
    choices: &[Settings],
    validation: &ValidationSample,
) -> Vec<Evaluation> {
    let foci = choices.par_iter().map(|it| importance_of(scenario, it));
    let foci: Vec<(ImportanceDensity, usize)> = foci.collect();
    let on_set = |set: &PendingReplicate| {
        let mut shots = set.open();
        let pairs = choices.iter().zip(&foci);
        let ledger = |(settings, (importance, _)): (&Settings, &(ImportanceDensity, usize))| {
            set.importance(&mut shots, &scenario.problem, importance);
            Ledger::of(scenario, settings, &shots)
        };
        pairs.map(ledger).collect()
    };
    let of_sets: Vec<Vec<Ledger>> = validation.sets.par_iter().map(on_set).collect();
    let mut of_choices: Vec<Vec<Ledger>> = choices.iter().map(|_| Vec::new()).collect();
    for ledgers in of_sets {
        for (of_choice, ledger) in of_choices.iter_mut().zip(ledgers) {
            of_choice.push(ledger);
        }
    }
    let pairs = of_choices
        .into_par_iter()
        .zip(choices.par_iter().zip(&foci));
    let found = pairs.map(|(ledgers, (settings, (_, rays)))| {
        summed_up(scenario, settings, ledgers).with_rays(*rays)
    });
    found.collect()
}

/// The same as [`evaluate_adaptively`] on shots that are forgotten once they are fired, as [`ValidationSample`] ones of
/// the same number would take 230 bytes a shot.
pub fn evaluate_streamed(
    scenario: &Scenario,
    settings: &Settings,
    validation: &Draw,
) -> Evaluation {
    on_focus(scenario, settings, |importance| {
        let validation = validation.focused(importance);
        let numbers = (0..validation.sets()).into_par_iter();
        numbers
            .map(|number| Ledger::of(scenario, settings, &validation.set(number)))
            .collect()
    })
}

/// Sums up what shots do that are drawn by a focus on the harm of `settings`; its scouts' rays count.
fn on_focus(
    scenario: &Scenario,
    settings: &Settings,
    fire: impl FnOnce(&ImportanceDensity) -> Vec<Ledger>,
) -> Evaluation {
    let (importance, rays) = importance_of(scenario, settings);
    summed_up(scenario, settings, fire(&importance)).with_rays(rays)
}

impl Evaluation {
    /// The same after more rays.
    fn with_rays(self, more: usize) -> Self {
        Self {
            rays: self.rays + more,
            ..self
        }
    }
}
