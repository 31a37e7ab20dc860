//! What each effect of the model changes and costs: the problem without it, at the same settings.

use serde::{Deserialize, Serialize};

use super::common::{COMPARISON, excess, sums};
use super::control::Control;
use super::timing;
use crate::jet::{Samples, Stream};
use crate::objective::{Sums, Tally};
use crate::problem::Problem;
use crate::problem::setting::{Choice, Tolerance};
use crate::setup::Setup;
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
    /// Time for a pose without it over time with it.
    pub relative_cost: f64,
}

/// The problem without an effect, and the settings that a search for it recommends.
struct Variant {
    name: &'static str,
    setup: Setup,
    misled: Choice,
}

/// The effects that the problem has; those that were reached when the control stops it.
pub(super) fn effects(setup: &Setup, choice: &Choice, control: &Control) -> Vec<Effect> {
    let variants = solved_variants(setup, control);
    if variants.is_empty() {
        return Vec::new();
    }
    let goals = &setup.problem.goals;
    let shots = control.comparison_shots();
    let misled = variants.iter().map(|variant| variant.misled);
    let choices: Vec<Choice> = std::iter::once(*choice).chain(misled).collect();
    let full = sums(setup, &choices, COMPARISON, shots);
    let effect = |(variant, misled): (&Variant, &Vec<Sums>)| {
        let without = &sums(&variant.setup, &[*choice], COMPARISON, shots)[0];
        let (change, change_standard_error) = excess(goals, without, &full[0]);
        let (regret, regret_standard_error) = excess(goals, misled, &full[0]);
        Effect {
            name: variant.name.into(),
            change,
            change_standard_error,
            regret,
            regret_standard_error,
            relative_cost: relative_cost(&variant.setup, setup, choice),
        }
    };
    variants.iter().zip(&full[1..]).map(effect).collect()
}

fn solved_variants(setup: &Setup, control: &Control) -> Vec<Variant> {
    let removals = without_each_effect(&setup.problem);
    let of = removals.len();
    let mut variants = Vec::new();
    for (number, (name, problem)) in removals.into_iter().enumerate() {
        if control.is_stopped() {
            break;
        }
        control.tell("effects", number, of);
        let setup = Setup {
            problem,
            ..setup.clone()
        };
        let solution = solve(&setup, &control.of_a_search());
        let best = solution.answers.first().filter(|_| !control.is_stopped());
        variants.extend(best.map(|best| Variant {
            name,
            misled: best.choice,
            setup,
        }));
    }
    variants
}

/// Few enough to be done before something else takes its turn on a busy machine.
const TIMED_SHOTS: usize = 1024;

fn relative_cost(without: &Setup, with: &Setup, choice: &Choice) -> f64 {
    let draw = |setup: &Setup| Samples::new(&setup.problem, Stream::Search, TIMED_SHOTS);
    let (fewer, all) = (draw(without), draw(with));
    let trace = |setup: &Setup, samples: &Samples| {
        Tally::trace(setup, choice, choice.speed, &samples.deviates)
            .terms(&setup.problem.goals, choice.speed)
    };
    timing::ratio(|| trace(without, &fewer), || trace(with, &all))
}

/// The problem without each of the effects that it has.
fn without_each_effect(problem: &Problem) -> Vec<(&'static str, Problem)> {
    type Removal = (&'static str, fn(&Problem) -> bool, fn(&mut Problem));
    const REMOVALS: [Removal; 7] = [
        (
            "impacts after the first",
            |problem| problem.paths.impacts > 1,
            |problem| problem.paths.impacts = 1,
        ),
        (
            "impacts after the second",
            |problem| problem.paths.impacts > 2,
            |problem| problem.paths.impacts = 2,
        ),
        (
            "width of the exit",
            |problem| problem.jet.exit_diameter > 0.0,
            |problem| problem.jet.exit_diameter = 0.0,
        ),
        (
            "divergence of the jet",
            |problem| problem.jet.divergence > 0.0,
            |problem| problem.jet.divergence = 0.0,
        ),
        (
            "scatter of the speed",
            |problem| problem.jet.speed_spread > 0.0,
            |problem| problem.jet.speed_spread = 0.0,
        ),
        (
            "scatter of the size",
            |problem| problem.shot.size_spread > 0.0,
            |problem| problem.shot.size_spread = 0.0,
        ),
        (
            "tolerance of the settings",
            |problem| problem.tolerance != Tolerance::default(),
            |problem| problem.tolerance = Tolerance::default(),
        ),
    ];
    let present = REMOVALS.into_iter().filter(|(_, has, _)| has(problem));
    present
        .map(|(name, _, remove)| {
            let mut problem = problem.clone();
            remove(&mut problem);
            (name, problem)
        })
        .collect()
}
