//! Shots that are sent ahead to find out where harm comes from.

use rayon::prelude::*;

use super::deviate::Deviate;
use super::focus::{Cells, Focus};
use super::mixture::{Mixture, Origin, Parts};
use super::point::Stream;
use crate::problem::Problem;

/// Shots of a jet that may be wider than that of the problem.
pub struct Scouts {
    /// The shots.
    pub deviates: Vec<Deviate>,
    origins: Vec<Origin>,
}

impl Scouts {
    /// Shots of a jet `stretch` times as wide; a part of them is drawn by a focus.
    pub fn new(
        problem: &Problem,
        stretch: f64,
        stream: Stream,
        count: usize,
        focus: &Focus,
    ) -> Self {
        let wide = stretched(problem, stretch);
        let mixture = Mixture::new(PARTS, focus);
        let numbers = (0..count as u32).into_par_iter();
        let shots = numbers.map(|index| mixture.in_rounds(&wide, stream, index));
        let (deviates, origins) = shots.unzip();
        Self { deviates, origins }
    }

    /// A focus on what they did: `harm` of each, with what it stands for.
    pub fn focus(&self, before: &Focus, harm: &[f64]) -> Focus {
        let cells: Vec<Cells> = self.origins.iter().map(|origin| origin.cells).collect();
        before.on(&cells, harm)
    }
}

const PARTS: Parts = Parts {
    jet: 1,
    rim: 1,
    focused: 2,
};

/// A problem whose directions scatter so many times as far. What scatters in other ways is left as it
/// is: an exit may not grow into its walls, nor a standoff beyond the target.
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
