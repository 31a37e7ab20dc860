//! What every surface receives, in a record.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::evaluate::{Evaluation, Spread, SurfaceReceipt};
use crate::scenario::Scenario;

/// What the target receives by first hits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TargetRecord {
    /// Its surface.
    pub surface: String,
    /// Share of all shots that hit it first.
    pub share_on_target: f64,
    /// N*.
    #[serde(rename = "normal_impulse_N_s")]
    pub normal_impulse: SpreadRecord,
    /// f*.
    #[serde(rename = "tangential_impulse_N_s")]
    pub tangential_impulse: SpreadRecord,
    /// Share of those hits that stick.
    pub share_sticking: f64,
}

/// What a secondary surface receives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReceiptRecord {
    /// Share of all shots that hit it.
    pub share_of_shots: f64,
    /// Share of all shots with an impact over what it may take.
    pub share_over: f64,
    /// What it may take; absent when there is no limit.
    #[serde(rename = "allow_N_s")]
    pub allow: Option<f64>,
    /// N* of the impacts on it; absent when there is none.
    #[serde(rename = "normal_impulse_N_s")]
    pub normal_impulse: Option<SpreadRecord>,
    /// Impacts per shot by their number in the path: direct hits first.
    pub impacts_per_shot_by_number: Vec<f64>,
    /// The same for impacts over what it may take.
    pub over_per_shot_by_number: Vec<f64>,
}

/// Mean and range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpreadRecord {
    /// Mean.
    pub mean: f64,
    /// 5 % are below.
    pub low_5: f64,
    /// 95 % are below.
    pub high_95: f64,
    /// Largest.
    pub largest: f64,
}

impl TargetRecord {
    pub(super) fn new(scenario: &Scenario, evaluation: &Evaluation) -> Self {
        let target = &evaluation.target;
        Self {
            surface: scenario.scene.surfaces()[scenario.target.surface as usize].clone(),
            share_on_target: target.hits as f64 / evaluation.shots as f64,
            normal_impulse: target.normal_impulse.into(),
            tangential_impulse: target.tangential_impulse.into(),
            share_sticking: target.sticking as f64 / target.hits.max(1) as f64,
        }
    }
}

impl ReceiptRecord {
    fn new(receipt: &SurfaceReceipt, allow: Option<f64>, shots: usize) -> Self {
        let per_shot = |count: usize| count as f64 / shots as f64;
        let all = |counts: &[usize]| counts.iter().copied().map(per_shot).collect();
        Self {
            share_of_shots: per_shot(receipt.shots),
            share_over: per_shot(receipt.over),
            allow,
            normal_impulse: (receipt.shots > 0).then(|| receipt.normal_impulse.into()),
            impacts_per_shot_by_number: all(&receipt.impacts_by_number),
            over_per_shot_by_number: all(&receipt.over_by_number),
        }
    }
}

impl From<Spread> for SpreadRecord {
    fn from(spread: Spread) -> Self {
        Self {
            mean: spread.mean,
            low_5: spread.low,
            high_95: spread.high,
            largest: spread.largest,
        }
    }
}

/// Every secondary surface that was hit or has a limit; deflectors belong to the flight.
pub(super) fn receipts(
    scenario: &Scenario,
    evaluation: &Evaluation,
) -> BTreeMap<String, ReceiptRecord> {
    let names = scenario.scene.surfaces().iter();
    let surfaces = names.zip(&scenario.surfaces).zip(&evaluation.surfaces);
    surfaces
        .filter(|((_, limits), _)| !limits.deflector)
        .map(|((name, limits), receipt)| {
            let record = ReceiptRecord::new(receipt, limits.allow, evaluation.shots);
            (name.clone(), record)
        })
        .collect()
}
