//! J on the shots of one seed as a function on the unit cube, with an account of what it cost to
//! come down.

use std::cell::{Cell, RefCell};
use std::fmt;
use std::time::Instant;

use peenpose::feasibility::infeasibility;
use peenpose::jet::{Samples, ShotSample, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::{Setting, Settings};
use peenpose::scenario::Scenario;

use crate::common::cube::{ALL_BUT_SPEED, Cube};

/// Shots at each pose.
pub const SHOTS: usize = 1024;
/// Evaluations after which the state of a run is written down.
pub const CHECKPOINTS: [usize; 5] = [30, 100, 300, 1000, 3000];
/// ln J is below this wherever the nozzle fits.
const BLOCKED: f64 = 10.0;

/// What becomes of the speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Speed {
    /// One more axis of the cube.
    Searched,
    /// Its best value follows from the paths.
    Removed,
}

/// When a run is over.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub evaluations: usize,
    /// J that is good enough.
    pub objective: f64,
}

/// The best so far at some point of a run.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    pub evaluations: usize,
    pub seconds: f64,
    pub objective: f64,
    pub settings: Settings,
}

/// The run is over: its budget is spent, or what it found is good enough.
#[derive(Clone, Copy, Debug)]
pub struct Over;

impl fmt::Display for Over {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the run is over")
    }
}

impl std::error::Error for Over {}

/// The objective that every method sees: ln J, whose scale is the same near a needle and on its
/// plateau; above all of that where the nozzle does not fit, by how far it does not.
pub struct Objective<'a> {
    scenario: &'a Scenario,
    cube: Cube,
    speed: Speed,
    shots: &'a [ShotSample],
    limits: Limits,
    start: Instant,
    evaluations: Cell<usize>,
    best: Cell<Option<(f64, Settings)>>,
    steps: RefCell<Vec<Step>>,
}

/// The shots of a seed: those that the search of the library decides on.
pub fn shots(scenario: &Scenario) -> Samples {
    Samples::with_boundary(&scenario.problem, Stream::Search, SHOTS)
}

impl<'a> Objective<'a> {
    pub fn new(scenario: &'a Scenario, speed: Speed, shots: &'a Samples, limits: Limits) -> Self {
        let mut axes = ALL_BUT_SPEED.to_vec();
        if speed == Speed::Searched {
            axes.push(Setting::Speed);
        }
        Self {
            scenario,
            cube: Cube::new(&scenario.problem, scenario.problem.ranges.contact[0], &axes),
            speed,
            shots: &shots.shots,
            limits,
            start: Instant::now(),
            evaluations: Cell::new(0),
            best: Cell::new(None),
            steps: RefCell::default(),
        }
    }

    pub fn dimensions(&self) -> usize {
        self.cube.dimensions()
    }

    /// The start number `index` of the run with a seed.
    pub fn start(&self, index: u32, seed: u32) -> Vec<f64> {
        self.cube.sobol(index, seed)
    }

    pub fn is_over(&self) -> bool {
        let good_enough = |(objective, _)| objective <= self.limits.objective;
        self.evaluations.get() >= self.limits.evaluations
            || self.best.get().is_some_and(good_enough)
    }

    /// ln J at a point; what lies outside the cube is moved to its nearest face.
    pub fn cost(&self, point: &[f64]) -> Result<f64, Over> {
        if self.is_over() || !point.iter().all(|x| x.is_finite()) {
            return Err(Over);
        }
        self.evaluations.set(self.evaluations.get() + 1);
        let (settings, cost) = self.evaluator(point);
        let objective = if cost < BLOCKED {
            cost.exp()
        } else {
            f64::INFINITY
        };
        let is_better = self.best.get().is_none_or(|(best, _)| objective < best);
        if is_better {
            self.best.set(Some((objective, settings)));
        }
        if is_better || CHECKPOINTS.contains(&self.evaluations.get()) {
            self.note();
        }
        Ok(cost)
    }

    fn evaluator(&self, point: &[f64]) -> (Settings, f64) {
        let mut settings = self.cube.settings(point);
        if let Some(infeasible) = infeasibility(self.scenario, &settings) {
            return (settings, BLOCKED + infeasible.violation * 1e3);
        }
        let problem = &self.scenario.problem;
        let tally = Tally::trace(self.scenario, &settings, 1.0, self.shots);
        if self.speed == Speed::Removed {
            settings.speed = tally.best_speed(&problem.goals, problem.ranges.speed);
        }
        let objective = tally.terms(&problem.goals, settings.speed).total();
        (settings, objective.max(f64::MIN_POSITIVE).ln())
    }

    fn note(&self) {
        if let Some((objective, settings)) = self.best.get() {
            self.steps.borrow_mut().push(Step {
                evaluations: self.evaluations.get(),
                seconds: self.start.elapsed().as_secs_f64(),
                objective,
                settings,
            });
        }
    }

    /// How the run went.
    pub fn into_steps(self) -> Vec<Step> {
        self.note();
        self.steps.into_inner()
    }

    /// Runs a method from start after start until the run is over; the second argument of `once`
    /// counts the starts.
    pub fn many_starts(&self, seed: u32, mut once: impl FnMut(Vec<f64>, u32)) {
        for number in 0..self.limits.evaluations as u32 {
            if self.is_over() {
                return;
            }
            once(self.start(number, seed), number);
        }
    }

    /// Forward differences, taken inwards.
    pub fn gradient(&self, point: &[f64]) -> Result<Vec<f64>, Over> {
        let here = self.cost(point)?;
        let slope = |axis: usize| {
            let mut near = point.to_vec();
            let step = if near[axis] > 0.5 {
                -DIFFERENCE
            } else {
                DIFFERENCE
            };
            near[axis] += step;
            Ok((self.cost(&near)? - here) / step)
        };
        (0..point.len()).map(slope).collect()
    }
}

/// Step of finite differences, as a share of each range.
const DIFFERENCE: f64 = 1e-3;
