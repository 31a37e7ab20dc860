//! One search for what passes, with what a violation costs in it.

use super::super::answer::Answer;
use super::super::descent::Descent;
use super::super::figures::Figures;
use super::super::finalists::Agreement;
use super::super::sampler::Sampler;
use super::super::search::Search;
use super::super::stage::Stage;
use super::super::stopping_rule::{least_found, still_gains};
use super::super::{RISE, tie};
use super::{Penalty, Sought};
use crate::elementary::ln;
use crate::scenario::Scenario;

/// A search that has ended, for the contacts of some answers.
pub(super) struct Round<'a> {
    sought: &'a Sought<'a>,
    scenario: &'a Scenario,
    /// Indices of the answers.
    which: &'a [usize],
    descent: Descent<'a>,
    /// The search with the best candidate.
    leader: usize,
    /// How far the finalists of that search agree.
    agreement: Agreement,
}

impl<'a> Round<'a> {
    /// Searches all over the space, and from each of the answers.
    pub fn run(
        sought: &'a Sought<'a>,
        scenario: &'a Scenario,
        which: &'a [usize],
        answers: &[Answer],
        penalty: Penalty,
    ) -> Self {
        let (effort, control) = (sought.effort, sought.control);
        let sampler = Sampler::penalised(scenario, penalty);
        let mut descent = Descent::run(scenario, sampler, effort, control);
        let shots = descent.shots;
        let samples = descent.sampler.draw(shots);
        let evaluator = descent
            .sampler
            .evaluator(scenario, &samples, effort, control);
        for (search, &index) in descent.searches.iter_mut().zip(which) {
            search.add(&answers[index].settings, &evaluator, &Stage::beyond(shots));
        }
        let leader = descent.leading();
        let agreement = descent.confirmed(leader);
        Self {
            sought,
            scenario,
            which,
            descent,
            leader,
            agreement,
        }
    }

    /// Whether its best candidate passes on its own shots.
    pub fn passes(&self) -> bool {
        let best = self.descent.searches[self.leader].best();
        best.fitness.penalty() <= 0.0
    }

    /// Replaces the answers that it has something better for. Of the best answer, where it was found here, it is asked
    /// how far the finalists agree. Returns the least violation of what was found and is worth another search;
    /// infinite without any.
    pub fn hand_over(
        mut self,
        answers: &mut [Answer],
        agreements: &mut [Option<Agreement>],
        figures: &mut Figures,
    ) -> f64 {
        let mut searches = self.descent.best();
        let mut is_settled = self.refine(&mut searches[self.leader]);
        let mut new = self.answers(&mut searches, figures);
        let before = &answers[self.which[self.leader]];
        let (search, answer) = (&mut searches[self.leader], &mut new[self.leader]);
        if let Some(last) = self.use_up(before, search, answer, figures) {
            is_settled = last;
        }
        let worst = self.least_violation(&new, answers);
        let accuracy = self.sought.asked.problem.accuracy;
        // Whether J of what was found here is known.
        let mut known = vec![None; self.which.len()];
        for (place, (answer, search)) in new.into_iter().zip(&searches).enumerate() {
            let old = &mut answers[self.which[place]];
            if tie::is_better(&answer, old) {
                let claimed = search.best().fitness.objective();
                let bound = error_by_bound(old, &answer);
                known[place] = Some(is_known(claimed, &answer, bound, accuracy));
                let least_objective = old.least_objective.or(old.objective());
                *old = Answer {
                    least_objective,
                    ..answer
                };
                agreements[self.which[place]] = None;
            }
        }
        let best = tie::best(answers);
        let place = self.which.iter().position(|&index| index == best);
        if let Some((place, is_known)) = place.and_then(|it| Some((it, known[it]?))) {
            let agreement = match place == self.leader {
                true => self.agreement,
                false => self.descent.confirmed(place),
            };
            let is_settled = is_settled || place != self.leader;
            agreements[best] = Some(Agreement {
                is_reached: agreement.is_reached && is_settled && is_known,
                ..agreement
            });
        }
        worst
    }

    /// Goes on with more shots where it passes: the fewer there are, the farther the search stays below what is
    /// allowed. Whether that gains no more.
    fn refine(&self, search: &mut Search) -> bool {
        let shots = self.descent.shots * RISE;
        if !self.passes() || shots > self.sought.control.most_shots {
            return true;
        }
        let stage = Stage {
            descents: DESCENTS,
            ..Stage::beyond(shots)
        };
        *search = self.refined(&self.descent.searches[self.leader], &stage);
        !still_gains(search, &self.sought.asked.problem)
    }

    /// A search after one more stage from its finalists.
    fn refined(&self, search: &Search, stage: &Stage) -> Search {
        let Sought {
            effort, control, ..
        } = *self.sought;
        let sampler = &self.descent.sampler;
        let samples = sampler.draw(stage.shots);
        let evaluator = sampler.evaluator(self.scenario, &samples, effort, control);
        let mut refined = search.clone();
        refined.refine_together(&evaluator, stage);
        refined
    }

    /// Goes on with more and more shots while shares that are left of what is allowed could be worth a part of the
    /// accuracy in J: on few shots a search stays as far from what is allowed as these happen to say. Whether the last
    /// stage gained no more, where there was one. More shots than those of the validation promise what nobody can check.
    fn use_up(
        &self,
        failing: &Answer,
        search: &mut Search,
        answer: &mut Answer,
        figures: &mut Figures,
    ) -> Option<bool> {
        let Sought { asked, control, .. } = *self.sought;
        let worthwhile = WORTHWHILE * asked.problem.accuracy;
        let mut shots = self.descent.shots * RISE;
        let mut is_settled = None;
        while answer.passes()
            && worth_of_room(failing, answer) > worthwhile * answer.order()
            && shots * RISE <= control.most_shots.min(control.validation_shots)
            && !control.is_stopped()
        {
            shots *= RISE;
            let next = self.refined(search, &Stage::beyond(shots));
            is_settled = Some(!still_gains(&next, &asked.problem));
            let found = figures.of(std::slice::from_ref(&next)).pop()?;
            if !tie::is_better(&found, answer) {
                break;
            }
            (*search, *answer) = (next, found);
        }
        is_settled
    }

    /// What the best candidates are on validation shots. What is farther down may fail there where what the last stage
    /// began with passes: then the search goes back.
    fn answers(&self, searches: &mut [Search], figures: &mut Figures) -> Vec<Answer> {
        let mut new = figures.of(searches);
        let leading = &mut new[self.leader];
        if !leading.passes()
            && let Some(before) = searches[self.leader].gone_back()
            && let Some(answer) = figures.of(std::slice::from_ref(&before)).pop()
            && tie::is_better(&answer, leading)
        {
            (*leading, searches[self.leader]) = (answer, before);
        }
        new
    }

    /// The least violation of new answers, as far as they are better than all that pass by more than the accuracy.
    fn least_violation(&self, new: &[Answer], answers: &[Answer]) -> f64 {
        let all = answers.iter().chain(new);
        let least = least_found(all.filter(|it| it.passes()));
        let worthwhile = least * (1.0 - self.sought.asked.problem.accuracy);
        let is_worthwhile = |it: &&Answer| it.objective().is_none_or(|it| it < worthwhile);
        let violations = new.iter().filter(is_worthwhile);
        violations
            .map(Answer::largest_violation)
            .fold(f64::INFINITY, f64::min)
    }
}

/// Whether J on the shots of the search is J on validation shots, within the accuracy, and so is what J owes to the
/// error of the bound that it stays below.
fn is_known(claimed: Option<f64>, answer: &Answer, bound: f64, accuracy: f64) -> bool {
    let (Some(claimed), Some(found)) = (claimed, answer.objective()) else {
        return false;
    };
    bound <= accuracy * found && found - claimed <= accuracy * found + answer.standard_error()
}

/// What J of an answer that passes owes to the error of the share that bounds it.
fn error_by_bound(failing: &Answer, passing: &Answer) -> f64 {
    price_of_bound(failing, passing) * passing.error_of_violation()
}

/// By how much J of an answer that passes could be lower if all that is allowed were used up. Nothing, where more is
/// left than few shots can be mistaken about: then something else bounds it.
fn worth_of_room(failing: &Answer, passing: &Answer) -> f64 {
    let violation = passing.largest_violation();
    match violation < MISTAKEN {
        true => 0.0,
        false => -price_of_bound(failing, passing) * ln(violation),
    }
}

/// What the share that bounds an answer costs in J, for the same part of it: as much as between that and what fails.
/// Shares are tails of distributions, in whose logarithms J is nearly straight.
fn price_of_bound(failing: &Answer, passing: &Answer) -> f64 {
    let (Some(least), Some(found)) = (failing.objective(), passing.objective()) else {
        return 0.0;
    };
    let violations = [failing, passing].map(Answer::largest_violation);
    if failing.passes() || violations[1] <= 0.0 {
        return 0.0;
    }
    (found - least).max(0.0) / ln(violations[0] / violations[1])
}

/// Descents of the last stage: where several shares are used up at once J has a kink, in which a simplex shrinks early.
const DESCENTS: usize = 2;
/// A share of what is allowed that few shots do not take for all of it.
const MISTAKEN: f64 = 0.7;
/// Share of the accuracy that what is left may be worth: what it buys of J is known within a factor of two.
const WORTHWHILE: f64 = 0.35;
