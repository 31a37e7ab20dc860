//! The descent of a problem's contacts through the stages, from the first few shots to many.

use rayon::prelude::*;

use super::evaluator::{Effort, Evaluator};
use super::finalists::Agreement;
use super::polish::Candidate;
use super::sampler::Sampler;
use super::search::{GROUPS, Search};
use super::stage::{STAGES, STAGES_SET_EXACTLY, Stage};
use super::stopping_rule::{is_in_reach, least_objective};
use crate::control::{Control, Progress};
use crate::problem::setting::Tolerance;
use crate::scenario::Scenario;

/// What the descent has come to. Groups can be added to it, which are compared on the shots that it has ended on.
pub(super) struct Descent<'a> {
    scenario: &'a Scenario,
    effort: &'a Effort,
    control: &'a Control,
    /// The search of each contact, with all its groups.
    pub searches: Vec<Search>,
    /// How its last shots were drawn.
    pub sampler: Sampler<'a>,
    /// Shots at each pose of its last stage.
    pub shots: usize,
}

/// Shots of the screening.
pub(super) const SCREENING_SHOTS: usize = 64;
/// Up to this many shots every contact is refined for itself; beyond only those that could win, the
/// best one first.
const CHEAP_SHOTS: usize = 1024;

impl<'a> Descent<'a> {
    /// Screens the settings of every contact and goes down through the stages; to the end, unless the nozzle
    /// is set exactly and J is precise before.
    pub fn run(
        scenario: &'a Scenario,
        sampler: Sampler<'a>,
        effort: &'a Effort,
        control: &'a Control,
    ) -> Self {
        let samples = sampler.draw(SCREENING_SHOTS);
        let evaluator = sampler.evaluator(scenario, &samples, effort, control);
        let contacts = scenario.problem.ranges.contact.par_iter();
        let searches = contacts
            .map(|&contact| Search::screen(scenario, contact, &evaluator))
            .collect();
        let mut descent = Self {
            scenario,
            effort,
            control,
            searches,
            sampler,
            shots: SCREENING_SHOTS,
        };
        descent.go_down();
        descent
    }

    fn go_down(&mut self) {
        let (scenario, control, effort) = (self.scenario, self.control, self.effort);
        let stages: Vec<&Stage> = stages(scenario, control.most_shots).collect();
        let most_shots = stages.last().map_or(SCREENING_SHOTS, |stage| stage.shots);
        for (index, stage) in stages.into_iter().enumerate() {
            if control.is_stopped() {
                break;
            }
            if index > 0 {
                self.sampler.adapt(&self.searches, effort, control);
            }
            let samples = self.sampler.draw(stage.shots);
            let evaluator = self.sampler.evaluator(scenario, &samples, effort, control);
            advance(&mut self.searches, &evaluator, stage);
            self.shots = stage.shots;
            tell(control, effort, &self.searches);
            if stage.shots < CHEAP_SHOTS {
                continue;
            }
            let is_between = stage.shots < most_shots && !control.is_stopped();
            if self.sampler.is_far_from_passing(&self.searches)
                || (is_set_exactly(scenario)
                    && is_between
                    && self.sampler.is_precise(&self.searches, stage.shots, effort))
            {
                break;
            }
        }
    }

    /// The index of the search with the best candidate.
    pub fn leading(&self) -> usize {
        leading(&self.searches)
    }

    /// The searches with the best candidate of each alone.
    pub fn best(&self) -> Vec<Search> {
        let mut searches = self.searches.clone();
        searches.iter_mut().for_each(Search::keep_best);
        searches
    }

    /// How far the finalists of a contact agree.
    pub fn agreement(&self, contact: usize) -> Agreement {
        Agreement::of(&self.searches[contact], &self.scenario.problem)
    }

    /// Adds groups to the search of a contact until its finalists agree, or there are too many of them: then they are
    /// recombined. What comes of that is not independent of them, and confirms nothing.
    pub fn confirmed(&mut self, contact: usize) -> Agreement {
        let mut agreement = self.agreement(contact);
        let mut number = GROUPS;
        loop {
            let fails = self.searches[contact].best().fitness.penalty() > 0.0;
            let is_penalised = self.sampler.penalty().is_some();
            let most = if fails {
                MOST_THAT_FAIL
            } else if is_penalised && agreement.missing > 1 {
                // What passes often lies along a valley that every group ends elsewhere in.
                MOST_THAT_SCATTER
            } else {
                MOST_GROUPS
            };
            let end = most.min(number + agreement.missing);
            if agreement.is_reached || self.control.is_stopped() {
                return agreement;
            }
            if end <= number {
                self.recombine(contact);
                return agreement;
            }
            let groups: Vec<Search> = (number..end)
                .into_par_iter()
                .map(|number| self.another_group(contact, number))
                .collect();
            for group in groups {
                self.searches[contact].join(group);
            }
            number = end;
            agreement = self.agreement(contact);
        }
    }

    fn recombine(&mut self, contact: usize) {
        let samples = self.sampler.draw(self.shots);
        let sampler = &self.sampler;
        let evaluator = sampler.evaluator(self.scenario, &samples, self.effort, self.control);
        self.searches[contact].recombine(&evaluator, &Stage::beyond(self.shots));
    }

    /// Takes another group of a contact through the stages: on shots of its own, so that it does not end where theirs
    /// led the others, and at last on the common ones, on which finalists are compared.
    fn another_group(&self, contact: usize, number: u32) -> Search {
        let Self {
            scenario,
            effort,
            control,
            sampler,
            ..
        } = self;
        let samples = sampler.draw_for(number, SCREENING_SHOTS);
        let evaluator = sampler.evaluator(scenario, &samples, effort, control);
        let mut group = self.searches[contact].another_group(number, scenario, &evaluator);
        for stage in stages(scenario, self.shots) {
            // What stops the others must not leave it on shots of its own, on which J compares with nothing.
            if control.is_stopped() && stage.shots < self.shots {
                continue;
            }
            let samples = match stage.shots < self.shots {
                true => sampler.draw_for(number, stage.shots),
                false => sampler.draw(stage.shots),
            };
            let evaluator = sampler.evaluator(scenario, &samples, effort, control);
            group.refine(&evaluator, stage);
        }
        group
    }
}

/// Numbers of groups end here.
const MOST_GROUPS: u32 = 8;
/// Here where no two of those that are to pass agree.
const MOST_THAT_SCATTER: u32 = 4;
/// Here where the best of them fails.
const MOST_THAT_FAIL: u32 = 3;

/// Whether a shop hits the settings exactly.
fn is_set_exactly(scenario: &Scenario) -> bool {
    scenario.problem.tolerance == Tolerance::default()
}

/// The stages of a problem, up to the most shots.
fn stages(scenario: &Scenario, most_shots: usize) -> impl Iterator<Item = &'static Stage> {
    let all = if is_set_exactly(scenario) {
        &STAGES_SET_EXACTLY
    } else {
        &STAGES
    };
    all.iter().filter(move |stage| stage.shots <= most_shots)
}

/// The index of the search with the best candidate.
pub(super) fn leading(searches: &[Search]) -> usize {
    let best = searches.iter().map(Search::best).enumerate();
    let leader = best.min_by(|(_, a), (_, b)| Candidate::by_rank(a, b));
    leader.map_or(0, |(index, _)| index)
}

/// Takes the searches through a stage: all of them as long as shots are few, then those that could
/// win.
fn advance(searches: &mut [Search], evaluator: &Evaluator, stage: &Stage) {
    if stage.shots > CHEAP_SHOTS {
        let least = least_objective(searches);
        let could_win = |&index: &usize| is_in_reach(&searches[index], least);
        let open: Vec<usize> = (0..searches.len()).filter(could_win).collect();
        return refine_in_turn(searches, &open, evaluator, stage);
    }
    let each = searches.par_iter_mut();
    each.for_each(|search| search.refine(evaluator, stage));
}

/// Refines some of the searches, the best one first, so that the others can profit from it; the
/// others, and those that went before the best one, go where that one is if they are better there.
pub(super) fn refine_in_turn(
    searches: &mut [Search],
    which: &[usize],
    evaluator: &Evaluator,
    stage: &Stage,
) {
    let rank = |search: &Search| search.best().fitness.rank();
    let mut order = which.to_vec();
    order.sort_by(|&a, &b| rank(&searches[a]).total_cmp(&rank(&searches[b])));
    let mut leader = order[0];
    let mut beside = vec![None; searches.len()];
    searches[leader].refine(evaluator, stage);
    for &index in &order[1..] {
        let leading = searches[leader].best().clone();
        searches[index].refine_from_incumbent(&leading, evaluator, stage);
        beside[index] = Some(leader);
        if rank(&searches[index]) < rank(&searches[leader]) {
            leader = index;
        }
    }
    let leading = searches[leader].best().clone();
    for (index, search) in searches.iter_mut().enumerate() {
        if index != leader && beside[index] != Some(leader) {
            search.follow(&leading, evaluator, stage);
        }
    }
}

/// Tells how far the search has come.
pub(super) fn tell(control: &Control, effort: &Effort, searches: &[Search]) {
    let best = least_objective(searches);
    control.tell(Progress::Search {
        poses: effort.poses(),
        best: best.is_finite().then_some(best),
    });
}
