//! Windows in a record.

use serde::{Deserialize, Serialize};

use super::answer::subject_name;
use crate::scenario::Scenario;
use crate::solve::{Drift, Turn, Window};

/// How far one setting may drift alone before a verdict turns; deg for angles, else SI.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindowRecord {
    /// Key of the setting, with its unit.
    pub setting: String,
    /// Downwards.
    pub down: DriftRecord,
    /// Upwards.
    pub up: DriftRecord,
}

/// How far it may drift one way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DriftRecord {
    /// The last value at which no verdict has turned.
    pub to: f64,
    /// Width of the interval beyond in which the turn lies; 0 when none turned.
    pub within: f64,
    /// What turns: a goal, a surface, `clearance` or `free_space`; absent at the end of the setting's range.
    pub turns: Option<String>,
}

impl WindowRecord {
    /// The record of a window.
    pub fn new(scenario: &Scenario, window: &Window) -> Self {
        let setting = window.setting;
        let drift = |drift: &Drift| DriftRecord {
            to: setting.to_record(drift.to),
            within: setting.to_record(drift.within),
            turns: drift.turns.map(|turn| match turn {
                Turn::Verdict(subject) => subject_name(scenario, subject),
                Turn::Clearance => "clearance".into(),
                Turn::FreeSpace => "free_space".into(),
            }),
        };
        Self {
            setting: setting.record_key().into(),
            down: drift(&window.down),
            up: drift(&window.up),
        }
    }
}
