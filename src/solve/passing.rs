//! The search for settings that pass, where those with the least J do not.
//!
//! Weights that nobody can know decide whether the least J passes. So where it does not, the search goes on with what
//! violations beyond the allowed shares cost added to J: an exact penalty, so steep that what passes wins, and among
//! that J.

use super::answer::Answer;
use super::descent::Descent;
use super::evaluator::Effort;
use super::figures::Figures;
use super::finalists::Agreement;
use super::sampler::Sampler;
use super::stage::Stage;
use super::stopping_rule::{least_found, still_gains};
use super::{RISE, tie};
use crate::control::Control;
use crate::scenario::{Scenario, Station};

/// What violations cost in a search.
#[derive(Clone)]
pub(super) struct Penalty {
    /// J that a violation of 2, twice the share that is allowed, costs.
    pub price: f64,
    /// Share of what is allowed that the search allows.
    pub slack: f64,
    /// Stations of a stroke at which nothing may be violated either.
    pub watched: Vec<Station>,
}

impl Penalty {
    /// All that it depends on, for checkpoints.
    pub fn numbers(&self) -> Vec<f64> {
        let watched = self.watched.iter().map(|station| station.place);
        [self.price, self.slack]
            .into_iter()
            .chain(watched)
            .collect()
    }
}

/// The search for what passes, of a problem as it is asked and as it is searched.
pub(super) struct Sought<'a> {
    pub asked: &'a Scenario,
    pub searched: &'a Scenario,
    pub effort: &'a Effort,
    pub control: &'a Control,
}

impl Sought<'_> {
    /// Searches again for the contacts whose answers fail and could be recommended if they passed. Of the best answer,
    /// where it was found here, it is asked how far the finalists agree.
    pub fn passing(
        &self,
        answers: &mut [Answer],
        agreements: &mut [Option<Agreement>],
        figures: &mut Figures,
    ) {
        let (mut slack, mut price) = (1.0, PRICE);
        let first = self.searched.ends_and_middle().into_iter();
        let mut watched: Vec<Station> = first.map(|it| self.searched.station(it)).collect();
        for _ in 0..self.most_rounds() {
            let failing = worthwhile(answers, self.asked);
            if failing.is_empty() || self.control.is_stopped() {
                break;
            }
            let is_new = self.watch_worst(&failing, answers, &mut watched);
            let penalty = Penalty {
                price: price * scale(answers, &failing),
                slack,
                watched: watched.clone(),
            };
            let Round { worst, passed } =
                self.round(&failing, penalty, answers, agreements, figures);
            let unseen = self.watch_worst(&failing, answers, &mut watched);
            if worst <= 1.0 || (worst > NEAR && !unseen && !is_new) {
                break;
            }
            // Near misses pass with a little more room, or where violations outweigh what they gain in J.
            match passed {
                _ if worst > NEAR || unseen => {}
                true => slack *= ROOM / worst,
                false => price *= DEARER,
            }
        }
    }

    /// A stroke may need to watch more and more stations.
    fn most_rounds(&self) -> usize {
        match self.searched.stations.is_empty() {
            true => MOST_ROUNDS,
            false => 2 * MOST_ROUNDS,
        }
    }

    /// Watches the stations as well at which answers fail most; whether there are any new ones.
    fn watch_worst(
        &self,
        failing: &[usize],
        answers: &[Answer],
        watched: &mut Vec<Station>,
    ) -> bool {
        let before = watched.len();
        let verdicts = failing.iter().flat_map(|&index| &answers[index].verdicts);
        let places = verdicts
            .filter(|verdict| !verdict.passes())
            .filter_map(|verdict| verdict.place);
        for place in places {
            if watched.iter().all(|station| station.place != place) {
                watched.push(self.searched.station(place));
            }
        }
        watched.sort_by(|a, b| a.place.total_cmp(&b.place));
        watched.len() > before
    }

    /// One search.
    fn round(
        &self,
        failing: &[usize],
        penalty: Penalty,
        answers: &mut [Answer],
        agreements: &mut [Option<Agreement>],
        figures: &mut Figures,
    ) -> Round {
        let (effort, control) = (self.effort, self.control);
        let mut scenario = self.searched.clone();
        let contacts = failing.iter().map(|&index| answers[index].settings.contact);
        scenario.problem.ranges.contact = contacts.collect();
        let sampler = Sampler::penalised(&scenario, penalty);
        let mut descent = Descent::run(&scenario, sampler, effort, control);
        let shots = descent.shots;
        let samples = descent.sampler.draw(shots);
        let evaluator = descent
            .sampler
            .evaluator(&scenario, &samples, effort, control);
        for (search, &index) in descent.searches.iter_mut().zip(failing) {
            search.add(&answers[index].settings, &evaluator, &Stage::beyond(shots));
        }
        let leader = descent.leading();
        let of_leader = descent.confirmed(leader);
        let mut searches = descent.best();
        let passed = searches[leader].best().fitness.penalty() <= 0.0;
        // The fewer the shots, the farther the search stays below what is allowed.
        let more = shots * RISE;
        let mut is_settled = true;
        if passed && more <= control.most_shots {
            let samples = descent.sampler.draw(more);
            let evaluator = descent
                .sampler
                .evaluator(&scenario, &samples, effort, control);
            let stage = Stage {
                descents: DESCENTS,
                ..Stage::beyond(more)
            };
            searches[leader] = descent.searches[leader].clone();
            searches[leader].refine_together(&evaluator, &stage);
            is_settled = !still_gains(&searches[leader], &self.asked.problem);
        }
        let mut new = figures.of(&searches);
        // What is farther down may fail on validation shots where what the stage began with passes.
        if !new[leader].passes()
            && let Some(before) = searches[leader].gone_back()
            && let Some(answer) = figures.of(std::slice::from_ref(&before)).pop()
            && tie::is_better(&answer, &new[leader])
        {
            (new[leader], searches[leader]) = (answer, before);
        }
        let claims = searches.iter().map(|it| it.best().fitness.objective());
        // What is not better than all that pass, by more than the accuracy, is worth no other search.
        let all = answers.iter().chain(&new);
        let least = least_found(all.filter(|it| it.passes()));
        let worthwhile = least * (1.0 - self.asked.problem.accuracy);
        let mut worst = f64::INFINITY;
        // Whether J of what was found here is known.
        let mut known = vec![None; failing.len()];
        for (place, (answer, claimed)) in new.into_iter().zip(claims).enumerate() {
            if answer
                .objective()
                .is_none_or(|objective| objective < worthwhile)
            {
                worst = worst.min(answer.largest_violation());
            }
            let old = &mut answers[failing[place]];
            if tie::is_better(&answer, old) {
                let accuracy = self.asked.problem.accuracy;
                let bound = error_by_bound(old, &answer);
                known[place] = Some(is_known(claimed, &answer, bound, accuracy));
                let least = old.least_objective.or(old.objective());
                *old = Answer {
                    least_objective: least,
                    ..answer
                };
                agreements[failing[place]] = None;
            }
        }
        let best = tie::best(answers);
        let place = failing.iter().position(|&index| index == best);
        if let Some((place, is_known)) = place.and_then(|it| Some((it, known[it]?))) {
            let found = match place == leader {
                true => Agreement {
                    is_reached: of_leader.is_reached && is_settled,
                    ..of_leader
                },
                false => descent.confirmed(place),
            };
            agreements[best] = Some(Agreement {
                is_reached: found.is_reached && is_known,
                ..found
            });
        }
        Round { worst, passed }
    }
}

/// What a search has found.
struct Round {
    /// The least violation of the answers that are worth another search; infinite without any.
    worst: f64,
    /// Whether its best candidate passes on its own shots.
    passed: bool,
}

/// What J is measured by.
fn scale(answers: &[Answer], which: &[usize]) -> f64 {
    let least = least_found(which.iter().map(|&index| &answers[index]));
    if least > 0.0 { least } else { 1.0 }
}

/// Whether J on the shots of the search is J on validation shots, within the accuracy, and so is what J owes to the
/// error of the bound that it stays below.
fn is_known(claimed: Option<f64>, answer: &Answer, bound: f64, accuracy: f64) -> bool {
    let (Some(claimed), Some(found)) = (claimed, answer.objective()) else {
        return false;
    };
    bound <= accuracy * found && found - claimed <= accuracy * found + answer.standard_error()
}

/// What J of an answer that passes owes to the error of the share that bounds it: as much as J costs by that share
/// between it and what fails.
fn error_by_bound(failing: &Answer, passing: &Answer) -> f64 {
    let (Some(least), Some(found)) = (failing.objective(), passing.objective()) else {
        return 0.0;
    };
    let violation = passing.largest_violation();
    let gap = failing.largest_violation() - violation;
    if failing.passes() || gap <= 0.0 {
        return 0.0;
    }
    (found - least).max(0.0) / gap * violation * passing.error_of_violation()
}

/// The answers that fail, as far as they could be recommended if they passed: their J is below that of what passes.
fn worthwhile(answers: &[Answer], scenario: &Scenario) -> Vec<usize> {
    let least = least_found(answers.iter().filter(|answer| answer.passes()));
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
const MOST_ROUNDS: usize = 3;
/// Descents of the last stage: where several shares are used up at once J has a kink, in which a simplex shrinks early.
const DESCENTS: usize = 2;
/// The price of a violation, in the J of the answers that fail.
const PRICE: f64 = 100.0;
/// Factor on it where a violation is worth it.
const DEARER: f64 = 30.0;
/// A violation up to this is near.
const NEAR: f64 = 1.5;
/// What is left of the allowed share for the next search.
const ROOM: f64 = 0.95;
