//! Randomised-QMC replicates: independent scramblings of the same jet.

use rayon::prelude::*;

use super::qmc_point::Stream;
use super::samples::Samples;
use super::validation::Draw;
use crate::problem::Problem;

/// Randomised-QMC replicates of the same jet; their scatter gives the standard error of an average.
#[derive(Clone, Debug)]
pub struct Replicates {
    /// One for each replicate.
    pub sets: Vec<Replicate>,
}

/// The shots of one replicate.
#[derive(Clone, Debug)]
pub struct Replicate {
    /// Shots as the jet fires them.
    pub jet: Samples,
    /// Shots drawn towards the boundary, half of them with an importance density. Weighted averages over both
    /// sets estimate the same as those over the jet alone, and see rare violations.
    pub boundary: Samples,
}

impl Replicates {
    /// Number of replicates.
    pub const COUNT: usize = 32;

    /// One of the streams of validation shots for a [`purpose`](super::purpose).
    pub fn stream(purpose: u32, number: u32) -> Stream {
        Stream::Validation(purpose * Self::COUNT as u32 + number)
    }

    /// Validation shots of the jet, rounded up to a multiple of [`Self::COUNT`], and half as many on the
    /// boundary. Sets for different [purposes](super::purpose) are independent of each other and of every
    /// search.
    pub fn new(problem: &Problem, purpose: u32, shots: usize) -> Self {
        Self::of(&Draw::new(problem, purpose, shots))
    }

    /// Validation shots of the jet alone: for shares of shots.
    pub fn without_boundary(problem: &Problem, purpose: u32, shots: usize) -> Self {
        Self::of(&Draw::new(problem, purpose, shots).without_boundary())
    }

    fn of(draw: &Draw) -> Self {
        let numbers = (0..draw.sets()).into_par_iter();
        Self {
            sets: numbers.map(|number| draw.set(number)).collect(),
        }
    }

    /// Number of shots of the jet in all sets together.
    pub fn shots(&self) -> usize {
        self.sets.iter().map(|set| set.jet.shots.len()).sum()
    }
}
