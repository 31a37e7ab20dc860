//! What parses but can hardly be meant: all that the file alone and its scene tell.

mod extent;
mod inside;
mod sight;

use crate::problem::Source;
use crate::problem::warning::{self, Warning};
use crate::scenario::Scenario;

/// All warnings about a problem, in the order of its text.
///
/// ```
/// use peenpose::{scenario::Scenario, warnings};
/// let (scenario, source) = Scenario::load("problems/keyway.yaml".as_ref())?;
/// assert_eq!(warnings::of(&scenario, &source), []);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn of(scenario: &Scenario, source: &Source) -> Vec<Warning> {
    let mut found = warning::warnings(&scenario.problem);
    found.extend(extent::warnings(scenario));
    found.extend(inside::warning(scenario));
    found.extend(sight::warning(scenario));
    let mut placed: Vec<Warning> = found.into_iter().map(|it| it.in_text(source)).collect();
    placed.sort_by_key(|warning| warning.at);
    placed
}
