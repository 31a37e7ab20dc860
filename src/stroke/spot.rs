//! The spot: where the first hits of a nozzle that stands still fall.

use nalgebra::Vector3;

use crate::jet::{Pose, Replicates, purpose};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::trace::Tracer;

/// Where first hits on the target's surface fall while the nozzle stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// In which 95 % of them fall, along the jet's heading in the target's plane, m.
    pub length: f64,
    /// The same across it, m.
    pub width: f64,
    /// Its area, that of an ellipse, over that of the target; at most 1.
    pub share_of_target: f64,
    /// Where each of them is from the aim point, m.
    hits: Vec<Vector3<f64>>,
}

/// Shots that show it.
const SHOTS: usize = 2048;
/// Share of the hits that lies outside on either side.
const OUTSIDE: f64 = 0.025;
/// Hits without which there is no spot.
const FEWEST: usize = 40;

impl Spot {
    /// The spot of some settings, of a stroke in its middle; `None` where hardly any shot hits the target's surface.
    pub fn of(scenario: &Scenario, settings: &Settings) -> Option<Self> {
        let validation = Replicates::without_boundary(&scenario.problem, purpose::EVIDENCE, SHOTS);
        let mut standing = scenario.standing_at(0.0);
        standing.problem.paths.impacts = 1;
        let tracer = Tracer::new(&standing, settings, settings.speed);
        let target = &standing.target;
        let frame = target.frame;
        let hits = validation
            .sets
            .iter()
            .flat_map(|set| tracer.first_hits(&set.jet.shots));
        let hits: Vec<Vector3<f64>> = hits.flatten().map(|hit| hit.point - frame.aim).collect();
        if hits.len() < FEWEST {
            return None;
        }
        let pose = Pose::new(&frame, settings);
        let across = pose.side;
        let along = frame.normal.cross(&across);
        let mut spot = Self {
            length: 0.0,
            width: 0.0,
            share_of_target: 0.0,
            hits,
        };
        spot.length = spot.extent(&along);
        spot.width = spot.extent(&across);
        let area = std::f64::consts::FRAC_PI_4 * spot.length * spot.width;
        spot.share_of_target = (area / target.area).min(1.0);
        Some(spot)
    }

    /// In what length along a unit vector 95 % of the hits fall, m.
    fn extent(&self, along: &Vector3<f64>) -> f64 {
        let [low, high] = self.quantiles(along);
        high - low
    }

    /// How far from the aim point it reaches along a unit vector, m.
    pub fn reach(&self, along: &Vector3<f64>) -> f64 {
        let [_, high] = self.quantiles(along);
        high.max(0.0)
    }

    fn quantiles(&self, along: &Vector3<f64>) -> [f64; 2] {
        let mut places: Vec<f64> = self.hits.iter().map(|hit| hit.dot(along)).collect();
        let last = (places.len() - 1) as f64;
        [OUTSIDE, 1.0 - OUTSIDE].map(|share| {
            let index = (last * share).round() as usize;
            *places.select_nth_unstable_by(index, f64::total_cmp).1
        })
    }
}
