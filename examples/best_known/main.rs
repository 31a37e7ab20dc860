//! Finds the best settings of the keyways by brute force, contact by contact, to measure the search by.
//!
//! It shares nothing with `peenpose::solve` but the evaluator: a screen of tens of thousands of
//! poses, direct searches from dozens of them with ever more shots, and a decision between what they
//! found on a million fresh shots that nothing was tuned on. The winner's J comes from as many again.
//!
//! ```text
//! cargo run --release --example best_known -- tests/data/best_known.csv
//! cargo run --release --example best_known -- part.csv --poses 2000 --most-shots 16384 --only long
//! cargo run --release --example best_known -- tests/data/brute_force.csv --suite --most-shots 65536
//! ```

#[path = "../common/mod.rs"]
mod common;
mod descent;
mod suite;

use std::error::Error;
use std::path::PathBuf;

use clap::Parser;
use peenpose::jet::{Samples, Stream};
use peenpose::problem::setting::{Setting, Settings};
use peenpose::scenario::Scenario;
use rayon::prelude::*;

use common::cube::{ALL_BUT_SPEED, Cube};
use common::known::{HEADER, Known, in_units};
use common::statistics::Mean;
use common::validation;
use common::variant::{Variant, variants};
use descent::{Evaluator, Trial, Work};

/// Finds the best settings of the keyways by brute force.
#[derive(Parser)]
struct Arguments {
    /// Where the table goes.
    table: PathBuf,
    /// Poses of the first screen of each contact.
    #[arg(long, default_value_t = 20_000)]
    poses: u32,
    /// Most shots of a direct search.
    #[arg(long, default_value_t = 1 << 18)]
    most_shots: usize,
    /// Fresh shots of the last decision, at least.
    #[arg(long, default_value_t = 1 << 20)]
    validation_shots: usize,
    /// Only variants whose name contains this.
    #[arg(long, default_value = "")]
    only: String,
    /// The problems of the suite instead, against the settings known of them.
    #[arg(long)]
    suite: bool,
}

/// Direct searches from the best places so far.
struct Stage {
    shots: usize,
    starts: usize,
    /// First step, as a share of each range.
    reach: f64,
}

const STAGES: [Stage; 4] = [
    Stage {
        shots: 1 << 12,
        starts: 24,
        reach: 0.1,
    },
    Stage {
        shots: 1 << 14,
        starts: 8,
        reach: 0.03,
    },
    Stage {
        shots: 1 << 16,
        starts: 4,
        reach: 0.01,
    },
    Stage {
        shots: 1 << 18,
        starts: 2,
        reach: 0.004,
    },
];
const SCREENING_SHOTS: usize = 256;
/// Starts of a screen or of a stage are farther apart than this share of their reach.
const APART: f64 = 0.1;
/// The standard error of the J reported, relative to it, at most.
const LEAST_ACCURACY: f64 = 0.001;
/// Numbers of the first set of shots of the last decision, and of the J reported.
const DECISION: u32 = 0;
const REPORT: u32 = 1 << 16;
/// More sets than this are not drawn for the J reported.
const MOST_SETS: usize = 1 << 11;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.suite {
        return Ok(std::fs::write(&arguments.table, suite::table(&arguments)?)?);
    }
    let mut table = format!("{HEADER}\n");
    println!("{HEADER}");
    for variant in variants() {
        if !variant.name().contains(&arguments.only) {
            continue;
        }
        let mut scenario = variant.scenario()?;
        scenario.problem.seed = validation::SEED;
        for contact in scenario.problem.ranges.contact.clone() {
            let line = best_known(&variant, &scenario, contact, &arguments)?.line();
            println!("{line}");
            table += &format!("{line}\n");
        }
    }
    std::fs::write(&arguments.table, table)?;
    Ok(())
}

fn best_known(
    variant: &Variant,
    scenario: &Scenario,
    contact: usize,
    arguments: &Arguments,
) -> Result<Known, Box<dyn Error>> {
    let work = Work::default();
    let candidates = search(scenario, contact, arguments, &work);
    let (
        settings,
        Mean {
            value,
            standard_error,
        },
    ) = decide(scenario, &candidates, arguments);
    Ok(Known {
        file: variant.file.into(),
        tolerance: variant.tolerance_word().into(),
        shots: variant.shots_word().into(),
        contact: scenario.problem.contacts[contact].name.clone(),
        settings: in_units(&settings),
        objective: value,
        standard_error,
        poses: work.poses(),
        rays: work.rays(),
    })
}

/// The best places of the screen and of every stage.
fn search(
    scenario: &Scenario,
    contact: usize,
    arguments: &Arguments,
    work: &Work,
) -> Vec<Settings> {
    let free = match scenario.speed_scales_out(contact) {
        true => &ALL_BUT_SPEED[..],
        false => &Setting::ALL,
    };
    let cube = &Cube::new(&scenario.problem, contact, free);
    let affordable = |stage: &&Stage| stage.shots <= arguments.most_shots;
    let stages: Vec<&Stage> = STAGES.iter().filter(affordable).collect();
    let most_shots = stages.last().map_or(SCREENING_SHOTS, |stage| stage.shots);
    let samples = Samples::with_boundary(&scenario.problem, Stream::Search, most_shots);
    let evaluator = |shots: usize| Evaluator {
        scenario,
        cube,
        shots: &samples.shots[..shots],
        work,
    };
    let mut trials: Vec<Trial> = (0..arguments.poses)
        .into_par_iter()
        .map(|index| evaluator(SCREENING_SHOTS).try_at(&cube.sobol(index, 0)))
        .collect();
    let mut candidates = Vec::new();
    for stage in stages {
        let starts = distinct(trials, stage);
        trials = starts
            .into_par_iter()
            .enumerate()
            .map(|(number, start)| {
                evaluator(stage.shots).descend(&start.point, stage.reach, number as u32)
            })
            .collect();
        let best = trials
            .iter()
            .min_by(|a, b| a.objective.total_cmp(&b.objective));
        candidates.extend(best.map(|trial| trial.settings));
    }
    candidates.extend(trials.iter().map(|trial| trial.settings));
    candidates
}

/// The best trials that are not too near to each other.
fn distinct(mut trials: Vec<Trial>, stage: &Stage) -> Vec<Trial> {
    trials.sort_by(|a, b| a.objective.total_cmp(&b.objective));
    let mut kept: Vec<Trial> = Vec::new();
    for trial in trials {
        let is_far = |other: &Trial| {
            let pairs = trial.point.iter().zip(&other.point);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) > APART * stage.reach
        };
        if kept.len() < stage.starts && kept.iter().all(is_far) {
            kept.push(trial);
        }
    }
    kept
}

/// The best candidate on common fresh shots, with its J on others.
fn decide(scenario: &Scenario, candidates: &[Settings], arguments: &Arguments) -> (Settings, Mean) {
    let shots = arguments.validation_shots;
    let objectives = validation::objectives(scenario, candidates, DECISION, shots);
    let mean = |index: &usize| Mean::of_choice(&objectives, *index).value;
    let best = (0..candidates.len()).min_by(|a, b| mean(a).total_cmp(&mean(b)));
    let settings = candidates[best.unwrap_or(0)];
    let mut drawn = Vec::new();
    loop {
        let next = REPORT + drawn.len() as u32;
        drawn.extend(validation::objectives(scenario, &[settings], next, shots));
        let report = Mean::of_choice(&drawn, 0);
        if report.standard_error <= LEAST_ACCURACY * report.value || drawn.len() >= MOST_SETS {
            return (settings, report);
        }
    }
}
