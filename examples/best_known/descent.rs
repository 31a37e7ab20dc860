//! Downhill by polling: both ways along every axis of a frame that is turned at each step, further
//! after a success, nearer after none (mesh adaptive direct search with Householder frames).

use std::sync::atomic::{AtomicUsize, Ordering};

use peenpose::feasibility::infeasibility;
use peenpose::jet::ShotSample;
use peenpose::objective::Tally;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;

use crate::common::cube::Cube;

/// A point with its settings and what they are worth.
#[derive(Clone, Debug)]
pub struct Trial {
    pub point: Vec<f64>,
    pub settings: Settings,
    /// J; infinite where the nozzle does not fit.
    pub objective: f64,
}

/// Work done, shared by all threads.
#[derive(Debug, Default)]
pub struct Work {
    poses: AtomicUsize,
    rays: AtomicUsize,
}

impl Work {
    pub fn poses(&self) -> usize {
        self.poses.load(Ordering::Relaxed)
    }

    pub fn rays(&self) -> usize {
        self.rays.load(Ordering::Relaxed)
    }
}

/// Tries points on given shots.
pub struct Evaluator<'a> {
    pub scenario: &'a Scenario,
    pub cube: &'a Cube,
    pub shots: &'a [ShotSample],
    pub work: &'a Work,
}

impl Evaluator<'_> {
    /// A point with the best speed for it.
    pub fn try_at(&self, point: &[f64]) -> Trial {
        self.work.poses.fetch_add(1, Ordering::Relaxed);
        let mut trial = Trial {
            point: point.to_vec(),
            settings: self.cube.settings(point),
            objective: f64::INFINITY,
        };
        if infeasibility(self.scenario, &trial.settings).is_none() {
            let problem = &self.scenario.problem;
            let settings = &mut trial.settings;
            let tally = Tally::trace(self.scenario, settings, settings.speed, self.shots);
            self.work.rays.fetch_add(tally.rays, Ordering::Relaxed);
            if self.scenario.speed_scales_out(settings.contact) {
                settings.speed = tally.best_speed(&problem.goals, problem.ranges.speed);
            }
            trial.objective = tally.terms(&problem.goals, settings.speed).total();
        }
        trial
    }

    /// The best point found downhill from `start`, whose first steps are `reach` long.
    pub fn descend(&self, start: &[f64], reach: f64, seed: u32) -> Trial {
        let mut best = self.try_at(start);
        let mut step = reach;
        let mut turn = 0;
        while step > LEAST_STEP * reach {
            let frame = frame(self.cube.dimensions(), turn, seed);
            turn += 1;
            let both_ways = frame.iter().flat_map(|axis| [(axis, step), (axis, -step)]);
            let better = both_ways
                .map(|(axis, step)| self.try_at(&moved(&best.point, axis, step)))
                .find(|trial| trial.objective < best.objective);
            match better {
                Some(trial) => {
                    best = trial;
                    step = (2.0 * step).min(reach);
                }
                None => step *= 0.5,
            }
        }
        best
    }
}

/// Share of the first step below which steps no longer matter.
const LEAST_STEP: f64 = 0.01;

/// The point a step away, inside the cube.
fn moved(point: &[f64], axis: &[f64], step: f64) -> Vec<f64> {
    let pairs = point.iter().zip(axis);
    pairs.map(|(x, d)| (x + step * d).clamp(0.0, 1.0)).collect()
}

/// An orthonormal frame: the axes mirrored in a plane with a pseudo-random normal.
fn frame(dimensions: usize, turn: u32, seed: u32) -> Vec<Vec<f64>> {
    let coordinate = |axis| 2.0 * f64::from(sobol_burley::sample(turn, axis as u32, seed)) - 1.0;
    let normal: Vec<f64> = (0..dimensions).map(coordinate).collect();
    let square: f64 = normal.iter().map(|x| x * x).sum();
    let mirrored = |axis: usize| {
        let scale = 2.0 * normal[axis] / square.max(f64::MIN_POSITIVE);
        let own = |other| if other == axis { 1.0 } else { 0.0 };
        (0..dimensions)
            .map(|other| own(other) - scale * normal[other])
            .collect()
    };
    (0..dimensions).map(mirrored).collect()
}
