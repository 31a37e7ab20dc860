//! The unit of bare coordinates.

use nalgebra::Point3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::digits::coordinate;
use crate::elementary::log10;
use crate::units::{self, Dimension};

/// The unit of a file's coordinates, in which places are told as well.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(inline)]
#[expect(
    missing_docs,
    reason = "their names say it, and the schema would list them one by one"
)]
pub enum LengthUnit {
    #[serde(rename = "um")]
    Micrometre,
    #[default]
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

    /// A bare length in metres, through the same door as `0.5 mm`; infinite where that overflows.
    pub fn metres(self, value: f64) -> f64 {
        let written = format!("{value} {}", self.name());
        units::parse(Dimension::Length, &written).unwrap_or(f64::INFINITY)
    }

    /// A point, m, in this unit: `[0.000, 18.300, 4.000] mm`.
    pub fn point(self, point: &Point3<f64>) -> String {
        let [x, y, z] = [point.x, point.y, point.z].map(|it| self.text(it));
        format!("[{x}, {y}, {z}] {}", self.name())
    }

    /// A coordinate, m, in this unit but without its name, to a micrometre or a tenth of that.
    pub fn text(self, length: f64) -> String {
        let unit = self.metres(1.0);
        let decimals = log10(unit * 1e6).ceil().max(0.0) as usize;
        coordinate(length / unit, decimals)
    }
}
