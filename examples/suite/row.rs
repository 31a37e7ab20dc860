//! Many seeds of one problem against the best settings known.

use std::error::Error;
use std::time::Instant;

use peenpose::control::Control;
use peenpose::problem::setting::{Setting, Settings};
use peenpose::scenario::Scenario;
use peenpose::solve::{Status, solve};

use crate::common::statistics::{Mean, median};
use crate::common::suite::KnownBest;
use crate::common::validation;

/// Names of the columns.
pub const HEADER: &str = "problem,seeds,best_J,best_passes,within_1_percent,pass,as_good,converged,converged_true,\
                          median_excess_percent,worst_excess_percent,errors_cover,median_seconds,worst_seconds,median_rays";

/// An answer with what it cost.
pub struct Run {
    pub seed: u64,
    settings: Settings,
    fits: bool,
    passes: bool,
    violation: f64,
    /// J with its standard error, as told.
    told: Mean,
    status: Status,
    rays: usize,
    seconds: f64,
}

impl Run {
    pub fn of(scenario: &mut Scenario, seed: u64) -> Self {
        scenario.problem.seed = seed;
        let started = Instant::now();
        let solution = solve(scenario, &Control::default());
        let seconds = started.elapsed().as_secs_f64();
        let best = &solution.answers[0];
        Self {
            seed,
            settings: best.settings,
            fits: best.evaluation.is_some(),
            passes: best.passes(),
            violation: best.largest_violation(),
            told: best.evaluation.as_ref().map_or(NOWHERE, |it| Mean {
                value: it.terms.total(),
                standard_error: it.standard_error,
            }),
            status: solution.status,
            rays: solution.rays,
            seconds,
        }
    }
}

/// Where the nozzle does not fit.
const NOWHERE: Mean = Mean {
    value: f64::INFINITY,
    standard_error: 0.0,
};

/// The row of a problem.
pub struct Row {
    pub line: String,
    /// Settings that are better than the best known.
    pub better: Option<KnownBest>,
    excesses: Vec<f64>,
}

/// Answers are as good as the best known up to this excess of J.
const GOOD: f64 = 0.01;
/// Where nothing passes, violations are alike up to this: so well does a search know them.
const SURE: f64 = 0.05;
/// Standard errors that hold 95 % of all answers.
const SIGMAS: f64 = 1.96;
/// What is better by more than this is told.
const BETTER: f64 = 0.002;

impl Row {
    pub fn new(
        name: &str,
        scenario: &Scenario,
        known: Option<&KnownBest>,
        runs: &[Run],
        shots: usize,
    ) -> Result<Self, Box<dyn Error>> {
        let mut choices: Vec<Settings> = runs.iter().map(|run| run.settings).collect();
        choices.extend(known.map(|known| known.settings));
        let objectives = validation::objectives(scenario, &choices, 0, shots);
        let mean = |index: usize| Mean::of_choice(&objectives, index).value;
        let order = |index: usize| {
            let run = &runs[index];
            let worth = if run.passes {
                mean(index)
            } else {
                run.violation
            };
            (!run.passes, !run.fits, worth)
        };
        let found = (0..runs.len())
            .min_by(|&a, &b| order(a).partial_cmp(&order(b)).expect("J is a number"))
            .ok_or("no seeds")?;
        let is_better = known.is_none_or(|known| {
            let now = mean(runs.len());
            let better = match known.passes {
                true => mean(found) < now * (1.0 - BETTER),
                false => runs[found].violation < known.violation * (1.0 - SURE),
            };
            (runs[found].passes && !known.passes) || (runs[found].passes == known.passes && better)
        });
        let better = is_better.then(|| KnownBest {
            problem: name.into(),
            settings: runs[found].settings,
            objective: mean(found),
            passes: runs[found].passes,
            violation: runs[found].violation,
            origin: format!("search seed {}", runs[found].seed),
        });
        let (best, best_passes, least) = match (&better, known) {
            (None, Some(known)) => (mean(runs.len()), known.passes, known.violation),
            _ => (mean(found), runs[found].passes, runs[found].violation),
        };
        let excess = |index: usize| match best_passes {
            true => mean(index) / best - 1.0,
            false => runs[index].violation / least - 1.0,
        };
        let excesses: Vec<f64> = (0..runs.len()).map(excess).collect();
        let good = if best_passes { GOOD } else { SURE };
        let is_good = |index: &usize| {
            let run = &runs[*index];
            run.fits && excesses[*index] <= good && (run.passes || !best_passes)
        };
        let indices = 0..runs.len();
        let as_good = indices.clone().filter(is_good).count();
        let converged: Vec<usize> = indices
            .filter(|&index| runs[index].status == Status::Converged)
            .collect();
        // Both have errors, that of common shots the smaller one.
        let covers = |index: usize| {
            let (told, true_one) = (&runs[index].told, Mean::of_choice(&objectives, index));
            (told.value - true_one.value).abs()
                <= SIGMAS * told.standard_error.hypot(true_one.standard_error)
        };
        let line = format!(
            "{name},{},{best:.6},{best_passes},{},{},{as_good},{},{},{:.3},{:.2},{},{:.2},{:.2},{:.0}",
            runs.len(),
            excesses.iter().filter(|&&it| it <= good).count(),
            runs.iter().filter(|run| run.passes).count(),
            converged.len(),
            converged.iter().filter(|index| is_good(index)).count(),
            100.0 * median(excesses.iter().copied()),
            100.0 * excesses.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            (0..runs.len()).filter(|&index| covers(index)).count(),
            median(runs.iter().map(|run| run.seconds)),
            runs.iter().map(|run| run.seconds).fold(0.0, f64::max),
            median(runs.iter().map(|run| run.rays as f64)),
        );
        Ok(Self {
            line,
            better,
            excesses,
        })
    }

    pub fn tell_runs(&self, runs: &[Run]) {
        for (run, excess) in runs.iter().zip(&self.excesses) {
            let values = Setting::ALL.map(|setting| format!("{:.5}", setting.of(&run.settings)));
            println!(
                "  seed {} {:?} {} excess {:.3} % in {:.2} s, contact {}: {}",
                run.seed,
                run.status,
                if run.passes { "PASS" } else { "FAIL" },
                100.0 * excess,
                run.seconds,
                run.settings.contact,
                values.join(" "),
            );
        }
    }
}
