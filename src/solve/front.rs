//! The trade-off between target error, tangential risk and rebound: answers of which none is better
//! than another in everything.
//!
//! The search is run with many weightings of the three, from the one extreme to the other, and every
//! pose that it evaluates on the way is kept. What is not dominated among these, spread over the whole
//! front, is evaluated on validation shots; what stays apart by more than its standard error is reported.

use rayon::prelude::*;

use super::answer::Answer;
use super::descent::SCREENING_SHOTS;
use super::evaluator::{Effort, Evaluator};
use super::objectives::{Objectives, objectives};
use super::pareto_archive::{Evaluated, ParetoArchive, dominates, not_dominated, spread_out};
use super::search::Search;
use super::stage::STAGES;
use crate::control::{Control, Progress};
use crate::elementary::hypot;
use crate::evaluate::evaluate_adaptively;
use crate::jet::{Samples, Stream, ValidationSample, purpose};
use crate::scenario::Scenario;

/// What can be had.
#[derive(Clone, Debug)]
pub struct Front {
    /// From the least target error on.
    pub answers: Vec<Answer>,
    /// Which of them is the recommended one; `None` where the nozzle fits nowhere.
    pub recommended: Option<usize>,
    /// Poses evaluated.
    pub poses: usize,
    /// Rays cast.
    pub rays: usize,
}

/// Most answers besides the recommended ones that are evaluated on validation shots.
const MOST_EVALUATED: usize = 32;
/// Most answers of a front.
const MOST_SHOWN: usize = 12;
/// Standard errors beyond which two risks differ.
const CONFIDENCE: f64 = 2.0;

/// The front round answers that a search has found, the recommended one first.
pub fn front(scenario: &Scenario, found: &[Answer], control: &Control) -> Front {
    let effort = Effort::default();
    let archive = ParetoArchive::default();
    let contacts = &scenario.problem.ranges.contact;
    let runs: Vec<(Objectives, usize)> = weightings(scenario)
        .into_iter()
        .flat_map(|weights| contacts.iter().map(move |&contact| (weights, contact)))
        .collect();
    let samples = Samples::with_boundary(&scenario.problem, Stream::Search, STAGES[2].shots);
    runs.par_iter().for_each(|&(weights, contact)| {
        search(
            scenario, weights, contact, &samples, &archive, &effort, control,
        );
    });
    let evaluated = spread_out(not_dominated(archive.into_sorted()), MOST_EVALUATED);
    let validation = ValidationSample::new(
        &scenario.problem,
        purpose::ANSWERS,
        control.validation_shots,
    );
    let answer = |evaluated: &Evaluated| {
        if control.is_stopped() {
            return None;
        }
        let evaluation = evaluate_adaptively(scenario, &evaluated.settings, &validation);
        Some(Answer::feasible(
            scenario,
            &evaluated.settings,
            evaluation,
            &effort,
        ))
    };
    let evaluated: Vec<Answer> = evaluated.par_iter().filter_map(answer).collect();
    let all = found.iter().chain(&evaluated).filter_map(Measured::of);
    let all: Vec<Measured> = all.collect();
    let mut kept = apart(&all);
    kept.sort_by(|a, b| a.objectives[0].total_cmp(&b.objectives[0]));
    let recommended = found.first().filter(|first| first.evaluation.is_some());
    let is_recommended =
        |it: &&Measured| recommended.is_some_and(|first| std::ptr::eq(it.answer, first));
    Front {
        recommended: kept.iter().position(is_recommended),
        answers: kept.iter().map(|it| it.answer.clone()).collect(),
        poses: effort.poses(),
        rays: effort.rays(),
    }
}

/// Factors on the three risks, each weighting once: all alike, each one nearly alone, and between.
fn weightings(scenario: &Scenario) -> Vec<Objectives> {
    let goals = &scenario.problem.goals;
    let is_open = [
        true,
        goals
            .tangential_impulse
            .is_some_and(|goal| goal.weight > 0.0),
        scenario
            .surfaces
            .iter()
            .any(|limits| limits.allow.is_some() && limits.weight > 0.0),
    ];
    let levels = |risk: usize| match (is_open[risk], is_open == [true; 3]) {
        (false, _) => vec![1.0],
        (true, true) => vec![1e-3, 0.03, 1.0, 30.0, 1e3],
        (true, false) => vec![1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e3],
    };
    let between = levels(1).into_iter().flat_map(|tangential| {
        let rebounds = levels(2).into_iter();
        rebounds.map(move |rebound| [1.0, tangential, rebound])
    });
    let alone = (0..3).filter(|&risk| is_open[risk]).map(|risk| {
        // The others still decide between what is equal.
        let mut weights = [ALMOST_NOTHING; 3];
        weights[risk] = 1.0;
        weights
    });
    between.chain(alone).collect()
}

const ALMOST_NOTHING: f64 = 1e-6;

/// The problem with factors on its weights.
fn weighted(scenario: &Scenario, [target, tangential, rebound]: Objectives) -> Scenario {
    let mut weighted = scenario.clone();
    let goals = &mut weighted.problem.goals;
    goals.normal_impulse.weight *= target;
    goals.miss.weight *= target;
    if let Some(goal) = &mut goals.tangential_impulse {
        goal.weight *= tangential;
    }
    for limits in &mut weighted.surfaces {
        limits.weight *= rebound;
    }
    weighted
}

/// One search with factors on the weights; what it evaluates in its last stage goes to the archive.
fn search(
    scenario: &Scenario,
    weights: Objectives,
    contact: usize,
    samples: &Samples,
    archive: &ParetoArchive,
    effort: &Effort,
    control: &Control,
) {
    let weighted = weighted(scenario, weights);
    let evaluator = |shots: usize| {
        let shots = shots.min(samples.shots.len());
        Evaluator::new(&weighted, &samples.shots[..shots], effort, control)
    };
    if control.is_stopped() {
        return;
    }
    let mut search = Search::screen(&weighted, contact, &evaluator(SCREENING_SHOTS));
    search.refine(&evaluator(STAGES[1].shots), &STAGES[1]);
    let last = evaluator(STAGES[2].shots).keeping(archive, weights);
    search.refine(&last, &STAGES[2]);
    control.tell(Progress::Search {
        poses: effort.poses(),
        best: None,
    });
}

/// An answer with its risks and their standard errors.
struct Measured<'a> {
    answer: &'a Answer,
    objectives: Objectives,
    errors: Objectives,
    total: f64,
}

impl<'a> Measured<'a> {
    fn of(answer: &'a Answer) -> Option<Self> {
        let evaluation = answer.evaluation.as_ref()?;
        let errors = &evaluation.term_errors;
        Some(Self {
            answer,
            objectives: objectives(&evaluation.terms),
            errors: [
                hypot(errors.normal_impulse, errors.miss),
                errors.tangential_impulse,
                errors.rebound,
            ],
            total: evaluation.terms.total(),
        })
    }

    /// Whether it is better than another in something by more than the errors.
    fn beats_somewhere(&self, other: &Self) -> bool {
        (0..3).any(|risk| {
            let error = hypot(self.errors[risk], other.errors[risk]);
            let rounding = 1e-9 * (self.objectives[risk] + other.objectives[risk]);
            self.objectives[risk] < other.objectives[risk] - (CONFIDENCE * error).max(rounding)
        })
    }
}

/// Answers that differ from each other by more than their errors, the recommended one (which comes
/// first) among them, and none of which another one dominates.
fn apart<'a, 'b>(all: &'b [Measured<'a>]) -> Vec<&'b Measured<'a>> {
    let Some((recommended, others)) = all.split_first() else {
        return Vec::new();
    };
    let least = |risk: usize| {
        let by_risk = |a: &&Measured, b: &&Measured| {
            let order = a.objectives[risk].total_cmp(&b.objectives[risk]);
            order.then(a.total.total_cmp(&b.total))
        };
        others.iter().min_by(by_risk)
    };
    let ends = (0..3).filter_map(least);
    // Whoever chooses wants to see what passes.
    let (passing, failing): (Vec<&Measured>, Vec<&Measured>) =
        others.iter().partition(|it| it.answer.passes());
    let mut kept = vec![recommended];
    for candidate in ends.chain(passing).chain(failing) {
        let is_new = kept.iter().all(|other| candidate.beats_somewhere(other));
        if is_new && kept.len() < MOST_SHOWN {
            kept.push(candidate);
        }
    }
    let stays = |index: usize| {
        let others = kept.iter().enumerate().filter(|(other, _)| *other != index);
        let mut others = others.map(|(_, other)| other);
        index == 0
            || others.all(|other| {
                !(dominates(&other.objectives, &kept[index].objectives)
                    && other.beats_somewhere(kept[index]))
            })
    };
    (0..kept.len())
        .filter(|&index| stays(index))
        .map(|index| kept[index])
        .collect()
}
