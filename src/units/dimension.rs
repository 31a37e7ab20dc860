//! What can be measured, and in which units.

use super::tidy::{POINTS, SLASHES, tidy};

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
pub(super) enum Scale {
    /// Shifts the decimal point, so that `0.5 mm` is exactly the number 0.0005.
    Shift(i32),
    /// Multiplies.
    Factor(f64),
}

use Scale::{Factor, Shift};

pub(super) type Unit = (&'static str, Scale);

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

    pub(super) const fn units(self) -> &'static [Unit] {
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
    pub(super) const fn signs(self) -> &'static [Unit] {
        match self {
            Self::Length => LENGTH_SIGNS,
            Self::Angle => ANGLE_SIGNS,
            _ => &[],
        }
    }

    pub(super) const fn article(self) -> &'static str {
        match self {
            Self::Angle | Self::Impulse => "an",
            _ => "a",
        }
    }

    /// What a unit is worth; `unit` is tidy.
    pub(super) fn scale(self, unit: &str) -> Option<Scale> {
        let unit = plain_spelling(unit);
        let mut known = self.units().iter().chain(self.signs());
        known
            .find(|(name, _)| *name == unit)
            .map(|(_, scale)| *scale)
    }

    /// How `number` was probably meant.
    pub(super) fn completed(self, number: &str) -> String {
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

/// The unit as the tables have it: `µN s`, `uN·s` and `uNs` are `uN.s`, `kg / m^3` is `kg/m3`.
pub(super) fn plain_spelling(unit: &str) -> String {
    let signs: String = tidy(unit)
        .replace("^3", "3")
        .chars()
        .map(|c| match c {
            'µ' | 'μ' => 'u',
            '³' => '3',
            _ if POINTS.contains(c) => '.',
            _ if SLASHES.contains(c) => '/',
            other => other,
        })
        .collect();
    let mut plain = String::new();
    for word in signs.split(' ').filter(|word| !word.is_empty()) {
        // A blank means a point, unless a sign is beside it.
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
