//! Defensive mixture: shots of several proposals with their importance weights.

use super::importance::{Cells, ImportanceDensity};
use super::qmc_point::{Proposal, QmcPoint, Stream};
use super::shot_sample::ShotSample;
use crate::problem::Problem;

/// Number of shots of each proposal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    /// As the jet fires them.
    pub jet: usize,
    /// Towards the boundary.
    pub boundary: usize,
    /// Towards the boundary, and there with an importance density.
    pub by_importance: usize,
}

impl Parts {
    pub const NONE: Self = Self {
        jet: 0,
        boundary: 0,
        by_importance: 0,
    };

    pub const JET_ALONE: Self = Self {
        jet: 1,
        ..Self::NONE
    };

    pub fn count(self) -> usize {
        self.jet + self.boundary + self.by_importance
    }
}

/// Where a shot comes from: what its importance weight depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin {
    pub cells: Cells,
    /// Density of the boundary proposal over that of the jet.
    boundary_density: f64,
}

/// Fixed shares of shots from each proposal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mixture<'a> {
    parts: Parts,
    importance: &'a ImportanceDensity,
}

impl<'a> Mixture<'a> {
    pub fn new(parts: Parts, importance: &'a ImportanceDensity) -> Self {
        Self { parts, importance }
    }

    /// Importance weight of a shot: the density of the jet over that of the mixture, so that weighted averages
    /// over the mixture estimate averages over the jet (the balance heuristic of Veach and Guibas, SIGGRAPH
    /// 1995).
    pub fn weight(&self, origin: &Origin) -> f64 {
        let Parts {
            jet,
            boundary,
            by_importance,
        } = self.parts;
        let on_boundary = match by_importance {
            0 => boundary as f64,
            _ => boundary as f64 + by_importance as f64 * self.importance.density(&origin.cells),
        };
        self.parts.count() as f64 / (jet as f64 + origin.boundary_density * on_boundary)
    }

    /// One shot of a proposal.
    pub fn shot(
        &self,
        problem: &Problem,
        stream: Stream,
        index: u32,
        by: Proposal,
    ) -> (ShotSample, Origin) {
        let mut point = if self.parts.boundary + self.parts.by_importance == 0 {
            QmcPoint::of_jet(problem.seed, stream, index)
        } else {
            QmcPoint::new(problem.seed, stream, index, by, self.importance)
        };
        let mut shot = ShotSample::at(problem, &mut point);
        let origin = Origin {
            cells: point.cells,
            boundary_density: point.boundary_density,
        };
        shot.weight = self.weight(&origin);
        shot.of_jet = by == Proposal::Nominal;
        (shot, origin)
    }

    /// One shot of a sequence that goes round the proposals, each with its share.
    pub fn in_rounds(&self, problem: &Problem, stream: Stream, index: u32) -> (ShotSample, Origin) {
        let parts = [
            (Proposal::Nominal, self.parts.jet as u32),
            (Proposal::Boundary, self.parts.boundary as u32),
            (Proposal::Importance, self.parts.by_importance as u32),
        ];
        let round = index / self.parts.count() as u32;
        let mut place = index % self.parts.count() as u32;
        for (by, count) in parts {
            if place < count {
                return self.shot(problem, stream, round * count + place, by);
            }
            place -= count;
        }
        unreachable!("a place in a round belongs to one of its parts")
    }
}
