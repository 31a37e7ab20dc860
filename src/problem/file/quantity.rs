//! What the values of keys may be: quantities with a unit, numbers and counts, each type with its own range. The
//! check, the JSON Schema and the documentation take the range from here.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

use super::form;
use crate::problem::Limit;
use crate::units::Dimension;

/// The number behind a value, and what it may be.
pub(in crate::problem) trait Quantity: Copy {
    /// What it may be, in SI.
    const LIMIT: Limit;

    /// In SI.
    fn si(self) -> f64;
}

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident: $serde:literal $dimension:ident $limit:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Deserialize)]
        #[serde(rename = $serde)]
        pub(in crate::problem) struct $name(pub f64);

        impl Quantity for $name {
            const LIMIT: Limit = Limit::$limit;

            fn si(self) -> f64 {
                self.0
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                form::quantity(Dimension::$dimension, Self::LIMIT.expected)
            }
        }
    )*};
}

// The word is the name of the dimension, by which the reader knows that a unit belongs to the number.
quantities! {
    /// A length above 0, here in m.
    Length: "length" Length LENGTH;
    /// A length that may be 0, here in m.
    LengthOrZero: "length" Length LENGTH_OR_ZERO;
    /// A length in either direction, here in m.
    Shift: "length" Length SHIFT;
    /// An angle between jet and target, here in rad.
    Incidence: "angle" Angle INCIDENCE;
    /// The same for a jet that may run along the target.
    IncidenceOrZero: "angle" Angle INCIDENCE_OR_ZERO;
    /// An angle up to a turn in either direction, here in rad.
    Turn: "angle" Angle TURN;
    /// An angle of many turns, here in rad.
    Turns: "angle" Angle TURNS;
    /// An angle up to a turn, here in rad.
    AngleOrZero: "angle" Angle ANGLE_OR_ZERO;
    /// A change of an angle that is worth programming, here in rad.
    AngleStep: "angle" Angle ANGLE_STEP;
    /// The half-angle of a cone, here in rad.
    Divergence: "angle" Angle DIVERGENCE;
    /// The standard deviation of tilts, here in rad.
    Roughness: "angle" Angle ROUGHNESS;
    /// A speed, here in m/s.
    Speed: "speed" Speed SPEED;
    /// An impulse, here in N s.
    Impulse: "impulse" Impulse IMPULSE;
    /// A density, here in kg/m3.
    Density: "density" Density DENSITY;
    /// A mass flow, here in kg/s.
    MassFlow: "mass flow" MassFlow MASS_FLOW;
    /// A pressure, here in Pa.
    Pressure: "pressure" Pressure PRESSURE;
    /// A hardness, here in Pa.
    Hardness: "hardness" Hardness HARDNESS;
    /// The standard deviation of what stays above 0 when it is cut at two, as a fraction of the mean.
    Spread: "percentage" Fraction SPREAD;
    /// A share of a whole, as a fraction of 1.
    Share: "percentage" Fraction SHARE;
    /// A share that leaves something, as a fraction of 1.
    BelowAll: "percentage" Fraction BELOW_ALL;
    /// An accuracy, as a fraction of 1.
    Accuracy: "percentage" Fraction ACCURACY;
    /// How far something may be off, as a fraction of it.
    Deviation: "percentage" Fraction DEVIATION;
    /// What coverage is wanted, as a fraction of 1; above 1 it is how often.
    Wanted: "percentage" Fraction WANTED;
}

macro_rules! numbers {
    ($($(#[$doc:meta])* $name:ident: $kind:ty, $limit:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Deserialize)]
        pub(in crate::problem) struct $name(pub $kind);

        impl Quantity for $name {
            const LIMIT: Limit = Limit::$limit;

            fn si(self) -> f64 {
                self.0 as f64
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                form::number(<$kind>::json_schema(generator), &Self::LIMIT)
            }
        }
    )*};
}

numbers! {
    /// A coefficient of friction.
    Friction: f64, FRICTION;
    /// A number of a whole.
    Fraction: f64, FRACTION;
    /// The same, or its negative.
    SignedFraction: f64, SIGNED_FRACTION;
    /// A weight in the objective.
    Weight: f64, WEIGHT;
    /// Impacts of a path.
    Impacts: u64, IMPACTS;
    /// Stations of a stroke.
    Stations: u64, STATIONS;
}
