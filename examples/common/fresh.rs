//! J of several settings on the same fresh shots, which no search has seen.

use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::Problem;
use peenpose::problem::setting::Choice;
use peenpose::setup::Setup;
use rayon::prelude::*;

/// Shots of one set.
const SHOTS_PER_SET: usize = 1 << 13;
/// Far from every seed that a search is run with.
pub const SEED: u64 = 0x5EED_0F5E_75A9_A127;

/// J of each choice on each set of shots, `[set][choice]`: as many sets as hold `shots`, at least two.
/// They are numbered from `first` on; sets with other numbers are independent.
pub fn objectives(setup: &Setup, choices: &[Choice], first: u32, shots: usize) -> Vec<Vec<f64>> {
    let sets = shots.div_ceil(SHOTS_PER_SET).max(2) as u32;
    let problem = Problem {
        seed: SEED,
        ..setup.problem.clone()
    };
    let goals = &problem.goals;
    (first..first + sets)
        .into_par_iter()
        .map(|number| {
            let samples = Samples::new(&problem, Stream::Fresh(number), SHOTS_PER_SET);
            let objective = |choice: &Choice| {
                Tally::trace(setup, choice, choice.speed, &samples.deviates)
                    .terms(goals, choice.speed)
                    .total()
            };
            choices.iter().map(objective).collect()
        })
        .collect()
}
