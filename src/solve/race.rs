//! Early termination: a pose races against a rival on the same first shots.

use crate::jet::ShotSample;
use crate::objective::Rest;

use super::polish::Candidate;

/// A moment at which J of the first shots may decide a race.
pub(super) struct Look {
    /// Shots until then.
    pub end: usize,
    pub rest: Rest,
}

/// Shares of the shots after which J is looked at.
const SHARES: [f64; 4] = [0.125, 0.25, 0.5, 0.75];
/// Most looks of a race.
pub(super) const LOOKS: usize = SHARES.len();
/// Shots that are traced before J is looked at, at least.
const FEWEST: usize = 64;

impl Look {
    /// All looks at a sample. They are the same for every race: on them depends the order of sums, and so their
    /// last bits.
    pub fn all(shots: &[ShotSample]) -> Vec<Self> {
        let ends = SHARES.map(|share| (shots.len() as f64 * share) as usize);
        let worthwhile = ends.into_iter().filter(|&end| end >= FEWEST);
        let look = |end| Self {
            end,
            rest: Rest::of(&shots[end..]),
        };
        worthwhile.map(look).collect()
    }
}

/// A rival on the same shots; the race is lost as soon as J is above the rival's, by proof or clearly.
pub(super) struct Race {
    /// J of the rival.
    objective: f64,
    /// J of the rival's first shots, and the margin above it that is clear, at each look.
    partial: Vec<(f64, f64)>,
}

impl Race {
    /// No rival: all shots are traced.
    pub fn none() -> Self {
        Self::above(f64::INFINITY)
    }

    /// Lost where the shots that were traced prove that J of all is above `objective`.
    pub fn above(objective: f64) -> Self {
        Self {
            objective,
            partial: Vec::new(),
        }
    }

    /// Against the last, the worst, of the corners of a simplex.
    ///
    /// On common random numbers the difference of two poses on the first shots is close to that on all shots. How
    /// close, the corners show among themselves: a difference several times larger than theirs is clear.
    pub fn against_worst(corners: &[Candidate]) -> Self {
        let [others @ .., worst] = corners else {
            return Self::none();
        };
        let objective = worst.fitness.rank();
        let looks = worst.partial.len();
        let others = others.iter().filter(|it| it.partial.len() == looks);
        let others: Vec<&Candidate> = others.collect();
        if others.is_empty() {
            return Self::above(objective);
        }
        let at = |look: usize| {
            let drift = others.iter().map(|other| {
                let on_first = other.partial[look] - worst.partial[look];
                let on_all = other.fitness.rank() - objective;
                (on_first - on_all).abs()
            });
            (worst.partial[look], CLEAR * drift.fold(0.0, f64::max))
        };
        Self {
            objective,
            partial: (0..looks).map(at).collect(),
        }
    }

    /// An estimate of J of all shots, which is above the rival's, where that is decided at a look; `partial` is J of
    /// the first shots, and J of all is at least `share` of it.
    pub fn lost(&self, look: usize, partial: f64, share: f64) -> Option<f64> {
        if partial * share > self.objective {
            return Some(partial);
        }
        let &(rival, margin) = self.partial.get(look)?;
        (partial - rival > margin).then_some(self.objective + (partial - rival))
    }

    /// All that it depends on, for checkpoints.
    pub fn numbers(&self) -> Vec<f64> {
        let partial = self.partial.iter();
        let partial = partial.flat_map(|&(objective, margin)| [objective, margin]);
        std::iter::once(self.objective).chain(partial).collect()
    }
}

/// A difference is clear when it is this many times the largest change that the corners show.
const CLEAR: f64 = 3.0;
