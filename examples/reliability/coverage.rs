//! How often the interval that is reported covers the true J.
//!
//! First that of whole solves: for every seed J as it is printed, of the settings that were found. Then
//! settings are held, so that only the shots change with the seed: as many fresh ones as are fired
//! first, and as at most. The truth is J on many more shots, and its own small error is allowed for.

use std::error::Error;
use std::fmt::{Display, Formatter};

use peenpose::control::Control;
use peenpose::evaluate::evaluate_adaptively;
use peenpose::jet::{ValidationSample, purpose};
use peenpose::problem::setting::{Setting, Settings};
use peenpose::scenario::Scenario;
use peenpose::solve::solve;

use crate::common::known::Known;
use crate::common::statistics::{Mean, median};
use crate::common::validation;
use crate::common::variant::{Shots, Variant};

/// Names of the columns.
pub const HEADER: &str = "variant,contact,shots,incidence_deg,J,reference_error,intervals,covered_percent,\
                          below_percent,above_percent,median_reported_error,scatter_of_J";

/// A contact of a problem.
pub struct Case {
    pub variant: Variant,
    contact: &'static str,
}

pub const CASES: [Case; 3] = [
    Case {
        variant: Variant {
            file: "keyway.yaml",
            tolerance: true,
            shots: Shots::Spheres,
        },
        contact: "oiled",
    },
    Case {
        variant: Variant {
            file: "keyway-long.yaml",
            tolerance: false,
            shots: Shots::Spheres,
        },
        contact: "damp",
    },
    Case {
        variant: Variant {
            file: "keyway-blind.yaml",
            tolerance: true,
            shots: Shots::Spheres,
        },
        contact: "oiled",
    },
];

/// Towards the cliff from the best incidence, deg.
const STEPS: [f64; 2] = [0.0, 0.5];
/// Half-width of the interval, in standard errors.
const HALF_WIDTH: f64 = 1.96;
/// Shots behind the truth are numbered from here on.
const TRUTH: u32 = 1 << 22;

impl Case {
    /// Lines at the best settings known and on the cliff's side of them.
    pub fn lines(
        &self,
        known: &[Known],
        intervals: u64,
        reference_shots: usize,
    ) -> Result<Vec<String>, Box<dyn Error>> {
        let mut scenario = self.variant.scenario()?;
        let best = known
            .iter()
            .find(|known| known.is_of(&self.variant) && known.contact == self.contact)
            .ok_or_else(|| format!("no best settings of {} are known", self.variant.name()))?
            .settings(&scenario.problem)?;
        let figures = whole_solves(&mut scenario, intervals, reference_shots / 64);
        let line = format!("{},any,{figures}", self.variant.name());
        println!("{line}");
        let mut lines = vec![line];
        for step in STEPS {
            let settings = Setting::Incidence.with(&best, best.incidence + step.to_radians());
            let truth = validation::objectives(&scenario, &[settings], TRUTH, reference_shots);
            let truth = Mean::of_choice(&truth, 0);
            let control = Control::default();
            for shots in [control.first_validation_shots(), control.validation_shots] {
                let figures = coverage(&mut scenario, &settings, &truth, intervals, shots);
                let line = format!("{},{},{figures}", self.variant.name(), self.contact);
                println!("{line}");
                lines.push(line);
            }
        }
        Ok(lines)
    }
}

/// J as solves with different seeds print it, against the truth of the settings that each has found.
fn whole_solves(scenario: &mut Scenario, solves: u64, reference_shots: usize) -> String {
    let (found, reported): (Vec<Settings>, Vec<Mean>) = (1..=solves)
        .map(|seed| {
            scenario.problem.seed = seed;
            let answer = solve(scenario, &Control::default()).answers.swap_remove(0);
            let evaluation = answer.evaluation.expect("the winner is evaluated");
            let reported = Mean {
                value: evaluation.terms.total(),
                standard_error: evaluation.standard_error,
            };
            (answer.settings, reported)
        })
        .unzip();
    let objectives = validation::objectives(scenario, &found, TRUTH, reference_shots);
    let truths: Vec<Mean> = (0..found.len())
        .map(|index| Mean::of_choice(&objectives, index))
        .collect();
    let middle = |of: &dyn Fn(&Mean) -> f64| median(truths.iter().map(of));
    let incidence = median(found.iter().map(|settings| settings.incidence));
    format!(
        "of the solve,{:.3},{:.7},{:.1e},{}",
        incidence.to_degrees(),
        middle(&|truth| truth.value),
        middle(&|truth| truth.standard_error),
        Intervals::new(&reported, &truths),
    )
}

fn coverage(
    scenario: &mut Scenario,
    settings: &Settings,
    truth: &Mean,
    intervals: u64,
    shots: usize,
) -> String {
    let reported: Vec<Mean> = (1..=intervals)
        .map(|seed| {
            scenario.problem.seed = seed;
            let validation = ValidationSample::new(&scenario.problem, purpose::ANSWERS, shots);
            let evaluation = evaluate_adaptively(scenario, settings, &validation);
            Mean {
                value: evaluation.terms.total(),
                standard_error: evaluation.standard_error,
            }
        })
        .collect();
    let truths = vec![*truth; reported.len()];
    format!(
        "{shots},{:.3},{:.7},{:.1e},{}",
        settings.incidence.to_degrees(),
        truth.value,
        truth.standard_error,
        Intervals::new(&reported, &truths),
    )
}

/// How intervals lie to the truths.
struct Intervals {
    count: usize,
    below: usize,
    above: usize,
    median_error: f64,
    /// Standard deviation of what was reported about the truth.
    scatter: f64,
}

impl Intervals {
    fn new(reported: &[Mean], truths: &[Mean]) -> Self {
        // By how much J is off, and by how much the errors of both allow it to be.
        let off: Vec<(f64, f64)> = reported
            .iter()
            .zip(truths)
            .map(|(one, truth)| {
                let allowed = HALF_WIDTH * one.standard_error.hypot(truth.standard_error);
                (one.value - truth.value, allowed)
            })
            .collect();
        let count = off.len();
        let error_of_mean = Mean::of(off.iter().map(|(off, _)| *off)).standard_error;
        Self {
            count,
            below: off.iter().filter(|(off, allowed)| *off < -allowed).count(),
            above: off.iter().filter(|(off, allowed)| off > allowed).count(),
            median_error: median(reported.iter().map(|one| one.standard_error)),
            scatter: error_of_mean * (count as f64).sqrt(),
        }
    }
}

impl Display for Intervals {
    fn fmt(&self, formatter: &mut Formatter) -> std::fmt::Result {
        let percent = |count: usize| 100.0 * count as f64 / self.count as f64;
        write!(
            formatter,
            "{},{:.1},{:.1},{:.1},{:.1e},{:.1e}",
            self.count,
            percent(self.count - self.below - self.above),
            percent(self.below),
            percent(self.above),
            self.median_error,
            self.scatter,
        )
    }
}
