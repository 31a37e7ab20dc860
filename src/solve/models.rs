//! The model that figures come from, and the one that the search makes do with.

use rayon::prelude::*;

use super::accuracy::{Claim, is_in_reach, is_sharp, least_objective, rounding_of_objective};
use super::control::Control;
use super::judge::{Effort, Judge};
use super::ladder::{Bench, Ladder, fewer, objective, objective_in};
use super::polish::Candidate;
use super::search::Search;
use crate::evaluate::focus_on_harm;
use crate::jet::{Focus, Replicates, Samples, Stream, purpose};
use crate::objective::Tally;
use crate::precision::Precision;
use crate::problem::model::Model;
use crate::setup::Setup;

/// The models of one problem.
pub(super) struct Models<'a> {
    /// With every effect.
    whole: &'a Setup,
    /// With those that are asked for: figures come from it.
    pub asked: Setup,
    /// With those that matter.
    pub searched: Setup,
    pub ladder: Ladder,
    /// Where harm comes from, once that is known.
    focus: Option<Focus>,
}

impl<'a> Models<'a> {
    pub fn new(whole: &'a Setup) -> Self {
        let asked = whole.as_asked();
        Self {
            whole,
            searched: asked.clone(),
            asked,
            ladder: Ladder::of(whole),
            focus: None,
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
            let focus = self.focus.as_ref();
            if let Some(bench) = Bench::new(&self.asked, focus, searches, effort, control) {
                self.ladder.climb(&bench, &self.asked.problem.effects());
                let has_cliffs = searches.iter().any(Search::has_met_harm);
                self.ladder.leave_out_from_afar(&bench, has_cliffs);
            }
            self.reduce(searches);
        }
    }

    /// Leaves out the size of the shots, if the candidates stand near the best settings and it does not
    /// matter there.
    pub fn leave_out_size(&mut self, searches: &mut [Search], effort: &Effort, control: &Control) {
        if self.whole.problem.model == Model::Auto {
            let focus = self.focus.as_ref();
            if self.ladder.asks_about_size(self.asked.problem.accuracy)
                && let Some(bench) = Bench::new(&self.asked, focus, searches, effort, control)
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
        let focus = self.focus.as_ref();
        if let Some(bench) = Bench::new(self.whole, focus, searches, effort, control) {
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
        claims: &[Claim],
        effort: &Effort,
        control: &Control,
    ) -> bool {
        let least = least_objective(searches);
        let accuracy = self.asked.problem.accuracy;
        let rounding = rounding_of_objective(&self.asked.problem.goals);
        let differs = |(searched, asked): (f64, f64)| {
            (asked - searched).abs() > (accuracy * asked).max(rounding)
        };
        let disagrees = |(search, claim): (&Search, &Claim)| {
            is_in_reach(search, least) && claim.is_some_and(differs)
        };
        let must = searches.iter().zip(claims).any(disagrees);
        if must {
            if self.ladder.left_out().is_empty() {
                self.ladder.precision = Precision::F64;
            }
            let focus = self.focus.as_ref();
            if let Some(bench) = Bench::new(&self.asked, focus, searches, effort, control) {
                self.ladder.put_back(&bench);
            }
            self.reduce(searches);
        }
        must
    }

    /// Focuses the shots of the search on the harm that the leading candidate does.
    pub fn focus_on_harm(&mut self, searches: &[Search], effort: &Effort, control: &Control) {
        if !control.shortcuts.focus {
            return;
        }
        let leader = leader(searches).filter(|it| it.standing.objective().is_some());
        self.focus = leader.map(|leader| {
            let (focus, rays) = focus_on_harm(&self.asked, &leader.choice);
            effort.add(0, rays);
            focus
        });
    }

    /// Shots of the search.
    pub fn draw(&self, shots: usize) -> Samples {
        self.draw_from(Stream::Search, &self.searched, shots)
    }

    fn draw_from(&self, stream: Stream, setup: &Setup, shots: usize) -> Samples {
        Samples::focused(&setup.problem, stream, shots, self.focus.as_ref())
    }

    /// Judges the model that is searched.
    pub fn judge<'b>(
        &'b self,
        samples: &'b Samples,
        effort: &'b Effort,
        control: &'b Control,
    ) -> Judge<'b> {
        let shots = &samples.deviates;
        Judge::new(
            &self.searched,
            self.ladder.precision,
            shots,
            effort,
            control,
        )
    }

    /// J of the best candidates on the shots of the search.
    pub fn claims(&self, searches: &[Search], shots: usize, control: &Control) -> Vec<Claim> {
        if control.is_stopped() {
            return searches.iter().map(|_| None).collect();
        }
        let precision = self.ladder.precision;
        let is_whole = self.ladder.left_out().is_empty() && precision == Precision::F64;
        let draw = || self.draw_from(Stream::Search, &self.asked, shots).deviates;
        let whole = if is_whole { Vec::new() } else { draw() };
        let fewer = fewer(&self.asked, &self.searched, &whole, self.focus.as_ref());
        let claim = |search: &Search| {
            let best = search.best();
            let searched = best.standing.objective()?;
            if is_whole {
                return Some((searched, searched));
            }
            let with = objective(&self.asked, &best.choice, &whole);
            let without = objective_in(precision, &self.searched, &best.choice, &fewer);
            Some((searched, searched + with - without))
        };
        searches.par_iter().map(claim).collect()
    }

    /// Whether J of the leading candidate is much the same on other sets of so many shots.
    pub fn are_sharp(&self, searches: &[Search], shots: usize, effort: &Effort) -> bool {
        let problem = &self.searched.problem;
        let Some(leader) = leader(searches).filter(|it| it.standing.objective().is_some()) else {
            return false;
        };
        let on_another_set = |number| {
            let stream = Replicates::stream(purpose::EFFECTS, number);
            let shots = self.draw_from(stream, &self.searched, shots).deviates;
            let choice = &leader.choice;
            let precision = self.ladder.precision;
            let tally = Tally::trace_as(precision, &self.searched, choice, choice.speed, &shots);
            effort.add(0, tally.rays);
            tally.terms(&problem.goals, choice.speed).total()
        };
        let objectives: Vec<f64> = (0..SETS).into_par_iter().map(on_another_set).collect();
        is_sharp(&objectives, problem)
    }

    fn reduce(&mut self, searches: &mut [Search]) {
        let Some(best) = leader(searches) else {
            return;
        };
        self.searched = self.asked.without(&self.ladder.left_out(), &best.choice);
        for search in searches {
            *search = search.carried_over(&self.searched);
        }
    }
}

/// The best candidate of all contacts.
fn leader(searches: &[Search]) -> Option<&Candidate> {
    let best = searches.iter().map(Search::best);
    best.min_by(|a, b| a.standing.rank().total_cmp(&b.standing.rank()))
}

/// Sets of shots that tell how much J scatters.
const SETS: u32 = 8;
