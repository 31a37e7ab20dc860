//! J of several settings on the same fresh shots, which no search has seen, with its error from the
//! scatter between independent sets of shots.

use std::ops::Range;

use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::Problem;
use peenpose::problem::setting::Choice;
use peenpose::setup::Setup;
use rayon::prelude::*;

/// Shots of one set.
pub const SHOTS_PER_SET: usize = 1 << 15;
/// Far from every seed that a search is run with.
pub const SEED: u64 = 0x5EED_0F5E_75A9_A127;

/// J of each choice on each of the numbered sets of shots: `[set][choice]`.
pub fn objectives(setup: &Setup, choices: &[Choice], sets: Range<u32>) -> Vec<Vec<f64>> {
    let problem = Problem {
        seed: SEED,
        ..setup.problem.clone()
    };
    let goals = &problem.goals;
    sets.into_par_iter()
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

/// A mean over independent sets.
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    pub value: f64,
    pub standard_error: f64,
}

impl Mean {
    /// The mean of some values; it has no error when there is only one.
    pub fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let value = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|x| (x - value).powi(2)).sum();
        let variance = squares / (count - 1.0).max(1.0);
        Self {
            value,
            standard_error: (variance / count).sqrt(),
        }
    }

    /// The mean of one choice over all sets.
    pub fn of_choice(objectives: &[Vec<f64>], choice: usize) -> Self {
        let values: Vec<f64> = objectives.iter().map(|set| set[choice]).collect();
        Self::of(&values)
    }
}
