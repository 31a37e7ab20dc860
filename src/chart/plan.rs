//! How much a chart measures.

use crate::control::{Control, Progress};

/// How much a chart measures, and how that is watched and ended.
#[derive(Clone)]
pub struct Plan {
    /// Most shots at a pose; the reference takes [`Replicates::COUNT`](crate::jet::Replicates::COUNT)
    /// times as many.
    pub most_shots: usize,
    /// Independent sets of shots behind each error of J.
    pub replicates: usize,
    /// Searches with seeds of their own at each speed.
    pub seeds: usize,
    /// How it is watched and ended, and the clock behind its times; searches are as `peenpose solve` does
    /// them.
    pub control: Control,
}

impl Default for Plan {
    fn default() -> Self {
        Self {
            most_shots: 1 << 18,
            replicates: 16,
            seeds: 3,
            control: Control::default(),
        }
    }
}

impl Plan {
    pub(super) fn is_stopped(&self) -> bool {
        self.control.is_stopped()
    }

    /// The time, s.
    pub(super) fn seconds(&self) -> f64 {
        self.control.clock.seconds()
    }

    pub(super) fn tell(&self, name: impl Into<String>, number: usize, of: usize) {
        self.control.tell(Progress::Step {
            name: name.into(),
            number,
            of,
        });
    }

    /// Shots on which answers and effects are compared.
    pub(super) fn comparison_shots(&self) -> usize {
        4 * self.most_shots
    }

    /// For searches.
    pub(super) fn of_a_search(&self) -> Control {
        Control {
            cancel: self.control.cancel.clone(),
            clock: self.control.clock.clone(),
            ..Control::default()
        }
    }
}
