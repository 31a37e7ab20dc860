//! Fresh shots, which no search has seen, some of which are drawn where settings are found to do harm.

use std::mem::take;

use rayon::prelude::*;

use super::deviate::Deviate;
use super::focus::Focus;
use super::mixture::{Mixture, Origin, Parts};
use super::point::{By, Stream};
use super::replicates::{Replicate, Replicates};
use super::samples::Samples;
use crate::problem::Problem;

/// Fresh shots in independent scramblings, but for those that a focus decides about.
#[derive(Clone, Debug)]
pub struct Fresh {
    /// One for each scrambling.
    pub sets: Vec<Unfocused>,
}

/// The shots of one scrambling, but for those that a focus decides about.
#[derive(Clone, Debug)]
pub struct Unfocused {
    jet: Vec<Deviate>,
    rim: Vec<Deviate>,
    /// Of all of them, in this order.
    origins: Vec<Origin>,
    stream: Stream,
    parts: Parts,
}

impl Fresh {
    /// Those of [`Replicates::new`].
    pub fn new(problem: &Problem, purpose: u32, shots: usize) -> Self {
        let draw = Draw::new(problem, purpose, shots);
        let numbers = (0..draw.sets()).into_par_iter();
        Self {
            sets: numbers.map(|number| draw.unfocused(number)).collect(),
        }
    }

    /// Number of shots of the jet in all sets together.
    pub fn shots(&self) -> usize {
        self.sets.iter().map(|set| set.jet.len()).sum()
    }
}

impl Unfocused {
    fn new(problem: &Problem, stream: Stream, parts: Parts) -> Self {
        let mixture = Mixture::new(parts, &Focus::NONE);
        let draw = |count: usize, by| {
            let shots = (0..count as u32).map(|index| mixture.shot(problem, stream, index, by));
            shots.unzip::<_, _, Vec<_>, Vec<_>>()
        };
        let (jet, mut origins) = draw(parts.jet, By::Jet);
        let (rim, of_rim) = draw(parts.rim, By::Rim);
        origins.extend(of_rim);
        Self {
            jet,
            rim,
            origins,
            stream,
            parts,
        }
    }

    /// These shots and those that a focus draws, each with what it stands for among all of them.
    pub fn focused(&self, problem: &Problem, focus: &Focus) -> Replicate {
        let mut replicate = self.open();
        self.focus(&mut replicate, problem, focus);
        replicate
    }

    /// The same without a copy of them.
    fn into_focused(mut self, problem: &Problem, focus: &Focus) -> Replicate {
        let [jet, rim] = [&mut self.jet, &mut self.rim].map(|shots| Samples {
            deviates: take(shots),
        });
        let mut replicate = Replicate { jet, rim };
        self.focus(&mut replicate, problem, focus);
        replicate
    }

    /// These shots, and space for those that a focus will draw.
    pub(crate) fn open(&self) -> Replicate {
        let mut rim = Vec::with_capacity(self.parts.rim + self.parts.focused);
        rim.extend_from_slice(&self.rim);
        Replicate {
            jet: Samples {
                deviates: self.jet.clone(),
            },
            rim: Samples { deviates: rim },
        }
    }

    /// Makes [open](Self::open) shots, or those of another focus, what [`Self::focused`] gives.
    pub(crate) fn focus(&self, replicate: &mut Replicate, problem: &Problem, focus: &Focus) {
        let mixture = Mixture::new(self.parts, focus);
        let jet = &mut replicate.jet.deviates;
        let rim = &mut replicate.rim.deviates;
        rim.truncate(self.parts.rim);
        for (shot, origin) in jet.iter_mut().chain(&mut *rim).zip(&self.origins) {
            shot.weight = mixture.weight(origin);
        }
        let numbers = 0..self.parts.focused as u32;
        rim.extend(numbers.map(|index| mixture.shot(problem, self.stream, index, By::Focus).0));
    }
}

/// Fresh shots that are too many to be kept: each scrambling is drawn when it is needed.
#[derive(Clone, Copy, Debug)]
pub struct Draw<'a> {
    problem: &'a Problem,
    purpose: u32,
    /// Of each scrambling.
    parts: Parts,
    focus: &'a Focus,
}

impl<'a> Draw<'a> {
    /// The shots of [`Replicates::new`].
    pub fn new(problem: &'a Problem, purpose: u32, shots: usize) -> Self {
        let jet = shots.div_ceil(Replicates::COUNT).max(1);
        let on_rim = jet.div_ceil(2);
        let focused = on_rim / 2;
        let rim = on_rim - focused;
        Self {
            problem,
            purpose,
            parts: Parts { jet, rim, focused },
            focus: &Focus::NONE,
        }
    }

    /// Those of the jet alone.
    pub(super) fn without_rim(self) -> Self {
        let parts = Parts {
            jet: self.parts.jet,
            ..Parts::NONE
        };
        Self { parts, ..self }
    }

    /// The same with other shots where a focus decides about them.
    #[must_use]
    pub fn focused(self, focus: &'a Focus) -> Self {
        Self { focus, ..self }
    }

    /// Number of scramblings: one, when all shots of the problem are the same.
    pub fn sets(&self) -> u32 {
        if self.problem.has_one_ray() {
            1
        } else {
            Replicates::COUNT as u32
        }
    }

    /// The shots of one scrambling; one shot, when all shots of the problem are the same.
    pub fn set(&self, number: u32) -> Replicate {
        let unfocused = self.unfocused(number);
        unfocused.into_focused(self.problem, self.focus)
    }

    fn unfocused(&self, number: u32) -> Unfocused {
        if self.problem.has_one_ray() {
            return Unfocused::new(self.problem, Stream::Fresh(0), Parts::JET_ALONE);
        }
        let stream = Replicates::stream(self.purpose, number);
        Unfocused::new(self.problem, stream, self.parts)
    }
}
