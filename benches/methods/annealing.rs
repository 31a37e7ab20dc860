//! argmin's simulated annealing, with steps that shorten as it cools.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::simulatedannealing::{Anneal, SATempFunc, SimulatedAnnealing};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};

use crate::objective::Objective;

struct Annealed<'a, 'b> {
    objective: &'a Objective<'b>,
    generator: RefCell<Xoshiro256PlusPlus>,
}

impl CostFunction for Annealed<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.objective.cost(point)?)
    }
}

/// Longest step at the first temperature, as a share of each range, and the shortest at the last.
const LONGEST: f64 = 0.5;
const SHORTEST: f64 = 1e-3;
/// In units of ln J.
const FIRST_TEMPERATURE: f64 = 1.0;
/// Factor on the temperature at every step: cold after a thousand.
const COOLING: f64 = 0.993;
const MOST_ITERATIONS: u64 = 1000;

impl Anneal for Annealed<'_, '_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Float = f64;

    fn anneal(&self, point: &Vec<f64>, temperature: f64) -> Result<Vec<f64>, Error> {
        let reach = (LONGEST * temperature / FIRST_TEMPERATURE).clamp(SHORTEST, LONGEST);
        let mut generator = self.generator.borrow_mut();
        let step = |x: &f64| {
            let fraction = generator.next_u64() as f64 / u64::MAX as f64;
            (x + reach * (2.0 * fraction - 1.0)).clamp(0.0, 1.0)
        };
        Ok(point.iter().map(step).collect())
    }
}

pub fn simulated_annealing(objective: &Objective, seed: u32) {
    objective.many_starts(seed, |start, number| {
        let mut generator =
            Xoshiro256PlusPlus::seed_from_u64(u64::from(seed) << 32 | u64::from(number));
        let acceptance = Xoshiro256PlusPlus::seed_from_u64(generator.next_u64());
        let Ok(solver) = SimulatedAnnealing::new_with_rng(FIRST_TEMPERATURE, acceptance) else {
            return;
        };
        let annealed = Annealed {
            objective,
            generator: RefCell::new(generator),
        };
        let solver = solver.with_temp_func(SATempFunc::Exponential(COOLING));
        let executor = Executor::new(annealed, solver)
            .configure(|state| state.param(start).max_iters(MOST_ITERATIONS));
        drop(executor.run());
    });
}
