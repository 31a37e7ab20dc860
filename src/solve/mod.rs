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
mod descent;
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
mod segments;
mod space;
mod stage;
mod starts;
mod status;
mod stopping_rule;
mod tie;
mod tilt;
mod window;

pub use ablation::Ablation;
pub use answer::Answer;
pub use evaluator::{Effort, Fitness};
pub use front::{Front, front};
pub use objectives::{Objectives, objectives};
pub use segments::{Segment, solve_stroke};
pub use status::Status;
pub use tie::is_tie;
pub use window::{Drift, Turn, Window, passing_windows, windows};

use crate::control::Control;
use crate::problem::Problem;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use descent::{Descent, leading, refine_in_turn, tell};
use figures::Figures;
use finalists::{Agreement, MANY};
use passing::Sought;
use sampler::Sampler;
use search::Search;
use space::Space;
use stage::Stage;
use stopping_rule::{is_near_best, not_converged, still_gains};
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
    best_of(scenario, control, Wanted::ALL)
}

/// How many times what is allowed is far from passing.
const HOPELESS: f64 = 2.0;

/// What a search is to find besides the settings with the least J.
#[derive(Clone, Copy)]
struct Wanted {
    /// Others that pass, where those fail.
    passing: bool,
    /// What each effect of the model does.
    ablations: bool,
    /// J to within the accuracy, even where it is far from passing.
    failing: bool,
}

impl Wanted {
    const ALL: Self = Self {
        passing: true,
        ablations: true,
        failing: true,
    };
}

fn best_of(scenario: &Scenario, control: &Control, wanted: Wanted) -> Solution {
    let effort = Effort::default();
    let asked = scenario.as_asked();
    let searched = asked.as_searched();
    let (mut descent, mut figures) = rayon::join(
        || Descent::run(&searched, Sampler::new(&searched), &effort, control),
        || Figures::new(&asked, control, &effort),
    );
    let mut answers = figures.all(&descent.searches);
    let mut agreements = vec![None; answers.len()];
    let leader = descent.leading();
    // Where the least J fails, finalists of the search for what passes are asked instead.
    agreements[leader] = Some(match answers[leader].passes() {
        true => descent.confirmed(leader),
        false => descent.agreement(leader),
    });
    let mut searches = descent.best();
    answers = figures.renewed(answers, &mut searches);
    let problem = &asked.problem;
    let (mut sampler, mut shots) = (descent.sampler.clone(), descent.shots);
    let still_open = |sampler: &Sampler, searches: &[Search], answers: &[Answer], shots| {
        let mut open = not_converged(searches, answers, problem, shots, control.validation_shots);
        // Many settings fit themselves to the shots: where these are few, J on others has to be the same.
        let leader = leading(searches);
        if open.is_empty()
            && shots < control.validation_shots
            && searches[leader].dimensions() >= MANY
            && !is_near_best(&searches[leader], problem)
            && !sampler.is_precise(searches, shots, &effort)
        {
            open.push(leader);
        }
        open
    };
    let mut open = still_open(&sampler, &searches, &answers, shots);
    for number in 0.. {
        let is_futile =
            !wanted.failing && answers[leading(&searches)].largest_violation() > HOPELESS;
        let is_spent = shots * RISE > control.most_shots;
        if open.is_empty() || is_spent || is_futile || control.is_stopped() {
            break;
        }
        shots *= RISE;
        sampler.adapt(&searches, &effort, control);
        let samples = sampler.draw_anew(number, shots);
        let evaluator = sampler.evaluator(&searched, &samples, &effort, control);
        refine_in_turn(&mut searches, &open, &evaluator, &Stage::beyond(shots));
        tell(control, &effort, &searches);
        answers = figures.renewed(answers, &mut searches);
        open = still_open(&sampler, &searches, &answers, shots);
    }
    let sought = Sought {
        asked: &asked,
        searched: &searched,
        effort: &effort,
        control,
    };
    if wanted.passing {
        sought.passing(&mut answers, &mut agreements, &mut figures);
    }
    let ablations = if control.is_stopped() || !wanted.ablations {
        Vec::new()
    } else {
        let importance = sampler.importance();
        ablation::measure(scenario, &asked, importance, &searches, &effort, control)
    };
    let agreement = agreement_on_best(&answers, &agreements, problem)
        .unwrap_or_else(|contact| descent.confirmed(contact));
    let best = tie::best(&answers);
    // Of what was searched for because the least J fails, its own finalists have told.
    let has_least = answers[best].least_objective.is_none();
    let still_gains = has_least && still_gains(&searches[best], problem);
    let answers = ranked(answers, problem);
    let status = match answers.first() {
        _ if control.is_stopped() => Status::Interrupted,
        Some(best) if best.evaluation.is_none() => Status::NoFeasiblePose,
        Some(best)
            if open.is_empty()
                && agreement.is_reached
                && !still_gains
                && best.violation_is_known(problem.accuracy) =>
        {
            Status::Converged
        }
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

/// How far the finalists agree of the contact with the best answer, or of one that ties with it; else the contact
/// whose finalists have to be asked.
fn agreement_on_best(
    answers: &[Answer],
    agreements: &[Option<Agreement>],
    problem: &Problem,
) -> Result<Agreement, usize> {
    let best = tie::best(answers);
    let of_best = agreements[best];
    let pairs = answers.iter().zip(agreements);
    let mut tied = pairs.filter(|(answer, _)| tie::tie_with(&answers[best], answer, problem));
    of_best
        .or_else(|| tied.find_map(|(_, agreement)| *agreement))
        .ok_or(best)
}
