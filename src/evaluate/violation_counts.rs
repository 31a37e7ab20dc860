//! How many shots break goals and limits.

use super::Evaluation;
use crate::scenario::Scenario;

/// Counts of violating shots: all that verdicts depend on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViolationCounts {
    /// Shots of the jet.
    pub shots: usize,
    /// Whether all of them are the same.
    pub is_exact: bool,
    /// First hits on target.
    pub hits: usize,
    /// Those off the wanted normal impulse by more than the tolerance.
    pub off_target: usize,
    /// Those over the tangential limit.
    pub over_limit: usize,
    /// For each surface of the scene, shots with an impact over what it may take.
    pub over: Vec<usize>,
}

impl ViolationCounts {
    /// What was counted in both sets of shots.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let over = self.over.iter().zip(&other.over);
        Self {
            shots: self.shots + other.shots,
            is_exact: self.is_exact,
            hits: self.hits + other.hits,
            off_target: self.off_target + other.off_target,
            over_limit: self.over_limit + other.over_limit,
            over: over.map(|(a, b)| a + b).collect(),
        }
    }

    /// Of no shots.
    pub fn none(scenario: &Scenario) -> Self {
        Self {
            shots: 0,
            is_exact: scenario.problem.has_one_ray(),
            hits: 0,
            off_target: 0,
            over_limit: 0,
            over: vec![0; scenario.surfaces.len()],
        }
    }

    /// Of several sets of shots.
    pub fn together(scenario: &Scenario, each: impl IntoIterator<Item = Self>) -> Self {
        let each = each.into_iter();
        each.fold(Self::none(scenario), |all, one| all.plus(&one))
    }

    /// What was counted in an evaluation.
    pub fn of(evaluation: &Evaluation) -> Self {
        let target = &evaluation.target;
        let receipts = evaluation.surfaces.iter();
        Self {
            shots: evaluation.shots,
            is_exact: evaluation.is_exact,
            hits: target.hits,
            off_target: target.off_target,
            over_limit: target.over_limit,
            over: receipts.map(|receipt| receipt.over).collect(),
        }
    }
}
