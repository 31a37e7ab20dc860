//! How shots are drawn, and what for.

use serde::{Deserialize, Serialize};

use crate::jet::{Replicates, Samples, Stream};
use crate::problem::Problem;

/// How shots are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sampling {
    /// Independently of each other.
    Random,
    /// As scrambled Sobol points.
    Sobol,
    /// The same with some of the shots towards the boundary, as the search draws them.
    SobolRim,
}

impl Sampling {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Random, Self::Sobol, Self::SobolRim];

    pub(super) fn draw(self, problem: &Problem, stream: Stream, count: usize) -> Samples {
        match self {
            Self::Random => Samples::random(problem, stream, count),
            Self::Sobol => Samples::new(problem, stream, count),
            Self::SobolRim => Samples::with_boundary(problem, stream, count),
        }
    }
}

/// Independent replicates behind a standard error.
pub(super) const SCRAMBLINGS: usize = Replicates::COUNT;
