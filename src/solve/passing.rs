//! The search for settings that pass, where those with the least J do not.
//!
//! Weights that nobody can know decide whether the least J passes. So where it does not, the search goes on with what
//! violations beyond the allowed shares cost added to J: an exact penalty, so steep that what passes wins, and among
//! that J.

mod correction;
mod penalty;
mod round;

pub(super) use penalty::Penalty;

use super::answer::Answer;
use super::evaluator::Effort;
use super::figures::Figures;
use super::finalists::Agreement;
use super::stopping_rule::least_found;
use crate::control::Control;
use crate::scenario::{Scenario, Station};
use round::Round;

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
        let (mut without_news, mut nearest) = (0, f64::INFINITY);
        for _ in 0..MOST_ROUNDS {
            let failing = worthwhile(answers, self.asked);
            if failing.is_empty() || self.control.is_stopped() {
                break;
            }
            let is_new = self.watch_worst(&failing, answers, &mut watched);
            let penalty = Penalty {
                price: price * scale(answers, &failing),
                slack,
                watched: watched.clone(),
                corrections: Vec::new(),
            };
            let scenario = self.with_contacts_of(&failing, answers);
            let round = Round::run(self, &scenario, &failing, answers, penalty);
            let passed = round.passes();
            let worst = round.hand_over(answers, agreements, figures);
            let unseen = self.watch_worst(&failing, answers, &mut watched);
            if worst <= 1.0 || (worst > NEAR && !unseen && !is_new) {
                break;
            }
            // Near misses pass with a little more room, or where violations outweigh what they gain in J.
            without_news += usize::from(!unseen);
            let is_nearer = worst < nearest * (1.0 - self.asked.problem.accuracy);
            let is_in_vain = !unseen && !passed && !is_nearer;
            if is_in_vain || without_news == MOST_WITHOUT_NEWS {
                break;
            }
            nearest = nearest.min(worst);
            match passed {
                _ if worst > NEAR || unseen => {}
                true => slack *= ROOM / worst,
                false => price *= DEARER,
            }
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

    /// The problem with the contacts of some answers alone.
    fn with_contacts_of(&self, which: &[usize], answers: &[Answer]) -> Scenario {
        let mut scenario = self.searched.clone();
        let contacts = which.iter().map(|&index| answers[index].settings.contact);
        scenario.problem.ranges.contact = contacts.collect();
        scenario
    }
}

/// What J is measured by.
fn scale(answers: &[Answer], which: &[usize]) -> f64 {
    let least = least_found(which.iter().map(|&index| &answers[index]));
    if least > 0.0 { least } else { 1.0 }
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

/// Searches at most: a stroke may need to watch more and more stations.
const MOST_ROUNDS: usize = 6;
/// Searches at most after which no other station fails most.
const MOST_WITHOUT_NEWS: usize = 3;
/// The price of a violation, in the J of the answers that fail.
const PRICE: f64 = 100.0;
/// Factor on it where a violation is worth it.
const DEARER: f64 = 30.0;
/// A violation up to this is near.
const NEAR: f64 = 1.5;
/// What is left of the allowed share for the next search.
const ROOM: f64 = 0.95;
