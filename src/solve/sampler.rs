//! The shots of a search.

use rayon::prelude::*;

use super::evaluator::Effort;
use super::polish::Candidate;
use super::search::Search;
use super::stopping_rule::is_precise;
use crate::control::Control;
use crate::evaluate::importance_of;
use crate::jet::{ImportanceDensity, Replicates, Samples, Stream, purpose};
use crate::objective::Tally;
use crate::scenario::Scenario;

/// Draws the shots of a search, a part of them with an importance density for the violations of the incumbent.
pub(super) struct Sampler<'a> {
    scenario: &'a Scenario,
    /// The importance density, once there is one.
    importance: Option<ImportanceDensity>,
}

impl<'a> Sampler<'a> {
    pub fn new(scenario: &'a Scenario) -> Self {
        Self {
            scenario,
            importance: None,
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

    fn draw_from(&self, stream: Stream, shots: usize) -> Samples {
        Samples::with_importance(&self.scenario.problem, stream, shots, self.importance())
    }

    /// Whether J of the leading candidate is much the same on other samples of this size.
    pub fn is_precise(&self, searches: &[Search], shots: usize, effort: &Effort) -> bool {
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
    let best = searches.iter().map(Search::best);
    best.min_by(|a, b| a.fitness.rank().total_cmp(&b.fitness.rank()))
}

/// Samples for the variance of J.
const SAMPLES: u32 = 8;
