//! argmin's Nelder-Mead method: once from the middle, from many starts, and from the best of a screen.

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;

use crate::objective::Objective;

/// The objective as argmin wants it.
pub struct Cost<'a, 'b>(pub &'a Objective<'b>);

impl CostFunction for Cost<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        // Nelder-Mead panics on an error while it shrinks; so a run that is over sees a flat cost.
        Ok(self.0.cost(point).unwrap_or(f64::MAX))
    }
}

/// Edge of the first simplex.
const EDGE: f64 = 0.25;
/// A run ends when ln J scatters by less over the simplex.
const SETTLED: f64 = 1e-5;
const MOST_ITERATIONS: u64 = 500;

fn descend(objective: &Objective, start: Vec<f64>, edge: f64) {
    let mut simplex = vec![start.clone()];
    for axis in 0..start.len() {
        let mut corner = start.clone();
        corner[axis] += if corner[axis] > 0.5 { -edge } else { edge };
        simplex.push(corner);
    }
    if let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(SETTLED) {
        let executor = Executor::new(Cost(objective), solver)
            .configure(|state| state.max_iters(MOST_ITERATIONS));
        // The objective keeps the best point itself; that the run is over is no failure.
        drop(executor.run());
    }
}

pub fn once(objective: &Objective, _seed: u32) {
    descend(objective, vec![0.5; objective.dimensions()], EDGE);
}

pub fn multistart(objective: &Objective, seed: u32) {
    objective.many_starts(seed, |start, _| descend(objective, start, EDGE));
}

/// Points of the screen.
const SCREEN: u32 = 64;

/// A screen, then down from its points, best first.
pub fn screened(objective: &Objective, seed: u32) {
    screened_from(objective, seed, SCREEN);
}

/// Down from every point of a large screen whose J is among the best: what is found counts as the
/// best on these shots.
pub fn thorough(objective: &Objective, seed: u32) {
    screened_from(objective, seed, 16 * SCREEN);
}

fn screened_from(objective: &Objective, seed: u32, points: u32) {
    let points = (0..points).map(|index| objective.start(index, seed));
    let mut screen: Vec<(f64, Vec<f64>)> = points
        .filter_map(|point| Some((objective.cost(&point).ok()?, point)))
        .collect();
    screen.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, start) in screen {
        if objective.is_over() {
            return;
        }
        descend(objective, start, 0.5 * EDGE);
    }
}
