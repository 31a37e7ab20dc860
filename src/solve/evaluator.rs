//! Evaluates one point of the search: feasibility, best speed and J.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::objectives::Objectives;
use super::pareto_archive::ParetoArchive;
use crate::checkpoint::{Checkpoint, Page};
use crate::control::Control;
use crate::feasibility::infeasibility;
use crate::jet::ShotSample;
use crate::objective::{Rest, Tally, Terms};
use crate::problem::model::Model;
use crate::problem::setting::{Range, Settings};
use crate::scenario::Scenario;

/// Fitness of some settings on a set of shots.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Fitness {
    /// The nozzle fits.
    Feasible(Terms),
    /// The nozzle cannot be there, by this much, m.
    Infeasible(f64),
}

impl Fitness {
    /// A finite number that orders fitnesses: feasible ones first, by J; then infeasible ones, by how much they
    /// violate the clearance. It is J itself where the nozzle fits, so
    /// that a common factor on all weights changes nothing.
    pub fn rank(&self) -> f64 {
        match self {
            Self::Feasible(terms) => terms.total().min(WORST_OBJECTIVE),
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
            Self::Feasible(terms) => terms.are_sound(),
            Self::Infeasible(violation) => *violation >= 0.0 && self.rank().is_finite(),
        }
    }

    /// J, when the nozzle fits.
    pub fn objective(&self) -> Option<f64> {
        match self {
            Self::Feasible(terms) => Some(terms.total()),
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
    rays: usize,
}

impl Evaluated {
    /// Whether evaluating `settings` can give this: the best speed is theirs, or one within the range.
    fn is_sound(&self, settings: &Settings, range: Range) -> bool {
        let is_allowed = self.speed == settings.speed || range.contains(self.speed);
        is_allowed && self.fitness.is_sound() && self.rays <= MOST_RAYS
    }
}

/// More rays than any pose takes, and few enough for those of any number of poses to be added.
const MOST_RAYS: usize = u32::MAX as usize;

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

    /// The fitness of some settings, and the settings with the best speed for them.
    ///
    /// Where the first shots prove that J of all of them is above `cut`, they are all that is traced, and J
    /// is what it is on them. So it is after a request to stop, on however few shots, and nothing of it is
    /// kept.
    pub(super) fn evaluate(&self, settings: &Settings, cut: f64) -> (Settings, Fitness) {
        let cut = if self.ends_early() {
            cut
        } else {
            f64::INFINITY
        };
        let range = self.scenario.problem.ranges.speed;
        let is_sound = |evaluated: &Evaluated| evaluated.is_sound(settings, range);
        let page = self.page.as_ref();
        let recalled = page.and_then(|page| page.recall(settings, &[cut], is_sound));
        let evaluated = recalled.unwrap_or_else(|| {
            let evaluated = self.evaluate_anew(settings, cut);
            if let Some(page) = page
                && !self.is_stopped()
            {
                page.keep(settings, &[cut], &evaluated);
            }
            evaluated
        });
        self.effort.add(1, evaluated.rays);
        let settings = Settings {
            speed: evaluated.speed,
            ..*settings
        };
        if let (Some((archive, factors)), Fitness::Feasible(terms)) =
            (&self.archive, &evaluated.fitness)
            && !self.is_stopped()
        {
            archive.add(settings, terms, factors);
        }
        (settings, evaluated.fitness)
    }

    /// Whether evaluations may end early. With an archive they may not: what is hopeless with some factors on
    /// the weights may be the best with others. With `model: full` nothing is left out.
    fn ends_early(&self) -> bool {
        self.archive.is_none()
            && self.control.shortcuts.early_ends
            && self.scenario.problem.model != Model::Full
    }

    fn evaluate_anew(&self, settings: &Settings, cut: f64) -> Evaluated {
        if let Some(infeasible) = infeasibility(self.scenario, settings) {
            return Evaluated {
                speed: settings.speed,
                fitness: Fitness::Infeasible(infeasible.violation),
                rays: 0,
            };
        }
        let mut tally = Tally::default();
        for look in &self.looks {
            tally = self.traced_up_to(look.end, settings, tally);
            if cut < f64::INFINITY {
                let evaluated = self.evaluated(settings, &tally);
                if evaluated.fitness.rank() * tally.least_share_with(&look.rest) > cut {
                    return evaluated;
                }
            }
        }
        let all = self.traced_up_to(self.shots.len(), settings, tally);
        self.evaluated(settings, &all)
    }

    /// What some of the first shots did, and those up to `end`.
    fn traced_up_to(&self, end: usize, settings: &Settings, tally: Tally) -> Tally {
        let next = self.trace(settings, &self.shots[tally.shots..end]);
        Tally::join(vec![tally, next])
    }

    fn evaluated(&self, settings: &Settings, tally: &Tally) -> Evaluated {
        let problem = &self.scenario.problem;
        let speed = if self.scenario.speed_scales_out(settings.contact) {
            tally.best_speed(&problem.goals, problem.ranges.speed)
        } else {
            settings.speed
        };
        Evaluated {
            speed,
            fitness: Fitness::Feasible(tally.terms(&problem.goals, speed)),
            rays: tally.rays,
        }
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

/// A moment at which J of the first shots may prove that J of all is too high.
struct Look {
    /// Shots until then.
    end: usize,
    rest: Rest,
}

impl Look {
    /// All of them: they do not depend on the cut, on which the order of sums and so their last bits must not.
    fn all(shots: &[ShotSample]) -> Vec<Self> {
        let ends = LOOKS.map(|share| (shots.len() as f64 * share) as usize);
        let worthwhile = ends.into_iter().filter(|&end| end >= FEWEST);
        let look = |end| Self {
            end,
            rest: Rest::of(&shots[end..]),
        };
        worthwhile.map(look).collect()
    }
}

/// Shares of the shots after which J is looked at.
const LOOKS: [f64; 4] = [0.125, 0.25, 0.5, 0.75];
/// Shots that are traced before J is looked at, at least.
const FEWEST: usize = 64;
/// One thread traces up to this many shots alone.
const MOST_ALONE: usize = 2048;
/// Shots of larger samples that one thread traces at a time.
const CHUNK: usize = 256;
