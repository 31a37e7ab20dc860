//! Pilot runs, which find out where violations come from.

use rayon::prelude::*;

use super::importance::{Cells, ImportanceDensity};
use super::mixture::{Mixture, Origin, Parts};
use super::qmc_point::Stream;
use super::shot_sample::ShotSample;
use crate::problem::Problem;

/// Shots of a jet that may be wider than that of the problem.
pub struct PilotRun {
    /// The shots.
    pub shots: Vec<ShotSample>,
    origins: Vec<Origin>,
}

impl PilotRun {
    /// Shots of a jet `stretch` times as wide; a part of them is drawn with an importance density.
    pub fn new(
        problem: &Problem,
        stretch: f64,
        stream: Stream,
        count: usize,
        importance: &ImportanceDensity,
    ) -> Self {
        let wide = stretched(problem, stretch);
        let mixture = Mixture::new(PARTS, importance);
        let numbers = (0..count as u32).into_par_iter();
        let shots = numbers.map(|index| mixture.in_rounds(&wide, stream, index));
        let (shots, origins) = shots.unzip();
        Self { shots, origins }
    }

    /// The importance density for what they did: the `violation` of each, times its importance weight.
    pub fn adapted(&self, before: &ImportanceDensity, violation: &[f64]) -> ImportanceDensity {
        let cells: Vec<Cells> = self.origins.iter().map(|origin| origin.cells).collect();
        before.on(&cells, violation)
    }
}

const PARTS: Parts = Parts {
    jet: 1,
    boundary: 1,
    by_importance: 2,
};

/// A problem whose directions scatter `times` as far. What scatters in other ways stays: an exit may not
/// grow into its walls, nor a standoff beyond the target.
fn stretched(problem: &Problem, times: f64) -> Problem {
    let half_angle = problem.jet.divergence;
    let mut wide = problem.clone();
    wide.jet.divergence = (half_angle * times).min(WIDEST).max(half_angle);
    for width in [
        &mut wide.tolerance.incidence,
        &mut wide.tolerance.azimuth,
        &mut wide.tolerance.aim_along,
        &mut wide.tolerance.aim_across,
    ] {
        *width *= times;
    }
    wide
}

/// No cone is stretched beyond this half-angle, rad.
const WIDEST: f64 = 1.5;
