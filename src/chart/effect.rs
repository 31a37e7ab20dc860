//! What each effect of the model changes and costs: the problem without it, at the same settings.

use serde::{Deserialize, Serialize};

use super::common::{COMPARISON, excess, sums};
use super::plan::Plan;
use super::timing;
use crate::feasibility::infeasibility;
use crate::jet::{Samples, Stream};
use crate::objective::{Sums, Tally};
use crate::problem::model::{Effect as Modelled, Model};
use crate::problem::setting::{Settings, Tolerance};
use crate::scenario::Scenario;
use crate::solve::solve;

/// One effect: what happens without it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Effect {
    /// What is left out.
    pub name: String,
    /// By how much J at the recommended settings changes without it, relative.
    pub change: f64,
    /// Standard error of that.
    pub change_standard_error: f64,
    /// By how much J, computed with it, is higher at the settings that a search without it
    /// recommends, relative to J at the recommended ones.
    pub regret: f64,
    /// Standard error of that.
    pub regret_standard_error: f64,
    /// Whether the nozzle fits at those settings; where it does not, J there means nothing.
    #[serde(default = "yes")]
    pub fits: bool,
    /// Time for a pose without it over time with it.
    pub relative_cost: f64,
}

/// Charts of older versions do not say whether the nozzle fits.
fn yes() -> bool {
    true
}

/// The problem without an effect, and the settings that a search for it recommends.
struct Variant {
    name: &'static str,
    scenario: Scenario,
    misled: Settings,
}

/// The effects that the problem has; those that were reached when a request to end came.
pub(super) fn effects(scenario: &Scenario, settings: &Settings, plan: &Plan) -> Vec<Effect> {
    let variants = solved_variants(scenario, settings, plan);
    if variants.is_empty() {
        return Vec::new();
    }
    let goals = &scenario.problem.goals;
    let shots = plan.comparison_shots();
    let misled = variants.iter().map(|variant| variant.misled);
    let choices: Vec<Settings> = std::iter::once(*settings).chain(misled).collect();
    let full = sums(scenario, &choices, COMPARISON, shots);
    let effect = |(variant, misled): (&Variant, &Vec<Sums>)| {
        let without = &sums(&variant.scenario, &[*settings], COMPARISON, shots)[0];
        let (change, change_standard_error) = excess(goals, without, &full[0]);
        let (regret, regret_standard_error) = excess(goals, misled, &full[0]);
        Effect {
            name: variant.name.into(),
            change,
            change_standard_error,
            regret,
            regret_standard_error,
            fits: infeasibility(scenario, &variant.misled).is_none(),
            relative_cost: relative_cost(plan, &variant.scenario, scenario, settings),
        }
    };
    variants.iter().zip(&full[1..]).map(effect).collect()
}

fn solved_variants(scenario: &Scenario, settings: &Settings, plan: &Plan) -> Vec<Variant> {
    let removals = without_each_effect(scenario, settings);
    let of = removals.len();
    let mut variants = Vec::new();
    for (number, (name, scenario)) in removals.into_iter().enumerate() {
        if plan.is_stopped() {
            break;
        }
        plan.tell("effects", number, of);
        let solution = solve(&scenario, &plan.of_a_search());
        let best = solution.least().filter(|_| !plan.is_stopped());
        variants.extend(best.map(|best| Variant {
            name,
            misled: best.settings,
            scenario,
        }));
    }
    variants
}

/// Few enough to be done before something else takes its turn on a busy machine.
const TIMED_SHOTS: usize = 1024;

fn relative_cost(plan: &Plan, without: &Scenario, with: &Scenario, settings: &Settings) -> f64 {
    let draw = |scenario: &Scenario| Samples::new(&scenario.problem, Stream::Search, TIMED_SHOTS);
    let (fewer, all) = (draw(without), draw(with));
    let trace = |scenario: &Scenario, samples: &Samples| {
        Tally::trace(scenario, settings, settings.speed, &samples.shots)
            .terms(&scenario.problem.goals, settings.speed)
    };
    timing::ratio(
        &plan.control.clock,
        || trace(without, &fewer),
        || trace(with, &all),
    )
}

/// The scenario without each of the effects that it has, and without its tolerance; searches for them
/// leave out nothing else.
fn without_each_effect(scenario: &Scenario, settings: &Settings) -> Vec<(&'static str, Scenario)> {
    let effects = scenario.problem.effects().into_iter();
    let without = |effect: Modelled| (effect.description(), scenario.without(&[effect], settings));
    let mut variants: Vec<(&'static str, Scenario)> = effects.map(without).collect();
    if scenario.problem.tolerance != Tolerance::default() {
        let mut exact = scenario.clone();
        exact.problem.tolerance = Tolerance::default();
        variants.push(("tolerance of the settings", exact));
    }
    for (_, variant) in &mut variants {
        variant.problem.model = Model::Full;
    }
    variants
}
