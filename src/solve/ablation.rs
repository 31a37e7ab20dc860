//! Ablation: each effect of the model left out at the answer.

mod bench;

use rayon::prelude::*;

use super::evaluator::Effort;
use super::search::Search;
use crate::control::Control;
use crate::jet::ImportanceDensity;
use crate::problem::model::Effect;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::verdict::Subject;
use bench::Bench;

/// The model without one effect against the whole model.
#[derive(Clone, Debug, PartialEq)]
pub struct Ablation {
    /// The effect.
    pub effect: Effect,
    /// Relative change of J without it at the leading settings.
    pub change: f64,
    /// The largest such change, either way, over the leading settings of all contacts.
    pub largest_change: f64,
    /// The verdicts that change without it.
    pub turned: Vec<Subject>,
    /// The best settings near the leading ones without it, and with it.
    pub best_without: Settings,
    /// See `best_without`.
    pub best_with: Settings,
    /// Regret: by how much J of the whole model is higher at the former, relative.
    pub regret: f64,
    /// Rays of a pose without it over rays with it.
    pub relative_rays: f64,
    /// Whether the problem asks for a model without it.
    pub left_out: bool,
}

/// Shots that changes of J and of verdicts are measured on.
const SHOTS: usize = 1024;

/// Measures every effect of a problem, those of the model that is asked for first, at the best
/// candidates of the searches; none where the nozzle fits nowhere.
pub(super) fn measure(
    whole: &Scenario,
    asked: &Scenario,
    importance: Option<&ImportanceDensity>,
    searches: &[Search],
    effort: &Effort,
    control: &Control,
) -> Vec<Ablation> {
    let of = |scenario: &Scenario, effects: &[Effect], left_out: bool| -> Vec<Ablation> {
        if effects.is_empty() {
            return Vec::new();
        }
        let Some(bench) = Bench::new(scenario, importance, searches, effort, control) else {
            return Vec::new();
        };
        let start = bench.start();
        let each = effects.par_iter();
        each.map(|&effect| bench.ablation(effect, &start, left_out))
            .collect()
    };
    let mut all = of(asked, &asked.problem.effects(), false);
    all.extend(of(whole, &whole.unasked(), true));
    all
}
