//! The search for the best settings.
//!
//! J over the settings is a flat valley that ends at a cliff, or a needle in a plateau, with a jump wherever one
//! shot changes surface. So the search
//!
//! 1. screens a low-discrepancy set of poses with few shots, and looks for more where few can see the target or fit;
//! 2. descends with Nelder-Mead from those that are better than their neighbours, in independent groups, and goes on
//!    with fewer candidates and more shots (successive halving); poses are compared on common random numbers, those
//!    that clearly lose end early (racing), and blocked ones are repaired;
//! 3. draws a part of the shots with an importance density for the violations of the incumbent;
//! 4. validates the answer on shots that the search has not seen, and raises the number of shots while the
//!    optimism gap is too large;
//! 5. starts further groups until the finalists of independent ones agree;
//! 6. searches again for settings that pass, where those with the least J do not.
//!
//! The speed is not searched: its best value follows exactly from the traced paths wherever restitution does not
//! depend on it.

mod ablation;
mod answer;
mod evaluator;
mod figures;
mod finalists;
mod front;
mod objectives;
mod pareto_archive;
mod passing;
mod point;
mod polish;
mod race;
mod repair;
mod sampler;
mod screening;
mod search;
mod space;
mod stage;
mod starts;
mod status;
mod stopping_rule;
mod tie;
mod window;

pub use ablation::Ablation;
pub use answer::Answer;
pub use evaluator::{Effort, Fitness};
pub use front::{Front, front};
pub use objectives::{Objectives, objectives};
pub use status::Status;
pub use tie::is_tie;
pub use window::{Drift, Turn, Window, passing_windows, windows};

use rayon::prelude::*;

use crate::control::{Control, Progress};
use crate::problem::setting::{Settings, Tolerance};
use crate::scenario::Scenario;
use evaluator::Evaluator;
use figures::Figures;
use finalists::{Agreement, confirmed};
use polish::Candidate;
use sampler::Sampler;
use search::Search;
use space::Space;
use stage::{STAGES, STAGES_SET_EXACTLY, Stage};
use stopping_rule::{is_in_reach, least_objective, not_converged};
use tie::ranked;

/// What a search found.
#[derive(Clone, Debug)]
pub struct Solution {
    /// How it ended.
    pub status: Status,
    /// By how much finalists of independent searches differ in J, relative to the best one.
    pub spread: f64,
    /// The best settings for each contact, best first: by J, and contacts that tie with the best in
    /// the order of the file.
    pub answers: Vec<Answer>,
    /// What each effect of the model does at the answer; none where the search was asked to stop.
    pub ablations: Vec<Ablation>,
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
/// Up to this many shots every contact is refined for itself; beyond only those that could win, the
/// best one first.
const CHEAP_SHOTS: usize = 1024;
/// Factor on the number of shots when the last stage was not accurate enough.
const RISE: usize = 4;

/// Settings for a contact, spread evenly over their ranges: one where every setting is held.
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
    let asked = scenario.as_asked();
    let searched = asked.as_searched();
    let mut sampler = Sampler::new(&searched);
    let ((mut searches, mut shots), mut figures) = rayon::join(
        || descend(&searched, &mut sampler, control, &effort),
        || Figures::new(&asked, control, &effort),
    );
    let mut answers = figures.all(&searches);
    let leader = leading(&searches);
    // Where the least J fails, finalists of the search for what passes are asked instead.
    let agreement = if answers[leader].passes() {
        confirmed(
            &mut searches[leader],
            &searched,
            &sampler,
            shots,
            &effort,
            control,
        )
    } else {
        Agreement::of(&searches[leader], &searched.problem)
    };
    searches.iter_mut().for_each(Search::keep_best);
    answers = figures.renewed(answers, &searches);
    let problem = &asked.problem;
    let not_converged = |searches: &[Search], answers: &[Answer], shots| {
        not_converged(searches, answers, problem, shots, control.validation_shots)
    };
    let mut open = not_converged(&searches, &answers, shots);
    while !open.is_empty() && shots * RISE <= control.most_shots && !control.is_stopped() {
        shots *= RISE;
        sampler.adapt(&searches, &effort, control);
        let samples = sampler.draw(shots);
        let evaluator = sampler.evaluator(&searched, &samples, &effort, control);
        refine_in_turn(&mut searches, &open, &evaluator, &Stage::beyond(shots));
        tell(control, &effort, &searches);
        answers = figures.renewed(answers, &searches);
        open = not_converged(&searches, &answers, shots);
    }
    let sought = passing::sought(
        &mut answers,
        (&asked, &searched),
        &mut figures,
        &effort,
        control,
    );
    let agreement = sought.unwrap_or(agreement);
    let ablations = if control.is_stopped() {
        Vec::new()
    } else {
        let importance = sampler.importance();
        ablation::measure(scenario, &asked, importance, &searches, &effort, control)
    };
    let answers = ranked(answers, problem);
    let status = match answers.first() {
        _ if control.is_stopped() => Status::Interrupted,
        Some(best) if best.evaluation.is_none() => Status::NoFeasiblePose,
        Some(_) if open.is_empty() && agreement.is_reached => Status::Converged,
        _ => Status::BestFound,
    };
    Solution {
        status,
        spread: agreement.spread,
        answers,
        ablations,
        poses: effort.poses(),
        shots_per_pose: shots,
        rays: effort.rays(),
    }
}

/// Screens the settings of every contact and goes down through the stages; to the end, unless the nozzle
/// is set exactly and J is precise before. Returns the searches and the shots at each pose of the last
/// stage.
fn descend(
    scenario: &Scenario,
    sampler: &mut Sampler,
    control: &Control,
    effort: &Effort,
) -> (Vec<Search>, usize) {
    let stages: Vec<&Stage> = stages(scenario, control.most_shots).collect();
    let most_shots = stages.last().map_or(SCREENING_SHOTS, |stage| stage.shots);
    let samples = sampler.draw(SCREENING_SHOTS);
    let evaluator = sampler.evaluator(scenario, &samples, effort, control);
    let contacts = scenario.problem.ranges.contact.par_iter();
    let mut searches: Vec<Search> = contacts
        .map(|&contact| Search::screen(scenario, contact, &evaluator))
        .collect();
    for (index, stage) in stages.into_iter().enumerate() {
        if control.is_stopped() {
            break;
        }
        if index > 0 {
            sampler.adapt(&searches, effort, control);
        }
        let samples = sampler.draw(stage.shots);
        let evaluator = sampler.evaluator(scenario, &samples, effort, control);
        advance(&mut searches, &evaluator, stage);
        tell(control, effort, &searches);
        if stage.shots >= CHEAP_SHOTS && sampler.is_far_from_passing(&searches) {
            return (searches, stage.shots);
        }
        let is_between = stage.shots >= CHEAP_SHOTS && stage.shots < most_shots;
        if is_set_exactly(scenario)
            && is_between
            && !control.is_stopped()
            && sampler.is_precise(&searches, stage.shots, effort)
        {
            return (searches, stage.shots);
        }
    }
    (searches, most_shots)
}

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

/// Takes another group of the same contact through the stages, up to those of so many shots.
fn descend_group(
    search: &Search,
    number: u32,
    scenario: &Scenario,
    sampler: &Sampler,
    shots: usize,
    effort: &Effort,
    control: &Control,
) -> Search {
    let samples = sampler.draw(SCREENING_SHOTS);
    let evaluator = sampler.evaluator(scenario, &samples, effort, control);
    let mut group = search.another_group(number, scenario, &evaluator);
    for stage in stages(scenario, shots) {
        if control.is_stopped() {
            break;
        }
        let samples = sampler.draw(stage.shots);
        let evaluator = sampler.evaluator(scenario, &samples, effort, control);
        group.refine(&evaluator, stage);
    }
    group
}

/// The index of the search with the best candidate.
fn leading(searches: &[Search]) -> usize {
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
fn refine_in_turn(searches: &mut [Search], which: &[usize], evaluator: &Evaluator, stage: &Stage) {
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

fn tell(control: &Control, effort: &Effort, searches: &[Search]) {
    let best = least_objective(searches);
    control.tell(Progress::Search {
        poses: effort.poses(),
        best: best.is_finite().then_some(best),
    });
}
