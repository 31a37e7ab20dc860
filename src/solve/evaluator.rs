//! Evaluates one point of the search: feasibility, best speed and J.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::objectives::Objectives;
use super::pareto_archive::ParetoArchive;
use super::passing::Penalty;
use super::race::{LOOKS, Look, Race};
use super::repair::repaired;
use super::space::Space;
use crate::checkpoint::{Checkpoint, Page};
use crate::control::Control;
use crate::evaluate::LargestImpulses;
use crate::feasibility::infeasibility;
use crate::jet::ShotSample;
use crate::objective::{Tally, Terms};
use crate::problem::model::Model;
use crate::problem::setting::{Range, Settings};
use crate::scenario::Scenario;

/// Fitness of some settings on a set of shots.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Fitness {
    /// The nozzle fits; with what violations cost besides, where that counts.
    Feasible(Terms, f64),
    /// The nozzle cannot be there, by this much, m.
    Infeasible(f64),
}

impl Fitness {
    /// A finite number that orders fitnesses: feasible ones first, by J; then infeasible ones, by how much they
    /// violate the clearance. It is J itself where the nozzle fits, so
    /// that a common factor on all weights changes nothing.
    pub fn rank(&self) -> f64 {
        match self {
            Self::Feasible(terms, penalty) => (terms.total() + penalty).min(WORST_OBJECTIVE),
            Self::Infeasible(violation) => {
                // Violations are of the order of millimetres.
                let millimetres = violation * 1e3;
                WORST_OBJECTIVE * (1.0 + millimetres / (1.0 + millimetres))
            }
        }
    }

    /// Whether an evaluation can give this.
    fn is_sound(&self) -> bool {
        match self {
            Self::Feasible(terms, penalty) => terms.are_sound() && *penalty >= 0.0,
            Self::Infeasible(violation) => *violation >= 0.0 && self.rank().is_finite(),
        }
    }

    /// What violations cost.
    pub fn penalty(&self) -> f64 {
        match self {
            Self::Feasible(_, penalty) => *penalty,
            Self::Infeasible(_) => 0.0,
        }
    }

    /// J, when the nozzle fits.
    pub fn objective(&self) -> Option<f64> {
        match self {
            Self::Feasible(terms, _) => Some(terms.total()),
            Self::Infeasible(_) => None,
        }
    }
}

/// Above every J that weights, impulses and limits within their ranges can give, and so far from the
/// largest number that squares of it can be added.
const WORST_OBJECTIVE: f64 = 1e150;

/// How much work was done; shared by all threads.
#[derive(Debug, Default)]
pub struct Effort {
    poses: AtomicUsize,
    rays: AtomicUsize,
}

impl Effort {
    /// Poses evaluated so far.
    pub fn poses(&self) -> usize {
        self.poses.load(Ordering::Relaxed)
    }

    /// Rays cast so far.
    pub fn rays(&self) -> usize {
        self.rays.load(Ordering::Relaxed)
    }

    /// Adds work.
    pub fn add(&self, poses: usize, rays: usize) {
        self.poses.fetch_add(poses, Ordering::Relaxed);
        self.rays.fetch_add(rays, Ordering::Relaxed);
    }
}

/// The outcome of an evaluation.
#[derive(Serialize, Deserialize)]
struct Evaluated {
    /// The best one, m/s.
    speed: f64,
    fitness: Fitness,
    /// J of the first shots at each look, as far as it was looked at.
    partial: Vec<f64>,
    rays: usize,
}

impl Evaluated {
    /// Whether evaluating `settings` can give this: the best speed is theirs, or one within the range.
    fn is_sound(&self, settings: &Settings, range: Range) -> bool {
        let is_allowed = self.speed == settings.speed || range.contains(self.speed);
        let are_sound = self.partial.iter().all(|objective| *objective >= 0.0);
        let looks = self.partial.len() <= LOOKS;
        is_allowed && self.fitness.is_sound() && are_sound && looks && self.rays <= MOST_RAYS
    }
}

/// More rays than any pose takes, and few enough for those of any number of poses to be added.
const MOST_RAYS: usize = 1 << 31;

/// Evaluates settings on common random numbers.
pub struct Evaluator<'a> {
    scenario: &'a Scenario,
    shots: &'a [ShotSample],
    /// When J is looked at before all shots are traced.
    looks: Vec<Look>,
    effort: &'a Effort,
    control: &'a Control,
    /// Checkpoint of evaluations.
    page: Option<Page<'a>>,
    /// Archive of evaluations, and the factors on the weights.
    archive: Option<(&'a ParetoArchive, Objectives)>,
    /// What violations cost.
    penalty: Option<Penalty>,
}

impl<'a> Evaluator<'a> {
    /// An evaluator on some shots.
    pub fn new(
        scenario: &'a Scenario,
        shots: &'a [ShotSample],
        effort: &'a Effort,
        control: &'a Control,
    ) -> Self {
        let page = |checkpoint: &'a Checkpoint| checkpoint.page("judged", scenario, shots);
        Self {
            scenario,
            shots,
            looks: Look::all(shots),
            effort,
            control,
            page: control.checkpoint.as_deref().map(page),
            archive: None,
            penalty: None,
        }
    }

    /// The same with a penalty on violations.
    #[must_use]
    pub(super) fn penalised(self, penalty: Penalty) -> Self {
        Self {
            penalty: Some(penalty),
            ..self
        }
    }

    /// The same with an archive and with factors on the weights.
    #[must_use]
    pub(super) fn keeping(self, archive: &'a ParetoArchive, factors: Objectives) -> Self {
        Self {
            archive: Some((archive, factors)),
            ..self
        }
    }

    /// The accuracy that is asked for, relative to J.
    pub fn accuracy(&self) -> f64 {
        self.scenario.problem.accuracy
    }

    /// Whether the search should come to an end.
    pub fn is_stopped(&self) -> bool {
        self.control.is_stopped()
    }

    /// A feasible point near an infeasible one, if there is one.
    pub(super) fn repaired(&self, space: &Space, point: &[f64]) -> Option<Vec<f64>> {
        repaired(self.scenario, space, point)
    }

    /// The fitness of some settings, the settings with the best speed for them, and J of the first shots.
    ///
    /// Where the first shots decide a race, they are all that is traced, and J is an estimate above the rival's.
    /// After a request to stop J is that of however few shots were traced, and nothing of it is kept.
    pub(super) fn evaluate(
        &self,
        settings: &Settings,
        race: &Race,
    ) -> (Settings, Fitness, Vec<f64>) {
        let none = Race::none();
        let race = if self.ends_early() { race } else { &none };
        let mut key = race.numbers();
        key.extend(self.penalty.iter().flat_map(Penalty::numbers));
        let range = self.scenario.problem.ranges.speed;
        let is_sound = |evaluated: &Evaluated| evaluated.is_sound(settings, range);
        let page = self.page.as_ref();
        let recalled = page.and_then(|page| page.recall(settings, &key, is_sound));
        let evaluated = recalled.unwrap_or_else(|| {
            let evaluated = self.evaluate_anew(settings, race);
            if let Some(page) = page
                && !self.is_stopped()
            {
                page.keep(settings, &key, &evaluated);
            }
            evaluated
        });
        self.effort.add(1, evaluated.rays);
        let settings = Settings {
            speed: evaluated.speed,
            ..*settings
        };
        if let (Some((archive, factors)), Fitness::Feasible(terms, _)) =
            (&self.archive, &evaluated.fitness)
            && !self.is_stopped()
        {
            archive.add(settings, terms, factors);
        }
        (settings, evaluated.fitness, evaluated.partial)
    }

    /// Whether evaluations may end early. With an archive they may not: what is hopeless with some factors on
    /// the weights may be the best with others. With `model: full` nothing is left out.
    fn ends_early(&self) -> bool {
        self.archive.is_none()
            && self.penalty.is_none()
            && self.control.shortcuts.early_ends
            && self.scenario.problem.model != Model::Full
    }

    fn evaluate_anew(&self, settings: &Settings, race: &Race) -> Evaluated {
        if let Some(infeasible) = infeasibility(self.scenario, settings) {
            return Evaluated {
                speed: settings.speed,
                fitness: Fitness::Infeasible(infeasible.violation),
                partial: Vec::new(),
                rays: 0,
            };
        }
        if let Some(penalty) = &self.penalty {
            return self.evaluate_violations(settings, penalty);
        }
        let (mut tally, mut partial) = (Tally::default(), Vec::new());
        // Whoever enters no race may be the rival of others.
        let looks = if self.ends_early() { &*self.looks } else { &[] };
        for (index, look) in looks.iter().enumerate() {
            tally = self.traced_up_to(look.end, settings, tally);
            let (speed, terms) = self.best_speed(settings, &tally);
            let share = tally.least_share_with(&look.rest);
            if let Some(estimate) = race.lost(index, terms.total(), share) {
                return Evaluated {
                    speed,
                    fitness: Fitness::Feasible(terms.scaled_to(estimate), 0.0),
                    partial,
                    rays: tally.rays,
                };
            }
            partial.push(terms.total());
        }
        let all = self.traced_up_to(self.shots.len(), settings, tally);
        let (speed, terms) = self.best_speed(settings, &all);
        Evaluated {
            speed,
            fitness: Fitness::Feasible(terms, 0.0),
            partial,
            rays: all.rays,
        }
    }

    /// J and what violations cost, at the speed at which both together are least.
    fn evaluate_violations(&self, settings: &Settings, penalty: &Penalty) -> Evaluated {
        let scenarios = penalty.scenarios(self.scenario);
        let impulses = scenarios.map(|it| LargestImpulses::of(it, settings, self.shots));
        let impulses: Vec<LargestImpulses> = impulses.collect();
        let cost = |speed: f64| penalty.cost(self.scenario, &impulses, speed);
        let (whole, range) = (&impulses[0], self.scenario.problem.ranges.speed);
        let speed = match self.scenario.speed_scales_out(settings.contact) {
            true => whole.best_speed(self.scenario, range, cost),
            false => settings.speed,
        };
        Evaluated {
            speed,
            fitness: Fitness::Feasible(whole.terms(self.scenario, speed), cost(speed)),
            partial: Vec::new(),
            rays: impulses.iter().map(LargestImpulses::rays).sum(),
        }
    }

    /// What some of the first shots did, and those up to `end`.
    fn traced_up_to(&self, end: usize, settings: &Settings, tally: Tally) -> Tally {
        let next = self.trace(settings, &self.shots[tally.shots..end]);
        Tally::join(vec![tally, next])
    }

    /// The best speed, m/s, and the terms there.
    fn best_speed(&self, settings: &Settings, tally: &Tally) -> (f64, Terms) {
        let problem = &self.scenario.problem;
        let speed = if self.scenario.speed_scales_out(settings.contact) {
            tally.best_speed(&problem.goals, problem.ranges.speed)
        } else {
            settings.speed
        };
        (speed, tally.terms(&problem.goals, speed))
    }

    /// Traces shots, on all threads where they are some of many.
    fn trace(&self, settings: &Settings, shots: &[ShotSample]) -> Tally {
        let speed = if self.scenario.speed_scales_out(settings.contact) {
            // Paths do not depend on the speed; any will do to trace them.
            1.0
        } else {
            settings.speed
        };
        let tally = |shots: &[ShotSample]| Tally::trace(self.scenario, settings, speed, shots);
        if self.shots.len() <= MOST_ALONE {
            return tally(shots);
        }
        let chunks = shots.par_chunks(CHUNK).enumerate();
        let wanted = chunks.filter(|(number, _)| *number == 0 || !self.is_stopped());
        Tally::join(wanted.map(|(_, shots)| tally(shots)).collect())
    }
}

/// One thread traces up to this many shots alone.
const MOST_ALONE: usize = 2048;
/// Shots of larger samples that one thread traces at a time.
const CHUNK: usize = 256;
