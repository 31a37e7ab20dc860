//! What a search may spend, how it is watched, and how it can end.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::checkpoint::Checkpoint;

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The accuracy asked for was reached.
    Converged,
    /// The budget was spent before.
    BudgetSpent,
    /// The nozzle collides with the part at every pose that was tried.
    NoFeasiblePose,
    /// It was told to stop.
    Interrupted,
}

/// What makes a search faster and changes its answer by less than it is accurate; all of it unless told
/// otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortcuts {
    /// Poses that a part of their shots proves to be worse are given no more.
    pub early_ends: bool,
    /// More shots are drawn from where the leading settings do harm.
    pub importance: bool,
}

impl Default for Shortcuts {
    fn default() -> Self {
        Self {
            early_ends: true,
            importance: true,
        }
    }
}

/// What a search may spend, and how it is watched.
pub struct Control<'a> {
    /// Most shots at a pose.
    pub most_shots: usize,
    /// Most fresh shots for the reported figures.
    pub validation_shots: usize,
    /// Set to end the search with the best answer so far.
    pub stop: &'a AtomicBool,
    /// Told about progress; called from any thread.
    pub watch: &'a (dyn Fn(Progress) + Sync),
    /// Where what poses are worth is kept, and taken from.
    pub checkpoint: Option<&'a Checkpoint>,
    /// What may make it faster.
    pub shortcuts: Shortcuts,
}

impl Control<'_> {
    /// Fresh shots that are fired first; all of them only where these say too little.
    pub fn first_validation_shots(&self) -> usize {
        self.validation_shots.div_ceil(PARTS)
    }

    /// Whether the search should come to an end.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// One of so many parts of the fresh shots is fired first.
const PARTS: usize = 4;

static NEVER: AtomicBool = AtomicBool::new(false);

impl Default for Control<'_> {
    fn default() -> Self {
        Self {
            most_shots: 1 << 18,
            validation_shots: 1 << 16,
            stop: &NEVER,
            watch: &|_| (),
            checkpoint: None,
            shortcuts: Shortcuts::default(),
        }
    }
}

/// How far a search is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Poses judged so far.
    pub poses: usize,
    /// Least J so far, on the shots of the search.
    pub best: Option<f64>,
}
