//! Validation sample: shots that no search has seen, some of them drawn where settings are found to violate.

use std::mem::take;

use rayon::prelude::*;

use super::importance::ImportanceDensity;
use super::mixture::{Mixture, Origin, Parts};
use super::qmc_point::{Proposal, Stream};
use super::replicates::{Replicate, Replicates};
use super::samples::Samples;
use super::shot_sample::ShotSample;
use crate::problem::Problem;

/// A validation sample in replicates, without the shots that wait for an importance density.
#[derive(Clone, Debug)]
pub struct ValidationSample {
    /// One for each replicate.
    pub sets: Vec<PendingReplicate>,
}

/// One replicate without the shots that wait for an importance density.
#[derive(Clone, Debug)]
pub struct PendingReplicate {
    jet: Vec<ShotSample>,
    boundary: Vec<ShotSample>,
    /// Of all of them, in this order.
    origins: Vec<Origin>,
    stream: Stream,
    parts: Parts,
}

impl ValidationSample {
    /// Those of [`Replicates::new`].
    pub fn new(problem: &Problem, purpose: u32, shots: usize) -> Self {
        let draw = Draw::new(problem, purpose, shots);
        let numbers = (0..draw.sets()).into_par_iter();
        Self {
            sets: numbers.map(|number| draw.pending(number)).collect(),
        }
    }

    /// Number of shots of the jet in all sets together.
    pub fn shots(&self) -> usize {
        self.sets.iter().map(|set| set.jet.len()).sum()
    }
}

impl PendingReplicate {
    fn new(problem: &Problem, stream: Stream, parts: Parts) -> Self {
        let mixture = Mixture::new(parts, &ImportanceDensity::NONE);
        let draw = |count: usize, by| {
            let shots = (0..count as u32).map(|index| mixture.shot(problem, stream, index, by));
            shots.unzip::<_, _, Vec<_>, Vec<_>>()
        };
        let (jet, mut origins) = draw(parts.jet, Proposal::Nominal);
        let (boundary, of_boundary) = draw(parts.boundary, Proposal::Boundary);
        origins.extend(of_boundary);
        Self {
            jet,
            boundary,
            origins,
            stream,
            parts,
        }
    }

    /// These shots and those that an importance density draws, each with its importance weight.
    pub fn with_importance(&self, problem: &Problem, importance: &ImportanceDensity) -> Replicate {
        let mut replicate = self.open();
        self.draw_by(&mut replicate, problem, importance);
        replicate
    }

    /// The same without a copy of them.
    fn into_replicate(mut self, problem: &Problem, importance: &ImportanceDensity) -> Replicate {
        let [jet, boundary] =
            [&mut self.jet, &mut self.boundary].map(|shots| Samples { shots: take(shots) });
        let mut replicate = Replicate { jet, boundary };
        self.draw_by(&mut replicate, problem, importance);
        replicate
    }

    /// These shots, and space for those that an importance density will draw.
    pub(crate) fn open(&self) -> Replicate {
        let mut boundary = Vec::with_capacity(self.parts.boundary + self.parts.by_importance);
        boundary.extend_from_slice(&self.boundary);
        Replicate {
            jet: Samples {
                shots: self.jet.clone(),
            },
            boundary: Samples { shots: boundary },
        }
    }

    /// Makes [open](Self::open) shots, or those of another importance density, what [`Self::with_importance`] gives.
    pub(crate) fn draw_by(
        &self,
        replicate: &mut Replicate,
        problem: &Problem,
        importance: &ImportanceDensity,
    ) {
        let mixture = Mixture::new(self.parts, importance);
        let jet = &mut replicate.jet.shots;
        let boundary = &mut replicate.boundary.shots;
        boundary.truncate(self.parts.boundary);
        for (shot, origin) in jet.iter_mut().chain(&mut *boundary).zip(&self.origins) {
            shot.weight = mixture.weight(origin);
        }
        let numbers = 0..self.parts.by_importance as u32;
        boundary.extend(numbers.map(|index| {
            mixture
                .shot(problem, self.stream, index, Proposal::Importance)
                .0
        }));
    }
}

/// A validation sample too large to be kept: each replicate is drawn when it is needed.
#[derive(Clone, Copy, Debug)]
pub struct Draw<'a> {
    problem: &'a Problem,
    purpose: u32,
    /// Of each replicate.
    parts: Parts,
    importance: &'a ImportanceDensity,
}

impl<'a> Draw<'a> {
    /// The shots of [`Replicates::new`].
    pub fn new(problem: &'a Problem, purpose: u32, shots: usize) -> Self {
        let jet = shots.div_ceil(Replicates::COUNT).max(1);
        let on_boundary = jet.div_ceil(2);
        let by_importance = on_boundary / 2;
        let boundary = on_boundary - by_importance;
        Self {
            problem,
            purpose,
            parts: Parts {
                jet,
                boundary,
                by_importance,
            },
            importance: &ImportanceDensity::NONE,
        }
    }

    /// Those of the jet alone.
    pub fn without_boundary(self) -> Self {
        let parts = Parts {
            jet: self.parts.jet,
            ..Parts::NONE
        };
        Self { parts, ..self }
    }

    /// The same with other shots where the importance density decides on them.
    #[must_use]
    pub fn with_importance(self, importance: &'a ImportanceDensity) -> Self {
        Self { importance, ..self }
    }

    /// Number of replicates: one, when all shots of the problem are the same.
    pub fn sets(&self) -> u32 {
        if self.problem.has_one_ray() {
            1
        } else {
            Replicates::COUNT as u32
        }
    }

    /// The shots of one replicate; one shot, when all shots of the problem are the same.
    pub fn set(&self, number: u32) -> Replicate {
        let pending = self.pending(number);
        pending.into_replicate(self.problem, self.importance)
    }

    fn pending(&self, number: u32) -> PendingReplicate {
        if self.problem.has_one_ray() {
            return PendingReplicate::new(self.problem, Stream::Validation(0), Parts::JET_ALONE);
        }
        let stream = Replicates::stream(self.purpose, number);
        PendingReplicate::new(self.problem, stream, self.parts)
    }
}
