//! Comparisons on common validation shots: differences between choices of settings are not noise.

use rayon::prelude::*;

use super::sampling::{SCRAMBLINGS, Sampling};
use crate::elementary::square;
use crate::jet::{Replicates, purpose};
use crate::objective::{Sums, Tally};
use crate::problem::goal::Goals;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// Boundary samples show rare violations, in which good answers differ, with less noise.
pub const COMPARISON: (u32, Sampling) = (purpose::CHART_COMPARISON, Sampling::SobolRim);

/// The sums of each replicate (inner) for each choice (outer), on shots common to all choices.
pub fn sums(
    scenario: &Scenario,
    choices: &[Settings],
    (purpose, sampling): (u32, Sampling),
    shots: usize,
) -> Vec<Vec<Sums>> {
    let goals = &scenario.problem.goals;
    let each = (shots / SCRAMBLINGS).max(1);
    let sets: Vec<Vec<Sums>> = (0..SCRAMBLINGS)
        .into_par_iter()
        .map(|number| {
            let stream = Replicates::stream(purpose, number as u32);
            let samples = sampling.draw(&scenario.problem, stream, each);
            let sums = |settings: &Settings| {
                Tally::trace(scenario, settings, settings.speed, &samples.shots)
                    .sums(goals, settings.speed)
            };
            choices.iter().map(sums).collect()
        })
        .collect();
    let of_choice = |index: usize| sets.iter().map(|set| set[index]).collect();
    (0..choices.len()).map(of_choice).collect()
}

/// J of the replicates that are kept.
pub fn objective(goals: &Goals, sets: &[Sums], kept: impl Fn(usize) -> bool) -> f64 {
    let kept = sets.iter().enumerate().filter(|(index, _)| kept(*index));
    kept.fold(Sums::default(), |total, (_, set)| total.plus(set))
        .terms(goals)
        .total()
}

/// By how much J of some sets is above that of others on the same shots, relative to the latter,
/// and the standard error of that.
pub fn excess(goals: &Goals, sets: &[Sums], over: &[Sums]) -> (f64, f64) {
    jackknife(over.len(), |kept| {
        objective(goals, sets, kept) / objective(goals, over, kept) - 1.0
    })
}

/// A function of `count` independent sets, and its standard error from leaving out one at a time.
pub fn jackknife(count: usize, value: impl Fn(&dyn Fn(usize) -> bool) -> f64) -> (f64, f64) {
    let left_out: Vec<f64> = (0..count)
        .map(|skip| value(&|index| index != skip))
        .collect();
    let mean = left_out.iter().sum::<f64>() / count as f64;
    let squares: f64 = left_out.iter().map(|one| square(one - mean)).sum();
    let error = ((count as f64 - 1.0) / count as f64 * squares).sqrt();
    (value(&|_| true), error)
}
