//! Many seeds of one problem: how far above the best J known the answers are.

use std::error::Error;
use std::time::Instant;

use peenpose::control::Control;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::solve::{Status, solve};

use crate::common::known::Known;
use crate::common::statistics::median;
use crate::common::validation;
use crate::common::variant::{Variant, contact_named};

/// Names of the columns.
pub const HEADER: &str = "variant,contacts,seeds,within_1_percent,worst_excess_percent,\
                          median_excess_percent,excess_error_percent,median_poses,median_rays,\
                          median_seconds,converged,best_found,other";

/// What one run of the search found and cost.
struct Run {
    settings: Settings,
    status: Status,
    poses: usize,
    rays: usize,
    seconds: f64,
}

/// Each contact alone, then all together; every line is printed as soon as it is known.
pub fn of_variant(
    variant: &Variant,
    known: &[Known],
    seeds: u64,
    shots: usize,
) -> Result<Vec<String>, Box<dyn Error>> {
    let mut scenario = variant.scenario()?;
    let known: Vec<&Known> = known.iter().filter(|known| known.is_of(variant)).collect();
    let alone = known.iter().map(|&one| vec![one]);
    let groups: Vec<Vec<&Known>> = alone.chain([known.clone()]).collect();
    let mut lines = Vec::new();
    for group in groups {
        let contacts = group
            .iter()
            .map(|one| contact_named(&scenario.problem, &one.contact).ok_or("unknown contact"));
        scenario.problem.ranges.contact = contacts.collect::<Result<_, _>>()?;
        let best: Vec<Settings> = group
            .iter()
            .map(|one| one.settings(&scenario.problem))
            .collect::<Result<_, _>>()?;
        let runs: Vec<Run> = (1..=seeds).map(|seed| run(&mut scenario, seed)).collect();
        let name = match &group[..] {
            [one] => one.contact.clone(),
            _ => "all".into(),
        };
        let line = format!(
            "{},{name},{}",
            variant.name(),
            summary(&scenario, &best, &runs, shots)
        );
        println!("{line}");
        lines.push(line);
    }
    Ok(lines)
}

fn run(scenario: &mut Scenario, seed: u64) -> Run {
    scenario.problem.seed = seed;
    let start = Instant::now();
    let solution = solve(scenario, &Control::default());
    Run {
        settings: solution.answers[0].settings,
        status: solution.status,
        poses: solution.poses,
        rays: solution.rays,
        seconds: start.elapsed().as_secs_f64(),
    }
}

fn summary(scenario: &Scenario, best: &[Settings], runs: &[Run], shots: usize) -> String {
    let found: Vec<Settings> = runs.iter().map(|run| run.settings).collect();
    let mut excesses = validation::excesses(scenario, best, &found, COMPARISON, shots);
    excesses.sort_by(|a, b| a.value.total_cmp(&b.value));
    let percent = |x: f64| 100.0 * x;
    let within = excesses
        .iter()
        .filter(|excess| excess.value <= 0.01)
        .count();
    let worst = excesses.last().map_or(f64::NAN, |excess| excess.value);
    let errors = excesses.iter().map(|excess| excess.standard_error);
    let count = |status: Status| runs.iter().filter(|run| run.status == status).count();
    let (converged, spent) = (count(Status::Converged), count(Status::BestFound));
    format!(
        "{},{within},{:.3},{:.3},{:.3},{:.0},{:.0},{:.4},{converged},{spent},{}",
        runs.len(),
        percent(worst),
        percent(median(excesses.iter().map(|excess| excess.value))),
        percent(median(errors)),
        median(runs.iter().map(|run| run.poses as f64)),
        median(runs.iter().map(|run| run.rays as f64)),
        median(runs.iter().map(|run| run.seconds)),
        runs.len() - converged - spent,
    )
}

/// Answers are compared on sets of shots from here on, which found no best settings.
const COMPARISON: u32 = 1 << 20;
