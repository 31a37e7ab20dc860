//! The search for the best settings.
//!
//! J over the settings is a flat valley that ends at a cliff, or a needle in a plateau, with a jump
//! wherever one shot changes surface. So: screen widely with few shots, go down from the best few
//! places with Nelder-Mead, raise the number of shots as the candidates get better, draw a part of
//! them from where the leading candidate does harm, decide between candidates on common shots, and
//! report the winner on shots that the search has not seen. The speed is not searched: its best value
//! follows exactly from the traced paths wherever restitution does not depend on it.

mod answer;
mod control;
mod evaluator;
mod figures;
mod front;
mod ladder;
mod models;
mod objectives;
mod pareto_archive;
mod polish;
mod search;
mod space;
mod stopping_rule;
mod tie;
mod window;

pub use answer::Answer;
pub use control::{Control, Progress, Shortcuts, Status};
pub use evaluator::{Effort, Fitness};
pub use front::{Front, front};
pub use ladder::{Ladder, Rung};
pub use objectives::{Objectives, objectives};
pub use tie::is_tie;
pub use window::{Drift, Turn, Window, passing_windows, passing_windows_until, windows};

use rayon::prelude::*;

use crate::problem::setting::{Settings, Tolerance};
use crate::scenario::Scenario;
use evaluator::Evaluator;
use figures::Figures;
use models::Models;
use search::{STAGES, STAGES_SET_EXACTLY, Search, Stage};
use space::Space;
use stopping_rule::{SearchEstimate, is_in_reach, least_objective, not_converged};
use tie::ranked;

/// What a search found.
#[derive(Clone, Debug)]
pub struct Solution {
    /// How it ended.
    pub status: Status,
    /// The best settings for each contact, best first: by J, and contacts that tie with the best in
    /// the order of the file.
    pub answers: Vec<Answer>,
    /// Which effects were searched with, and what each of them does.
    pub ladder: Ladder,
    /// Work done.
    pub poses: usize,
    /// Shots at each pose in the last stage.
    pub shots_per_pose: usize,
    /// Rays cast.
    pub rays: usize,
}

impl Solution {
    /// The answer with the least J; contacts that tie with it may be recommended before it.
    pub fn least(&self) -> Option<&Answer> {
        let answers = self.answers.iter();
        answers.min_by(|a, b| a.order().total_cmp(&b.order()))
    }
}

const SCREENING_SHOTS: usize = 64;
/// Up to so many shots every contact is refined for itself, beyond only those that could win, the
/// best one first.
const CHEAP_SHOTS: usize = 1024;
/// By how much the shots rise when the last stage was not accurate enough.
const RISE: usize = 4;

/// Choices for a contact, spread evenly over all settings: one where every setting is held.
pub fn spread_settings(scenario: &Scenario, contact: usize, count: usize) -> Vec<Settings> {
    let space = Space::new(&scenario.problem, contact, true);
    let count = if space.dimensions() == 0 { 1 } else { count };
    let seed = scenario.problem.seed as u32;
    (0..count as u32)
        .map(|index| space.settings(&space.spread(index, seed)))
        .collect()
}

/// Finds the best settings of a problem.
pub fn solve(scenario: &Scenario, control: &Control) -> Solution {
    let effort = Effort::default();
    let mut models = Models::new(scenario);
    let asked = models.asked.clone();
    let ((mut searches, mut shots), mut figures) = rayon::join(
        || descend(&mut models, control, &effort),
        || Figures::new(&asked, control, &effort),
    );
    let mut estimates = agree(&mut models, &mut searches, shots, control, &effort);
    let mut answers = figures.all(&searches);
    let problem = &scenario.problem;
    let mut open = not_converged(
        &estimates,
        &answers,
        problem,
        shots,
        control.validation_shots,
    );
    while !open.is_empty() && shots * RISE <= control.most_shots && !control.is_stopped() {
        shots *= RISE;
        let stage = Stage::beyond(shots);
        models.importance_of(&searches, &effort, control);
        refine(&models, &mut searches, &open, &stage, control, &effort);
        estimates = agree(&mut models, &mut searches, shots, control, &effort);
        answers = figures.renewed(answers, &searches);
        open = not_converged(
            &estimates,
            &answers,
            problem,
            shots,
            control.validation_shots,
        );
    }
    if !control.is_stopped() {
        models.measure_unasked(&searches, &effort, control);
    }
    let answers = ranked(answers, problem);
    let status = match answers.first() {
        _ if control.is_stopped() => Status::Interrupted,
        Some(best) if best.evaluation.is_none() => Status::NoFeasiblePose,
        Some(_) if open.is_empty() => Status::Converged,
        _ => Status::BudgetSpent,
    };
    Solution {
        status,
        answers,
        ladder: models.ladder,
        poses: effort.poses(),
        shots_per_pose: shots,
        rays: effort.rays(),
    }
}

/// Goes on with what was left out, as long as the whole model disagrees with the one that is
/// searched. Returns J of the candidates.
fn agree(
    models: &mut Models,
    searches: &mut [Search],
    shots: usize,
    control: &Control,
    effort: &Effort,
) -> Vec<SearchEstimate> {
    let mut estimates = models.estimates(searches, shots, control);
    while !control.is_stopped() && models.put_back(searches, &estimates, effort, control) {
        let all: Vec<usize> = (0..searches.len()).collect();
        let stage = Stage::beyond(shots);
        refine(models, searches, &all, &stage, control, effort);
        estimates = models.estimates(searches, shots, control);
    }
    estimates
}

/// Takes some of the searches through a stage, in turn.
fn refine(
    models: &Models,
    searches: &mut [Search],
    which: &[usize],
    stage: &Stage,
    control: &Control,
    effort: &Effort,
) {
    let samples = models.draw(stage.shots);
    let evaluator = models.evaluator(&samples, effort, control);
    let accuracy = models.asked.problem.accuracy;
    refine_in_turn(searches, which, &evaluator, stage, accuracy);
    tell(control, effort, searches);
}

/// Screens the settings of every contact and goes down through the stages, after the first of them
/// with the effects that matter; to the end, unless the nozzle is set exactly and J is sharp before.
/// Returns the searches and the shots at each pose of the last stage.
fn descend(models: &mut Models, control: &Control, effort: &Effort) -> (Vec<Search>, usize) {
    let affordable = |stage: &&Stage| stage.shots <= control.most_shots;
    let is_set_exactly = models.asked.problem.tolerance == Tolerance::default();
    let all = if is_set_exactly {
        &STAGES_SET_EXACTLY
    } else {
        &STAGES
    };
    let stages: Vec<&Stage> = all.iter().filter(affordable).collect();
    let most_shots = stages.last().map_or(SCREENING_SHOTS, |stage| stage.shots);
    let contacts = &models.asked.problem.ranges.contact;
    let samples = models.draw(SCREENING_SHOTS);
    let evaluator = models.evaluator(&samples, effort, control);
    let mut searches: Vec<Search> = contacts
        .par_iter()
        .map(|&contact| Search::screen(&models.searched, contact, &evaluator))
        .collect();
    if !control.is_stopped() {
        models.choose_precision(&searches, effort, control);
    }
    for (index, stage) in stages.into_iter().enumerate() {
        if control.is_stopped() {
            break;
        }
        let before = searches.clone();
        if index > 0 {
            models.importance_of(&searches, effort, control);
        }
        if stage.shots > CHEAP_SHOTS {
            models.leave_out_size(&mut searches, effort, control);
        }
        advance(models, &mut searches, stage, control, effort);
        if control.is_stopped() {
            continue;
        }
        if index == 0 {
            models.climb(&mut searches, effort, control);
        } else if stage.shots < most_shots {
            let mut estimates = models.estimates(&searches, stage.shots, control);
            // What was found without effects that matter leads astray: once more from where it began.
            while !control.is_stopped()
                && models.put_back(&mut searches, &estimates, effort, control)
            {
                let carried = |search: &Search| search.carried_over(&models.searched);
                searches = before.iter().map(carried).collect();
                advance(models, &mut searches, stage, control, effort);
                estimates = models.estimates(&searches, stage.shots, control);
            }
            if is_set_exactly && models.are_precise(&searches, stage.shots, effort) {
                return (searches, stage.shots);
            }
        }
    }
    (searches, most_shots)
}

/// Takes the searches through a stage: all of them as long as shots are few, then those that could
/// win.
fn advance(
    models: &Models,
    searches: &mut [Search],
    stage: &Stage,
    control: &Control,
    effort: &Effort,
) {
    if stage.shots > CHEAP_SHOTS {
        let least = least_objective(searches);
        let could_win = |&index: &usize| is_in_reach(&searches[index], least);
        let open: Vec<usize> = (0..searches.len()).filter(could_win).collect();
        return refine(models, searches, &open, stage, control, effort);
    }
    let samples = models.draw(stage.shots);
    let evaluator = models.evaluator(&samples, effort, control);
    let accuracy = models.asked.problem.accuracy;
    let each = searches.par_iter_mut();
    each.for_each(|search| search.refine(&evaluator, stage, accuracy));
    tell(control, effort, searches);
}

/// Refines some of the searches, the best one first, so that the others can profit from it; the
/// others, and those that went before the best one, go where that one is if they are better there.
fn refine_in_turn(
    searches: &mut [Search],
    which: &[usize],
    evaluator: &Evaluator,
    stage: &Stage,
    accuracy: f64,
) {
    let rank = |search: &Search| search.best().fitness.rank();
    let mut order = which.to_vec();
    order.sort_by(|&a, &b| rank(&searches[a]).total_cmp(&rank(&searches[b])));
    let mut leader = order[0];
    let mut beside = vec![None; searches.len()];
    searches[leader].refine(evaluator, stage, accuracy);
    for &index in &order[1..] {
        let leading = searches[leader].best().clone();
        searches[index].refine_from_incumbent(&leading, evaluator, stage, accuracy);
        beside[index] = Some(leader);
        if rank(&searches[index]) < rank(&searches[leader]) {
            leader = index;
        }
    }
    let leading = searches[leader].best().clone();
    for (index, search) in searches.iter_mut().enumerate() {
        if index != leader && beside[index] != Some(leader) {
            search.follow(&leading, evaluator, stage, accuracy);
        }
    }
}

fn tell(control: &Control, effort: &Effort, searches: &[Search]) {
    let best = least_objective(searches);
    (control.watch)(Progress {
        poses: effort.poses(),
        best: best.is_finite().then_some(best),
    });
}
