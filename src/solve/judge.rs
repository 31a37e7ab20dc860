//! What one point of the search is worth: feasible or not, the best speed there, and J.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use rayon::prelude::*;

use super::archive::Archive;
use super::risks::Risks;
use crate::jet::{Deviate, Pose};
use crate::objective::{Tally, Terms};
use crate::problem::setting::Choice;
use crate::setup::Setup;

/// What a choice of settings is worth on a set of shots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standing {
    /// The nozzle fits.
    Feasible(Terms),
    /// The nozzle is nearer to a surface than it may be, by this much, m.
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

/// Judges choices on common shots.
pub struct Judge<'a> {
    setup: &'a Setup,
    shots: &'a [Deviate],
    effort: &'a Effort,
    stop: &'a AtomicBool,
    /// Where to keep what was judged, and the factors that are on the weights.
    archive: Option<(&'a Archive, Risks)>,
}

impl<'a> Judge<'a> {
    /// A judge on some shots.
    pub fn new(
        setup: &'a Setup,
        shots: &'a [Deviate],
        effort: &'a Effort,
        stop: &'a AtomicBool,
    ) -> Self {
        Self {
            setup,
            shots,
            effort,
            stop,
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
        self.stop.load(Ordering::Relaxed)
    }

    /// The standing of a choice, and the choice with the best speed for it.
    pub fn judge(&self, choice: &Choice) -> (Choice, Standing) {
        if let Some(violation) = clearance_violation(self.setup, choice) {
            self.effort.add(1, 0);
            return (*choice, Standing::Blocked(violation));
        }
        let goals = &self.setup.problem.goals;
        let mut choice = *choice;
        let tally = if speed_scales_out(self.setup, choice.contact) {
            // Paths do not depend on the speed; any will do to trace them.
            let tally = self.trace(&choice, 1.0);
            choice.speed = tally.best_speed(goals, self.setup.problem.settings.speed);
            tally
        } else {
            self.trace(&choice, choice.speed)
        };
        self.effort.add(1, tally.rays);
        let terms = tally.terms(goals, choice.speed);
        if let Some((archive, factors)) = &self.archive {
            archive.add(choice, &terms, factors);
        }
        (choice, Standing::Feasible(terms))
    }

    /// Traces the shots, many of them on all threads.
    fn trace(&self, choice: &Choice, speed: f64) -> Tally {
        let tally = |shots: &[Deviate]| Tally::trace(self.setup, choice, speed, shots);
        if self.shots.len() <= SHARE {
            return tally(self.shots);
        }
        Tally::join(self.shots.par_chunks(SHARE).map(tally).collect())
    }
}

/// Shots that one thread traces at a time.
const SHARE: usize = 2048;

/// Whether the paths stay the same when every speed is multiplied by one factor.
pub fn speed_scales_out(setup: &Setup, contact: usize) -> bool {
    let own = setup.surfaces.iter().filter_map(|limits| limits.contact);
    setup.problem.contacts[contact].contact.is_scale_free()
        && own.into_iter().all(|contact| contact.is_scale_free())
}

/// By how much the nozzle of a choice is nearer to a surface than it may be, m.
pub fn clearance_violation(setup: &Setup, choice: &Choice) -> Option<f64> {
    let nozzle = &setup.problem.nozzle;
    let pose = Pose::new(&setup.target.frame, choice);
    let (gap, _) = setup
        .scene
        .clearance(nozzle, &pose.exit, &pose.direction, nozzle.clearance)?;
    Some(nozzle.clearance - gap)
}
