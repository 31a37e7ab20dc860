//! Stopping rule: when the answer is good enough.

use super::answer::Answer;
use super::search::Search;
use crate::elementary::square;
use crate::problem::Problem;
use crate::problem::goal::Goals;

/// Least J over all contacts; infinite while the nozzle has fitted nowhere.
pub(super) fn least_objective(searches: &[Search]) -> f64 {
    let objectives = searches
        .iter()
        .filter_map(|search| search.best().fitness.objective());
    objectives.fold(f64::INFINITY, f64::min)
}

/// Whether a contact could still become the best.
pub(super) fn is_in_reach(search: &Search, least: f64) -> bool {
    let objective = search.best().fitness.objective();
    objective.is_none_or(|objective| objective <= least * (1.0 + IN_REACH))
}

/// The searches that could still change the answer: contacts that could win, whose optimism gap is above a part
/// of the accuracy and above its standard error.
///
/// The least J on a sample is on average below the least true J, and the true J of the settings found is above it
/// (sample average approximation). So the gap between J on the search's shots and on validation shots bounds how
/// far these settings are from the best ones; and a contact cannot win where even its J on the search's shots, less
/// its error, is above J of another one.
///
/// Where the standard error is too large for that gap to say much, the search goes on as well, up to the number of
/// validation shots, or until the [optimality gap](Search::optimality_gap) of a stage on shots of its own is as small.
/// Where every goal is reached J is rounding, of which no accuracy can be asked.
pub(super) fn not_converged(
    searches: &[Search],
    answers: &[Answer],
    problem: &Problem,
    shots: usize,
    validation_shots: usize,
) -> Vec<usize> {
    let least = least_found(answers);
    let least_claimed = least_objective(searches);
    let is_open = |search: &Search, answer: &Answer| {
        let claimed = search.best().fitness.objective()?;
        let found = answer.objective()?;
        let wanted = wanted(found, problem);
        let error = answer.standard_error();
        let lowest = claimed - CONFIDENCE * answer.standard_error_on(shots);
        // More shots than there are validation shots would promise what nobody can check.
        let promises =
            shots < validation_shots && lowest <= least - WORTHWHILE * problem.accuracy * least;
        // On common random numbers contacts are told apart by far fewer shots than J of each is known by.
        let is_behind = claimed > least_claimed * (1.0 + BEHIND * problem.accuracy);
        let could_win = (found <= least || promises) && !is_behind;
        let is_noisy = error > NOISY * wanted && shots < validation_shots;
        let tolerable = if shots < validation_shots {
            TOLERABLE * wanted
        } else {
            TOLERABLE_ON_MANY * wanted + error
        };
        let gains = shots < validation_shots && still_gains(search, problem);
        let is_doubtful = is_noisy || found - claimed > tolerable || gains;
        Some(could_win && is_doubtful && !is_near_best(search, problem))
    };
    let pairs = searches.iter().zip(answers).enumerate();
    pairs
        .filter(|(_, (search, answer))| is_open(search, answer).unwrap_or(false))
        .map(|(index, _)| index)
        .collect()
}

/// Whether the optimality gap says that the settings which the last stage began with were good enough: those that it
/// has found on four times the shots are better.
pub(super) fn is_near_best(search: &Search, problem: &Problem) -> bool {
    let least = search.best().fitness.rank();
    search.optimality_gap() <= TOLERABLE * wanted(least, problem)
}

/// Whether the last stage has still found what is better by more than the accuracy: the next may as well.
pub(super) fn still_gains(search: &Search, problem: &Problem) -> bool {
    search.gain() > wanted(search.best().fitness.rank(), problem)
}

/// Whether J of a contact that could win is too noisy.
pub(super) fn is_noisy(answers: &[Answer], problem: &Problem) -> bool {
    let least = least_found(answers);
    let is_noisy = |found: f64, error: f64| {
        found - CONFIDENCE * error <= least && error > NOISY * wanted(found, problem)
    };
    answers.iter().any(|answer| {
        let found = answer.objective();
        found.is_some_and(|found| is_noisy(found, answer.standard_error()))
    })
}

/// Whether the variance of J over samples is so small that a search gains nothing from more shots.
pub(super) fn is_precise(objectives: &[f64], problem: &Problem) -> bool {
    let count = objectives.len() as f64;
    let mean = objectives.iter().sum::<f64>() / count;
    let squares = objectives.iter().map(|objective| square(objective - mean));
    let deviation = (squares.sum::<f64>() / (count - 1.0)).sqrt();
    deviation <= NOISY * wanted(mean, problem)
}

/// Least J of some answers; infinite where the nozzle fits for none.
pub(super) fn least_found<'a>(answers: impl IntoIterator<Item = &'a Answer>) -> f64 {
    let found = answers.into_iter().filter_map(Answer::objective);
    found.fold(f64::INFINITY, f64::min)
}

/// The standard error that J of an answer should have.
fn wanted(found: f64, problem: &Problem) -> f64 {
    (problem.accuracy * found).max(rounding_of_objective(&problem.goals))
}

/// J of shots whose impulses are as wanted but for rounding.
pub(super) fn rounding_of_objective(goals: &Goals) -> f64 {
    let tangential = goals.tangential_impulse.map_or(0.0, |goal| goal.weight);
    goals.normal_impulse.weight.max(tangential) * ROUNDING * ROUNDING
}

/// Relative rounding of an impulse.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Share of the accuracy that either gap may reach. A search that ends in a hollow of its sample beside the
/// least value there shows less of a gap than its settings are worse: with half of the accuracy 2 of
/// 100 seeds were up to 2 % off in the long hub set within its tolerance.
const TOLERABLE: f64 = 0.35;
/// The same for a sample as large as the validation sample, which has such hollows
/// less often; asking more of it makes some searches of the fir tree three times as long.
const TOLERABLE_ON_MANY: f64 = 0.5;
/// Share of the accuracy by which a contact may be behind the best one on common shots and still be searched on.
const BEHIND: f64 = 0.5;
/// Share of the accuracy by which a contact must promise to be better than the best one.
const WORTHWHILE: f64 = 0.5;
/// Share of the accuracy above which a standard error is too large for the gap to say much.
const NOISY: f64 = 0.35;
/// Standard errors that a difference must exceed to count.
const CONFIDENCE: f64 = 2.0;
/// A contact whose J is above the best by more than this share cannot become the best.
const IN_REACH: f64 = 0.25;
