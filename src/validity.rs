//! What the model leaves out, and how much that could matter at the answer.
//!
//! `docs/model.md` derives the numbers behind the notes.

mod facets;
mod flight;
mod interference;
mod restitution;
mod size;

pub use interference::STRONG as STRONG_INTERFERENCE;

use crate::evaluate::Evaluation;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// Something that the model leaves out or that the user should know, with its number.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// A short fixed name for programs.
    pub name: &'static str,
    /// The number behind it, in the unit that the text gives.
    pub value: f64,
    /// What it means, for people.
    pub text: String,
}

/// The notes on an answer; `evaluation` is what it does, when that is known.
pub fn notes(
    scenario: &Scenario,
    settings: &Settings,
    evaluation: Option<&Evaluation>,
) -> Vec<Note> {
    let mut notes = vec![
        flight::gravity(settings),
        flight::drag(scenario, settings),
        restitution::note(scenario, settings, evaluation),
    ];
    notes.extend(size::point_shots(scenario));
    if scenario.problem.tolerance == Default::default() {
        notes.push(Note {
            name: "no_tolerance",
            value: 0.0,
            text: "the file has no tolerance: the answer holds for a nozzle that is set exactly"
                .into(),
        });
    }
    notes.extend(interference::note(scenario, settings, evaluation));
    notes.extend(size::fillet(scenario));
    notes.extend(size::opening(scenario, settings));
    notes.extend(facets::note(scenario));
    notes.extend(scenario.scene.warnings().iter().map(|warning| Note {
        name: "mesh",
        value: 0.0,
        text: warning.clone(),
    }));
    notes
}
