//! Speed against accuracy on the problem at hand: how well J is known after how much time, how good
//! the answer is after how much, and what each effect of the model changes and costs.
//!
//! Times are measured on the machine that runs it; every other number is the same on each run, for
//! any number of threads.

mod beside;
mod common;
mod effect;
mod leaks;
mod plan;
mod pose;
mod sampling;
mod search;
mod timing;

pub use beside::{BesideFault, BesidePoint, LARGEST_TABLE, LONGEST_NAME, MOST_METHODS, MOST_RUNS};
pub use effect::Effect;
pub use leaks::Leaks;
pub use plan::Plan;
pub use pose::{PoseCurve, PosePoint, Walls};
pub use sampling::Sampling;
pub use search::{BestKnown, Method, SearchRun, Searches};
#[cfg(feature = "report")]
pub(crate) use timing::median;

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::jet::purpose;
use crate::printable;
use crate::problem::Source;
use crate::problem::fault::Fault;
use crate::problem::setting::Settings;
use crate::record::{RecordFault, SettingsRecord, mesh_sha256, read_json};
use crate::scenario::Scenario;
use crate::solve::solve;
use common::{jackknife, objective, sums};
use sampling::SCRAMBLINGS;

/// Everything that was measured; all figures, tables and texts are made from it alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// Title of the problem.
    pub title: String,
    /// The problem file as it was given on the command line.
    pub file: String,
    /// Its checksum.
    pub problem_sha256: String,
    /// Those of the mesh files; none in charts of older versions.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub mesh_sha256: BTreeMap<String, String>,
    /// Version of the program.
    pub version: String,
    /// The command that makes it again.
    pub command: String,
    /// Seed of all samples.
    pub seed: u64,
    /// Accuracy of J that the file asks for, relative.
    pub accuracy: f64,
    /// Threads that a search may use.
    pub threads: usize,
    /// Whether it was asked to stop before all was measured.
    pub interrupted: bool,
    /// The settings that the search recommends, where J and the effects are looked at.
    pub recommended: Recommended,
    /// J there, on as many shots as it takes to know it well.
    pub reference: Reference,
    /// How well J is known after how much time, for every way to compute it.
    pub poses: Vec<PoseCurve>,
    /// How good the answer is after how much time.
    pub searches: Option<Searches>,
    /// What each effect of the model changes and costs.
    pub effects: Vec<Effect>,
}

/// The answer of the search as the file asks for it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recommended {
    /// Name of the contact.
    pub contact: String,
    /// The settings.
    pub settings: SettingsRecord,
    /// Shots at each pose with which the search ended.
    pub shots_per_pose: usize,
}

/// J at the recommended settings, on exact walls in double precision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// J.
    pub objective: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Shots behind it.
    pub shots: usize,
}

/// Why there is nothing to chart.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The nozzle fits nowhere.
    NoFeasiblePose,
    /// J is 0 at the answer, so that there is no relative error.
    NothingToImprove,
    /// It was asked to stop before anything was measured.
    Interrupted,
    /// The part cannot be turned into triangles.
    TriangleMesh(Vec<Fault>),
}

/// Measures everything, as far as `plan` lets it.
///
/// # Errors
/// When there is nothing to measure.
pub fn measure(
    scenario: &Scenario,
    source: &Source,
    command: String,
    beside: Vec<BesidePoint>,
    plan: &Plan,
) -> Result<Chart, Refusal> {
    plan.tell("search", 0, 1);
    let problem = &scenario.problem;
    let solution = solve(scenario, &plan.of_a_search());
    if plan.is_stopped() {
        return Err(Refusal::Interrupted);
    }
    let best = solution
        .answers
        .first()
        .filter(|best| best.violation <= 0.0);
    let settings = best.ok_or(Refusal::NoFeasiblePose)?.settings;
    let reference = reference(scenario, &settings, plan);
    if reference.objective <= 0.0 {
        return Err(Refusal::NothingToImprove);
    }
    let poses = pose::curves(scenario, &settings, reference.objective, plan)?;
    let searches = search::runs(scenario, &settings, beside, plan);
    let effects = effect::effects(scenario, &settings, plan);
    Ok(Chart {
        title: problem.title.clone(),
        file: printable::line(&source.path.display().to_string()).into_owned(),
        problem_sha256: source.sha256.clone(),
        mesh_sha256: mesh_sha256(scenario, source),
        version: env!("CARGO_PKG_VERSION").into(),
        command,
        seed: problem.seed,
        accuracy: problem.accuracy,
        threads: rayon::current_num_threads(),
        interrupted: plan.is_stopped(),
        recommended: Recommended {
            contact: problem.contacts[settings.contact].name.clone(),
            settings: SettingsRecord::new(&settings),
            shots_per_pose: solution.shots_per_pose,
        },
        reference,
        poses,
        searches,
        effects,
    })
}

fn reference(scenario: &Scenario, settings: &Settings, plan: &Plan) -> Reference {
    plan.tell("reference", 0, 1);
    let goals = &scenario.problem.goals;
    let shots = plan.most_shots * SCRAMBLINGS;
    let sets = &sums(
        scenario,
        &[*settings],
        (purpose::CHART_REFERENCE, Sampling::Sobol),
        shots,
    )[0];
    let (value, standard_error) = jackknife(sets.len(), |kept| objective(goals, sets, kept));
    Reference {
        objective: value,
        standard_error,
        shots,
    }
}

impl Chart {
    /// The chart as JSON text.
    ///
    /// # Errors
    /// None is expected: every number in a chart is finite.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }

    /// Reads a chart back.
    ///
    /// # Errors
    /// When the text is not a chart, or one of a newer version of the program.
    pub fn from_json(text: &str) -> Result<Self, RecordFault> {
        read_json(text)
    }
}

impl From<Vec<Fault>> for Refusal {
    fn from(faults: Vec<Fault>) -> Self {
        Self::TriangleMesh(faults)
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoFeasiblePose => f.write_str(
                "the nozzle fits nowhere, so there is nothing to chart; `peenpose solve` says why",
            ),
            Self::NothingToImprove => f.write_str(
                "J is 0 at the best settings, so errors cannot be given as a share of it",
            ),
            Self::Interrupted => f.write_str("interrupted before anything was measured"),
            Self::TriangleMesh(faults) => {
                f.write_str("the part cannot be turned into triangles")?;
                faults.iter().try_for_each(|fault| write!(f, "; {fault}"))
            }
        }
    }
}

impl std::error::Error for Refusal {}
