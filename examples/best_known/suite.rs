//! Brute force on the problems of the suite: whether it finds a lower J than that of the settings known.

use std::error::Error;
use std::path::Path;

use peenpose::evaluate::evaluate_adaptively;
use peenpose::jet::{ValidationSample, purpose};
use peenpose::problem::setting::{Setting, Settings};
use peenpose::scenario::Scenario;
use peenpose::verdict::Verdict;

use crate::common::statistics::Mean;
use crate::common::suite::{self, KnownBest};
use crate::common::validation;
use crate::descent::Work;
use crate::{Arguments, DECISION, REPORT, search};

/// Names of the columns.
const HEADER: &str = "problem,contact,J,passes,excess_percent,standard_error_percent,known_J,known_passes,poses,rays";
/// Validation shots that tell whether settings pass.
const SHOTS: usize = 1 << 17;

/// The table of all problems, a line for each contact, also on the terminal.
pub fn table(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let known = KnownBest::all()?;
    let mut table = format!("{HEADER},{}\n", Setting::ALL.map(Setting::name).join(","));
    print!("{table}");
    for (name, path) in suite::problems() {
        let Some(best) = known.iter().find(|it| it.problem == name) else {
            continue;
        };
        if name.contains(&arguments.only) {
            let lines = lines(best, &path, arguments)?;
            print!("{lines}");
            table += &lines;
        }
    }
    Ok(table)
}

fn lines(best: &KnownBest, path: &Path, arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let mut scenario = suite::scenario(path)?;
    scenario.problem.seed = validation::SEED;
    let mut lines = String::new();
    for contact in scenario.problem.ranges.contact.clone() {
        let name = &scenario.problem.contacts[contact].name;
        let work = Work::default();
        let candidates = search(&scenario, contact, arguments, &work);
        let (settings, excess) = decide(&scenario, best, &candidates, arguments);
        let numbers = Setting::ALL.map(|setting| format!("{:e}", setting.of(&settings)));
        lines += &format!(
            "{},{name},{:.6e},{},{:.3},{:.3},{:.6e},{},{},{},{}\n",
            best.problem,
            best.objective * (1.0 + excess.value),
            passes(&scenario, &settings),
            100.0 * excess.value,
            100.0 * excess.standard_error,
            best.objective,
            best.passes,
            work.poses(),
            work.rays(),
            numbers.join(","),
        );
    }
    Ok(lines)
}

/// The candidate with the lowest J on fresh shots, and its excess over that of the settings known on others.
fn decide(
    scenario: &Scenario,
    best: &KnownBest,
    candidates: &[Settings],
    arguments: &Arguments,
) -> (Settings, Mean) {
    let shots = arguments.validation_shots;
    let excesses = |found: &[Settings], first| {
        validation::excesses(scenario, &[best.settings], found, first, shots)
    };
    let pairs = excesses(candidates, DECISION).into_iter().zip(candidates);
    let least = pairs.min_by(|(a, _), (b, _)| a.value.total_cmp(&b.value));
    let settings = least.map_or(best.settings, |(_, settings)| *settings);
    (settings, excesses(&[settings], REPORT)[0])
}

fn passes(scenario: &Scenario, settings: &Settings) -> bool {
    let validation = ValidationSample::new(&scenario.problem, purpose::ANSWERS, SHOTS);
    let evaluation = evaluate_adaptively(scenario, settings, &validation);
    Verdict::all(scenario, &evaluation)
        .iter()
        .all(Verdict::passes)
}
