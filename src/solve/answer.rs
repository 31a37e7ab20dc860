//! The answer for one contact, with its figures.

use super::evaluator::{Effort, Fitness};
use super::polish::Candidate;
use crate::evaluate::{Evaluation, evaluate_each_adaptively};
use crate::feasibility::{Obstacle, infeasibility};
use crate::jet::ValidationSample;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::verdict::{StationVerdicts, Verdict};

/// The best settings found for one contact.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The settings.
    pub settings: Settings,
    /// Their evaluation on validation shots; `None` when the nozzle does not fit.
    pub evaluation: Option<Evaluation>,
    /// Its verdicts.
    pub verdicts: Vec<Verdict>,
    /// Those at each station of a stroke; none for a spot.
    pub stations: Vec<StationVerdicts>,
    /// By how much the pose is infeasible, m; 0 when it is feasible.
    pub violation: f64,
    /// What is in the way then.
    pub obstacle: Option<Obstacle>,
    /// J of the settings with the least J, where these fail and others were searched that pass or fail less.
    pub least_objective: Option<f64>,
}

impl Answer {
    /// Answers are ranked by this.
    pub(super) fn order(&self) -> f64 {
        match &self.evaluation {
            Some(evaluation) => Fitness::Feasible(evaluation.terms, 0.0).rank(),
            None => Fitness::Infeasible(self.violation).rank(),
        }
    }

    /// The largest share of shots that break a goal or a limit, over what is allowed: at most 1 where all pass.
    pub fn largest_violation(&self) -> f64 {
        Verdict::largest_violation(&self.verdicts)
    }

    /// J, where the nozzle fits.
    pub(super) fn objective(&self) -> Option<f64> {
        let evaluation = self.evaluation.as_ref()?;
        Some(evaluation.terms.total())
    }

    /// Standard error of the largest violation, relative to it.
    pub(super) fn error_of_violation(&self) -> f64 {
        let verdicts = self.verdicts.iter();
        let worst = verdicts.max_by(|a, b| a.violation().total_cmp(&b.violation()));
        worst.map_or(0.0, Verdict::relative_error)
    }

    /// Whether what it violates most is known to some accuracy, relative to it; what passes violates nothing.
    pub(super) fn violation_is_known(&self, accuracy: f64) -> bool {
        self.passes() || self.error_of_violation() <= accuracy
    }

    pub(super) fn standard_error(&self) -> f64 {
        self.evaluation
            .as_ref()
            .map_or(0.0, |evaluation| evaluation.standard_error)
    }

    /// The standard error that J would have on this many shots, if these are fewer.
    pub(super) fn standard_error_on(&self, shots: usize) -> f64 {
        self.evaluation.as_ref().map_or(0.0, |evaluation| {
            let seen = evaluation.shots + evaluation.boundary_shots;
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

    /// Whether more shots of the same kind would not turn a verdict.
    pub(super) fn is_certain(&self) -> bool {
        self.verdicts.iter().all(Verdict::is_certain)
    }

    /// Answers from candidates, evaluated on validation shots.
    pub(super) fn of_all(
        scenario: &Scenario,
        candidates: &[&Candidate],
        validation: &ValidationSample,
        effort: &Effort,
    ) -> Vec<Self> {
        let fits = |candidate: &&&Candidate| candidate.fitness.objective().is_some();
        let feasible = candidates.iter().filter(fits);
        let choices: Vec<Settings> = feasible.map(|candidate| candidate.settings).collect();
        let mut evaluations = evaluate_each_adaptively(scenario, &choices, validation).into_iter();
        let answer = |candidate: &&Candidate| match candidate.fitness {
            Fitness::Feasible(..) => {
                let evaluation = evaluations.next()?;
                Some(Self::feasible(
                    scenario,
                    &candidate.settings,
                    evaluation,
                    effort,
                ))
            }
            Fitness::Infeasible(_) => Some(Self::evaluated(scenario, &candidate.settings, None)),
        };
        candidates.iter().filter_map(answer).collect()
    }

    /// The answer for settings at which the nozzle fits.
    pub(super) fn feasible(
        scenario: &Scenario,
        settings: &Settings,
        evaluation: Evaluation,
        effort: &Effort,
    ) -> Self {
        let answer = Self::evaluated(scenario, settings, Some(evaluation));
        effort.add(1, answer.rays());
        answer
    }

    /// Rays traced for what is said of it.
    pub fn rays(&self) -> usize {
        let evaluated = self.evaluation.as_ref().map_or(0, |it| it.rays);
        let stations = self.stations.iter();
        evaluated + stations.map(|station| station.rays).sum::<usize>()
    }

    /// Settings with the verdicts on their evaluation, if there is one, and on their pose.
    pub fn evaluated(
        scenario: &Scenario,
        settings: &Settings,
        evaluation: Option<Evaluation>,
    ) -> Self {
        let infeasible = infeasibility(scenario, settings);
        let stations = match &evaluation {
            Some(_) => StationVerdicts::all(scenario, settings),
            None => Vec::new(),
        };
        let whole = evaluation
            .as_ref()
            .map_or_else(Vec::new, |evaluation| Verdict::all(scenario, evaluation));
        let mut verdicts = StationVerdicts::worst(whole, &stations);
        verdicts.extend(Verdict::of_pose(scenario, settings, infeasible.as_ref()));
        Self {
            settings: *settings,
            evaluation,
            verdicts,
            stations,
            violation: infeasible.map_or(0.0, |it| it.violation),
            obstacle: infeasible.map(|it| it.obstacle),
            least_objective: None,
        }
    }
}
