//! `settings`, `goals`, `tolerance` and `solve`, as written.

use schemars::JsonSchema;
use serde::Deserialize;

use super::quantity::{
    Accuracy, AngleOrZero, BelowAll, Deviation, Fraction, Impulse, IncidenceOrZero, Length,
    LengthOrZero, Share, Shift, Speed, Turn, Weight,
};

use crate::problem::field::{Field, Needed};

/// A single value, which is held, or a range, which is searched.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename = "a single value or a range `[min, max]`")]
#[schemars(rename = "OneOrRange_{T}", untagged, inline)]
pub(in crate::problem) enum OneOrRange<T> {
    /// Held.
    #[serde(rename = "scalar")]
    One(T),
    /// Searched.
    #[serde(rename = "list")]
    Range([Field<T>; 2]),
}

/// One name or several.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename = "a name or a list of names")]
#[schemars(rename = "OneOrMany", untagged, inline)]
pub(in crate::problem) enum OneOrMany {
    /// A single one.
    #[serde(rename = "scalar")]
    One(String),
    /// Several.
    #[serde(rename = "list")]
    Many(Vec<Field<String>>),
}

/// What may be chosen. A range `[min, max]` is searched, a single value is held.
///
/// ```yaml
/// settings:
///   incidence: [30 deg, 85 deg]
///   azimuth: 0 deg
///   standoff: [6 mm, 20 mm]
///   speed: [5 m/s, 40 m/s]
///   contact: [dry, oiled]
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct SettingsEntry {
    /// Angle between jet axis and target plane, 90 deg being perpendicular;
    /// 0 deg, along the target, only where all of `aim_above` is above 0 mm.
    #[schemars(example = ["30 deg", "85 deg"])]
    pub incidence: Needed<OneOrRange<IncidenceOrZero>>,
    /// Direction of the jet in the target's plane, at most a full turn wide;
    /// 0 deg is along `target.along`.
    #[schemars(example = ["-90 deg", "90 deg"])]
    pub azimuth: Needed<OneOrRange<Turn>>,
    /// From the aim point back along the axis to the exit.
    #[schemars(example = ["6 mm", "20 mm"])]
    pub standoff: Needed<OneOrRange<Length>>,
    /// Speed of the shot at the exit.
    #[schemars(example = ["5 m/s", "40 m/s"])]
    pub speed: Needed<OneOrRange<Speed>>,
    /// Moves the aim point along azimuth 0.
    #[schemars(example = ["-2 mm", "2 mm"], extend("default" = "0 mm"))]
    pub aim_along: Field<OneOrRange<Shift>>,
    /// Moves it across, along azimuth 90 deg.
    #[schemars(example = &"0.5 mm", extend("default" = "0 mm"))]
    pub aim_across: Field<OneOrRange<Shift>>,
    /// Moves it away from the target, along its normal: a jet at 0 deg runs parallel to the target
    /// at this height.
    #[schemars(example = &"6 mm", extend("default" = "0 mm"))]
    pub aim_above: Field<OneOrRange<Shift>>,
    /// The contacts that may be chosen; all of them where absent.
    #[schemars(example = ["dry", "oiled"])]
    pub contact: Field<OneOrMany>,
}

/// What must be reached and what must not happen. `weight` is that of the goal in the objective;
/// verdicts do not depend on it.
///
/// ```yaml
/// goals:
///   normal_impulse: { target: 40 uN.s, tolerance: 15 %, share: 5 %, weight: 1 }
///   tangential_impulse: { limit: 8 uN.s, share: 5 %, weight: 1 }
///   rebound: { allow: 10 uN.s, share: 1 %, weight: 0.5 }
///   miss: { share: 1 %, weight: 2 }
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct GoalsEntry {
    /// First hits on the target shall give this normal impulse.
    pub normal_impulse: Needed<NormalImpulseEntry>,
    /// First hits on the target shall not give more tangential impulse; no limit where absent.
    pub tangential_impulse: Field<TangentialImpulseEntry>,
    /// What other surfaces may take; no limit where absent.
    pub rebound: Field<ReboundEntry>,
    /// Shots whose first hit is not on the target; the defaults of its keys where absent.
    pub miss: Field<MissEntry>,
}

/// First hits on the target shall give this normal impulse.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct NormalImpulseEntry {
    /// The impulse.
    #[schemars(example = &"40 uN.s")]
    pub target: Needed<Impulse>,
    /// A first hit on target breaks the goal when it is off by more.
    #[schemars(example = &"15 %", extend("default" = "10 %"))]
    pub tolerance: Field<Deviation>,
    /// Share of the first hits on target that may break it.
    #[schemars(example = &"2 %", extend("default" = "5 %"))]
    pub share: Field<Share>,
    /// Weight in the objective.
    #[schemars(example = 0.5, extend("default" = 1))]
    pub weight: Field<Weight>,
}

/// First hits on the target shall not give more tangential impulse.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct TangentialImpulseEntry {
    /// The limit.
    #[schemars(example = &"8 uN.s")]
    pub limit: Needed<Impulse>,
    /// Share of the first hits on target that may break it.
    #[schemars(example = &"2 %", extend("default" = "5 %"))]
    pub share: Field<Share>,
    /// Weight in the objective.
    #[schemars(example = 0.5, extend("default" = 1))]
    pub weight: Field<Weight>,
}

/// What other surfaces than the target may take. [`surfaces`](#surfaces) says where one of them
/// differs.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct ReboundEntry {
    /// Normal impulse of one impact on any of them.
    #[schemars(example = &"10 uN.s")]
    pub allow: Needed<Impulse>,
    /// Share of all shots that may break it on each surface.
    #[schemars(example = &"0.5 %", extend("default" = "1 %"))]
    pub share: Field<Share>,
    /// Weight in the objective.
    #[schemars(example = 0.5, extend("default" = 1))]
    pub weight: Field<Weight>,
}

/// Shots whose first hit is not on the target.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct MissEntry {
    /// Share of all shots that may miss.
    #[schemars(example = &"2 %", extend("default" = "1 %"))]
    pub share: Field<Share>,
    /// Weight in the objective.
    #[schemars(example = 2, extend("default" = 1))]
    pub weight: Field<Weight>,
}

/// How exactly a shop sets what the sheet says: half-widths. Every shot is fired from its own setting
/// within that box, so the answer is best for what will really be set. With one for `restitution`
/// or `friction` the sheet says which of the two moves the result most.
///
/// A half-width may be at most half the range that is searched, and neither incidence nor standoff
/// may reach 0 (the incidence may where `aim_above` lets it be 0).
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct ToleranceEntry {
    /// Of the incidence.
    #[schemars(example = &"2 deg", extend("default" = "0 deg"))]
    pub incidence: Field<AngleOrZero>,
    /// Of the azimuth.
    #[schemars(example = &"2 deg", extend("default" = "0 deg"))]
    pub azimuth: Field<AngleOrZero>,
    /// Of the standoff.
    #[schemars(example = &"1 mm", extend("default" = "0 mm"))]
    pub standoff: Field<LengthOrZero>,
    /// Of the speed, relative.
    #[schemars(example = &"3 %", extend("default" = "0 %"))]
    pub speed: Field<BelowAll>,
    /// Of the aim point along azimuth 0.
    #[schemars(example = &"0.5 mm", extend("default" = "0 mm"))]
    pub aim_along: Field<LengthOrZero>,
    /// Of the aim point across it.
    #[schemars(example = &"0.5 mm", extend("default" = "0 mm"))]
    pub aim_across: Field<LengthOrZero>,
    /// Of the aim point away from the target.
    #[schemars(example = &"0.5 mm", extend("default" = "0 mm"))]
    pub aim_above: Field<LengthOrZero>,
    /// Of the coefficient of restitution, absolute; the result is kept within 0 to 1. Of one that
    /// falls with speed it shifts `value`, which is E at the speed `at`: E at other speeds shifts in proportion.
    #[schemars(example = 0.1, extend("default" = 0))]
    pub restitution: Field<Fraction>,
    /// Of both friction coefficients at once, relative.
    #[schemars(example = &"20 %", extend("default" = "0 %"))]
    pub friction: Field<BelowAll>,
}

/// How the answer is searched.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct SolveEntry {
    /// Accuracy of the objective. The search ends when validation shots confirm it.
    /// `--accuracy` overrides it.
    #[schemars(example = &"0.5 %", extend("default" = "1 %"))]
    pub accuracy: Field<Accuracy>,
    /// Seed of every sample. `--seed` overrides it.
    #[schemars(example = 2, extend("default" = 1))]
    pub seed: Field<u64>,
}
