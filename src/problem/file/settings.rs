//! `settings`, `goals`, `tolerance` and `solve`, as written.

use serde::Deserialize;

use super::{Angle, Impulse, Length, Percentage, Speed};
use crate::problem::field::Field;

/// A single value, which is held, or a range, which is searched.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "a single value or a range `[min, max]`")]
pub(in crate::problem) enum OneOrRange<T> {
    /// Held.
    #[serde(rename = "scalar")]
    One(T),
    /// Searched.
    #[serde(rename = "list")]
    Range([Field<T>; 2]),
}

/// One name or several.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "a name or a list of names")]
pub(in crate::problem) enum OneOrMany {
    /// A single one.
    #[serde(rename = "scalar")]
    One(String),
    /// Several.
    #[serde(rename = "list")]
    Many(Vec<Field<String>>),
}

/// What may be chosen.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct SettingsEntry {
    /// Angle between jet axis and target plane; 90 deg is perpendicular.
    pub incidence: Field<OneOrRange<Angle>>,
    /// Direction of the jet in the target plane; 0 deg is along `target.along`.
    pub azimuth: Field<OneOrRange<Angle>>,
    /// From the aim point back along the axis to the exit.
    pub standoff: Field<OneOrRange<Length>>,
    /// Speed of the shot at the exit.
    pub speed: Field<OneOrRange<Speed>>,
    /// Shift of the aim point along azimuth 0; held at 0 mm where absent.
    pub aim_along: Field<OneOrRange<Length>>,
    /// Shift of the aim point across it; held at 0 mm where absent.
    pub aim_across: Field<OneOrRange<Length>>,
    /// Shift of the aim point away from the target; held at 0 mm where absent.
    pub aim_above: Field<OneOrRange<Length>>,
    /// Which contacts may be chosen; all of them where absent.
    pub contact: Field<OneOrMany>,
}

/// What must be reached and what must not happen.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct GoalsEntry {
    /// First hits on the target shall give this normal impulse.
    pub normal_impulse: Field<NormalImpulseEntry>,
    /// First hits on the target shall not give more tangential impulse; no limit where absent.
    pub tangential_impulse: Field<TangentialImpulseEntry>,
    /// What other surfaces may take; no limit where absent.
    pub rebound: Field<ReboundEntry>,
    /// Shots whose first hit is not on the target.
    pub miss: Field<MissEntry>,
}

/// First hits on the target shall give this normal impulse.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct NormalImpulseEntry {
    /// The impulse.
    pub target: Field<Impulse>,
    /// Deviation from which a shot breaks the goal; 10 % where absent.
    pub tolerance: Field<Percentage>,
    /// Share of the first hits on target that may break it; 5 % where absent.
    pub share: Field<Percentage>,
    /// Weight in the objective; 1 where absent.
    pub weight: Field<f64>,
}

/// First hits on the target shall not give more tangential impulse.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct TangentialImpulseEntry {
    /// The limit.
    pub limit: Field<Impulse>,
    /// Share of the first hits on target that may break it; 5 % where absent.
    pub share: Field<Percentage>,
    /// Weight in the objective; 1 where absent.
    pub weight: Field<f64>,
}

/// What other surfaces may take.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct ReboundEntry {
    /// Normal impulse of one impact.
    pub allow: Field<Impulse>,
    /// Share of all shots that may break it on each surface; 1 % where absent.
    pub share: Field<Percentage>,
    /// Weight in the objective; 1 where absent.
    pub weight: Field<f64>,
}

/// Shots whose first hit is not on the target.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct MissEntry {
    /// Share of all shots that may miss; 1 % where absent.
    pub share: Field<Percentage>,
    /// Weight in the objective; 1 where absent.
    pub weight: Field<f64>,
}

/// How exactly a shop sets the settings: half-widths, exact where absent.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct ToleranceEntry {
    /// Of the incidence.
    pub incidence: Field<Angle>,
    /// Of the azimuth.
    pub azimuth: Field<Angle>,
    /// Of the standoff.
    pub standoff: Field<Length>,
    /// Of the speed, relative.
    pub speed: Field<Percentage>,
    /// Of the aim point along azimuth 0.
    pub aim_along: Field<Length>,
    /// Of the aim point across it.
    pub aim_across: Field<Length>,
    /// Of the aim point away from the target.
    pub aim_above: Field<Length>,
    /// Of the coefficient of restitution, absolute.
    pub restitution: Field<f64>,
    /// Of both friction coefficients, relative.
    pub friction: Field<Percentage>,
}

/// How the answer is searched.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct SolveEntry {
    /// Accuracy of the objective; 1 % where absent.
    pub accuracy: Field<Percentage>,
    /// Seed of every sample; 1 where absent.
    pub seed: Field<u64>,
}
