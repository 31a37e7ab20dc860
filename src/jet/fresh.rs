//! Fresh shots, which no search has seen, in independent scramblings.

use rayon::prelude::*;

use super::deviate::Deviate;
use super::focus::Focus;
use super::mixture::{Mixture, Origin, Parts};
use super::point::{By, Stream};
use super::samples::Samples;
use crate::problem::Problem;

/// Independent scramblings of the same jet, whose scatter tells the error of an average.
#[derive(Clone, Debug)]
pub struct Replicates {
    /// One for each scrambling.
    pub sets: Vec<Replicate>,
}

/// The shots of one scrambling.
#[derive(Clone, Debug)]
pub struct Replicate {
    /// Shots as the jet fires them.
    pub jet: Samples,
    /// Shots drawn towards the rim, half of them by a focus; weighted averages over both estimate the
    /// same as those over the jet alone, and see what harms rarely.
    pub rim: Samples,
    stream: Stream,
    parts: Parts,
    /// Of the shots that no focus decides about: those of the jet, and half of those on the rim.
    origins: Vec<Origin>,
}

impl Replicates {
    /// Number of scramblings.
    pub const COUNT: usize = 32;

    /// One of the streams of fresh shots for a [`purpose`](super::purpose).
    pub fn stream(purpose: u32, number: u32) -> Stream {
        Stream::Fresh(purpose * Self::COUNT as u32 + number)
    }

    /// Fresh shots of the jet, rounded up to a multiple of [`Self::COUNT`], and half as many on the
    /// rim. Sets for different [purposes](super::purpose) are independent of each other and of every
    /// search.
    pub fn new(problem: &Problem, purpose: u32, shots: usize) -> Self {
        Self::of(&Draw::new(problem, purpose, shots))
    }

    /// Fresh shots of the jet alone: for shares of shots.
    pub fn without_rim(problem: &Problem, purpose: u32, shots: usize) -> Self {
        let draw = Draw::new(problem, purpose, shots);
        let parts = Parts {
            jet: draw.parts.jet,
            ..Parts::NONE
        };
        Self::of(&Draw { parts, ..draw })
    }

    fn of(draw: &Draw) -> Self {
        let numbers = (0..draw.sets()).into_par_iter();
        Self {
            sets: numbers.map(|number| draw.set(number)).collect(),
        }
    }

    /// Number of shots of the jet in all sets together.
    pub fn shots(&self) -> usize {
        self.sets.iter().map(|set| set.jet.deviates.len()).sum()
    }
}

impl From<Samples> for Replicate {
    /// Shots as they are, about none of which a focus decides.
    fn from(jet: Samples) -> Self {
        Self {
            jet,
            rim: Samples {
                deviates: Vec::new(),
            },
            stream: Stream::Search,
            parts: Parts::NONE,
            origins: Vec::new(),
        }
    }
}

impl Replicate {
    fn new(problem: &Problem, stream: Stream, parts: Parts, focus: &Focus) -> Self {
        let mixture = Mixture::new(parts, focus);
        let draw = |count: usize, by| {
            let shots = (0..count as u32).map(|index| mixture.shot(problem, stream, index, by));
            shots.unzip::<_, _, Vec<Deviate>, Vec<Origin>>()
        };
        let (jet, mut origins) = draw(parts.jet, By::Jet);
        let (mut rim, of_rim) = draw(parts.rim, By::Rim);
        origins.extend(of_rim);
        rim.extend(draw(parts.focused, By::Focus).0);
        Self {
            jet: Samples { deviates: jet },
            rim: Samples { deviates: rim },
            stream,
            parts,
            origins,
        }
    }

    /// The same shots with those drawn anew that a focus decides about.
    #[must_use]
    pub fn focused(&self, problem: &Problem, focus: &Focus) -> Self {
        let mixture = Mixture::new(self.parts, focus);
        let mut focused = self.clone();
        let (jet, rim) = (&mut focused.jet.deviates, &mut focused.rim.deviates);
        rim.truncate(self.parts.rim);
        for (shot, origin) in jet.iter_mut().chain(&mut *rim).zip(&self.origins) {
            shot.weight = mixture.weight(origin);
        }
        let numbers = 0..self.parts.focused as u32;
        let shots = numbers.map(|index| mixture.shot(problem, self.stream, index, By::Focus).0);
        rim.extend(shots);
        focused
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
        if self.problem.has_one_ray() {
            return Replicate::new(self.problem, Stream::Fresh(0), Parts::JET_ALONE, self.focus);
        }
        let stream = Replicates::stream(self.purpose, number);
        Replicate::new(self.problem, stream, self.parts, self.focus)
    }
}
