//! How good the answer of a search is after how much time.

use serde::{Deserialize, Serialize};

use super::beside::BesidePoint;
use super::common::{COMPARISON, excess, objective, sums};
use super::plan::Plan;
use super::timing::median;
use crate::control::Control;
use crate::problem::setting::Settings;
use crate::record::SettingsRecord;
use crate::scenario::Scenario;
use crate::solve::solve;

/// Searches with more and more effort, against the best answer that is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Searches {
    /// The best of all answers seen here.
    pub best_known: BestKnown,
    /// Shots common to all answers, on which they are compared.
    pub shots: usize,
    /// Single searches.
    pub runs: Vec<SearchRun>,
    /// Other methods, measured elsewhere.
    pub beside: Vec<BesidePoint>,
}

/// The best of all answers seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BestKnown {
    /// Name of the contact.
    pub contact: String,
    /// The settings.
    pub settings: SettingsRecord,
    /// J there.
    pub objective: f64,
}

/// One search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SearchRun {
    /// How it was told to trade accuracy for time.
    pub method: Method,
    /// Its seed.
    pub seed: u64,
    /// Wall time on all threads, s.
    pub seconds: f64,
    /// Shots at each pose with which it ended.
    pub shots_per_pose: usize,
    /// Name of the contact that it recommends.
    pub contact: String,
    /// The settings that it recommends.
    pub settings: SettingsRecord,
    /// By how much J there is above the best known, relative to it.
    pub excess: f64,
    /// Standard error of that.
    pub excess_standard_error: f64,
}

/// How a search is told to trade accuracy for time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Shots rise until this accuracy of J is reached, as `peenpose solve --accuracy` does.
    Accuracy(f64),
    /// The search ends with the stage that takes this many shots, however inaccurate.
    MostShots(usize),
}

impl Searches {
    /// The median standard error of an excess: smaller differences are noise.
    pub fn noise(&self) -> f64 {
        median(
            self.runs
                .iter()
                .map(|run| run.excess_standard_error)
                .collect(),
        )
    }
}

/// Accuracies that are tried besides that of the file.
const ACCURACIES: [f64; 5] = [0.3, 0.1, 0.03, 0.01, 0.003];
/// Shots with which searches end that are not asked for an accuracy.
const RUNGS: [usize; 4] = [64, 256, 1024, 4096];

fn methods(accuracy: f64) -> Vec<Method> {
    let mut accuracies = ACCURACIES.to_vec();
    if !accuracies.contains(&accuracy) {
        accuracies.push(accuracy);
        accuracies.sort_by(|a, b| b.total_cmp(a));
    }
    let accuracies = accuracies.into_iter().map(Method::Accuracy);
    accuracies.chain(RUNGS.map(Method::MostShots)).collect()
}

/// What one search took and found.
struct Outcome {
    method: Method,
    seed: u64,
    seconds: f64,
    shots_per_pose: usize,
    settings: Settings,
}

/// Searches by every method and seed; those that came to an end when a request to end came.
pub(super) fn runs(
    scenario: &Scenario,
    recommended: &Settings,
    beside: Vec<BesidePoint>,
    plan: &Plan,
) -> Option<Searches> {
    let methods = methods(scenario.problem.accuracy);
    let of = methods.len() * plan.seeds;
    let mut outcomes: Vec<Outcome> = Vec::new();
    for seed in 0..plan.seeds as u64 {
        for &method in &methods {
            if plan.is_stopped() {
                break;
            }
            plan.tell("searches", outcomes.len(), of);
            let seed = scenario.problem.seed.wrapping_add(seed);
            outcomes.extend(outcome(scenario, method, seed, plan));
        }
    }
    if outcomes.is_empty() {
        return None;
    }
    let mut choices: Vec<Settings> = outcomes.iter().map(|outcome| outcome.settings).collect();
    choices.push(*recommended);
    Some(compared(scenario, outcomes, &choices, beside, plan))
}

/// One search; nothing if it was stopped or the nozzle fitted nowhere.
fn outcome(scenario: &Scenario, method: Method, seed: u64, plan: &Plan) -> Option<Outcome> {
    let mut scenario = scenario.clone();
    scenario.problem.seed = seed;
    let usual = plan.of_a_search();
    let effort = match method {
        Method::Accuracy(accuracy) => {
            scenario.problem.accuracy = accuracy;
            usual
        }
        Method::MostShots(most_shots) => Control {
            most_shots,
            ..usual
        },
    };
    let started = plan.seconds();
    let solution = solve(&scenario, &effort);
    let seconds = plan.seconds() - started;
    let best = solution.least()?;
    (!plan.is_stopped() && best.violation <= 0.0).then_some(Outcome {
        method,
        seed,
        seconds,
        shots_per_pose: solution.shots_per_pose,
        settings: best.settings,
    })
}

fn compared(
    scenario: &Scenario,
    outcomes: Vec<Outcome>,
    choices: &[Settings],
    beside: Vec<BesidePoint>,
    plan: &Plan,
) -> Searches {
    let goals = &scenario.problem.goals;
    let shots = plan.comparison_shots();
    let sums = sums(scenario, choices, COMPARISON, shots);
    let totals: Vec<f64> = sums
        .iter()
        .map(|sets| objective(goals, sets, |_| true))
        .collect();
    let best = (0..totals.len())
        .min_by(|&a, &b| totals[a].total_cmp(&totals[b]))
        .unwrap_or_default();
    let contact = |settings: &Settings| scenario.problem.contacts[settings.contact].name.clone();
    let runs = outcomes.iter().zip(&sums).map(|(outcome, sets)| {
        let (excess, excess_standard_error) = excess(goals, sets, &sums[best]);
        SearchRun {
            method: outcome.method,
            seed: outcome.seed,
            seconds: outcome.seconds,
            shots_per_pose: outcome.shots_per_pose,
            contact: contact(&outcome.settings),
            settings: SettingsRecord::new(&outcome.settings),
            excess,
            excess_standard_error,
        }
    });
    Searches {
        runs: runs.collect(),
        best_known: BestKnown {
            contact: contact(&choices[best]),
            settings: SettingsRecord::new(&choices[best]),
            objective: totals[best],
        },
        shots,
        beside,
    }
}
