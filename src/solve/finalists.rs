//! Whether a search ends where it does by chance: finalists of independent groups must agree.

use super::search::Search;
use super::stopping_rule::rounding_of_objective;
use crate::problem::Problem;

/// What the finalists of a search say about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Agreement {
    /// Whether enough of them are as good as the best one, within the accuracy.
    pub is_reached: bool,
    /// How many more would have to agree at least.
    pub missing: u32,
    /// By how much the last of those that had to agree is above the best one, relative to that.
    pub spread: f64,
}

/// By how much finalists that agree may differ.
#[derive(Clone, Copy)]
struct Tolerated {
    /// Of the best J.
    share: f64,
    /// Where every goal is reached J is rounding.
    rounding: f64,
}

impl Agreement {
    /// Where there is nothing to search.
    const CERTAIN: Self = Self {
        is_reached: true,
        missing: 0,
        spread: 0.0,
    };

    /// Of finalists on the same shots. Two have to agree, and three once one has ended elsewhere, or where many settings
    /// are searched: then there is more than one place to end in.
    pub fn of(search: &Search, problem: &Problem) -> Self {
        if search.dimensions() == 0 {
            return Self::CERTAIN;
        }
        let ranks = search.finalists().map(|it| it.fitness.rank()).collect();
        let tolerance = Tolerated {
            share: NEAR * problem.accuracy,
            rounding: rounding_of_objective(&problem.goals),
        };
        Self::of_ranks(ranks, search.dimensions(), tolerance)
    }

    fn of_ranks(mut ranks: Vec<f64>, dimensions: usize, tolerated: Tolerated) -> Self {
        ranks.sort_by(f64::total_cmp);
        let best = ranks[0];
        let above = |rank: f64| ((rank - best) / best.max(f64::MIN_POSITIVE)).min(LARGEST_SPREAD);
        let is_near = |rank: f64| rank - best <= (tolerated.share * best).max(tolerated.rounding);
        let is_simple = dimensions < MANY && ranks.iter().all(|&rank| is_near(rank));
        let needed = if is_simple { 2 } else { 3 };
        let agreeing = ranks.iter().filter(|&&rank| is_near(rank)).count();
        let last = ranks.get(needed - 1).copied();
        Self {
            is_reached: agreeing >= needed,
            missing: needed.saturating_sub(agreeing) as u32,
            spread: above(last.or(ranks.last().copied()).unwrap_or(best)),
        }
    }
}

/// What is farther apart than this is not measured: one of two finalists may not even fit.
const LARGEST_SPREAD: f64 = 1e6;
/// Share of the accuracy within which finalists agree: those that are stuck on the same slope are farther apart.
const NEAR: f64 = 0.5;
/// From this number of searched settings on.
pub(super) const MANY: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;

    fn agreement(ranks: &[f64], dimensions: usize) -> (bool, f64) {
        let tolerated = Tolerated {
            share: 0.005,
            rounding: 1e-30,
        };
        let agreement = Agreement::of_ranks(ranks.to_vec(), dimensions, tolerated);
        (agreement.is_reached, (agreement.spread * 1e6).round() / 1e6)
    }

    #[test]
    fn two_agree_where_no_other_place_was_seen() {
        assert_eq!(agreement(&[1.0, 1.004], 3), (true, 0.004));
        assert_eq!(agreement(&[1.0], 3), (false, 0.0));
        assert!(agreement(&[1e-33, 1e-31], 3).0);
        // Many settings have many places to end in.
        assert_eq!(agreement(&[1.0, 1.004], 4), (false, 0.004));
        assert_eq!(agreement(&[1.0, 1.004, 1.001], 4), (true, 0.004));
    }

    #[test]
    fn as_many_more_are_asked_as_are_missing() {
        let missing = |ranks: &[f64], dimensions: usize| {
            let tolerated = Tolerated {
                share: 0.005,
                rounding: 0.0,
            };
            Agreement::of_ranks(ranks.to_vec(), dimensions, tolerated).missing
        };
        assert_eq!(missing(&[1.0, 1.001], 2), 0);
        assert_eq!(missing(&[1.0, 1.001], 4), 1);
        assert_eq!(missing(&[1.0, 2.0], 2), 2);
        assert_eq!(missing(&[1.0, 2.0, 3.0], 2), 2);
    }

    #[test]
    fn three_agree_where_another_place_was_seen() {
        assert_eq!(agreement(&[1.0, 2.0], 2), (false, 1.0));
        assert_eq!(agreement(&[1.0, 2.0, 1.001], 2), (false, 1.0));
        assert_eq!(agreement(&[1.003, 2.0, 1.0, 1.001], 2), (true, 0.003));
    }
}
