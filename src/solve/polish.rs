//! Downhill from a start with argmin's Nelder-Mead method, inside the unit cube.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;

use super::judge::{Judge, Standing};
use super::space::Space;
use crate::problem::setting::Choice;

/// A point of the search with what it is worth.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Coordinates in the unit cube.
    pub point: Vec<f64>,
    /// The settings there, with the best speed.
    pub choice: Choice,
    /// What they are worth on the shots they were judged on.
    pub standing: Standing,
}

impl Candidate {
    /// Judges a point.
    pub fn at(space: &Space, judge: &Judge, point: &[f64]) -> Self {
        let (choice, standing) = judge.judge(&space.choice(point));
        Self {
            point: point.to_vec(),
            choice,
            standing,
        }
    }
}

/// The cost function that argmin sees. It keeps the best point itself: argmin loses it when a run
/// ends early.
struct Descent<'a> {
    space: &'a Space,
    judge: &'a Judge<'a>,
    best: RefCell<Candidate>,
}

impl CostFunction for &Descent<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        if self.judge.is_stopped() {
            // A flat cost ends the run at once.
            return Ok(f64::MAX);
        }
        let candidate = Candidate::at(self.space, self.judge, point);
        let rank = candidate.standing.rank();
        if rank < self.best.borrow().standing.rank() {
            self.best.replace(candidate);
        }
        Ok(rank)
    }
}

/// The best point found from `start` with a first simplex of edge `size`, until the values at the
/// corners differ by less than `accuracy` relative to the best.
pub fn polish(
    space: &Space,
    judge: &Judge,
    start: Candidate,
    size: f64,
    accuracy: f64,
) -> Candidate {
    let dimensions = space.dimensions();
    let scale = start.standing.rank();
    let mut simplex = vec![start.point.clone()];
    for axis in 0..dimensions {
        let mut corner = start.point.clone();
        // Inwards, so that a start on a bound does not make a flat simplex.
        corner[axis] += if corner[axis] > 0.5 { -size } else { size };
        simplex.push(corner);
    }
    let descent = Descent {
        space,
        judge,
        best: RefCell::new(start),
    };
    let solver =
        NelderMead::new(simplex).with_sd_tolerance(accuracy * scale.max(f64::MIN_POSITIVE));
    if let Ok(solver) = solver {
        let executor = Executor::new(&descent, solver)
            .configure(|state| state.max_iters(ITERATIONS_PER_DIMENSION * dimensions as u64));
        // The best point is kept by the cost function; how the run ended does not matter.
        drop(executor.run());
    }
    descent.best.into_inner()
}

const ITERATIONS_PER_DIMENSION: u64 = 40;
