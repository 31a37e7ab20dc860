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
    /// The same with every second shot towards the rim, as the search draws them.
    SobolRim,
}

impl Sampling {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Random, Self::Sobol, Self::SobolRim];

    pub(super) fn draw(self, problem: &Problem, stream: Stream, count: usize) -> Samples {
        match self {
            Self::Random => Samples::random(problem, stream, count),
            Self::Sobol => Samples::new(problem, stream, count),
            Self::SobolRim => Samples::with_rim(problem, stream, count),
        }
    }
}

/// Independent scramblings behind a standard error.
pub(super) const SCRAMBLINGS: usize = Replicates::COUNT;

/// What fresh shots are drawn for; those of different purposes are independent.
#[derive(Clone, Copy)]
pub(super) enum Purpose {
    // Purposes 0 and 1 belong to the answers and windows of a search.
    Reference = 2,
    Comparison = 3,
    // The last, because it may take more streams than the others.
    Scatter = 4,
}

/// One of the streams for a purpose.
pub(super) fn stream(purpose: Purpose, number: usize) -> Stream {
    Stream::Fresh(purpose as u32 * SCRAMBLINGS as u32 + number as u32)
}
