//! The search for the best settings.
//!
//! J over the settings is a flat valley that ends at a cliff, or a needle in a plateau, with a jump
//! wherever one shot changes surface. So: screen widely with few shots, go down from the best few
//! places with Nelder-Mead, raise the number of shots as the candidates get better, decide between
//! candidates on common shots, and report the winner on shots that the search has not seen. The
//! speed is not searched: its best value follows exactly from the traced paths wherever restitution
//! does not depend on it.

mod judge;
mod polish;
mod space;
mod window;

pub use judge::{Effort, Standing, clearance_violation, speed_scales_out};
pub use window::{Drift, Turn, Window, passing_windows, windows};

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::evaluate::{Evaluation, evaluate};
use crate::jet::{Replicates, Samples, Stream};
use crate::problem::setting::Choice;
use crate::setup::Setup;
use crate::verdict::Verdict;
use judge::Judge;
use polish::{Candidate, polish};
use space::Space;

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The accuracy asked for was reached.
    Converged,
    /// The budget was spent before.
    BudgetSpent,
    /// The nozzle collides with the part at every pose that was tried.
    NoFeasiblePose,
    /// It was told to stop.
    Interrupted,
}

/// What a search may spend, and how it is watched.
pub struct Control<'a> {
    /// Most shots at a pose.
    pub most_shots: usize,
    /// Fresh shots for the reported figures.
    pub fresh_shots: usize,
    /// Set to end the search with the best answer so far.
    pub stop: &'a AtomicBool,
    /// Told about progress; called from any thread.
    pub watch: &'a (dyn Fn(Progress) + Sync),
}

static NEVER: AtomicBool = AtomicBool::new(false);

impl Default for Control<'_> {
    fn default() -> Self {
        Self {
            most_shots: 1 << 18,
            fresh_shots: 1 << 16,
            stop: &NEVER,
            watch: &|_| (),
        }
    }
}

/// How far a search is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Poses judged so far.
    pub poses: usize,
    /// Least J so far, on the shots of the search.
    pub best: Option<f64>,
}

/// The answer of a search.
#[derive(Clone, Debug)]
pub struct Solution {
    /// How it ended.
    pub status: Status,
    /// The best settings for each contact, best first.
    pub answers: Vec<Answer>,
    /// Work done.
    pub poses: usize,
    /// Shots at each pose in the last stage.
    pub shots_per_pose: usize,
    /// Rays cast.
    pub rays: usize,
}

/// The best settings found for one contact.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The settings.
    pub choice: Choice,
    /// What they do, on fresh shots; `None` when the nozzle does not fit.
    pub evaluation: Option<Evaluation>,
    /// Verdicts on that.
    pub verdicts: Vec<Verdict>,
    /// By how much the clearance is violated, m; 0 when it is kept.
    pub violation: f64,
}

/// A stage of the search: shots at a pose, candidates that go on for each contact, first simplex.
struct Stage {
    shots: usize,
    candidates: usize,
    size: f64,
}

const STAGES: [Stage; 4] = [
    Stage {
        shots: 256,
        candidates: 6,
        size: 0.4,
    },
    Stage {
        shots: 1024,
        candidates: 3,
        size: 0.2,
    },
    Stage {
        shots: 4096,
        candidates: 2,
        size: 0.08,
    },
    Stage {
        shots: 16384,
        candidates: 1,
        size: 0.03,
    },
];

const SCREENING_SHOTS: usize = 64;

/// By how much the shots rise when the last stage was not accurate enough.
const RISE: usize = 4;

/// A descent ends when J differs by less than this share of the accuracy over its simplex. Along the
/// flat valley a looser end stops far from the best place.
const SETTLED: f64 = 0.01;

/// What the shots behind reported figures are drawn for.
pub const ANSWERS: u32 = 0;

/// Finds the best settings of a problem.
pub fn solve(setup: &Setup, control: &Control) -> Solution {
    let effort = Effort::default();
    let contacts = &setup.problem.settings.contact;
    let mut samples = Samples::with_rim(
        &setup.problem,
        Stream::Search,
        FIRST_SHOTS.min(control.most_shots),
    );
    let is_stopped = || control.stop.load(Ordering::Relaxed);
    let mut searches: Vec<Search> = contacts
        .par_iter()
        .map(|&contact| {
            Search::screen(
                setup,
                contact,
                &Judge::new(
                    setup,
                    &samples.deviates[..SCREENING_SHOTS],
                    &effort,
                    control.stop,
                ),
            )
        })
        .collect();
    let tell = |searches: &[Search]| {
        let best = least_objective(searches);
        (control.watch)(Progress {
            poses: effort.poses(),
            best: best.is_finite().then_some(best),
        });
    };
    let mut shots = SCREENING_SHOTS;
    for stage in STAGES
        .iter()
        .filter(|stage| stage.shots <= control.most_shots)
    {
        shots = stage.shots;
        let judge = Judge::new(setup, &samples.deviates[..shots], &effort, control.stop);
        let least = least_objective(&searches);
        searches
            .par_iter_mut()
            .filter(|search| shots <= CHEAP_SHOTS || search.is_in_reach(least))
            .for_each(|search| search.refine(&judge, stage, setup.problem.accuracy));
        tell(&searches);
    }
    let fresh = Replicates::new(&setup.problem, ANSWERS, control.fresh_shots);
    let report = |search: &Search| answer(setup, search.best(), &fresh, &effort);
    let mut answers: Vec<Answer> = searches.iter().map(report).collect();
    loop {
        let open = unsettled(&searches, &answers, setup.problem.accuracy);
        if open.is_empty() || shots * RISE > control.most_shots || is_stopped() {
            break;
        }
        shots *= RISE;
        samples = Samples::with_rim(&setup.problem, Stream::Search, shots);
        let stage = Stage {
            shots,
            candidates: 1,
            size: 0.03,
        };
        for index in open {
            let judge = Judge::new(setup, &samples.deviates, &effort, control.stop);
            searches[index].refine(&judge, &stage, setup.problem.accuracy);
            answers[index] = report(&searches[index]);
            tell(&searches);
        }
    }
    let settled = unsettled(&searches, &answers, setup.problem.accuracy).is_empty();
    answers.sort_by(|a, b| a.order().total_cmp(&b.order()));
    let status = match answers.first() {
        _ if is_stopped() => Status::Interrupted,
        Some(best) if best.evaluation.is_none() => Status::NoFeasiblePose,
        Some(_) if settled => Status::Converged,
        _ => Status::BudgetSpent,
    };
    Solution {
        status,
        answers,
        poses: effort.poses(),
        shots_per_pose: shots,
        rays: effort.rays(),
    }
}

/// Shots that every search draws.
const FIRST_SHOTS: usize = STAGES[STAGES.len() - 1].shots;

/// Least J over all contacts; infinite while the nozzle has fitted nowhere.
fn least_objective(searches: &[Search]) -> f64 {
    let objectives = searches
        .iter()
        .filter_map(|search| search.best().standing.objective());
    objectives.fold(f64::INFINITY, f64::min)
}

/// The searches that could still change the answer: among the contacts within reach of the best,
/// those whose J on fresh shots is above J on the shots of the search by more than the accuracy
/// asked for and the statistical error.
///
/// The least J on any set of shots is on average below the least true J, and the true J of the
/// settings found is above it. So the gap between the two bounds how far these settings are from
/// the best ones.
fn unsettled(searches: &[Search], answers: &[Answer], accuracy: f64) -> Vec<usize> {
    let fresh = |answer: &Answer| {
        Some((
            answer.evaluation.as_ref()?.terms.total(),
            answer.standard_error(),
        ))
    };
    let least = answers
        .iter()
        .filter_map(|answer| Some(fresh(answer)?.0))
        .fold(f64::INFINITY, f64::min);
    let is_unsettled = |search: &Search, answer: &Answer| {
        let (claimed, (found, error)) = search.best().standing.objective().zip(fresh(answer))?;
        let in_reach = found - CONFIDENCE * error <= least * (1.0 + IN_REACH);
        let gap = found - claimed;
        Some(in_reach && gap > accuracy * found + CONFIDENCE * error)
    };
    let pairs = searches.iter().zip(answers).enumerate();
    pairs
        .filter(|(_, (search, answer))| is_unsettled(search, answer).unwrap_or(false))
        .map(|(index, _)| index)
        .collect()
}

/// Standard errors that a difference must exceed to count.
const CONFIDENCE: f64 = 2.0;
/// A contact whose J is above the best by more than this share cannot become the best.
const IN_REACH: f64 = 0.25;
/// Up to so many shots every contact is worth its refinement.
const CHEAP_SHOTS: usize = 4096;

impl Answer {
    fn order(&self) -> f64 {
        match &self.evaluation {
            Some(evaluation) => Standing::Feasible(evaluation.terms).rank(),
            None => Standing::Blocked(self.violation).rank(),
        }
    }

    fn standard_error(&self) -> f64 {
        self.evaluation
            .as_ref()
            .map_or(0.0, |evaluation| evaluation.standard_error)
    }

    /// Whether the nozzle fits and every verdict passes.
    pub fn passes(&self) -> bool {
        self.violation <= 0.0
            && self.evaluation.is_some()
            && self.verdicts.iter().all(Verdict::passes)
    }
}

/// The reported figures of a candidate, on shots that the search has not seen.
fn answer(setup: &Setup, candidate: &Candidate, fresh: &Replicates, effort: &Effort) -> Answer {
    let choice = candidate.choice;
    match candidate.standing {
        Standing::Blocked(violation) => Answer {
            choice,
            evaluation: None,
            verdicts: Vec::new(),
            violation,
        },
        Standing::Feasible(_) => {
            let evaluation = evaluate(setup, &choice, fresh);
            effort.add(1, evaluation.rays);
            Answer {
                choice,
                verdicts: Verdict::all(setup, &evaluation),
                evaluation: Some(evaluation),
                violation: 0.0,
            }
        }
    }
}

/// The search for one contact.
struct Search {
    space: Space,
    /// Best first.
    candidates: Vec<Candidate>,
}

impl Search {
    /// Judges a low-discrepancy set of points all over the space.
    fn screen(setup: &Setup, contact: usize, judge: &Judge) -> Self {
        let space = Space::new(&setup.problem, contact, !speed_scales_out(setup, contact));
        let dimensions = space.dimensions();
        let points = match dimensions {
            0 => 1,
            1 => 32,
            2 => 96,
            3 => 192,
            _ => 128 * dimensions,
        };
        let seed = setup.problem.seed as u32;
        let candidates = (0..points as u32)
            .into_par_iter()
            .map(|index| {
                let coordinate = |axis| f64::from(sobol_burley::sample(index, axis as u32, seed));
                let point: Vec<f64> = (0..dimensions).map(coordinate).collect();
                Candidate::at(&space, judge, &point)
            })
            .collect();
        let mut search = Self { space, candidates };
        search.sort();
        search
    }

    fn best(&self) -> &Candidate {
        &self.candidates[0]
    }

    /// Whether this contact could still become the best.
    fn is_in_reach(&self, least: f64) -> bool {
        let objective = self.best().standing.objective();
        objective.is_none_or(|objective| objective <= least * (1.0 + IN_REACH))
    }

    fn sort(&mut self) {
        self.candidates
            .sort_by(|a, b| a.standing.rank().total_cmp(&b.standing.rank()));
    }

    /// Goes on from the best few candidates with more shots.
    fn refine(&mut self, judge: &Judge, stage: &Stage, accuracy: f64) {
        let space = &self.space;
        let mut starts: Vec<Candidate> = Vec::new();
        for candidate in &self.candidates {
            let is_new = |other: &Candidate| {
                space.distance(&candidate.point, &other.point) > 0.2 * stage.size
            };
            if starts.len() < stage.candidates && starts.iter().all(is_new) {
                starts.push(candidate.clone());
            }
        }
        self.candidates = starts
            .into_par_iter()
            .map(|start| {
                let start = Candidate::at(space, judge, &start.point);
                if space.dimensions() == 0 {
                    return start;
                }
                polish(space, judge, start, stage.size, SETTLED * accuracy)
            })
            .collect();
        self.sort();
    }
}
