//! What those do that are not known exactly, at the ends of their ranges, in a record.

use serde::{Deserialize, Serialize};

use super::answer::subject_name;
use crate::scenario::Scenario;
use crate::units::degrees;
use crate::unknowns::{Outcome, Quantity, UnknownRange, Unknowns};

/// See [`Unknowns`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnknownsRecord {
    /// With all at their nominal values.
    pub nominal: OutcomeRecord,
    /// One for each that is not known exactly.
    pub ranges: Vec<UnknownRangeRecord>,
}

/// See [`UnknownRange`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnknownRangeRecord {
    /// `restitution`, `friction` or `walls`.
    pub quantity: QuantityRecord,
    /// Restitution, or static friction, at the target; how far walls are on the near side of the triangles, m.
    pub low: f64,
    /// What that does.
    pub at_low: OutcomeRecord,
    /// The same at the other end.
    pub high: f64,
    /// What that does.
    pub at_high: OutcomeRecord,
}

/// See [`Quantity`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum QuantityRecord {
    /// The normal coefficient of restitution.
    Restitution,
    /// Both friction coefficients at once.
    Friction,
    /// How far the walls are on the near side of the triangles that approximate them, m.
    Walls,
}

/// See [`Outcome`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutcomeRecord {
    /// J.
    pub objective: f64,
    /// Mean angle between path and surface after first hits on target, deg; absent without any.
    pub rebound_angle_deg: Option<f64>,
    /// Mean N* of first hits on target.
    #[serde(rename = "normal_impulse_N_s")]
    pub normal_impulse: f64,
    /// The share of shots over each limit.
    pub shares: Vec<ShareRecord>,
}

/// The share of shots over a limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShareRecord {
    /// The goal, or the full name of the surface.
    pub subject: String,
    /// Share of shots that break it.
    pub share: f64,
}

impl UnknownsRecord {
    /// The record of what was evaluated.
    pub fn new(scenario: &Scenario, unknowns: &Unknowns) -> Self {
        Self {
            nominal: OutcomeRecord::new(scenario, &unknowns.nominal),
            ranges: unknowns
                .ranges
                .iter()
                .map(|range| UnknownRangeRecord::new(scenario, range))
                .collect(),
        }
    }
}

impl UnknownRangeRecord {
    fn new(scenario: &Scenario, range: &UnknownRange) -> Self {
        let [(low, at_low), (high, at_high)] = &range.ends;
        Self {
            quantity: match range.quantity {
                Quantity::Restitution => QuantityRecord::Restitution,
                Quantity::Friction => QuantityRecord::Friction,
                Quantity::Walls => QuantityRecord::Walls,
            },
            low: *low,
            at_low: OutcomeRecord::new(scenario, at_low),
            high: *high,
            at_high: OutcomeRecord::new(scenario, at_high),
        }
    }
}

impl OutcomeRecord {
    fn new(scenario: &Scenario, effect: &Outcome) -> Self {
        Self {
            objective: effect.objective,
            rebound_angle_deg: effect.rebound_angle.map(degrees),
            normal_impulse: effect.normal_impulse,
            shares: effect
                .shares
                .iter()
                .map(|(subject, share)| ShareRecord {
                    subject: subject_name(scenario, *subject),
                    share: *share,
                })
                .collect(),
        }
    }
}
