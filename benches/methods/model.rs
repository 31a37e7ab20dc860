//! Methods that model the objective: BOBYQA by a quadratic, COBYLA by a plane, from many starts.

use basin::{Bobyqa, Cobyla, Executor, PointState, SelectedState};

use crate::bounded::Bounded;
use crate::objective::Objective;

/// Radius of the first model and of the last, as a share of each range.
const FIRST_RADIUS: f64 = 0.1;
const LAST_RADIUS: f64 = 1e-4;
const MOST_ITERATIONS: u64 = 1000;

pub fn bobyqa(objective: &Objective, seed: u32) {
    objective.many_starts(seed, |start, _| {
        let solver = Bobyqa::new()
            .with_initial_radius(FIRST_RADIUS)
            .with_final_radius(LAST_RADIUS);
        let executor = Executor::new(Bounded::new(objective), solver, PointState::new(start));
        drop(executor.max_iter(MOST_ITERATIONS).run());
    });
}

pub fn cobyla(objective: &Objective, seed: u32) {
    objective.many_starts(seed, |start, _| {
        let solver = Cobyla::new()
            .with_initial_radius(FIRST_RADIUS)
            .with_final_radius(LAST_RADIUS);
        let executor = Executor::new(Bounded::new(objective), solver, SelectedState::new(start));
        drop(executor.max_iter(MOST_ITERATIONS).run());
    });
}
