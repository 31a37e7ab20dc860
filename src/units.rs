//! Quantities as people write them, `0.5 mm`, turned into SI: the only conversions there are.
//!
//! ```
//! use peenpose::units::{Dimension, parse};
//!
//! assert_eq!(parse(Dimension::Length, "0.5 mm"), Ok(0.0005));
//! assert_eq!(
//!     parse(Dimension::Speed, "0.5 mm").unwrap_err().to_string(),
//!     "`0.5 mm` is a length; expected a speed such as `10 m/s`"
//! );
//! ```

mod fault;
mod pattern;
#[cfg(test)]
mod tests;
mod tidy;

pub use fault::UnitFault;

use tidy::tidy;

/// What kind of quantity a value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// In m.
    Length,
    /// In rad.
    Angle,
    /// In m/s.
    Speed,
    /// In N s.
    Impulse,
    /// In kg/m3.
    Density,
    /// In kg/s.
    MassFlow,
    /// In Pa.
    Pressure,
    /// Of Brinell, as a pressure in Pa.
    Hardness,
    /// A percentage, as a fraction of 1.
    Fraction,
}

/// How a unit leads to SI.
#[derive(Clone, Copy)]
enum Scale {
    /// Shifts the decimal point, so that `0.5 mm` is exactly the number 0.0005.
    Shift(i32),
    /// Multiplies.
    Factor(f64),
}

use Scale::{Factor, Shift};

type Unit = (&'static str, Scale);

/// A pound in kg, a foot and an inch in m, all exact.
const POUND: f64 = 0.453_592_37;
const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

// Each list is in the order of messages.
const LENGTHS: &[Unit] = &[
    ("um", Shift(-6)),
    ("mm", Shift(-3)),
    ("cm", Shift(-2)),
    ("m", Shift(0)),
    ("in", Factor(INCH)),
    ("inch", Factor(INCH)),
    ("mil", Factor(INCH / 1000.0)),
    ("thou", Factor(INCH / 1000.0)),
    ("ft", Factor(FOOT)),
];
const ANGLES: &[Unit] = &[("deg", Factor(DEGREE)), ("rad", Shift(0))];
const SPEEDS: &[Unit] = &[
    ("m/s", Shift(0)),
    ("mm/s", Shift(-3)),
    ("m/min", Factor(1.0 / 60.0)),
    ("km/h", Factor(1.0 / 3.6)),
    ("ft/s", Factor(FOOT)),
    ("fps", Factor(FOOT)),
    ("ft/min", Factor(FOOT / 60.0)),
    ("in/s", Factor(INCH)),
];
const IMPULSES: &[Unit] = &[
    ("N.s", Shift(0)),
    ("mN.s", Shift(-3)),
    ("uN.s", Shift(-6)),
    ("nN.s", Shift(-9)),
];
const DENSITIES: &[Unit] = &[
    ("kg/m3", Shift(0)),
    ("g/cm3", Shift(3)),
    ("g/cc", Shift(3)),
    ("kg/dm3", Shift(3)),
    ("lb/ft3", Factor(POUND / (FOOT * FOOT * FOOT))),
    ("lb/in3", Factor(POUND / (INCH * INCH * INCH))),
];
const MASS_FLOWS: &[Unit] = &[
    ("kg/min", Factor(1.0 / 60.0)),
    ("kg/s", Shift(0)),
    ("kg/h", Factor(1.0 / 3600.0)),
    ("g/s", Shift(-3)),
    ("g/min", Factor(1e-3 / 60.0)),
    ("lb/min", Factor(POUND / 60.0)),
    ("lb/h", Factor(POUND / 3600.0)),
];
const PRESSURES: &[Unit] = &[
    ("bar", Shift(5)),
    ("kPa", Shift(3)),
    ("MPa", Shift(6)),
    ("Pa", Shift(0)),
    // A pound-force on a square inch.
    ("psi", Factor(POUND * 9.806_65 / (INCH * INCH))),
];
/// A kilogram-force on a square millimetre.
const HARDNESSES: &[Unit] = &[("HB", Factor(9.806_65e6)), ("HBW", Factor(9.806_65e6))];
const FRACTIONS: &[Unit] = &[("%", Shift(-2))];

// Signs in the place of units, which messages do not list.
const LENGTH_SIGNS: &[Unit] = &[
    ("\"", Factor(INCH)),
    ("″", Factor(INCH)),
    ("”", Factor(INCH)),
    ("'", Factor(FOOT)),
    ("′", Factor(FOOT)),
    ("’", Factor(FOOT)),
];
const ANGLE_SIGNS: &[Unit] = &[
    ("°", Factor(DEGREE)),
    ("º", Factor(DEGREE)),
    ("'", Factor(DEGREE / 60.0)),
    ("′", Factor(DEGREE / 60.0)),
    ("’", Factor(DEGREE / 60.0)),
];

impl Dimension {
    /// Every dimension.
    pub const ALL: [Self; 9] = [
        Self::Length,
        Self::Angle,
        Self::Speed,
        Self::Impulse,
        Self::Density,
        Self::MassFlow,
        Self::Pressure,
        Self::Hardness,
        Self::Fraction,
    ];

    /// Its name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Angle => "angle",
            Self::Speed => "speed",
            Self::Impulse => "impulse",
            Self::Density => "density",
            Self::MassFlow => "mass flow",
            Self::Pressure => "pressure",
            Self::Hardness => "hardness",
            Self::Fraction => "percentage",
        }
    }

    /// What is expected, with an example: "a length such as `0.5 mm`".
    pub const fn described(self) -> &'static str {
        match self {
            Self::Length => "a length such as `0.5 mm`",
            Self::Angle => "an angle such as `60 deg`",
            Self::Speed => "a speed such as `10 m/s`",
            Self::Impulse => "an impulse such as `40 uN.s`",
            Self::Density => "a density such as `7000 kg/m3`",
            Self::MassFlow => "a mass flow such as `5 kg/min`",
            Self::Pressure => "a pressure such as `3 bar`",
            Self::Hardness => "a hardness such as `300 HB`",
            Self::Fraction => "a percentage such as `5 %`",
        }
    }

    /// The units that it may be written in.
    pub fn unit_names(self) -> impl Iterator<Item = &'static str> {
        self.units().iter().map(|(name, _)| *name)
    }

    const fn units(self) -> &'static [Unit] {
        match self {
            Self::Length => LENGTHS,
            Self::Angle => ANGLES,
            Self::Speed => SPEEDS,
            Self::Impulse => IMPULSES,
            Self::Density => DENSITIES,
            Self::MassFlow => MASS_FLOWS,
            Self::Pressure => PRESSURES,
            Self::Hardness => HARDNESSES,
            Self::Fraction => FRACTIONS,
        }
    }

    /// Signs that it may be written with in the place of a unit.
    const fn signs(self) -> &'static [Unit] {
        match self {
            Self::Length => LENGTH_SIGNS,
            Self::Angle => ANGLE_SIGNS,
            _ => &[],
        }
    }

    const fn article(self) -> &'static str {
        match self {
            Self::Angle | Self::Impulse => "an",
            _ => "a",
        }
    }

    /// What a unit is worth; `unit` is tidy.
    fn scale(self, unit: &str) -> Option<Scale> {
        let unit = plain_spelling(unit);
        let mut known = self.units().iter().chain(self.signs());
        known
            .find(|(name, _)| *name == unit)
            .map(|(_, scale)| *scale)
    }

    /// How `number` was probably meant.
    fn completed(self, number: &str) -> String {
        let usual = match self {
            Self::Length => "mm",
            Self::Angle => "deg",
            Self::Speed => "m/s",
            Self::Impulse => "uN.s",
            Self::Density => "kg/m3",
            Self::MassFlow => "kg/min",
            Self::Pressure => "bar",
            Self::Hardness => "HB",
            Self::Fraction => "%",
        };
        match number.parse::<f64>() {
            Ok(value) if self == Self::Fraction && value.abs() < 1.0 => {
                // To four digits, as 0.07 times 100 is not quite 7.
                format!("{} {usual}", (value * 1e6).round() / 1e4)
            }
            _ => format!("{number} {usual}"),
        }
    }
}

/// Reads a number with its unit, such as `0.5 mm`, as a value in SI.
///
/// # Errors
/// A [`UnitFault`] when there is no number, no unit, or a unit of something else.
pub fn parse(dimension: Dimension, text: &str) -> Result<f64, UnitFault> {
    let written = text.trim();
    let text = &*tidy(text);
    let Some((number, unit)) = split_number(text) else {
        return Err(UnitFault::NotANumber {
            text: shortened(written),
            dimension,
        });
    };
    if unit.is_empty() {
        return Err(UnitFault::MissingUnit {
            number: shortened(number),
            dimension,
        });
    }
    let Some(scale) = dimension.scale(unit) else {
        let other = Dimension::ALL
            .into_iter()
            .find(|other| other.scale(unit).is_some());
        return Err(match other {
            Some(found) => UnitFault::WrongDimension {
                text: shortened(text),
                found,
                dimension,
            },
            None => UnitFault::UnknownUnit {
                unit: shortened(unit),
                dimension,
            },
        });
    };
    let value = match scale {
        Shift(places) => shifted(number, places),
        Factor(factor) => shifted(number, 0) * factor,
    };
    if value.is_finite() {
        Ok(value)
    } else {
        Err(UnitFault::TooLarge {
            text: shortened(text),
            dimension,
        })
    }
}

/// An angle in degrees for people and files, rounded to 1e-10 deg: 60 deg that became radians
/// comes back as 60.
pub fn degrees(radians: f64) -> f64 {
    const DIGITS: f64 = 1e10;
    (radians.to_degrees() * DIGITS).round() / DIGITS
}

/// Reads a bare number in decimal notation; neither `1_000` nor `0x10` nor `inf` is one.
pub fn parse_number(text: &str) -> Option<f64> {
    match split_number(&tidy(text))? {
        (number, "") => Some(shifted(number, 0)),
        _ => None,
    }
}

/// Splits `0.5 mm` into its number and its unit, which may be empty.
fn split_number(text: &str) -> Option<(&str, &str)> {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));

    let mut end = sign(0);
    let whole = digits(end);
    end += whole;
    let mut fraction = 0;
    if bytes.get(end) == Some(&b'.') {
        fraction = digits(end + 1);
        end += 1 + fraction;
    }
    if whole + fraction == 0 {
        return None;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = end + 1 + sign(end + 1);
        let length = digits(exponent.min(bytes.len()));
        if length > 0 {
            end = exponent + length;
        }
    }
    let (number, unit) = text.split_at(end);
    // `1_000`, `0x10`, `1,5`, `1.2.3`, `4-5` and `1 000` are mistakes in the number, not in the unit.
    // An apostrophe alone is a unit.
    let thousands = unit.starts_with('\'') && unit.len() > 1;
    let broken = thousands || unit.starts_with(['_', ',', '.', 'x']);
    let unit = unit.trim_start();
    let goes_on = unit.starts_with(|c: char| c.is_ascii_digit() || "+-±".contains(c));
    (!broken && !goes_on).then_some((number, unit))
}

/// The number times 10^places, as exactly as the decimal text allows.
fn shifted(number: &str, places: i32) -> f64 {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let exponent = exponent.parse::<i32>().unwrap_or_else(|_| {
        // Beyond 32 bits every exponent means zero or infinity.
        if exponent.starts_with('-') {
            -1_000_000
        } else {
            1_000_000
        }
    });
    let exponent = exponent.saturating_add(places);
    format!("{mantissa}e{exponent}").parse().unwrap_or(f64::NAN)
}

/// The unit as the tables have it: `µN s`, `uN·s` and `uNs` are `uN.s`, `kg / m^3` is `kg/m3`.
fn plain_spelling(unit: &str) -> String {
    let signs: String = tidy(unit)
        .replace("^3", "3")
        .chars()
        .map(|c| match c {
            'µ' | 'μ' => 'u',
            '³' => '3',
            _ if tidy::POINTS.contains(c) => '.',
            _ if tidy::SLASHES.contains(c) => '/',
            other => other,
        })
        .collect();
    let mut plain = String::new();
    for word in signs.split(' ').filter(|word| !word.is_empty()) {
        // A blank stands for a point, unless a sign is beside it.
        let is_beside =
            plain.is_empty() || plain.ends_with(['/', '.']) || word.starts_with(['/', '.']);
        plain.push_str(if is_beside { "" } else { "." });
        plain.push_str(word);
    }
    match plain.strip_suffix("Ns") {
        Some(prefix) => format!("{prefix}N.s"),
        None => plain,
    }
}

/// What was written, short enough for a message.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut short: String = text
        .chars()
        .take(LONGEST)
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push('…');
    }
    short
}
