//! Methods that only divide the cube: DIRECT, and low-discrepancy search.

use basin::{Direct, Executor, PointState};

use crate::bounded::Bounded;
use crate::objective::Objective;

const MOST_ITERATIONS: u64 = 10_000;

pub fn direct(objective: &Objective, _seed: u32) {
    let state = PointState::new(vec![0.5; objective.dimensions()]);
    let executor = Executor::new(Bounded::new(objective), Direct::new(), state);
    drop(executor.max_iter(MOST_ITERATIONS).run());
}

/// Sobol points alone, which are no worse than random ones.
pub fn sobol(objective: &Objective, seed: u32) {
    // Once the run is over no more starts follow.
    objective.many_starts(seed, |point, _| {
        let _ = objective.cost(&point);
    });
}
