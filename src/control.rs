//! What a run may spend, how it is watched, and how it is ended.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use crate::checkpoint::Checkpoint;

/// What a run may spend, how it is watched, and how it is ended.
#[derive(Clone)]
pub struct Control {
    /// Most shots at a pose of a search.
    pub most_shots: usize,
    /// Most validation shots behind the reported figures.
    pub validation_shots: usize,
    /// Ends the run with the best answer so far.
    pub cancel: Cancel,
    /// Tells the time.
    pub clock: Clock,
    /// Is told about progress, from any thread.
    pub observer: Option<Observer>,
    /// Where what poses are worth is kept, and taken from.
    pub checkpoint: Option<Arc<Checkpoint>>,
    /// What may make a search faster.
    pub shortcuts: Shortcuts,
}

/// Is told about progress.
pub type Observer = Arc<dyn Fn(Progress) + Send + Sync>;

/// What makes a search faster and changes its answer by less than it is accurate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortcuts {
    /// Poses that a part of their shots proves to be worse are given no more.
    pub early_ends: bool,
    /// More shots are drawn from where the leading settings violate limits.
    pub importance: bool,
}

/// How far a run is.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// A search.
    Search {
        /// Poses evaluated so far.
        poses: usize,
        /// Least J so far, on the shots of the search; `None` while the nozzle has fitted nowhere.
        best: Option<f64>,
    },
    /// A step of several.
    Step {
        /// What is measured.
        name: String,
        /// Which of `of` steps, from 0 on.
        number: usize,
        /// How many there are.
        of: usize,
    },
}

/// A request to end, shared with whoever may make it.
#[derive(Clone, Debug)]
pub struct Cancel {
    requested: Arc<AtomicU8>,
    /// The least request that counts here.
    least: u8,
}

/// End with the best answer so far.
const END: u8 = 1;
/// Leave out what makes that answer complete.
const HURRY: u8 = 2;

impl Default for Cancel {
    fn default() -> Self {
        Self {
            requested: Arc::default(),
            least: END,
        }
    }
}

impl Cancel {
    /// Asks for the best answer so far, complete with windows and pictures.
    pub fn end(&self) {
        self.requested.fetch_max(END, Ordering::SeqCst);
    }

    /// Asks for it at once: what makes it complete is left out.
    pub fn hurry(&self) {
        self.requested.fetch_max(HURRY, Ordering::SeqCst);
    }

    /// Whether it was asked for.
    pub fn is_set(&self) -> bool {
        self.requested.load(Ordering::Relaxed) >= self.least
    }

    /// The same for what makes an answer complete: set by [`Self::hurry`] alone.
    #[must_use]
    pub fn of_finishing(&self) -> Self {
        Self {
            requested: Arc::clone(&self.requested),
            least: HURRY,
        }
    }
}

/// Tells the time since whenever it likes, s. The library asks no other clock.
#[derive(Clone)]
pub struct Clock(Arc<dyn Fn() -> f64 + Send + Sync>);

impl Clock {
    /// A clock that is read by a function, s.
    pub fn new(seconds: impl Fn() -> f64 + Send + Sync + 'static) -> Self {
        Self(Arc::new(seconds))
    }

    /// The time, s.
    pub fn seconds(&self) -> f64 {
        (self.0)()
    }
}

impl Default for Clock {
    /// One that stands still: measured times are 0.
    fn default() -> Self {
        Self::new(|| 0.0)
    }
}

impl fmt::Debug for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Clock({} s)", self.seconds())
    }
}

impl Default for Shortcuts {
    fn default() -> Self {
        Self {
            early_ends: true,
            importance: true,
        }
    }
}

impl Default for Control {
    fn default() -> Self {
        Self {
            most_shots: 1 << 18,
            validation_shots: 1 << 16,
            cancel: Cancel::default(),
            clock: Clock::default(),
            observer: None,
            checkpoint: None,
            shortcuts: Shortcuts::default(),
        }
    }
}

impl Control {
    /// Validation shots that are fired first; all of them only where these say too little.
    pub fn first_validation_shots(&self) -> usize {
        self.validation_shots.div_ceil(PARTS)
    }

    /// Whether the run should come to an end.
    pub fn is_stopped(&self) -> bool {
        self.cancel.is_set()
    }

    /// The same for what makes an answer complete: it ends when that should be left out.
    #[must_use]
    pub fn of_finishing(&self) -> Self {
        Self {
            cancel: self.cancel.of_finishing(),
            ..self.clone()
        }
    }

    /// Tells the observer, if there is one.
    pub(crate) fn tell(&self, progress: Progress) {
        if let Some(observer) = &self.observer {
            observer(progress);
        }
    }
}

/// One of this many parts of the validation shots is fired first.
const PARTS: usize = 4;
