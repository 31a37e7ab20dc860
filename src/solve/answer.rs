//! The answer for one contact, with its figures.

use super::judge::{Effort, Standing};
use super::polish::Candidate;
use crate::evaluate::{Evaluation, evaluate_each_focused};
use crate::feasibility::{Obstacle, infeasibility};
use crate::jet::Fresh;
use crate::problem::setting::Choice;
use crate::setup::Setup;
use crate::verdict::Verdict;

/// The best settings found for one contact.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The settings.
    pub choice: Choice,
    /// What they do, on fresh shots; `None` when the nozzle does not fit.
    pub evaluation: Option<Evaluation>,
    /// Verdicts on that.
    pub verdicts: Vec<Verdict>,
    /// By how much the pose is infeasible, m; 0 when it is feasible.
    pub violation: f64,
    /// What is in the way then.
    pub obstacle: Option<Obstacle>,
}

impl Answer {
    /// By this answers are ranked.
    pub(super) fn order(&self) -> f64 {
        match &self.evaluation {
            Some(evaluation) => Standing::Feasible(evaluation.terms).rank(),
            None => Standing::Blocked(self.violation).rank(),
        }
    }

    /// J, where the nozzle fits.
    pub(super) fn objective(&self) -> Option<f64> {
        let evaluation = self.evaluation.as_ref()?;
        Some(evaluation.terms.total())
    }

    pub(super) fn standard_error(&self) -> f64 {
        self.evaluation
            .as_ref()
            .map_or(0.0, |evaluation| evaluation.standard_error)
    }

    /// The standard error that J would have on so many shots, if these are fewer.
    pub(super) fn standard_error_on(&self, shots: usize) -> f64 {
        self.evaluation.as_ref().map_or(0.0, |evaluation| {
            let seen = evaluation.shots + evaluation.rim_shots;
            let times = (seen as f64 / shots as f64).max(1.0);
            evaluation.standard_error * times.sqrt()
        })
    }

    /// Whether the nozzle fits and every verdict passes.
    pub fn passes(&self) -> bool {
        self.violation <= 0.0
            && self.evaluation.is_some()
            && self.verdicts.iter().all(Verdict::passes)
    }

    /// The answers that candidates are, with figures from shots that the search has not seen.
    pub(super) fn of_all(
        setup: &Setup,
        candidates: &[&Candidate],
        fresh: &Fresh,
        effort: &Effort,
    ) -> Vec<Self> {
        let fits = |candidate: &&&Candidate| candidate.standing.objective().is_some();
        let feasible = candidates.iter().filter(fits);
        let choices: Vec<Choice> = feasible.map(|candidate| candidate.choice).collect();
        let mut evaluations = evaluate_each_focused(setup, &choices, fresh).into_iter();
        let answer = |candidate: &&Candidate| match candidate.standing {
            Standing::Feasible(_) => {
                let evaluation = evaluations.next()?;
                Some(Self::feasible(setup, &candidate.choice, evaluation, effort))
            }
            Standing::Blocked(_) => Some(Self::judged(setup, &candidate.choice, None)),
        };
        candidates.iter().filter_map(answer).collect()
    }

    /// The answer that settings are at which the nozzle fits.
    pub(super) fn feasible(
        setup: &Setup,
        choice: &Choice,
        evaluation: Evaluation,
        effort: &Effort,
    ) -> Self {
        effort.add(1, evaluation.rays);
        Self::judged(setup, choice, Some(evaluation))
    }

    /// Settings with the verdicts on what they do, if that is known, and on the pose that they mean.
    pub fn judged(setup: &Setup, choice: &Choice, evaluation: Option<Evaluation>) -> Self {
        let infeasible = infeasibility(setup, choice);
        let mut verdicts = evaluation
            .as_ref()
            .map_or_else(Vec::new, |evaluation| Verdict::all(setup, evaluation));
        verdicts.extend(Verdict::of_pose(setup, choice, infeasible.as_ref()));
        Self {
            choice: *choice,
            evaluation,
            verdicts,
            violation: infeasible.map_or(0.0, |it| it.violation),
            obstacle: infeasible.map(|it| it.obstacle),
        }
    }
}
