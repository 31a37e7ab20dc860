//! Brent's method, where a single setting is free.

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentOpt;

use crate::objective::Objective;

struct Line<'a, 'b>(&'a Objective<'b>);

impl CostFunction for Line<'_, '_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, x: &f64) -> Result<f64, Error> {
        Ok(self.0.cost(&[*x])?)
    }
}

const MOST_ITERATIONS: u64 = 200;

pub fn brent(objective: &Objective, _seed: u32) {
    let executor = Executor::new(Line(objective), BrentOpt::new(0.0, 1.0))
        .configure(|state| state.max_iters(MOST_ITERATIONS));
    drop(executor.run());
}
