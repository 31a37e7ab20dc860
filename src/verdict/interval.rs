//! What a count of shots says about the share that it comes from.

/// Of what distribution one tail is left out on each side of a 95 % interval.
const TAIL: f64 = 0.025;
/// What lies beyond three standard errors of a normal distribution, on one side.
const THREE_STANDARD_ERRORS: f64 = 0.001_349_898;
/// The same of both as standard errors.
const NORMAL_QUANTILES: [f64; 2] = [1.959_963_985, 3.0];
/// From this variance of the count on it is as good as normal.
const NORMAL_FROM: f64 = 1e4;
/// Terms below this part of a sum are lost in its rounding.
const NEGLIGIBLE: f64 = 1e-18;
/// Beyond this a sum outweighs the rest of any distribution.
const ALL: f64 = 1e200;
/// Halvings of the range in which an end of an interval lies.
const HALVINGS: usize = 64;

/// A number of shots out of all.
#[derive(Clone, Copy, Debug)]
pub(super) struct Count {
    pub broken: usize,
    pub counted: usize,
}

impl Count {
    /// 95 % interval of the share: the shares for which the count is in neither tail of its binomial
    /// distribution, with half of the count's own probability in each tail (mid-P). Clopper and
    /// Pearson put all of it into both, and cover more than is said; Jeffreys covers 90 % of the
    /// rarest shares.
    ///
    /// Where no shot breaks the goal, or every shot, the rule of three is the same.
    pub fn interval_95(&self) -> [f64; 2] {
        let counted = self.counted as f64;
        let of_none = (3.0 / counted).min(1.0);
        match self.broken {
            _ if self.counted == 0 => [0.0, 1.0],
            0 => [0.0, of_none],
            all if all >= self.counted => [1.0 - of_none, 1.0],
            _ if self.is_normal() => self.wilson(NORMAL_QUANTILES[0]),
            _ => {
                let share = self.share();
                [
                    self.share_with_tail(TAIL, [0.0, share]),
                    self.share_with_tail(1.0 - TAIL, [share, 1.0]),
                ]
            }
        }
    }

    /// Whether the share is three standard errors off another one, or what is as likely.
    pub fn is_far_from(&self, other: f64) -> bool {
        if self.counted == 0 {
            return false;
        }
        if self.is_normal() {
            let [low, high] = self.wilson(NORMAL_QUANTILES[1]);
            return other < low || high <= other;
        }
        let tail = self.tail(other);
        !(THREE_STANDARD_ERRORS..1.0 - THREE_STANDARD_ERRORS).contains(&tail)
    }

    fn share(&self) -> f64 {
        self.broken as f64 / self.counted as f64
    }

    fn is_normal(&self) -> bool {
        let share = self.share();
        self.counted as f64 * share * (1.0 - share) > NORMAL_FROM
    }

    /// Wilson's interval, `z` standard errors to both sides.
    fn wilson(&self, standard_errors: f64) -> [f64; 2] {
        let z2 = standard_errors * standard_errors / self.counted as f64;
        let share = self.share();
        let centre = share + z2 / 2.0;
        let half = (z2 * (share * (1.0 - share) + z2 / 4.0)).sqrt();
        [
            ((centre - half) / (1.0 + z2)).max(0.0),
            ((centre + half) / (1.0 + z2)).min(1.0),
        ]
    }

    /// The share in a range at which the tail is this.
    fn share_with_tail(&self, tail: f64, [mut low, mut high]: [f64; 2]) -> f64 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.tail(middle) < tail {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// The probability of more than this count plus half that of this count, where each shot counts
    /// with probability `share`.
    ///
    /// Probabilities are summed relative to that of the count itself, from there outwards: exact, and
    /// the same on every machine.
    fn tail(&self, share: f64) -> f64 {
        if share <= 0.0 {
            return if self.broken == 0 { 0.5 } else { 0.0 };
        }
        if share >= 1.0 {
            return if self.broken >= self.counted {
                0.5
            } else {
                1.0
            };
        }
        let odds = share / (1.0 - share);
        let (hits, misses) = (self.broken, self.counted - self.broken);
        let above = outwards(misses, hits, odds);
        if above > ALL {
            return 1.0;
        }
        let below = outwards(hits, misses, 1.0 / odds);
        if below > ALL {
            return 0.0;
        }
        (0.5 + above) / (1.0 + above + below)
    }
}

/// The probabilities of `more` further counts, one after the other, as parts of that of the first: each step
/// turns one of `more` shots into one of the others, of which there are `others`.
fn outwards(more: usize, others: usize, odds: f64) -> f64 {
    let (mut sum, mut term) = (0.0, 1.0);
    for step in 0..more {
        let ratio = (more - step) as f64 / (others + step + 1) as f64 * odds;
        term *= ratio;
        sum += term;
        let is_settled = ratio < 1.0 && term < NEGLIGIBLE * (1.0 + sum);
        if is_settled || sum > ALL {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Probabilities of the counts from 0 on, until they are too small to matter.
    fn probabilities(counted: usize, share: f64) -> Vec<f64> {
        let odds = share / (1.0 - share);
        let mut term = (1.0 - share).powi(counted as i32);
        let mut all = Vec::new();
        for count in 0..=counted {
            all.push(term);
            term *= (counted - count) as f64 / (count + 1) as f64 * odds;
            if term < 1e-15 && count as f64 > counted as f64 * share {
                break;
            }
        }
        all
    }

    /// The probability that the interval of a count holds the share that it comes from.
    fn coverage(counted: usize, share: f64) -> f64 {
        let all = probabilities(counted, share);
        let held = all.iter().enumerate().filter(|&(broken, _)| {
            let [low, high] = Count { broken, counted }.interval_95();
            low <= share && share <= high
        });
        held.map(|(_, probability)| probability).sum()
    }

    #[test]
    fn intervals_of_rare_shares_hold_them_as_often_as_they_say() {
        for (counted, share, expected) in [
            (2000, 7e-5, 0.9911),
            (2000, 1e-4, 0.9825),
            (2000, 1e-3, 0.9835),
            (16_384, 1e-4, 0.9741),
            (16_384, 1e-3, 0.9539),
        ] {
            let found = coverage(counted, share);
            assert!(
                (found - expected).abs() < 1e-4,
                "{counted}, {share}: {found}"
            );
        }
        // Whatever the share; so few shots have few counts, so that steps of one show.
        for counted in [50, 2000] {
            let shares = (1..600).map(|step| 0.03 * f64::from(step) / counted as f64);
            let all: Vec<f64> = shares.map(|share| coverage(counted, share)).collect();
            let least = all.iter().copied().fold(1.0, f64::min);
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            assert!(
                least > 0.91 && (0.945..0.965).contains(&mean),
                "{least}, {mean}"
            );
        }
    }

    /// Sums of the distribution itself.
    #[test]
    fn tails_are_those_of_the_binomial_distribution() {
        for (counted, share) in [(1, 0.3), (7, 0.5), (40, 0.02), (2000, 1e-3), (60, 0.9)] {
            let all = probabilities(counted, share);
            for broken in (0..all.len()).step_by(1 + all.len() / 40) {
                let above: f64 = all[broken + 1..].iter().sum();
                let tail = Count { broken, counted }.tail(share);
                assert!(
                    (tail - above - 0.5 * all[broken]).abs() < 1e-9,
                    "{broken} of {counted}"
                );
            }
        }
        let count = Count {
            broken: 3,
            counted: 1_000_000,
        };
        assert_eq!(
            [0.0, 0.9, 1.0].map(|share| count.tail(share)),
            [0.0, 1.0, 1.0]
        );
        let count = Count {
            broken: 999_997,
            counted: 1_000_000,
        };
        assert_eq!(
            [0.0, 0.1, 1.0].map(|share| count.tail(share)),
            [0.0, 0.0, 1.0]
        );
    }

    #[test]
    fn ends_are_where_the_tails_are() {
        for (broken, counted) in [(1, 2), (1, 2000), (5, 60), (59, 60), (700, 1_000_000)] {
            let count = Count { broken, counted };
            let [low, high] = count.interval_95();
            assert!(low < count.share() && count.share() < high);
            assert!(
                (count.tail(low) - 0.025).abs() < 1e-9,
                "{broken} of {counted}"
            );
            assert!(
                (count.tail(high) - 0.975).abs() < 1e-9,
                "{broken} of {counted}"
            );
            // What is broken and what is kept are two names for the same.
            let kept = Count {
                broken: counted - broken,
                counted,
            }
            .interval_95();
            assert!((low + kept[1] - 1.0).abs() < 1e-12 && (high + kept[0] - 1.0).abs() < 1e-12);
        }
        // One seen among 2000: 7e-5 is no longer out of the question.
        let [low, high] = Count {
            broken: 1,
            counted: 2000,
        }
        .interval_95();
        assert!((low - 2.50e-5).abs() < 1e-7 && (high - 2.463e-3).abs() < 1e-6);
    }

    #[test]
    fn none_seen_is_below_three_in_so_many() {
        let interval = |broken, counted| Count { broken, counted }.interval_95();
        assert_eq!(interval(0, 0), [0.0, 1.0]);
        assert_eq!(interval(0, 2), [0.0, 1.0]);
        assert_eq!(interval(0, 65_536), [0.0, 3.0 / 65_536.0]);
        assert_eq!(interval(65_536, 65_536), [1.0 - 3.0 / 65_536.0, 1.0]);
        assert_eq!(interval(3, 3), [0.0, 1.0]);
        // The rule of three is the same to a thousandth.
        let none = Count {
            broken: 0,
            counted: 2000,
        };
        let [_, high] = none.interval_95();
        assert!((none.share_with_tail(0.975, [0.0, 1.0]) / high - 1.0).abs() < 3e-3);
    }

    /// Where the count becomes as good as normal the ends make no step that anybody sees.
    #[test]
    fn large_counts_are_taken_to_be_normal() {
        for (broken, counted) in [(20_000, 40_001), (10_002, 100_000_000), (12_000, 72_001)] {
            let count = Count { broken, counted };
            assert!(count.is_normal());
            let width = count.interval_95()[1] - count.share();
            let exact = [
                count.share_with_tail(TAIL, [0.0, count.share()]),
                count.share_with_tail(1.0 - TAIL, [count.share(), 1.0]),
            ];
            for (normal, exact) in count.interval_95().into_iter().zip(exact) {
                assert!(
                    (normal - exact).abs() < 4e-3 * width,
                    "{broken}: {normal}, {exact}"
                );
            }
        }
    }

    #[test]
    fn far_is_three_standard_errors() {
        let far = |broken, counted, from| Count { broken, counted }.is_far_from(from);
        // 9 expected, standard error 3: a skewed distribution, so 9 more are not quite as far.
        assert!(far(20, 1_000_000, 9e-6) && !far(17, 1_000_000, 9e-6));
        assert!(far(1, 1_000_000, 9e-6) && !far(3, 1_000_000, 9e-6));
        // Half of (1 - share)^1000 is 0.00135 at 0.0059.
        assert!(far(0, 1000, 0.006) && !far(0, 1000, 0.0058));
        assert!(!far(0, 1000, 0.0) && !far(0, 0, 0.5));
        // 40 000 of 100 000: standard error 0.00155.
        assert!(far(40_000, 100_000, 0.4048) && !far(40_000, 100_000, 0.4045));
        assert!(far(40_000, 100_000, 0.3952) && !far(40_000, 100_000, 0.3955));
    }
}
