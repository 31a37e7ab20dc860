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
use crate::problem::setting::Choice;
use crate::setup::Setup;

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
pub fn notes(setup: &Setup, choice: &Choice, evaluation: Option<&Evaluation>) -> Vec<Note> {
    let mut notes = vec![
        flight::gravity(choice),
        flight::drag(setup, choice),
        restitution::note(setup, choice, evaluation),
    ];
    notes.extend(size::point_shots(setup));
    if setup.problem.tolerance == Default::default() {
        notes.push(Note {
            name: "no_tolerance",
            value: 0.0,
            text: "the file has no tolerance: the answer holds for a nozzle that is set exactly"
                .into(),
        });
    }
    notes.extend(interference::note(setup, choice, evaluation));
    notes.extend(size::fillet(setup));
    notes.extend(size::opening(setup, choice));
    notes.extend(facets::note(setup));
    notes.extend(setup.scene.warnings().iter().map(|warning| Note {
        name: "mesh",
        value: 0.0,
        text: warning.clone(),
    }));
    notes
}
