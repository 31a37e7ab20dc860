//! A problem file as it was written: one type per group of keys, one field per key.
//!
//! Plain data. Quantities are in SI already; what they mean together is checked elsewhere.

pub(super) mod equipment;
pub(super) mod scene;
pub(super) mod settings;

use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};

use equipment::{
    ContactEntry, CoverageEntry, JetEntry, NozzleEntry, PathsEntry, ShotEntry, SurfaceEntry,
};
use scene::{PartEntry, TargetEntry};
use settings::{GoalsEntry, OneOrMany, SettingsEntry, SolveEntry, ToleranceEntry};

use super::field::Field;

/// A problem file, format 1.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct ProblemFile {
    /// Version of the file format: 1.
    pub format: Field<u64>,
    /// What the problem is about; the name of the file where absent.
    pub title: Field<String>,
    /// Unit of coordinate lists and mesh files; needed when there are any.
    pub lengths_in: Field<LengthUnit>,
    /// Named parts.
    pub scene: Field<Named<PartEntry>>,
    /// What is to be peened.
    pub target: Field<TargetEntry>,
    /// The shot.
    pub shot: Field<ShotEntry>,
    /// How the shots leave the nozzle.
    pub jet: Field<JetEntry>,
    /// The body that carries the jet; none where absent.
    pub nozzle: Field<NozzleEntry>,
    /// Named friction choices.
    pub contacts: Field<Named<ContactEntry>>,
    /// A range is searched, a single value is held.
    pub settings: Field<SettingsEntry>,
    /// What must be reached and what must not happen.
    pub goals: Field<GoalsEntry>,
    /// Where one surface, `part.surface`, differs from the others.
    pub surfaces: Field<Named<SurfaceEntry>>,
    /// When a path ends.
    pub paths: Field<PathsEntry>,
    /// What is to be said about coverage; nothing where absent.
    pub coverage: Field<CoverageEntry>,
    /// How exactly a shop sets the settings: half-widths.
    pub tolerance: Field<ToleranceEntry>,
    /// Which effects are modelled: `auto`, `full` or a list; `auto` where absent.
    pub model: Field<OneOrMany>,
    /// How the answer is searched.
    pub solve: Field<SolveEntry>,
}

/// Three coordinates in `lengths_in`, or a direction.
pub(super) type Triple = [Field<f64>; 3];

/// Two coordinates in `lengths_in`.
pub(super) type Pair = [Field<f64>; 2];

/// A length with its unit, such as `0.5 mm`; here in m.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename = "length")]
pub(super) struct Length(pub f64);

/// An angle with its unit, such as `60 deg`; here in rad.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename = "angle")]
pub(super) struct Angle(pub f64);

/// A speed with its unit, such as `10 m/s`; here in m/s.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename = "speed")]
pub(super) struct Speed(pub f64);

/// An impulse with its unit, such as `40 uN.s`; here in N s.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename = "impulse")]
pub(super) struct Impulse(pub f64);

/// A density with its unit, such as `7000 kg/m3`; here in kg/m3.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename = "density")]
pub(super) struct Density(pub f64);

/// A mass flow with its unit, such as `5 kg/min`; here in kg/s.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename = "mass flow")]
pub(super) struct MassFlow(pub f64);

/// A pressure with its unit, such as `3 bar`; here in Pa.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename = "pressure")]
pub(super) struct Pressure(pub f64);

/// A percentage, such as `5 %`; here as a fraction of 1.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename = "percentage")]
pub(super) struct Percentage(pub f64);

/// The number behind a quantity.
pub(super) trait Quantity: Copy {
    /// In SI.
    fn si(self) -> f64;
}

macro_rules! quantities {
    ($($name:ident)*) => {$(
        impl Quantity for $name {
            fn si(self) -> f64 {
                self.0
            }
        }
    )*};
}

quantities! { Length Angle Speed Impulse Density MassFlow Pressure Percentage }

impl Quantity for f64 {
    fn si(self) -> f64 {
        self
    }
}

/// The unit of bare coordinates.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) enum LengthUnit {
    #[serde(rename = "um")]
    Micrometre,
    #[serde(rename = "mm")]
    Millimetre,
    #[serde(rename = "cm")]
    Centimetre,
    #[serde(rename = "m")]
    Metre,
    #[serde(rename = "in")]
    Inch,
}

impl LengthUnit {
    /// Its name in the file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Micrometre => "um",
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
            Self::Inch => "in",
        }
    }
}

/// Names with a value each, in the order of the file.
#[derive(Clone, Debug)]
pub(super) struct Named<T>(pub Vec<(String, Field<T>)>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NamedVisitor<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for NamedVisitor<T> {
            type Value = Named<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("names with a value each")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named<T>, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Named(entries))
            }
        }

        deserializer.deserialize_map(NamedVisitor(PhantomData))
    }
}
