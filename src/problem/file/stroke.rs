//! `stroke`, as written.

use std::fmt;

use schemars::JsonSchema;
use serde::de::{Deserializer, Visitor};
use serde::{Deserialize, de};
use serde_json::json;

use super::quantity::{AngleStep, Length, Shift, Speed, Stations, Turns};
use super::settings::OneOrMany;
use super::{Triple, form};
use crate::problem::field::{Field, Needed};

/// The nozzle travels while it peens: the aim point runs along a line over the target, which is the whole
/// feature, and the settings hold all along. Verdicts and clearance are those of the worst place.
///
/// ```yaml
/// stroke:
///   along: { from: [0, 18.3, 4], to: [0, 18.3, 36] }
///   stations: 9
///   hold: all
/// # or
/// stroke:
///   around: { axis: z, from: 0 deg, to: 3600 deg, pitch: 2 mm }
///   feed: 30 rpm
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(extend("oneOf" = form::exactly_one_of(&Self::LINES)))]
pub(in crate::problem) struct StrokeEntry {
    /// Straight from one point of the target to another.
    pub along: Field<AlongEntry>,
    /// From point to point of the target, at least two.
    #[schemars(length(min = 2), example = json!([[0, 18.3, 4], [0, 18.3, 36]]))]
    pub points: Field<Vec<Field<Triple>>>,
    /// Round an axis, as over a part that turns.
    pub around: Field<AroundEntry>,
    /// Stations at which it is verified at least.
    #[schemars(example = 9, extend("default" = 9))]
    pub stations: Field<Stations>,
    /// What the machine cannot change under way: `all`, `none`, or a list of settings.
    #[schemars(example = ["azimuth", "standoff", "contact"], extend("default" = "all"))]
    pub hold: Field<OneOrMany>,
    /// The smallest change of a setting that is worth programming, for what is not held; any change where absent.
    pub steps: Field<StepsEntry>,
    /// How fast the spot travels over the part: `auto`, as fast as `coverage.wanted` lets it, which needs
    /// [`coverage`](#coverage) and `jet.mass_flow`; a speed; or for a part that turns its turns, such as `30 rpm`.
    #[schemars(with = "Field<form::FeedText>", example = &"5 mm/s", extend("default" = "auto"))]
    pub feed: Field<Choice>,
    /// How often it goes over the target; `auto` is as often as the feed needs.
    #[schemars(with = "Field<form::PassesText>", example = 2, extend("default" = "auto"))]
    pub passes: Field<Choice>,
    /// How far the aim point travels beyond both ends: `auto`, at each end as far as the spot reaches if coverage is
    /// asked for and nothing forbids it, or a length from 0 mm to 1000 m.
    #[schemars(with = "Field<form::RunOutText>", example = &"3 mm", extend("default" = "auto"))]
    pub run_out: Field<Choice>,
}

impl StrokeEntry {
    /// The keys of which one must be there.
    pub const LINES: [&str; 3] = ["along", "points", "around"];
}

/// A straight line.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct AlongEntry {
    /// Where it begins: a point of the target.
    #[schemars(example = json!([0, 18.3, 4]))]
    pub from: Needed<Triple>,
    /// Where it ends.
    #[schemars(example = json!([0, 18.3, 36]))]
    pub to: Needed<Triple>,
}

/// A helix round an axis. Its middle is `target.aim`; in the part's coordinates it is the nozzle that goes round.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct AroundEntry {
    /// The axis: `x`, `y` or `z`.
    #[schemars(example = &"z")]
    pub axis: Needed<AxisEntry>,
    /// A point of the axis; the origin where absent.
    #[schemars(example = json!([0, 0, 0]))]
    pub through: Field<Triple>,
    /// The first angle.
    #[schemars(example = &"0 deg")]
    pub from: Needed<Turns>,
    /// The last angle, larger than the first.
    #[schemars(example = &"3600 deg")]
    pub to: Needed<Turns>,
    /// How far it moves along the axis in a turn.
    #[schemars(example = &"2 mm", extend("default" = "0 mm"))]
    pub pitch: Field<Shift>,
}

/// An axis of the scene.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
pub(in crate::problem) enum AxisEntry {
    /// x.
    X,
    /// y.
    Y,
    /// z.
    Z,
}

/// The smallest changes that are worth programming.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct StepsEntry {
    /// Of the incidence; any change where absent.
    #[schemars(example = &"1 deg")]
    pub incidence: Field<AngleStep>,
    /// Of the azimuth; any change where absent.
    #[schemars(example = &"1 deg")]
    pub azimuth: Field<AngleStep>,
    /// Of the standoff; any change where absent.
    #[schemars(example = &"0.5 mm")]
    pub standoff: Field<Length>,
    /// Of the speed; any change where absent.
    #[schemars(example = &"0.5 m/s")]
    pub speed: Field<Speed>,
    /// Of the shift along azimuth 0; any change where absent.
    #[schemars(example = &"0.5 mm")]
    pub aim_along: Field<Length>,
    /// Of the shift across it; any change where absent.
    #[schemars(example = &"0.5 mm")]
    pub aim_across: Field<Length>,
    /// Of the shift away from the target; any change where absent.
    #[schemars(example = &"0.5 mm")]
    pub aim_above: Field<Length>,
}

/// A word or a value, as it is written.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::problem) enum Choice {
    /// A word, or a number with a unit.
    Text(String),
    /// A plain number.
    Number(f64),
}

impl<'de> Deserialize<'de> for Choice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ChoiceVisitor;

        impl Visitor<'_> for ChoiceVisitor {
            type Value = Choice;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("`auto` or a value")
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Choice, E> {
                Ok(Choice::Text(text.trim().to_owned()))
            }

            fn visit_f64<E: de::Error>(self, number: f64) -> Result<Choice, E> {
                Ok(Choice::Number(number))
            }
        }

        deserializer.deserialize_any(ChoiceVisitor)
    }
}
