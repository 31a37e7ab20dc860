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

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::evaluate::{Evaluation, evaluate};
use crate::jet::{Samples, Stream};
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
            most_shots: 1 << 14,
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
        size: 0.1,
    },
    Stage {
        shots: 1024,
        candidates: 3,
        size: 0.03,
    },
    Stage {
        shots: 4096,
        candidates: 2,
        size: 0.01,
    },
    Stage {
        shots: 16384,
        candidates: 1,
        size: 0.004,
    },
];

const SCREENING_SHOTS: usize = 64;

/// Finds the best settings of a problem.
pub fn solve(setup: &Setup, control: &Control) -> Solution {
    let effort = Effort::default();
    let most_shots = STAGES
        .iter()
        .map(|stage| stage.shots)
        .max()
        .unwrap_or(SCREENING_SHOTS);
    let samples = Samples::with_rim(
        &setup.problem,
        Stream::Search,
        most_shots.min(control.most_shots),
    );
    let judge = |shots: usize| Judge::new(setup, &samples, shots, &effort, control.stop);
    let contacts = &setup.problem.settings.contact;
    let mut searches: Vec<Search> = contacts
        .par_iter()
        .map(|&contact| Search::screen(setup, contact, &judge(SCREENING_SHOTS)))
        .collect();
    let mut shots_per_pose = SCREENING_SHOTS;
    for stage in STAGES
        .iter()
        .filter(|stage| stage.shots <= control.most_shots)
    {
        shots_per_pose = stage.shots;
        searches
            .par_iter_mut()
            .for_each(|search| search.refine(&judge(stage.shots), stage, setup.problem.accuracy));
        let best = searches
            .iter()
            .filter_map(|search| search.best().standing.objective());
        (control.watch)(Progress {
            poses: effort.poses(),
            best: best.min_by(f64::total_cmp),
        });
    }
    let mut answers: Vec<Answer> = searches
        .iter()
        .map(|search| answer(setup, search.best(), control.fresh_shots, &effort))
        .collect();
    answers.sort_by(|a, b| a.order().total_cmp(&b.order()));
    let stopped = control.stop.load(std::sync::atomic::Ordering::Relaxed);
    let status = match answers.first() {
        _ if stopped => Status::Interrupted,
        Some(best) if best.evaluation.is_some() => Status::Converged,
        _ => Status::NoFeasiblePose,
    };
    Solution {
        status,
        answers,
        poses: effort.poses(),
        shots_per_pose,
        rays: effort.rays(),
    }
}

impl Answer {
    fn order(&self) -> f64 {
        match &self.evaluation {
            Some(evaluation) => Standing::Feasible(evaluation.terms).rank(),
            None => Standing::Blocked(self.violation).rank(),
        }
    }

    /// Whether the nozzle fits and every verdict passes.
    pub fn passes(&self) -> bool {
        self.violation <= 0.0
            && self.evaluation.is_some()
            && self.verdicts.iter().all(Verdict::passes)
    }
}

/// The reported figures of a candidate, on shots that the search has not seen.
fn answer(setup: &Setup, candidate: &Candidate, shots: usize, effort: &Effort) -> Answer {
    let choice = candidate.choice;
    match candidate.standing {
        Standing::Blocked(violation) => Answer {
            choice,
            evaluation: None,
            verdicts: Vec::new(),
            violation,
        },
        Standing::Feasible(_) => {
            let evaluation = evaluate(setup, &choice, shots, 0);
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
                space.distance(&candidate.point, &other.point) > 2.0 * stage.size
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
                polish(space, judge, start, stage.size, 0.1 * accuracy)
            })
            .collect();
        self.sort();
    }
}
