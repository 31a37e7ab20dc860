//! The problems that the search is tried on: the shipped keyways, with and without errors of setting,
//! as they are and with shots that fly as points.

use std::error::Error;
use std::path::PathBuf;

use peenpose::problem::Problem;
use peenpose::problem::model::Model;
use peenpose::problem::setting::Tolerance;
use peenpose::scenario::Scenario;

/// How shots fly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shots {
    /// In their size, and the program decides what it models: as the problem files have it.
    Spheres,
    /// As points, with every other effect.
    Points,
}

/// A shipped problem whose nozzle is set exactly or within a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    pub file: &'static str,
    pub tolerance: bool,
    pub shots: Shots,
}

const FILES: [&str; 3] = [SHORT, "keyway-long.yaml", "keyway-blind.yaml"];
const SHORT: &str = "keyway.yaml";

/// All of them.
pub fn variants() -> impl Iterator<Item = Variant> {
    let both = |file| [false, true].map(|tolerance| (file, tolerance));
    let all = [Shots::Spheres, Shots::Points];
    all.into_iter().flat_map(move |shots| {
        let cases = FILES.into_iter().flat_map(both);
        cases.map(move |(file, tolerance)| Variant {
            file,
            tolerance,
            shots,
        })
    })
}

/// Where a shipped problem is.
pub fn path(file: &str) -> PathBuf {
    super::root().join("problems").join(file)
}

impl Variant {
    /// The problem with its scene. Every share of violations is allowed: what is measured with it is the search for
    /// the least J.
    pub fn scenario(&self) -> Result<Scenario, Box<dyn Error>> {
        let (mut scenario, _) = Scenario::load(&path(self.file))?;
        if self.shots == Shots::Points {
            scenario.problem.paths.shot_size = false;
            scenario.problem.model = Model::Full;
        }
        let tolerance = &mut scenario.problem.tolerance;
        if !self.tolerance {
            *tolerance = Tolerance::default();
        } else if *tolerance == Tolerance::default() {
            // The long hub has none of its own: it is set as exactly as the short one.
            *tolerance = Scenario::load(&path(SHORT))?.0.problem.tolerance;
        }
        allow_every_share(&mut scenario);
        Ok(scenario)
    }

    /// "yes" or "no", as in tables.
    pub fn tolerance_word(&self) -> &'static str {
        if self.tolerance { "yes" } else { "no" }
    }

    /// "spheres" or "points", as in tables.
    pub fn shots_word(&self) -> &'static str {
        match self.shots {
            Shots::Spheres => "spheres",
            Shots::Points => "points",
        }
    }

    /// All of it in a few words.
    pub fn name(&self) -> String {
        let tolerance = if self.tolerance {
            " with tolerance"
        } else {
            ""
        };
        let shots = self.shots_word();
        format!(
            "{}{tolerance} ({shots})",
            self.file.trim_end_matches(".yaml")
        )
    }
}

/// Allows every share of violations: what is measured is the search for the least J.
pub fn allow_every_share(scenario: &mut Scenario) {
    let goals = &mut scenario.problem.goals;
    goals.normal_impulse.share = 1.0;
    goals.miss.share = 1.0;
    if let Some(tangential) = &mut goals.tangential_impulse {
        tangential.share = 1.0;
    }
    for limits in &mut scenario.surfaces {
        limits.share = 1.0;
    }
}

/// Index of a contact by its name.
pub fn contact_named(problem: &Problem, name: &str) -> Option<usize> {
    problem
        .contacts
        .iter()
        .position(|contact| contact.name == name)
}
