//! What the few shots of a search say about a share.

/// The share of shots that break a goal, from shots with importance weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShareEstimate {
    /// The share itself; 1 where there was nothing to count.
    share: f64,
    /// As many shots of the jet alone would tell it as well.
    shots: f64,
    /// What a goal asks for.
    asked: Asked,
}

/// What a goal asks of a share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Asked {
    /// Share that may break the goal.
    pub allowed: f64,
    /// Whether all shots are the same, so that the share has no error.
    pub is_exact: bool,
}

/// Standard errors by which a search stays below what is allowed,
const MARGIN: f64 = 1.5;
/// but no lower than this part of it.
const LEAST_PART: f64 = 0.5;

impl ShareEstimate {
    /// From the weights of the shots that break the goal, and the sum of the weights of all that count. A mean weight of
    /// one in ten among the former tells as much as ten times as many shots of the jet.
    pub fn of(breaking: impl Iterator<Item = f64>, all: f64, asked: Asked) -> Self {
        let (mut sum, mut squares) = (0.0, 0.0);
        for weight in breaking {
            sum += weight;
            squares += weight * weight;
        }
        let mean_weight = if sum > 0.0 { squares / sum } else { 1.0 };
        Self {
            share: if all > 0.0 { sum / all } else { 1.0 },
            shots: (all / mean_weight).max(1.0),
            asked,
        }
    }

    /// The share over a part `slack` of what is allowed, less what an estimate of it from so few shots may be off. A
    /// finite number, above 1 where that does not pass.
    pub fn violation(&self, slack: f64) -> f64 {
        self.over(self.share, self.usable(slack))
    }

    /// The share over what is allowed. A finite number, above 1 where that does not pass.
    pub fn utilisation(&self) -> f64 {
        self.over(self.share, self.asked.allowed)
    }

    /// What this share is to be multiplied by to be the one from more shots, and above it by as much as that may be
    /// off. None where that is too far below what is allowed to matter, or where nothing breaks the goal here.
    pub fn correction(&self, many: &Self) -> Option<f64> {
        let Asked { allowed, is_exact } = self.asked;
        let matters = many.share > allowed * LEAST_PART && allowed > 0.0;
        let known = many.share * allowed / many.usable(1.0);
        (matters && self.share > 0.0 && !is_exact).then(|| known / self.share)
    }

    /// The share over what is allowed, after a correction.
    pub fn corrected(&self, correction: f64) -> f64 {
        self.over(self.share * correction, self.asked.allowed)
    }

    /// A part of what is allowed, less what a share of that size would be off from as many shots.
    fn usable(&self, slack: f64) -> f64 {
        let allowed = self.asked.allowed * slack;
        let error = if self.asked.is_exact {
            0.0
        } else {
            (allowed * (1.0 - allowed) / self.shots).sqrt()
        };
        (allowed - MARGIN * error).max(allowed * LEAST_PART)
    }

    fn over(&self, share: f64, usable: f64) -> f64 {
        if usable > 0.0 {
            share / usable
        } else if share > 0.0 {
            1.0 + share * self.shots
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(breaking: &[f64], all: f64, allowed: f64, is_exact: bool) -> ShareEstimate {
        ShareEstimate::of(breaking.iter().copied(), all, Asked { allowed, is_exact })
    }

    #[test]
    fn shots_of_little_weight_tell_a_share_as_well_as_many() {
        let alike = estimate(&[1.0; 4], 4096.0, 0.001, false);
        let weighted = estimate(&[0.1; 40], 4096.0, 0.001, false);
        assert!((alike.share - weighted.share).abs() < 1e-15);
        assert!((weighted.shots / alike.shots - 10.0).abs() < 1e-9);
        // As much of what is allowed is left as it may be off, but no more than half.
        assert_eq!(alike.violation(1.0), 4.0 / 4096.0 / 0.0005);
        let error = (0.001 * 0.999 / 40_960.0_f64).sqrt();
        let expected = 4.0 / 4096.0 / (0.001 - 1.5 * error);
        assert!((weighted.violation(1.0) - expected).abs() < 1e-12);
    }

    #[test]
    fn nothing_to_count_breaks_a_goal_and_nothing_allowed_is_broken_by_one() {
        let violation = |breaking: &[f64], all, allowed, is_exact| {
            estimate(breaking, all, allowed, is_exact).violation(1.0)
        };
        assert!(violation(&[], 0.0, 0.05, false) > 1.0 && violation(&[], 0.0, 0.0, false) > 1.0);
        assert_eq!(violation(&[], 128.0, 0.05, false), 0.0);
        assert_eq!(violation(&[], 128.0, 0.0, false), 0.0);
        assert_eq!(violation(&[1.0], 1.0, 0.5, true), 2.0);
        assert_eq!(violation(&[1.0], 1.0, 0.0, true), 2.0);
    }

    #[test]
    fn a_share_on_few_shots_is_corrected_to_that_on_many_and_what_this_may_be_off() {
        let (few, many) = (
            estimate(&[1.0; 4], 4096.0, 0.001, false),
            estimate(&[1.0; 80], 65_536.0, 0.001, false),
        );
        let correction = few.correction(&many).expect("it matters");
        let error = (0.001 * 0.999 / 65_536.0_f64).sqrt();
        let expected = many.share / (0.001 - 1.5 * error);
        assert!((few.corrected(correction) - expected).abs() < 1e-12);
        assert!((many.utilisation() - 80.0 / 65.536).abs() < 1e-12);
        // What is far below what is allowed, or nothing here, needs none.
        let little = estimate(&[1.0; 30], 65_536.0, 0.001, false);
        assert_eq!(few.correction(&little), None);
        assert_eq!(estimate(&[], 4096.0, 0.001, false).correction(&many), None);
    }
}
