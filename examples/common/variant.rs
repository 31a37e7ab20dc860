//! The problems that the search is tried on: the shipped keyways, with and without errors of setting.

use std::error::Error;
use std::path::{Path, PathBuf};

use peenpose::problem::Problem;
use peenpose::problem::model::Model;
use peenpose::problem::setting::Tolerance;
use peenpose::setup::Setup;

/// A shipped problem whose nozzle is set exactly or within a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    pub file: &'static str,
    pub tolerance: bool,
}

const fn exact(file: &'static str) -> Variant {
    Variant {
        file,
        tolerance: false,
    }
}

const fn tolerant(file: &'static str) -> Variant {
    Variant {
        file,
        tolerance: true,
    }
}

const SHORT: &str = "keyway.yaml";
const LONG: &str = "keyway-long.yaml";
const BLIND: &str = "keyway-blind.yaml";

pub const VARIANTS: [Variant; 6] = [
    exact(SHORT),
    tolerant(SHORT),
    exact(LONG),
    tolerant(LONG),
    exact(BLIND),
    tolerant(BLIND),
];

fn path(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("problems")
        .join(file)
}

impl Variant {
    /// The problem with its scene.
    pub fn setup(&self) -> Result<Setup, Box<dyn Error>> {
        let (mut setup, _) = Setup::load(&path(self.file))?;
        // What is known as best was found for points, with everything else.
        setup.problem.paths.shot_size = false;
        setup.problem.model = Model::Full;
        let tolerance = &mut setup.problem.tolerance;
        if !self.tolerance {
            *tolerance = Tolerance::default();
        } else if *tolerance == Tolerance::default() {
            // The long hub has none of its own: it is set as exactly as the short one.
            *tolerance = Setup::load(&path(SHORT))?.0.problem.tolerance;
        }
        Ok(setup)
    }

    /// "yes" or "no", as in tables.
    pub fn tolerance_word(&self) -> &'static str {
        if self.tolerance { "yes" } else { "no" }
    }

    /// File and tolerance in a few words.
    pub fn name(&self) -> String {
        let ending = if self.tolerance {
            " with tolerance"
        } else {
            ""
        };
        format!("{}{ending}", self.file.trim_end_matches(".yaml"))
    }
}

/// Index of a contact by its name.
pub fn contact_named(problem: &Problem, name: &str) -> Option<usize> {
    problem
        .contacts
        .iter()
        .position(|contact| contact.name == name)
}
