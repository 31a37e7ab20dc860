//! Quasi-Newton methods on finite differences: argmin's L-BFGS, and L-BFGS-B, which knows bounds.

use argmin::core::{Error, Executor, Gradient};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;
use basin::{FirstOrderState, Lbfgsb};

use crate::bounded::Bounded;
use crate::objective::{Objective, Over};
use crate::simplex::Cost;

/// Pairs of steps that the curvature is estimated from.
const MEMORY: usize = 7;
/// Where differences mean nothing, a line search gets nowhere at any length: then starts count.
const MOST_ITERATIONS: u64 = 20;

impl Gradient for Cost<'_, '_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, point: &Vec<f64>) -> Result<Vec<f64>, Error> {
        Ok(self.0.gradient(point)?)
    }
}

pub fn lbfgs(objective: &Objective, seed: u32) {
    objective.many_starts(seed, |start, _| {
        let solver = LBFGS::new(MoreThuenteLineSearch::new(), MEMORY);
        let executor = Executor::new(Cost(objective), solver)
            .configure(|state| state.param(start).max_iters(MOST_ITERATIONS));
        drop(executor.run());
    });
}

impl basin::Gradient for Bounded<'_, '_> {
    type Gradient = Vec<f64>;

    fn gradient(&self, point: &Vec<f64>) -> Result<Vec<f64>, Over> {
        self.objective.gradient(point)
    }
}

pub fn lbfgsb(objective: &Objective, seed: u32) {
    objective.many_starts(seed, |start, _| {
        let solver = Lbfgsb::new().with_m_capacity(MEMORY);
        let problem = Bounded::new(objective);
        let executor = basin::Executor::new(problem, solver, FirstOrderState::new(start));
        drop(executor.max_iter(MOST_ITERATIONS).run());
    });
}
