//! J of several settings on the same fresh shots, which no search has seen.

use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::Problem;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use rayon::prelude::*;

use super::statistics::Mean;

/// Shots of one set.
const SHOTS_PER_SET: usize = 1 << 13;
/// Far from every seed that a search is run with.
pub const SEED: u64 = 0x5EED_0F5E_75A9_A127;

/// J of each choice on each set of shots, `[set][settings]`: as many sets as hold `shots`, at least two.
/// They are numbered from `first` on; sets with other numbers are independent.
pub fn objectives(
    scenario: &Scenario,
    choices: &[Settings],
    first: u32,
    shots: usize,
) -> Vec<Vec<f64>> {
    let sets = shots.div_ceil(SHOTS_PER_SET).max(2) as u32;
    let problem = Problem {
        seed: SEED,
        ..scenario.problem.clone()
    };
    let goals = &problem.goals;
    (first..first + sets)
        .into_par_iter()
        .map(|number| {
            let samples = Samples::new(&problem, Stream::Validation(number), SHOTS_PER_SET);
            let objective = |settings: &Settings| {
                Tally::trace(scenario, settings, settings.speed, &samples.shots)
                    .terms(goals, settings.speed)
                    .total()
            };
            choices.iter().map(objective).collect()
        })
        .collect()
}

/// By how much J of each choice found is above that of the best of those known, relative to it, with
/// the error of this on common shots; see [`objectives`].
pub fn excesses(
    scenario: &Scenario,
    known: &[Settings],
    found: &[Settings],
    first: u32,
    shots: usize,
) -> Vec<Mean> {
    let choices = [known, found].concat();
    let objectives = objectives(scenario, &choices, first, shots);
    let mean = |index: usize| Mean::of_choice(&objectives, index).value;
    let best = (0..known.len()).min_by(|&a, &b| mean(a).total_cmp(&mean(b)));
    let reference = best.unwrap_or(0);
    let scale = mean(reference);
    (known.len()..choices.len())
        .map(|index| {
            let differences = objectives.iter().map(|set| set[index] - set[reference]);
            Mean::of(differences.map(|difference| difference / scale))
        })
        .collect()
}
