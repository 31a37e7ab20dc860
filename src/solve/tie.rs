//! Contacts between which J makes no difference, and which of them is recommended.

use std::cmp::Ordering;

use super::answer::Answer;
use crate::problem::Problem;

/// J with its standard error.
pub type Measured = (f64, f64);

/// Relative rounding of J.
const ROUNDING: f64 = 1e-9;
/// What is left of J where every goal is reached is rounding.
const NOTHING: f64 = 1e-20;

/// Whether J of a contact ties with the least one: equal within its standard error, or within the
/// accuracy asked for.
pub fn is_tie((least, least_error): Measured, (other, error): Measured, accuracy: f64) -> bool {
    let noise = (least_error * least_error + error * error).sqrt();
    let tolerated = noise.max(accuracy.max(ROUNDING) * least.abs()).max(NOTHING);
    (other - least).abs() <= tolerated
}

/// Whether an answer is better than another: one at which the nozzle fits before others, then one that passes by J,
/// then by the largest violation.
pub(super) fn is_better(one: &Answer, other: &Answer) -> bool {
    order(one, other).is_lt()
}

fn order(one: &Answer, other: &Answer) -> Ordering {
    let tier = |answer: &Answer| (answer.evaluation.is_none(), !answer.passes());
    let violation = |answer: &Answer| match tier(answer) {
        (false, true) => answer.largest_violation(),
        _ => 0.0,
    };
    tier(one)
        .cmp(&tier(other))
        .then(violation(one).total_cmp(&violation(other)))
        .then(one.order().total_cmp(&other.order()))
}

/// The answers, best first: those that pass by J, then others by their largest violation. Those that tie with the
/// best, and fail no more verdicts nor fewer than it, stand in the order of the file's contacts.
pub(super) fn ranked(mut answers: Vec<Answer>, problem: &Problem) -> Vec<Answer> {
    answers.sort_by(order);
    let Some(best) = answers.first().and_then(fitness) else {
        return answers;
    };
    let (mut tied, behind): (Vec<Answer>, Vec<Answer>) = answers
        .into_iter()
        .partition(|answer| ties(answer, best, problem));
    tied.sort_by_key(|answer| place_in_file(answer, problem));
    tied.extend(behind);
    tied
}

/// The index of the best answer, which one that ties with it may be recommended before.
pub(super) fn best(answers: &[Answer]) -> usize {
    let all = answers.iter().enumerate();
    let best = all.min_by(|(_, a), (_, b)| order(a, b));
    best.map_or(0, |(index, _)| index)
}

/// Whether two answers tie, and fail as many verdicts.
pub(super) fn tie_with(one: &Answer, other: &Answer, problem: &Problem) -> bool {
    fitness(one).is_some_and(|best| ties(other, best, problem))
}

/// The one that is ranked first.
pub(super) fn recommended<'a>(answers: &'a [Answer], problem: &Problem) -> Option<&'a Answer> {
    let least = answers.get(best(answers))?;
    let Some(best) = fitness(least) else {
        return Some(least);
    };
    let tied = answers.iter().filter(|answer| ties(answer, best, problem));
    tied.min_by_key(|answer| place_in_file(answer, problem))
}

fn ties(answer: &Answer, best: Fitness, problem: &Problem) -> bool {
    fitness(answer).is_some_and(|it| it.is_as_good_as(&best, NEAR * problem.accuracy))
}

fn place_in_file(answer: &Answer, problem: &Problem) -> Option<usize> {
    let mut contacts = problem.ranges.contact.iter();
    contacts.position(|&contact| contact == answer.settings.contact)
}

/// Share of the accuracy within which an answer may be recommended before a better one: the rest is for what the search misses.
const NEAR: f64 = 0.5;

/// What answers are compared by.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fitness {
    objective: Measured,
    /// How many verdicts fail.
    failing: usize,
    /// The largest share over the one that is allowed; 0 where all pass.
    violation: f64,
}

impl Fitness {
    fn is_as_good_as(&self, best: &Self, accuracy: f64) -> bool {
        let (violation, least) = (self.violation, best.violation);
        self.failing == best.failing
            && violation - least <= accuracy.max(ROUNDING) * least
            && is_tie(best.objective, self.objective, accuracy)
    }
}

/// Where the nozzle fits.
fn fitness(answer: &Answer) -> Option<Fitness> {
    let failing = answer.verdicts.iter().filter(|verdict| !verdict.passes());
    let failing = failing.count();
    Some(Fitness {
        objective: (answer.objective()?, answer.standard_error()),
        failing,
        violation: if failing > 0 {
            answer.largest_violation()
        } else {
            0.0
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_equal_within_its_error_or_the_accuracy_ties() {
        let accuracy = 0.01;
        assert!(is_tie((0.1, 0.0), (0.1009, 0.0), accuracy));
        assert!(!is_tie((0.1, 0.0), (0.1011, 0.0), accuracy));
        assert!(is_tie((0.1, 0.003), (0.1045, 0.004), accuracy));
        assert!(!is_tie((0.1, 0.003), (0.1055, 0.004), accuracy));
        assert!(is_tie((2e-28, 0.0), (9e-27, 0.0), accuracy));
        assert!(is_tie((0.25, 0.0), (0.25 * (1.0 + 1e-12), 0.0), 0.0));
    }

    #[test]
    fn what_fails_by_more_is_not_as_good_whatever_its_objective() {
        let of = |failing, violation| Fitness {
            objective: (0.1, 0.001),
            failing,
            violation,
        };
        assert!(of(1, 1.504).is_as_good_as(&of(1, 1.5), 0.005));
        assert!(!of(1, 2.0).is_as_good_as(&of(1, 1.5), 0.005));
        assert!(!of(2, 1.5).is_as_good_as(&of(1, 1.5), 0.005));
        assert!(of(0, 0.0).is_as_good_as(&of(0, 0.0), 0.0));
    }
}
