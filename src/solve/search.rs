//! The search for one contact, stage by stage.

use rayon::prelude::*;

use super::judge::Judge;
use super::polish::{Candidate, polish};
use super::space::Space;
use crate::setup::Setup;

/// A stage of the search.
pub(super) struct Stage {
    pub shots: usize,
    /// Candidates that go on, for each contact.
    pub candidates: usize,
    /// Longest edge of the first simplex, as a share of each range.
    pub size: f64,
}

/// More and more shots for fewer and fewer candidates.
pub(super) const STAGES: [Stage; 3] = [
    Stage {
        shots: 256,
        candidates: 6,
        size: 0.4,
    },
    Stage {
        shots: 1024,
        candidates: 2,
        size: 0.3,
    },
    Stage {
        shots: 4096,
        candidates: 1,
        size: 0.15,
    },
];

/// A descent ends when J differs by less than this share of the accuracy over its simplex.
const SETTLED: f64 = 0.1;

impl Stage {
    /// What follows the last stage while the answer is not accurate enough.
    pub fn beyond(shots: usize) -> Self {
        Self {
            shots,
            candidates: 1,
            size: 0.06,
        }
    }
}

/// The search for one contact.
#[derive(Clone)]
pub(super) struct Search {
    space: Space,
    /// Best first.
    candidates: Vec<Candidate>,
}

impl Search {
    /// Judges a low-discrepancy set of points all over the space.
    pub fn screen(setup: &Setup, contact: usize, judge: &Judge) -> Self {
        let space = Space::new(&setup.problem, contact, !setup.speed_scales_out(contact));
        let dimensions = space.dimensions();
        let points = match dimensions {
            0 => 1,
            1 => 32,
            2 => 96,
            3 => 192,
            _ => 128 * dimensions,
        };
        let seed = setup.problem.seed as u32;
        let candidates = (0..points as u32)
            .into_par_iter()
            .map(|index| Candidate::at(&space, judge, &space.spread(index, seed)))
            .collect();
        let mut search = Self { space, candidates };
        search.sort();
        search
    }

    /// The best candidate so far.
    pub fn best(&self) -> &Candidate {
        &self.candidates[0]
    }

    /// The same candidates in the space of another model of the same problem.
    pub fn carried_over(&self, setup: &Setup) -> Self {
        let contact = self.best().choice.contact;
        let space = Space::new(&setup.problem, contact, !setup.speed_scales_out(contact));
        let carried = |candidate: &Candidate| Candidate {
            point: space.point(&candidate.choice),
            ..candidate.clone()
        };
        Self {
            candidates: self.candidates.iter().map(carried).collect(),
            space,
        }
    }

    fn sort(&mut self) {
        self.candidates
            .sort_by(|a, b| a.standing.rank().total_cmp(&b.standing.rank()));
    }

    /// Goes on from the best few candidates with more shots.
    pub fn refine(&mut self, judge: &Judge, stage: &Stage, accuracy: f64) {
        let space = &self.space;
        let mut starts: Vec<Candidate> = Vec::new();
        for candidate in &self.candidates {
            let is_new = |other: &Candidate| {
                space.distance(&candidate.point, &other.point) > 0.2 * stage.size
            };
            if starts.len() < stage.candidates && starts.iter().all(is_new) {
                starts.push(candidate.clone());
            }
        }
        self.candidates = starts
            .into_par_iter()
            .map(|start| {
                let start = Candidate::at(space, judge, &start.point);
                polish(space, judge, start, stage.size, SETTLED * accuracy)
            })
            .collect();
        self.sort();
    }

    /// Goes on from the best candidate with more shots, or from where another contact is best.
    ///
    /// Often friction makes little difference: what is there within half the accuracy of that
    /// contact's J is taken as it is.
    pub fn refine_beside(&mut self, leader: &Self, judge: &Judge, stage: &Stage, accuracy: f64) {
        let other = leader.best();
        if other.point.len() != self.space.dimensions() {
            return self.refine(judge, stage, accuracy);
        }
        let there = Candidate::at(&self.space, judge, &other.point);
        let own = Candidate::at(&self.space, judge, &self.best().point);
        let start = there.or_better(own);
        let close_enough = other.standing.rank() * (1.0 + 0.5 * accuracy);
        self.candidates = vec![if start.standing.rank() <= close_enough {
            start
        } else {
            polish(&self.space, judge, start, stage.size, SETTLED * accuracy)
        }];
    }
}
