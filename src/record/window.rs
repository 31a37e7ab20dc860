//! Windows in a record.

use serde::{Deserialize, Serialize};

use super::answer::subject_name;
use crate::problem::setting::Setting;
use crate::setup::Setup;
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
    /// What turns: a goal, a surface or `clearance`; absent at the end of the setting's range.
    pub turns: Option<String>,
}

impl WindowRecord {
    /// The record of a window.
    pub fn new(setup: &Setup, window: &Window) -> Self {
        let (unit, scale) = match window.setting {
            Setting::Incidence | Setting::Azimuth => ("deg", 1_f64.to_degrees()),
            Setting::Speed => ("m_s", 1.0),
            Setting::Standoff | Setting::AimAlong | Setting::AimAcross => ("m", 1.0),
            Setting::StaticFriction => ("", 1.0),
        };
        let drift = |drift: &Drift| DriftRecord {
            to: drift.to * scale,
            within: drift.within * scale,
            turns: drift.turns.map(|turn| match turn {
                Turn::Verdict(subject) => subject_name(setup, subject),
                Turn::Clearance => "clearance".into(),
            }),
        };
        Self {
            setting: format!("{}_{unit}", window.setting.name()),
            down: drift(&window.down),
            up: drift(&window.up),
        }
    }
}
