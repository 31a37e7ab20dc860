//! How much is measured, and how it is watched.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::solve;

/// How much is measured, and how it is watched.
pub struct Control<'a> {
    /// Most shots at a pose; the reference takes [`Replicates::COUNT`](crate::jet::Replicates::COUNT)
    /// times as many.
    pub most_shots: usize,
    /// Independent sets of shots behind each error of J.
    pub replicates: usize,
    /// Searches with seeds of their own at each speed.
    pub seeds: usize,
    /// Set to end with what has been measured so far.
    pub stop: &'a AtomicBool,
    /// Told what is being measured.
    pub watch: &'a (dyn Fn(Step) + Sync),
}

/// What is being measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// For people.
    pub name: String,
    /// Its number, from 0.
    pub number: usize,
    /// How many there are of its kind.
    pub of: usize,
}

static NEVER: AtomicBool = AtomicBool::new(false);

impl Default for Control<'_> {
    fn default() -> Self {
        Self {
            most_shots: 1 << 18,
            replicates: 16,
            seeds: 3,
            stop: &NEVER,
            watch: &|_| (),
        }
    }
}

impl Control<'_> {
    pub(super) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    pub(super) fn tell(&self, name: impl Into<String>, number: usize, of: usize) {
        (self.watch)(Step {
            name: name.into(),
            number,
            of,
        });
    }

    /// Shots on which answers and effects are compared.
    pub(super) fn comparison_shots(&self) -> usize {
        4 * self.most_shots
    }

    /// For searches as `peenpose solve` does them.
    pub(super) fn of_a_search(&self) -> solve::Control<'_> {
        solve::Control {
            stop: self.stop,
            ..solve::Control::default()
        }
    }
}
