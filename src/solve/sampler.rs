//! The shots of a search.

use rayon::prelude::*;

use super::descent::leading;
use super::evaluator::{Effort, Evaluator};
use super::passing::Penalty;
use super::polish::Candidate;
use super::search::Search;
use super::stopping_rule::is_precise;
use crate::control::Control;
use crate::evaluate::importance_of;
use crate::jet::{ImportanceDensity, Replicates, Samples, Stream, purpose};
use crate::objective::Tally;
use crate::scenario::Scenario;

/// Draws the shots of a search, a part of them with an importance density for the violations of the incumbent.
#[derive(Clone)]
pub(super) struct Sampler<'a> {
    scenario: &'a Scenario,
    /// The importance density, once there is one.
    importance: Option<ImportanceDensity>,
    /// What violations cost, by their shares.
    penalty: Option<Penalty>,
}

impl<'a> Sampler<'a> {
    pub fn new(scenario: &'a Scenario) -> Self {
        Self {
            scenario,
            importance: None,
            penalty: None,
        }
    }

    /// The same where violations beyond what is allowed cost a penalty.
    pub fn penalised(scenario: &'a Scenario, penalty: Penalty) -> Self {
        Self {
            penalty: Some(penalty),
            ..Self::new(scenario)
        }
    }

    /// What violations cost.
    pub fn penalty(&self) -> Option<&Penalty> {
        self.penalty.as_ref()
    }

    /// An evaluator on shots that were drawn here.
    pub fn evaluator<'b>(
        &self,
        scenario: &'b Scenario,
        samples: &'b Samples,
        effort: &'b Effort,
        control: &'b Control,
    ) -> Evaluator<'b> {
        let evaluator = Evaluator::new(scenario, &samples.shots, effort, control);
        match &self.penalty {
            Some(penalty) => evaluator.penalised(penalty.clone()),
            None => evaluator,
        }
    }

    /// The importance density in use.
    pub fn importance(&self) -> Option<&ImportanceDensity> {
        self.importance.as_ref()
    }

    /// Adapts the importance density to the violations of the leading candidate.
    pub fn adapt(&mut self, searches: &[Search], effort: &Effort, control: &Control) {
        if !control.shortcuts.importance {
            return;
        }
        let leader = leader(searches).filter(|it| it.fitness.objective().is_some());
        self.importance = leader.map(|leader| {
            let (importance, rays) = importance_of(self.scenario, &leader.settings);
            effort.add(0, rays);
            importance
        });
    }

    /// The first shots of the search.
    pub fn draw(&self, shots: usize) -> Samples {
        self.draw_from(Stream::Search, shots)
    }

    /// Shots that are independent of those of the search, for a group that is to confirm what it has found.
    pub fn draw_for(&self, group: u32, shots: usize) -> Samples {
        self.draw_from(Replicates::stream(purpose::CONFIRMATION, group), shots)
    }

    /// Shots that are independent of those on which settings were found, to bound how far these are from the best ones,
    /// or to tell their shares; `number` tells such samples apart.
    pub fn draw_anew(&self, number: u32, shots: usize) -> Samples {
        self.draw_from(Replicates::stream(purpose::OPTIMALITY_GAP, number), shots)
    }

    fn draw_from(&self, stream: Stream, shots: usize) -> Samples {
        let problem = &self.scenario.problem;
        match &self.penalty {
            Some(_) => Samples::for_shares(problem, stream, shots, self.importance()),
            None => Samples::with_importance(problem, stream, shots, self.importance()),
        }
    }

    /// Whether what violates least does so by far more than is allowed: more shots would not change that.
    pub fn is_far_from_passing(&self, searches: &[Search]) -> bool {
        let leader = leader(searches);
        self.penalty
            .as_ref()
            .zip(leader)
            .is_some_and(|(penalty, leader)| leader.fitness.penalty() > FAR * penalty.price)
    }

    /// Whether J of the leading candidate is much the same on other samples of this size.
    pub fn is_precise(&self, searches: &[Search], shots: usize, effort: &Effort) -> bool {
        if self.penalty.is_some() {
            return false;
        }
        let problem = &self.scenario.problem;
        let Some(leader) = leader(searches).filter(|it| it.fitness.objective().is_some()) else {
            return false;
        };
        let on_another_sample = |number| {
            let stream = Replicates::stream(purpose::EFFECTS, number);
            let shots = self.draw_from(stream, shots).shots;
            let settings = &leader.settings;
            let tally = Tally::trace(self.scenario, settings, settings.speed, &shots);
            effort.add(0, tally.rays);
            tally.terms(&problem.goals, settings.speed).total()
        };
        let objectives: Vec<f64> = (0..SAMPLES)
            .into_par_iter()
            .map(on_another_sample)
            .collect();
        is_precise(&objectives, problem)
    }
}

/// The best candidate of all contacts.
fn leader(searches: &[Search]) -> Option<&Candidate> {
    searches.get(leading(searches)).map(Search::best)
}

/// Violations beyond 1 from which on they are far: on few shots they are up to twice what they are on many.
const FAR: f64 = 3.0;
/// Samples for the variance of J.
const SAMPLES: u32 = 8;
