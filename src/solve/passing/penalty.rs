//! What violations cost in a search.

use std::iter::repeat;

use crate::evaluate::LargestImpulses;
use crate::scenario::{Scenario, Station};

/// What violations cost in a search.
#[derive(Clone)]
pub(in super::super) struct Penalty {
    /// J that a violation of 2, twice the share that is allowed, costs.
    pub price: f64,
    /// Share of what is allowed that the search allows, where shares are not corrected.
    pub slack: f64,
    /// Stations of a stroke at which nothing may be violated either.
    pub watched: Vec<Station>,
    /// What shares are corrected by, of the whole, then of each station.
    pub corrections: Vec<Corrections>,
}

/// What the shares on the shots of a search are multiplied by, in the order of the goals and limits; none where they
/// count as they are, less what they may be off.
pub(super) type Corrections = Vec<Option<f64>>;

impl Penalty {
    /// The whole, then what there is at each station.
    pub fn scenarios<'a>(&'a self, whole: &'a Scenario) -> impl Iterator<Item = &'a Scenario> {
        let stations = self.watched.iter().map(|station| &station.scenario);
        [whole].into_iter().chain(stations)
    }

    /// What the violations of the impulses of each scenario cost at a launch speed, m/s.
    pub fn cost(&self, whole: &Scenario, impulses: &[LargestImpulses], speed: f64) -> f64 {
        let scenarios = self.scenarios(whole).zip(impulses).enumerate();
        let violations = scenarios.flat_map(|(place, (scenario, impulses))| {
            let corrections = self.corrections.get(place).into_iter().flatten();
            let corrections = corrections.copied().chain(repeat(None));
            let shares = impulses.shares(scenario, speed).zip(corrections);
            shares.map(|(share, correction)| match correction {
                Some(correction) => share.corrected(correction),
                None => share.violation(self.slack),
            })
        });
        self.price * (violations.fold(0.0, f64::max) - 1.0).max(0.0)
    }

    /// All that it depends on, for checkpoints.
    pub fn numbers(&self) -> Vec<f64> {
        let watched = self.watched.iter().map(|station| station.place);
        let corrections = self.corrections.iter().flatten();
        let corrections = corrections.map(|correction| correction.unwrap_or(0.0));
        [self.price, self.slack]
            .into_iter()
            .chain(watched)
            .chain(corrections)
            .collect()
    }
}
