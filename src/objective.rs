//! From impacts to named terms, to J, and to the speed that makes J least.

mod accumulator;
mod hits;
mod tally;

pub(crate) use accumulator::ObjectiveAccumulator;
pub use hits::{Hits, Impulses};
pub(crate) use tally::Rest;
pub use tally::Tally;

use serde::{Deserialize, Serialize};

use crate::problem::goal::Goals;

/// The terms of the objective with their weights, so that they add up to J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Terms {
    /// First hits on target: squared relative error of the normal impulse.
    pub normal_impulse: f64,
    /// First hits on target: squared excess of the tangential impulse.
    pub tangential_impulse: f64,
    /// Impacts on secondary surfaces: squared normal impulse over what they may take.
    pub rebound: f64,
    /// Shots whose first hit is not on the target.
    pub miss: f64,
}

impl Terms {
    /// J.
    pub fn total(&self) -> f64 {
        self.normal_impulse + self.tangential_impulse + self.rebound + self.miss
    }

    /// The same in proportion, with another J.
    pub(crate) fn scaled_to(&self, total: f64) -> Self {
        let factor = total / self.total();
        Self {
            normal_impulse: self.normal_impulse * factor,
            tangential_impulse: self.tangential_impulse * factor,
            rebound: self.rebound * factor,
            miss: self.miss * factor,
        }
    }

    /// Whether shots can have such terms: none is below 0.
    pub(crate) fn are_sound(&self) -> bool {
        let terms = [
            self.normal_impulse,
            self.tangential_impulse,
            self.rebound,
            self.miss,
        ];
        terms.iter().all(|term| *term >= 0.0)
    }
}

/// Sums over shots from which the terms follow; those of several sets of shots add up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    weight: f64,
    missed: f64,
    /// First hits on target of shots that the jet fires.
    hits_of_jet: f64,
    /// Over those.
    normal: f64,
    /// Over all first hits on target.
    tangential: f64,
    rebound: f64,
    /// The largest part that one shot has in `missed`.
    worst_miss: f64,
    /// The largest part that one impact has in `rebound`.
    worst_rebound: f64,
}

impl Sums {
    /// The sums of both sets of shots.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            weight: self.weight + other.weight,
            missed: self.missed + other.missed,
            hits_of_jet: self.hits_of_jet + other.hits_of_jet,
            normal: self.normal + other.normal,
            tangential: self.tangential + other.tangential,
            rebound: self.rebound + other.rebound,
            worst_miss: self.worst_miss.max(other.worst_miss),
            worst_rebound: self.worst_rebound.max(other.worst_rebound),
        }
    }

    /// The terms, averaged as the objective says: rare violations over nominal and boundary samples with their
    /// importance weights, N* over nominal samples alone, which average it several times better.
    pub fn terms(&self, goals: &Goals) -> Terms {
        let tangential_weight = goals.tangential_impulse.map_or(0.0, |goal| goal.weight);
        let mean = |sum: f64, hits: f64| if hits > 0.0 { sum / hits } else { 0.0 };
        let hits = self.weight - self.missed;
        Terms {
            normal_impulse: goals.normal_impulse.weight * mean(self.normal, self.hits_of_jet),
            tangential_impulse: tangential_weight * mean(self.tangential, hits),
            rebound: self.rebound / self.weight,
            miss: goals.miss.weight * self.missed / self.weight,
        }
    }

    /// What one more of the worst events that were seen would add to the terms.
    pub fn one_more_of_the_worst(&self, goals: &Goals) -> Terms {
        Terms {
            rebound: self.worst_rebound / self.weight,
            miss: goals.miss.weight * self.worst_miss / self.weight,
            ..Terms::default()
        }
    }
}

#[cfg(test)]
mod tests;
