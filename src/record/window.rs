//! Windows in a record.

use serde::{Deserialize, Serialize};

use super::answer::subject_name;
use crate::problem::setting::Setting;
use crate::scenario::Scenario;
use crate::solve::{Drift, Turn, Window};
use crate::units::degrees;

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
        let (key, shown) = key_and_unit(window.setting);
        let drift = |drift: &Drift| DriftRecord {
            to: shown(drift.to),
            within: shown(drift.within),
            turns: drift.turns.map(|turn| match turn {
                Turn::Verdict(subject) => subject_name(scenario, subject),
                Turn::Clearance => "clearance".into(),
                Turn::FreeSpace => "free_space".into(),
            }),
        };
        Self {
            setting: key,
            down: drift(&window.down),
            up: drift(&window.up),
        }
    }
}

/// The key of a setting with its unit, and how an SI value is written in that unit.
pub(super) fn key_and_unit(setting: Setting) -> (String, fn(f64) -> f64) {
    let (unit, shown): (_, fn(f64) -> f64) = match setting {
        Setting::Incidence | Setting::Azimuth => ("_deg", degrees),
        Setting::Speed => ("_m_s", |value| value),
        Setting::Standoff | Setting::AimAlong | Setting::AimAcross | Setting::AimAbove => {
            ("_m", |value| value)
        }
        Setting::StaticFriction => ("", |value| value),
    };
    (format!("{}{unit}", setting.name()), shown)
}
