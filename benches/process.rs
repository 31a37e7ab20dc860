//! Whole runs of the program as a user starts them, cold, on all cores, and how good their answers are.
//!
//! `cargo bench --bench process` runs `peenpose solve` on each shipped keyway, again and again with
//! one seed and once with each of several seeds. The answers of all seeds are compared with the best
//! settings that brute force found, on common shots that no search has seen; no such settings are known for
//! strokes, of which the seconds are measured alone.

#[path = "../examples/common/mod.rs"]
mod common;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use peenpose::control::Control;
use peenpose::problem::setting::Settings;
use peenpose::solve::solve;
use tempfile::TempDir;

use common::known::Known;
use common::statistics::median;
use common::validation;
use common::variant::{Shots, Variant, path};

/// Runs with one seed.
const RUNS: usize = 10;
const SEEDS: u64 = 12;
/// Common shots that answers are compared on.
const SHOTS: usize = 1 << 18;
/// Their sets are numbered from here on: no best settings were found on them.
const COMPARISON: u32 = 1 << 20;

/// File, whether with its tolerance, and the seconds that a run may take on two cores.
const CASES: [(&str, bool, f64); 7] = [
    ("keyway.yaml", false, 0.05),
    ("keyway.yaml", true, 0.1),
    ("keyway-long.yaml", false, 0.15),
    ("keyway-blind.yaml", true, 1.0),
    ("keyway-stroke.yaml", true, 0.5),
    ("keyway-100.yaml", true, 3.0),
    ("bore-turning.yaml", true, 3.0),
];

fn main() -> Result<(), Box<dyn Error>> {
    let known = Known::read()?;
    println!(
        "{:32} {:>6} {:>26} {:>26} {:>22}",
        "", "target", "seconds, seed 1", "seconds, 12 seeds", "J above the best known"
    );
    println!(
        "{:32} {:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>11} {:>10}",
        "", "s", "median", "least", "most", "median", "least", "most", "median", "most"
    );
    for (file, tolerance, target) in CASES {
        let variant = Variant {
            file,
            tolerance,
            shots: Shots::Spheres,
        };
        let folder = TempDir::new()?;
        let problem = problem(&variant, folder.path())?;
        let again: Vec<f64> = (0..RUNS)
            .map(|_| seconds(&problem, 1))
            .collect::<Result<_, _>>()?;
        let by_seed: Vec<f64> = (1..=SEEDS)
            .map(|seed| seconds(&problem, seed))
            .collect::<Result<_, _>>()?;
        let excesses = match known.iter().any(|known| known.is_of(&variant)) {
            true => {
                let excesses = excesses(&variant, &known)?;
                let median = 100.0 * median(excesses.iter().copied());
                format!("{median:>10.2}% {:>9.2}%", 100.0 * most(&excesses))
            }
            false => format!("{:>11} {:>10}", "-", "-"),
        };
        println!(
            "{:32} {target:>6} {} {} {excesses}",
            variant.name(),
            spread(&again),
            spread(&by_seed),
        );
    }
    Ok(())
}

/// The shipped file, or a copy that says nothing about a tolerance.
fn problem(variant: &Variant, folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let shipped = path(variant.file);
    let text = std::fs::read_to_string(&shipped)?;
    let has_tolerance = |line: &&str| line.starts_with("tolerance:");
    if variant.tolerance || !text.lines().any(|line| has_tolerance(&line)) {
        return Ok(shipped);
    }
    let lines: Vec<&str> = text.lines().filter(|line| !has_tolerance(line)).collect();
    let copy = folder.join(variant.file);
    std::fs::write(&copy, lines.join("\n"))?;
    Ok(copy)
}

/// The wall time of a whole run.
fn seconds(problem: &Path, seed: u64) -> Result<f64, Box<dyn Error>> {
    let started = Instant::now();
    let status = Command::new(env!("CARGO_BIN_EXE_peenpose"))
        .arg("solve")
        .arg(problem)
        .args(["--seed", &seed.to_string()])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()?;
    let taken = started.elapsed().as_secs_f64();
    match status.code() {
        Some(0 | 1) => Ok(taken),
        _ => Err(format!("{}: {status}", problem.display()).into()),
    }
}

/// By how much J of the answer of each seed is above that of the best settings known, relative to it.
/// The library gives the same answers as the program, to the last bit.
fn excesses(variant: &Variant, known: &[Known]) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut scenario = variant.scenario()?;
    let best = known.iter().filter(|known| known.is_of(variant));
    let best: Vec<Settings> = best
        .map(|known| known.settings(&scenario.problem))
        .collect::<Result<_, _>>()?;
    let answers = (1..=SEEDS).map(|seed| {
        scenario.problem.seed = seed;
        solve(&scenario, &Control::default()).answers[0].settings
    });
    let answers: Vec<Settings> = answers.collect();
    let excesses = validation::excesses(&scenario, &best, &answers, COMPARISON, SHOTS);
    Ok(excesses.iter().map(|excess| excess.value).collect())
}

fn spread(seconds: &[f64]) -> String {
    let least = seconds.iter().copied().fold(f64::INFINITY, f64::min);
    let median = median(seconds.iter().copied());
    format!("{median:8.3} {least:8.3} {:8.3}", most(seconds))
}

fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}
