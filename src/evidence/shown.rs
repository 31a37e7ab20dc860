//! Which shots are worth drawing: the first ones as they come, and some of those that break a
//! limit, however rare they are.

use std::collections::BTreeMap;

use super::Flight;
use crate::scenario::Scenario;
use crate::verdict::Subject;

/// Shots that are drawn.
const SHOWN: usize = 200;
/// Of these, shots that are picked because they break a goal or a limit.
const PICKED: usize = 50;

/// A shot that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Index of its flight.
    pub flight: usize,
    /// Whether it was picked because it breaks something; the others are shown as they come.
    pub picked: bool,
}

/// The first shots in their order, then the picked ones in theirs: of each goal and limit that any
/// of the later shots breaks about as many.
pub(super) fn pick(scenario: &Scenario, flights: &[Flight]) -> Vec<Shown> {
    let as_they_come = flights.len().min(SHOWN - PICKED);
    let breaking: Vec<(usize, Vec<Subject>)> = (as_they_come..flights.len())
        .map(|index| (index, flights[index].broken(scenario)))
        .filter(|(_, subjects)| !subjects.is_empty())
        .collect();
    let mut shown_of: BTreeMap<Subject, usize> = BTreeMap::new();
    for subject in breaking.iter().flat_map(|(_, subjects)| subjects) {
        shown_of.insert(*subject, 0);
    }
    let each = PICKED / shown_of.len().max(1);
    let mut picked = Vec::new();
    for (index, subjects) in &breaking {
        if picked.len() < PICKED && subjects.iter().any(|subject| shown_of[subject] < each) {
            picked.push(*index);
            for subject in subjects {
                *shown_of.entry(*subject).or_default() += 1;
            }
        }
    }
    let more = (SHOWN - PICKED) + (PICKED - picked.len());
    let usual = (0..flights.len().min(more)).filter(|index| !picked.contains(index));
    let shown = |picked| move |flight| Shown { flight, picked };
    let mut all: Vec<Shown> = usual.map(shown(false)).collect();
    all.extend(picked.iter().copied().map(shown(true)));
    all
}
