//! What one point of the search is worth: feasible or not, the best speed there, and J.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::archive::Archive;
use super::control::Control;
use super::risks::Risks;
use crate::checkpoint::{Checkpoint, Page};
use crate::feasibility::infeasibility;
use crate::jet::Deviate;
use crate::objective::{Tally, Terms};
use crate::precision::Precision;
use crate::problem::setting::{Choice, Range};
use crate::setup::Setup;

/// What a choice of settings is worth on a set of shots.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Standing {
    /// The nozzle fits.
    Feasible(Terms),
    /// The nozzle cannot be there, by this much, m.
    Blocked(f64),
}

impl Standing {
    /// A finite number by which standings are ordered: every feasible one before every blocked
    /// one, by J or by how much the clearance is violated. It is J itself where the nozzle fits, so
    /// that a common factor on all weights changes nothing.
    pub fn rank(&self) -> f64 {
        match self {
            Self::Feasible(terms) => terms.total().min(WORST_OBJECTIVE),
            Self::Blocked(violation) => {
                // Violations are of the order of millimetres.
                let millimetres = violation * 1e3;
                WORST_OBJECTIVE * (1.0 + millimetres / (1.0 + millimetres))
            }
        }
    }

    /// Whether shots miss the target or meet secondary surfaces.
    pub(super) fn does_harm(&self) -> bool {
        matches!(self, Self::Feasible(terms) if terms.rebound > 0.0 || terms.miss > 0.0)
    }

    /// Whether there can be such a standing.
    fn is_sound(&self) -> bool {
        match self {
            Self::Feasible(terms) => terms.are_sound(),
            Self::Blocked(violation) => *violation >= 0.0 && self.rank().is_finite(),
        }
    }

    /// J, when the nozzle fits.
    pub fn objective(&self) -> Option<f64> {
        match self {
            Self::Feasible(terms) => Some(terms.total()),
            Self::Blocked(_) => None,
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
    /// Poses judged so far.
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

/// What was found out about a choice, and with how many rays.
#[derive(Serialize, Deserialize)]
struct Judged {
    /// The best one, m/s.
    speed: f64,
    standing: Standing,
    rays: usize,
}

impl Judged {
    /// Whether judging a choice can come to this: the best speed is its own, or one within the range.
    fn is_sound(&self, choice: &Choice, range: Range) -> bool {
        let is_allowed = self.speed == choice.speed || range.contains(self.speed);
        is_allowed && self.standing.is_sound() && self.rays <= MOST_RAYS
    }
}

/// More rays than any pose takes, and few enough for those of any number of poses to be added.
const MOST_RAYS: usize = u32::MAX as usize;

/// Judges choices on common shots.
pub struct Judge<'a> {
    setup: &'a Setup,
    precision: Precision,
    shots: &'a [Deviate],
    effort: &'a Effort,
    control: &'a Control<'a>,
    /// Where what was judged is written down.
    page: Option<Page<'a>>,
    /// Where to keep what was judged, and the factors that are on the weights.
    archive: Option<(&'a Archive, Risks)>,
}

impl<'a> Judge<'a> {
    /// A judge on some shots, whose paths are traced in one of the precisions.
    pub fn new(
        setup: &'a Setup,
        precision: Precision,
        shots: &'a [Deviate],
        effort: &'a Effort,
        control: &'a Control,
    ) -> Self {
        let kind = match precision {
            Precision::F64 => "judged",
            Precision::F32 => "judged in f32",
        };
        let page = |checkpoint: &'a Checkpoint| checkpoint.page(kind, setup, shots);
        Self {
            setup,
            precision,
            shots,
            effort,
            control,
            page: control.checkpoint.map(page),
            archive: None,
        }
    }

    /// The same that keeps what it judges with factors on the weights.
    #[must_use]
    pub(super) fn keeping(self, archive: &'a Archive, factors: Risks) -> Self {
        Self {
            archive: Some((archive, factors)),
            ..self
        }
    }

    /// Whether the search should come to an end.
    pub fn is_stopped(&self) -> bool {
        self.control.is_stopped()
    }

    /// The standing of a choice, and the choice with the best speed for it.
    ///
    /// Where J on the first shots alone is so far above `best` that the rest could not bring it below,
    /// they are all that is traced, and J is what it is on them. So it is after a request to stop, on
    /// however few shots, and nothing of it is kept.
    pub(super) fn judge(&self, choice: &Choice, best: f64) -> (Choice, Standing) {
        // A pose that is hopeless with some factors on the weights may be the best with others.
        let ends_early = self.archive.is_none() && self.control.shortcuts.early_ends;
        let best = if ends_early { best } else { f64::INFINITY };
        let range = self.setup.problem.settings.speed;
        let is_sound = |judged: &Judged| judged.is_sound(choice, range);
        let page = self.page.as_ref();
        let recalled = page.and_then(|page| page.recall(choice, &[best], is_sound));
        let judged = recalled.unwrap_or_else(|| {
            let judged = self.judge_anew(choice, best);
            if let Some(page) = page
                && !self.is_stopped()
            {
                page.keep(choice, &[best], &judged);
            }
            judged
        });
        self.effort.add(1, judged.rays);
        let choice = Choice {
            speed: judged.speed,
            ..*choice
        };
        if let (Some((archive, factors)), Standing::Feasible(terms)) =
            (&self.archive, &judged.standing)
            && !self.is_stopped()
        {
            archive.add(choice, terms, factors);
        }
        (choice, judged.standing)
    }

    fn judge_anew(&self, choice: &Choice, best: f64) -> Judged {
        if let Some(infeasible) = infeasibility(self.setup, choice) {
            return Judged {
                speed: choice.speed,
                standing: Standing::Blocked(infeasible.violation),
                rays: 0,
            };
        }
        let first = (self.shots.len() / SHARES).max(FEWEST);
        if first >= self.shots.len() {
            return self.judged(choice, &self.trace(choice, self.shots));
        }
        let (first, rest) = self.shots.split_at(first);
        let few = self.trace(choice, first);
        if best < f64::INFINITY {
            let judged = self.judged(choice, &few);
            if judged.standing.rank() > SHARES as f64 * best {
                return judged;
            }
        }
        let all = Tally::join(vec![few, self.trace(choice, rest)]);
        self.judged(choice, &all)
    }

    fn judged(&self, choice: &Choice, tally: &Tally) -> Judged {
        let problem = &self.setup.problem;
        let speed = if self.setup.speed_scales_out(choice.contact) {
            tally.best_speed(&problem.goals, problem.settings.speed)
        } else {
            choice.speed
        };
        Judged {
            speed,
            standing: Standing::Feasible(tally.terms(&problem.goals, speed)),
            rays: tally.rays,
        }
    }

    /// Traces shots, on all threads where they are some of many.
    fn trace(&self, choice: &Choice, shots: &[Deviate]) -> Tally {
        let speed = if self.setup.speed_scales_out(choice.contact) {
            // Paths do not depend on the speed; any will do to trace them.
            1.0
        } else {
            choice.speed
        };
        let tally =
            |shots: &[Deviate]| Tally::trace_as(self.precision, self.setup, choice, speed, shots);
        if self.shots.len() <= MOST_ALONE {
            return tally(shots);
        }
        let chunks = shots.par_chunks(CHUNK).enumerate();
        let wanted = chunks.filter(|(number, _)| *number == 0 || !self.is_stopped());
        Tally::join(wanted.map(|(_, shots)| tally(shots)).collect())
    }
}

/// One of so many shares of the shots is traced first. Where J is as many times above the best on
/// them, it is above the best on all, even if the rest did no harm; unless the first hits on target,
/// over which two of the terms are means, are a still smaller share of all such hits.
const SHARES: usize = 8;
/// Shots that are traced first at least.
const FEWEST: usize = 64;
/// Up to so many shots one thread traces alone.
const MOST_ALONE: usize = 2048;
/// Shots of more than those that one thread traces at a time.
const CHUNK: usize = 256;
