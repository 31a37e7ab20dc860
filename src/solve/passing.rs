//! The search for settings that pass, where those with the least J do not.
//!
//! Weights that nobody can know decide whether the least J passes. So where it does not, the search goes on with what
//! violations beyond the allowed shares cost added to J: an exact penalty, so steep that what passes wins, and among
//! that J.

use super::answer::Answer;
use super::descend;
use super::evaluator::Effort;
use super::figures::Figures;
use super::finalists::{Agreement, confirmed};
use super::sampler::Sampler;
use super::search::Search;
use super::stage::Stage;
use super::{RISE, leading, tie};
use crate::control::Control;
use crate::scenario::Scenario;

/// What violations cost in a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Penalty {
    /// J that a violation of 2, twice the share that is allowed, costs.
    pub price: f64,
    /// Share of what is allowed that the search allows.
    pub slack: f64,
}

/// Searches again for the contacts whose answers fail and could be recommended if they passed; returns how far the
/// finalists of the leading one agree, where there was something to search.
pub(super) fn sought(
    answers: &mut [Answer],
    (asked, searched): (&Scenario, &Scenario),
    figures: &mut Figures,
    effort: &Effort,
    control: &Control,
) -> Option<Agreement> {
    let mut agreement = None;
    let mut slack = 1.0;
    for _ in 0..MOST_ROUNDS {
        let failing = worthwhile(answers, asked);
        if failing.is_empty() || control.is_stopped() {
            break;
        }
        let least = failing
            .iter()
            .filter_map(|&index| answers[index].objective());
        let scale = least.fold(f64::INFINITY, f64::min);
        let scale = if scale > 0.0 { scale } else { 1.0 };
        let penalty = Penalty {
            price: PRICE * scale,
            slack,
        };
        let mut scenario = searched.clone();
        let contacts = failing.iter().map(|&index| answers[index].settings.contact);
        scenario.problem.ranges.contact = contacts.collect();
        let mut sampler = Sampler::of_the_jet(&scenario, penalty);
        let (mut searches, shots) = descend(&scenario, &mut sampler, control, effort);
        let samples = sampler.draw(shots);
        let evaluator = sampler.evaluator(&scenario, &samples, effort, control);
        for (search, &index) in searches.iter_mut().zip(&failing) {
            search.add(&answers[index].settings, &evaluator, &Stage::beyond(shots));
        }
        let leader = leading(&searches);
        let found = confirmed(
            &mut searches[leader],
            &scenario,
            &sampler,
            shots,
            effort,
            control,
        );
        searches.iter_mut().for_each(Search::keep_best);
        // The fewer the shots, the farther the search stays below what is allowed.
        let more = shots * RISE;
        if searches[leader].best().fitness.penalty() <= 0.0 && more <= control.most_shots {
            let samples = sampler.draw(more);
            let evaluator = sampler.evaluator(&scenario, &samples, effort, control);
            searches[leader].refine(&evaluator, &Stage::beyond(more));
        }
        let new = figures.of_searches(&searches);
        let mut worst = f64::INFINITY;
        let claims = searches
            .iter()
            .map(|search| search.best().fitness.objective());
        for ((answer, claimed), &index) in new.into_iter().zip(claims).zip(&failing) {
            worst = worst.min(answer.largest_violation());
            let old = &mut answers[index];
            if tie::is_better(&answer, old) {
                let is_known = is_known(claimed, &answer, asked.problem.accuracy);
                let least = old.least_objective.or(old.objective());
                *old = Answer {
                    least_objective: least,
                    ..answer
                };
                agreement = Some(Agreement {
                    is_reached: found.is_reached && is_known,
                    ..found
                });
            }
        }
        // Near misses pass with a little more room.
        if worst <= 1.0 || worst > NEAR {
            break;
        }
        slack *= ROOM / worst;
    }
    agreement
}

/// Whether J on the shots of the search is J on validation shots, within the accuracy.
fn is_known(claimed: Option<f64>, answer: &Answer, accuracy: f64) -> bool {
    let (Some(claimed), Some(found)) = (claimed, answer.objective()) else {
        return false;
    };
    found - claimed <= accuracy * found + answer.standard_error()
}

/// The answers that fail, as far as they could be recommended if they passed: their J is below that of what passes.
fn worthwhile(answers: &[Answer], scenario: &Scenario) -> Vec<usize> {
    let passing = answers.iter().filter(|answer| answer.passes());
    let least = passing
        .filter_map(Answer::objective)
        .fold(f64::INFINITY, f64::min);
    let has_choice = |answer: &&Answer| {
        let contact = answer.settings.contact;
        scenario.problem.ranges.is_free()
            || !scenario.problem.contacts[contact].static_friction.is_held()
    };
    let could_win = |answer: &&Answer| {
        let objective = answer.objective();
        objective.is_some_and(|objective| objective < least) && !answer.passes()
    };
    let indices = answers.iter().enumerate();
    indices
        .filter(|(_, answer)| could_win(answer) && has_choice(answer))
        .map(|(index, _)| index)
        .collect()
}

/// Searches at most.
const MOST_ROUNDS: usize = 2;
/// The price of a violation, in the J of the answers that fail.
const PRICE: f64 = 100.0;
/// A violation up to this is near.
const NEAR: f64 = 1.5;
/// What is left of the allowed share for the next search.
const ROOM: f64 = 0.95;
