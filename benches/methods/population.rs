//! Populations: CMA-ES with restarts, and differential evolution.

use basin::{BoundedCmaEs, De, DeMutation, DenseMatrix, Executor, PopulationProgress};

use crate::bounded::Bounded;
use crate::objective::Objective;

/// Standard deviation of the first generation, as a share of each range.
const FIRST_DEVIATION: f64 = 0.3;
/// Below it a distribution has settled.
const LEAST_DEVIATION: f64 = 1e-4;
const MOST_GENERATIONS: u64 = 1000;

/// CMA-ES from start to start, each time with twice the population.
pub fn cma_es(objective: &Objective, seed: u32) {
    let usual = BoundedCmaEs::<Vec<f64>, DenseMatrix>::default_lambda(objective.dimensions());
    objective.many_starts(seed, |start, number| {
        let solver = BoundedCmaEs::<Vec<f64>, DenseMatrix>::new(
            u64::from(seed) << 32 | u64::from(number),
            FIRST_DEVIATION,
        )
        .with_absolute_distribution_size_tolerance(LEAST_DEVIATION)
        .with_lambda(usual << number.min(MOST_DOUBLINGS));
        let state = PopulationProgress::from_point(start);
        let executor = Executor::new(Bounded::new(objective), solver, state);
        drop(executor.max_iter(MOST_GENERATIONS).run());
    });
}

const MOST_DOUBLINGS: u32 = 6;
const MEMBERS: usize = 16;

pub fn differential_evolution(objective: &Objective, seed: u32) {
    let solver = De::new(u64::from(seed))
        .with_pop_size(MEMBERS)
        .with_mutation(DeMutation::CurrentToBest1)
        .with_dither(0.5, 1.0);
    let state = PopulationProgress::<Vec<f64>>::empty();
    let executor = Executor::new(Bounded::new(objective), solver, state);
    drop(executor.max_iter(MOST_GENERATIONS).run());
}
