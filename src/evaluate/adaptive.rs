//! Evaluation on validation shots, a part of them drawn with an importance density for the settings.

use rayon::prelude::*;

use super::replicate_stats::ReplicateStats;
use super::violations::importance_of;
use super::{Evaluation, summed_up};
use crate::jet::{Draw, ImportanceDensity, PendingReplicate, ValidationSample};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// Evaluates `settings` on validation shots, half of the boundary samples drawn with the
/// [importance density](super::importance_of) of these settings.
pub fn evaluate_adaptively(
    scenario: &Scenario,
    settings: &Settings,
    validation: &ValidationSample,
) -> Evaluation {
    with_importance_of(scenario, settings, |importance| {
        let sets = validation.sets.par_iter();
        // Each set is copied when it is fired: all of them together do not fit into a cache.
        sets.map(|set| {
            ReplicateStats::of(
                scenario,
                settings,
                &set.with_importance(&scenario.problem, importance),
            )
        })
        .collect()
    })
}

/// The same for several settings; a few of them share the cost of fetching a set from memory.
pub fn evaluate_each_adaptively(
    scenario: &Scenario,
    choices: &[Settings],
    validation: &ValidationSample,
) -> Vec<Evaluation> {
    let few = choices.chunks(MOST_TOGETHER);
    few.flat_map(|few| evaluate_few_adaptively(scenario, few, validation))
        .collect()
}

/// Statistics of at most this many settings are in memory at the same time.
const MOST_TOGETHER: usize = 4;

fn evaluate_few_adaptively(
    scenario: &Scenario,
    choices: &[Settings],
    validation: &ValidationSample,
) -> Vec<Evaluation> {
    let importance_densities = choices.par_iter().map(|it| importance_of(scenario, it));
    let importance_densities: Vec<(ImportanceDensity, usize)> = importance_densities.collect();
    let on_set = |set: &PendingReplicate| {
        let mut shots = set.open();
        let pairs = choices.iter().zip(&importance_densities);
        let stats = |(settings, (importance, _)): (&Settings, &(ImportanceDensity, usize))| {
            set.draw_by(&mut shots, &scenario.problem, importance);
            ReplicateStats::of(scenario, settings, &shots)
        };
        pairs.map(stats).collect()
    };
    let of_sets: Vec<Vec<ReplicateStats>> = validation.sets.par_iter().map(on_set).collect();
    let mut of_choices: Vec<Vec<ReplicateStats>> = choices.iter().map(|_| Vec::new()).collect();
    for stats in of_sets {
        for (of_choice, stats) in of_choices.iter_mut().zip(stats) {
            of_choice.push(stats);
        }
    }
    let pairs = of_choices
        .into_par_iter()
        .zip(choices.par_iter().zip(&importance_densities));
    let found = pairs.map(|(stats, (settings, (_, rays)))| {
        summed_up(scenario, settings, stats).with_rays(*rays)
    });
    found.collect()
}

/// The same as [`evaluate_adaptively`] on shots that are drawn when they are fired: a [`ValidationSample`]
/// takes 230 bytes a shot.
pub fn evaluate_streamed(
    scenario: &Scenario,
    settings: &Settings,
    validation: &Draw,
) -> Evaluation {
    with_importance_of(scenario, settings, |importance| {
        let validation = validation.with_importance(importance);
        let numbers = (0..validation.sets()).into_par_iter();
        numbers
            .map(|number| ReplicateStats::of(scenario, settings, &validation.set(number)))
            .collect()
    })
}

/// Sums up shots that are drawn with an importance density for `settings`; the rays of its pilot runs count.
fn with_importance_of(
    scenario: &Scenario,
    settings: &Settings,
    fire: impl FnOnce(&ImportanceDensity) -> Vec<ReplicateStats>,
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
