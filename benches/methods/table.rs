//! What is printed and written of the runs.

use std::fmt::Write;

use peenpose::problem::setting::Settings;

use crate::case::{Case, Run, SHIPPED, SHIPPED_WHOLE};
use crate::common::statistics::{Mean, median};
use crate::common::validation;
use crate::objective::{CHECKPOINTS, Speed, Step};

/// Columns of what is written.
pub const HEADER: &str =
    "problem,speed,method,seed,evaluations,seconds,excess_percent,true_excess_percent";
/// A run has succeeded within this share of the least J.
const SUCCESS: f64 = 0.01;
/// Fresh shots behind a true excess.
const FRESH_SHOTS: usize = 1 << 16;
/// Their sets are numbered from here on: no best settings were found on them.
const COMPARISON: u32 = 1 << 20;

impl Run {
    /// Its state at every checkpoint and at its end.
    fn at_checkpoints(&self) -> Vec<&Step> {
        let reached = |count: &usize| {
            let before = self.steps.iter().rfind(|step| step.evaluations <= *count);
            before.filter(|step| step.evaluations == *count)
        };
        let mut steps: Vec<&Step> = CHECKPOINTS.iter().filter_map(reached).collect();
        let end = self.steps.last();
        if steps.last().map(|step| step.evaluations) != end.map(|step| step.evaluations) {
            steps.extend(end);
        }
        steps
    }

    fn excess(&self, step: &Step) -> f64 {
        step.objective / self.reference - 1.0
    }

    fn success(&self) -> Option<&Step> {
        self.steps.iter().find(|step| self.excess(step) <= SUCCESS)
    }
}

/// True J of every run at its checkpoints, relative to that of the best settings known.
pub fn true_excesses(case: &Case, runs: &[Run]) -> Vec<Vec<f64>> {
    let steps: Vec<Vec<&Step>> = runs.iter().map(Run::at_checkpoints).collect();
    let found = steps.iter().flatten().map(|step| step.settings);
    let choices: Vec<Settings> = std::iter::once(case.known).chain(found).collect();
    let objectives = validation::objectives(&case.scenario, &choices, COMPARISON, FRESH_SHOTS);
    let mut values = (0..choices.len()).map(|index| Mean::of_choice(&objectives, index).value);
    let best = values.next().unwrap_or(f64::NAN);
    let excesses = steps.iter().map(|steps| {
        let values = values.by_ref().take(steps.len());
        values.map(|value| value / best - 1.0).collect()
    });
    excesses.collect()
}

/// All runs at their checkpoints.
pub fn lines(case: &Case, runs: &[Run], excesses: &[Vec<f64>]) -> Vec<String> {
    let mut lines = Vec::new();
    for (run, excesses) in runs.iter().zip(excesses) {
        for (step, excess) in run.at_checkpoints().into_iter().zip(excesses) {
            lines.push(format!(
                "\"{}\",{},\"{}\",{},{},{:.5},{:.4},{:.4}",
                case.name,
                word(run.speed),
                run.method,
                run.seed,
                step.evaluations,
                step.seconds,
                100.0 * run.excess(step),
                100.0 * excess,
            ));
        }
    }
    lines
}

/// Points that a chart draws beside its own: each method after so many evaluations, the medians of
/// its runs. A run that has ended stays where it is.
pub fn beside(runs: &[Run], excesses: &[Vec<f64>], speed: Speed) -> String {
    let mut text = "method,speed,seconds,excess\n".to_string();
    let ran_so = methods(runs).into_iter().filter(|one| one.0 == speed);
    for (_, method) in ran_so.filter(|one| ![SHIPPED, SHIPPED_WHOLE].contains(&one.1)) {
        let ran = || {
            let pairs = runs.iter().zip(excesses);
            pairs.filter(move |(run, _)| (run.speed, run.method) == (speed, method))
        };
        for (index, count) in CHECKPOINTS.iter().enumerate() {
            let at = |length: usize| index.min(length - 1);
            let seconds = ran().map(|(run, excesses)| {
                let steps = run.at_checkpoints();
                steps[at(excesses.len())].seconds
            });
            let seconds = median(seconds);
            let excess = median(ran().map(|(_, excesses)| excesses[at(excesses.len())]));
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{method},{count} evaluations,{seconds:.6},{excess:.6}"
            );
        }
    }
    text
}

/// All methods that ran, in order.
fn methods(runs: &[Run]) -> Vec<(Speed, &'static str)> {
    let mut methods: Vec<(Speed, &str)> = Vec::new();
    for run in runs {
        if !methods.contains(&(run.speed, run.method)) {
            methods.push((run.speed, run.method));
        }
    }
    methods
}

pub fn word(speed: Speed) -> &'static str {
    match speed {
        Speed::Searched => "searched",
        Speed::Removed => "removed",
    }
}

/// One line for each method.
pub fn table(case: &Case, runs: &[Run], excesses: &[Vec<f64>]) -> String {
    let mut text = format!(
        "{}\n{:32} {:9} {:>9} {:>12} {:>12} {:>14} {:>14}\n",
        case.name,
        "method",
        "speed",
        "successes",
        "evaluations",
        "seconds",
        "median excess",
        "true excess"
    );
    for (speed, method) in methods(runs) {
        let pairs = || {
            let pairs = runs.iter().zip(excesses);
            pairs.filter(|(run, _)| (run.speed, run.method) == (speed, method))
        };
        let of_method: Vec<&Run> = pairs().map(|(run, _)| run).collect();
        let true_excess = median(pairs().filter_map(|(_, excesses)| excesses.last().copied()));
        let last = of_method
            .iter()
            .filter_map(|run| Some(run.excess(run.steps.last()?)));
        let (evaluations, seconds) = expected(&of_method);
        // Shots that are not the common ones cannot be judged by them.
        let (successes, evaluations, seconds, excess) = if method == SHIPPED_WHOLE {
            let seconds = of_method
                .iter()
                .filter_map(|run| Some(run.steps.last()?.seconds));
            (
                "-".into(),
                "-".into(),
                format!("{:.3}", median(seconds)),
                "-".into(),
            )
        } else {
            (
                format!("{} of {}", successes(&of_method), of_method.len()),
                evaluations.map_or("-".into(), |count| format!("{count:.0}")),
                seconds.map_or("-".into(), |seconds| format!("{seconds:.3}")),
                format!("{:.2} %", 100.0 * median(last)),
            )
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{method:32} {:9} {successes:>9} {evaluations:>12} {seconds:>12} {excess:>14} {:>12.1} %",
            word(speed),
            100.0 * true_excess,
        );
    }
    let beaten = runs
        .iter()
        .flat_map(|run| Some(run.excess(run.steps.last()?)));
    let most = beaten.fold(0.0_f64, |most, excess| most.max(-excess));
    let _ = writeln!(
        text,
        "evaluations, seconds: expected until the first success, with restarts after failures;\n\
         those of peenpose count poses of 64 to 1024 shots alike\n\
         no run is below the least J on its shots by more than {:.3} %",
        100.0 * most
    );
    text
}

fn successes(runs: &[&Run]) -> usize {
    runs.iter().filter(|run| run.success().is_some()).count()
}

/// Evaluations and seconds of all runs up to their success or their end, for each success.
fn expected(runs: &[&Run]) -> (Option<f64>, Option<f64>) {
    let count = successes(runs) as f64;
    let spent = |of: fn(&Step) -> f64| {
        let steps = runs
            .iter()
            .filter_map(|run| run.success().or(run.steps.last()));
        let total: f64 = steps.map(of).sum();
        (count > 0.0).then_some(total / count)
    };
    (
        spent(|step| step.evaluations as f64),
        spent(|step| step.seconds),
    )
}
