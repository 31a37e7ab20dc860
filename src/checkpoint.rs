//! Work that is written down as it is done, so that a run that was ended goes on where it was.
//!
//! What settings do on given shots depends on nothing but the scene, the problem and those shots. A
//! run that finds it in the file takes it from there and does the rest: it ends with the same bits
//! as one that was never interrupted. Work of another problem in the same file is never taken, nor
//! is what no work can have come to.

mod log;

use std::collections::HashMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};

use crate::jet::ShotSample;
use crate::problem::Problem;
use crate::problem::part::{Part, Shape};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use log::Log;
pub use log::{LARGEST_FILE, Trouble};

/// The file that keeps the work of runs.
pub struct Checkpoint {
    /// Of the program's version and the scene.
    scene: Sha256,
    known: HashMap<Key, String>,
    log: Mutex<Log>,
    recalled: AtomicUsize,
}

/// What identifies a piece of work: a hash of all that it depends on.
type Key = [u8; 16];

impl Checkpoint {
    /// Opens the file in a folder, or makes both, for runs on the scene of a scenario.
    ///
    /// # Errors
    /// The file cannot be read or written, another run uses it, it has more than [`LARGEST_FILE`]
    /// bytes, or it is damaged before its end.
    pub fn open(folder: &Path, scenario: &Scenario) -> Result<Self, Trouble> {
        let (log, known) = Log::open(folder)?;
        Ok(Self {
            scene: hash_of_scene(scenario),
            known,
            log: Mutex::new(log),
            recalled: AtomicUsize::new(0),
        })
    }

    /// How many pieces of work this run has taken from the file.
    pub fn recalled(&self) -> usize {
        self.recalled.load(Ordering::Relaxed)
    }

    /// How many this run has added to it.
    pub fn added(&self) -> usize {
        self.log().added()
    }

    /// Writes what is not in the file yet.
    ///
    /// # Errors
    /// What could not be written, now or earlier. Nothing is written after a failure, so that the
    /// file is only ever cut short.
    pub fn finish(&self) -> Result<(), Trouble> {
        self.log().finish()
    }

    /// A page for work with a scenario on given shots; `kind` tells work of different kinds apart.
    pub(crate) fn page(&self, kind: &str, scenario: &Scenario, shots: &[ShotSample]) -> Page<'_> {
        let mut hash = self.scene.clone();
        let problem = Problem {
            // A title decides nothing; the parts are in the scene.
            title: String::new(),
            parts: Vec::new(),
            ..scenario.problem.clone()
        };
        hash.update(format!(
            "{kind} {problem:?} {:?} {:?}",
            scenario.target, scenario.surfaces
        ));
        for shot in shots {
            add(&mut hash, &shot.numbers());
        }
        Page {
            checkpoint: self,
            hash,
        }
    }

    fn recall<T: DeserializeOwned>(&self, key: &Key, is_sound: impl Fn(&T) -> bool) -> Option<T> {
        let outcome = serde_json::from_str(self.known.get(key)?).ok();
        let outcome = outcome.filter(is_sound)?;
        self.recalled.fetch_add(1, Ordering::Relaxed);
        Some(outcome)
    }

    fn keep<T: Serialize>(&self, key: &Key, value: &T) {
        // What JSON cannot hold is worked out again by the next run.
        if let Ok(value) = serde_json::to_string(value) {
            self.log().add(key, &value);
        }
    }

    fn log(&self) -> MutexGuard<'_, Log> {
        // What a thread left behind that panicked is whole lines.
        self.log.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The work on one set of shots.
pub(crate) struct Page<'a> {
    checkpoint: &'a Checkpoint,
    hash: Sha256,
}

impl Page<'_> {
    /// The outcome of work on some settings, from the file. `beside` is what else it depends on;
    /// `is_sound` whether an outcome is one that work can come to, as anybody can write a file.
    pub fn recall<T>(
        &self,
        settings: &Settings,
        beside: &[f64],
        is_sound: impl Fn(&T) -> bool,
    ) -> Option<T>
    where
        T: DeserializeOwned,
    {
        self.checkpoint
            .recall(&self.key(settings, beside), is_sound)
    }

    /// Writes such an outcome down.
    pub fn keep(&self, settings: &Settings, beside: &[f64], outcome: &impl Serialize) {
        self.checkpoint.keep(&self.key(settings, beside), outcome);
    }

    fn key(&self, settings: &Settings, beside: &[f64]) -> Key {
        let mut hash = self.hash.clone();
        add(&mut hash, &settings.numbers());
        add(&mut hash, beside);
        hash.update(settings.contact.to_le_bytes());
        let mut key = Key::default();
        key.copy_from_slice(&hash.finalize()[..16]);
        key
    }
}

/// Of everything that is there, whatever the names of the files it comes from.
fn hash_of_scene(scenario: &Scenario) -> Sha256 {
    let mut hash = Sha256::new();
    hash.update(env!("CARGO_PKG_VERSION"));
    for part in &scenario.problem.parts {
        hash.update(description(part));
    }
    let surfaces = scenario.scene.surfaces();
    for (index, name) in (0..).zip(surfaces) {
        hash.update(name);
        for corner in scenario.scene.surface_triangles(index).flatten() {
            add(&mut hash, &[corner.x, corner.y, corner.z]);
        }
    }
    hash
}

/// A part without the path of its mesh, whose triangles are in the scene.
fn description(part: &Part) -> String {
    let shape = match &part.shape {
        Shape::Mesh { .. } => String::new(),
        exact => format!("{exact:?}"),
    };
    let Part {
        name,
        place,
        on_nozzle,
        cut,
        ..
    } = part;
    format!("{name} {shape} {place:?} {on_nozzle} {cut:?}")
}

fn add(hash: &mut Sha256, numbers: &[f64]) {
    for number in numbers {
        hash.update(number.to_bits().to_le_bytes());
    }
}
