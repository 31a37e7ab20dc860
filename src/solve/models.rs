//! The model that figures come from, and the one that the search makes do with.

use rayon::prelude::*;

use super::control::Control;
use super::evaluator::{Effort, Evaluator};
use super::ladder::{Bench, Ladder, fewer, objective, objective_in};
use super::polish::Candidate;
use super::search::Search;
use super::stopping_rule::{
    SearchEstimate, is_in_reach, is_precise, least_objective, rounding_of_objective,
};
use crate::evaluate::importance_of;
use crate::jet::{ImportanceDensity, Replicates, Samples, Stream, purpose};
use crate::objective::Tally;
use crate::precision::Precision;
use crate::problem::model::Model;
use crate::scenario::Scenario;

/// The models of one problem.
pub(super) struct Models<'a> {
    /// With every effect.
    whole: &'a Scenario,
    /// With those that are asked for: figures come from it.
    pub asked: Scenario,
    /// With those that matter.
    pub searched: Scenario,
    pub ladder: Ladder,
    /// Where harm comes from, once that is known.
    importance: Option<ImportanceDensity>,
}

impl<'a> Models<'a> {
    pub fn new(whole: &'a Scenario) -> Self {
        let asked = whole.as_asked();
        Self {
            whole,
            searched: asked.clone(),
            asked,
            ladder: Ladder::of(whole),
            importance: None,
        }
    }

    /// Finds out in which precision paths can be traced.
    pub fn choose_precision(&mut self, searches: &[Search], effort: &Effort, control: &Control) {
        let is_faster = self.asked.scene.has_exact_walls();
        if control.shortcuts.single_precision
            && is_faster
            && let Some(bench) = Bench::new(&self.asked, None, searches, effort, control)
        {
            self.ladder.choose_precision(&bench);
        }
    }

    /// Finds out which effects matter at the best candidates, where that is left to the program.
    pub fn climb(&mut self, searches: &mut [Search], effort: &Effort, control: &Control) {
        if self.whole.problem.model == Model::Auto {
            let importance = self.importance.as_ref();
            if let Some(bench) = Bench::new(&self.asked, importance, searches, effort, control) {
                self.ladder.climb(&bench, &self.asked.problem.effects());
                let has_cliffs = searches.iter().any(Search::has_violations);
                self.ladder.leave_out_from_afar(&bench, has_cliffs);
            }
            self.reduce(searches);
        }
    }

    /// Leaves out the size of the shots, if the candidates stand near the best settings and it does not
    /// matter there.
    pub fn leave_out_size(&mut self, searches: &mut [Search], effort: &Effort, control: &Control) {
        if self.whole.problem.model == Model::Auto {
            let importance = self.importance.as_ref();
            if self.ladder.asks_about_size(self.asked.problem.accuracy)
                && let Some(bench) = Bench::new(&self.asked, importance, searches, effort, control)
            {
                self.ladder.leave_out_size(&bench);
            }
            self.reduce(searches);
        }
    }

    /// Measures what the effects do that were not asked for.
    pub fn measure_unasked(&mut self, searches: &[Search], effort: &Effort, control: &Control) {
        let unasked = self.whole.unasked();
        if unasked.is_empty() {
            return;
        }
        let importance = self.importance.as_ref();
        if let Some(bench) = Bench::new(self.whole, importance, searches, effort, control) {
            self.ladder.climb(&bench, &unasked);
        }
        self.ladder.leave_out_all();
    }

    /// Puts back the effect that matters most, when the whole model disagrees with the one that
    /// is searched about J by more than the accuracy; when no effect is left out, it is the precision.
    /// Returns whether it did.
    pub fn put_back(
        &mut self,
        searches: &mut [Search],
        estimates: &[SearchEstimate],
        effort: &Effort,
        control: &Control,
    ) -> bool {
        let least = least_objective(searches);
        let accuracy = self.asked.problem.accuracy;
        let rounding = rounding_of_objective(&self.asked.problem.goals);
        let differs = |(searched, asked): (f64, f64)| {
            (asked - searched).abs() > (accuracy * asked).max(rounding)
        };
        let disagrees = |(search, claim): (&Search, &SearchEstimate)| {
            is_in_reach(search, least) && claim.is_some_and(differs)
        };
        let must = searches.iter().zip(estimates).any(disagrees);
        if must {
            if self.ladder.left_out().is_empty() {
                self.ladder.precision = Precision::F64;
            }
            let importance = self.importance.as_ref();
            if let Some(bench) = Bench::new(&self.asked, importance, searches, effort, control) {
                self.ladder.put_back(&bench);
            }
            self.reduce(searches);
        }
        must
    }

    /// Focuses the shots of the search on the harm that the leading candidate does.
    pub fn importance_of(&mut self, searches: &[Search], effort: &Effort, control: &Control) {
        if !control.shortcuts.importance {
            return;
        }
        let leader = leader(searches).filter(|it| it.fitness.objective().is_some());
        self.importance = leader.map(|leader| {
            let (importance, rays) = importance_of(&self.asked, &leader.settings);
            effort.add(0, rays);
            importance
        });
    }

    /// Shots of the search.
    pub fn draw(&self, shots: usize) -> Samples {
        self.draw_from(Stream::Search, &self.searched, shots)
    }

    fn draw_from(&self, stream: Stream, scenario: &Scenario, shots: usize) -> Samples {
        Samples::focused(&scenario.problem, stream, shots, self.importance.as_ref())
    }

    /// Judges the model that is searched.
    pub fn evaluator<'b>(
        &'b self,
        samples: &'b Samples,
        effort: &'b Effort,
        control: &'b Control,
    ) -> Evaluator<'b> {
        let shots = &samples.shots;
        Evaluator::new(
            &self.searched,
            self.ladder.precision,
            shots,
            effort,
            control,
        )
    }

    /// J of the best candidates on the shots of the search.
    pub fn estimates(
        &self,
        searches: &[Search],
        shots: usize,
        control: &Control,
    ) -> Vec<SearchEstimate> {
        if control.is_stopped() {
            return searches.iter().map(|_| None).collect();
        }
        let precision = self.ladder.precision;
        let is_whole = self.ladder.left_out().is_empty() && precision == Precision::F64;
        let draw = || self.draw_from(Stream::Search, &self.asked, shots).shots;
        let whole = if is_whole { Vec::new() } else { draw() };
        let fewer = fewer(
            &self.asked,
            &self.searched,
            &whole,
            self.importance.as_ref(),
        );
        let claim = |search: &Search| {
            let best = search.best();
            let searched = best.fitness.objective()?;
            if is_whole {
                return Some((searched, searched));
            }
            let with = objective(&self.asked, &best.settings, &whole);
            let without = objective_in(precision, &self.searched, &best.settings, &fewer);
            Some((searched, searched + with - without))
        };
        searches.par_iter().map(claim).collect()
    }

    /// Whether J of the leading candidate is much the same on other sets of so many shots.
    pub fn are_precise(&self, searches: &[Search], shots: usize, effort: &Effort) -> bool {
        let problem = &self.searched.problem;
        let Some(leader) = leader(searches).filter(|it| it.fitness.objective().is_some()) else {
            return false;
        };
        let on_another_set = |number| {
            let stream = Replicates::stream(purpose::EFFECTS, number);
            let shots = self.draw_from(stream, &self.searched, shots).shots;
            let settings = &leader.settings;
            let precision = self.ladder.precision;
            let tally =
                Tally::trace_as(precision, &self.searched, settings, settings.speed, &shots);
            effort.add(0, tally.rays);
            tally.terms(&problem.goals, settings.speed).total()
        };
        let objectives: Vec<f64> = (0..SETS).into_par_iter().map(on_another_set).collect();
        is_precise(&objectives, problem)
    }

    fn reduce(&mut self, searches: &mut [Search]) {
        let Some(best) = leader(searches) else {
            return;
        };
        self.searched = self.asked.without(&self.ladder.left_out(), &best.settings);
        for search in searches {
            *search = search.carried_over(&self.searched);
        }
    }
}

/// The best candidate of all contacts.
fn leader(searches: &[Search]) -> Option<&Candidate> {
    let best = searches.iter().map(Search::best);
    best.min_by(|a, b| a.fitness.rank().total_cmp(&b.fitness.rank()))
}

/// Sets of shots that tell how much J scatters.
const SETS: u32 = 8;
