//! How often the interval that is reported covers the true J.
//!
//! The settings are held, so that only the shots change with the seed: as many fresh ones as are fired
//! first, and as at most. The truth is J on many more shots, and its own small error is allowed for.

use std::error::Error;

use peenpose::evaluate::evaluate;
use peenpose::jet::{Replicates, purpose};
use peenpose::problem::setting::{Choice, Setting};
use peenpose::setup::Setup;
use peenpose::solve::Control;

use crate::common::fresh;
use crate::common::known::Known;
use crate::common::statistics::{Mean, median};
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
        let mut setup = self.variant.setup()?;
        let best = known
            .iter()
            .find(|known| known.is_of(&self.variant) && known.contact == self.contact)
            .ok_or_else(|| format!("no best settings of {} are known", self.variant.name()))?
            .choice(&setup.problem)?;
        let mut lines = Vec::new();
        for step in STEPS {
            let choice = Setting::Incidence.with(&best, best.incidence + step.to_radians());
            let truth = fresh::objectives(&setup, &[choice], TRUTH, reference_shots);
            let truth = Mean::of_choice(&truth, 0);
            let control = Control::default();
            for shots in [control.first_fresh_shots(), control.fresh_shots] {
                let figures = coverage(&mut setup, &choice, &truth, intervals, shots);
                let line = format!("{},{},{figures}", self.variant.name(), self.contact);
                println!("{line}");
                lines.push(line);
            }
        }
        Ok(lines)
    }
}

fn coverage(
    setup: &mut Setup,
    choice: &Choice,
    truth: &Mean,
    intervals: u64,
    shots: usize,
) -> String {
    let reported: Vec<Mean> = (1..=intervals)
        .map(|seed| {
            setup.problem.seed = seed;
            let fresh = Replicates::new(&setup.problem, purpose::ANSWERS, shots);
            let evaluation = evaluate(setup, choice, &fresh);
            Mean {
                value: evaluation.terms.total(),
                standard_error: evaluation.standard_error,
            }
        })
        .collect();
    // By how much J is off, and by how much the errors of both allow it to be.
    let off = |one: &Mean| one.value - truth.value;
    let allowed = |one: &Mean| HALF_WIDTH * one.standard_error.hypot(truth.standard_error);
    let percent = |count: usize| 100.0 * count as f64 / reported.len() as f64;
    let below = reported.iter().filter(|one| off(one) < -allowed(one));
    let above = reported.iter().filter(|one| off(one) > allowed(one));
    let (below, above) = (below.count(), above.count());
    let count = reported.len() as f64;
    let scatter = Mean::of(reported.iter().map(|one| one.value)).standard_error * count.sqrt();
    format!(
        "{shots},{:.3},{:.7},{:.1e},{},{:.1},{:.1},{:.1},{:.1e},{scatter:.1e}",
        choice.incidence.to_degrees(),
        truth.value,
        truth.standard_error,
        reported.len(),
        percent(reported.len() - below - above),
        percent(below),
        percent(above),
        median(reported.iter().map(|one| one.standard_error)),
    )
}
