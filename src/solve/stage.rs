//! The stages of a search.

use super::evaluator::Evaluator;
use super::polish::{Candidate, polish};
use super::space::Space;

/// A stage of the search.
#[derive(Clone, Copy)]
pub(super) struct Stage {
    pub shots: usize,
    /// Candidates that go on, of each group.
    pub candidates: usize,
    /// Longest edge of the first simplex, as a share of each range.
    pub size: f64,
    /// A descent ends when J differs by less than this share of the accuracy over its simplex.
    pub settled: f64,
    /// Descents at most, each from where the one before ended: a new simplex leaves hollows in which
    /// an old one has shrunk.
    pub descents: usize,
    /// Whether contacts that lag behind descend as well.
    pub catches_up: bool,
}

/// Successive halving: more shots for fewer candidates.
pub(super) const STAGES: [Stage; 4] = [
    Stage {
        shots: 128,
        candidates: 6,
        size: 0.4,
        settled: 1.0,
        descents: 1,
        catches_up: true,
    },
    Stage {
        shots: 256,
        candidates: 2,
        size: 0.4,
        settled: 0.1,
        descents: 1,
        catches_up: true,
    },
    Stage {
        shots: 1024,
        candidates: 1,
        size: 0.3,
        settled: 0.05,
        descents: 1,
        catches_up: true,
    },
    Stage {
        shots: 4096,
        candidates: 1,
        size: 0.15,
        settled: 0.1,
        descents: 2,
        catches_up: true,
    },
];

/// The same for nozzles that are set exactly: a descent that looks more closely finds hollows of the few
/// shots, which makes more of them necessary than J does.
pub(super) const STAGES_SET_EXACTLY: [Stage; 4] = [
    STAGES[0],
    Stage {
        settled: 0.5,
        ..STAGES[1]
    },
    Stage {
        settled: 0.1,
        ..STAGES[2]
    },
    STAGES[3],
];

impl Stage {
    /// The stage after the last one, while the answer is not accurate enough.
    pub fn beyond(shots: usize) -> Self {
        Self {
            shots,
            candidates: 1,
            size: 0.06,
            settled: 0.1,
            descents: 1,
            catches_up: false,
        }
    }

    /// The same with its descents shared out among groups.
    pub fn shared_by(&self, groups: usize) -> Self {
        Self {
            descents: self.descents.div_ceil(groups),
            ..*self
        }
    }

    /// The same for a contact that lags behind.
    pub fn catching_up(&self) -> Self {
        Self {
            descents: if self.catches_up { self.descents } else { 0 },
            ..*self
        }
    }

    /// Where the descents from a candidate end.
    pub fn descent(&self, space: &Space, evaluator: &Evaluator, start: Candidate) -> Candidate {
        let descents = 0..self.descents;
        descents.fold(start, |best, _| {
            let next = polish(
                space,
                evaluator,
                best.clone(),
                self.size,
                self.settled * evaluator.accuracy(),
            );
            best.or_better(next)
        })
    }
}
