//! The settings, their ranges, and how exactly a shop can set them.

use crate::units::{Dimension, degrees};

/// A closed interval in SI units; a single value is an interval of no width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lower end.
    pub min: f64,
    /// Upper end.
    pub max: f64,
}

impl Range {
    /// A setting that is held at one value.
    pub const fn held(value: f64) -> Self {
        Self {
            min: value,
            max: value,
        }
    }

    /// Whether there is nothing to search.
    pub fn is_held(self) -> bool {
        self.min == self.max
    }

    /// Upper minus lower end.
    pub fn width(self) -> f64 {
        self.max - self.min
    }

    /// The point at `fraction` (0 to 1) of the way.
    pub fn at(self, fraction: f64) -> f64 {
        // Exact at both ends; rounding leads out of no interval, not even of one without width.
        let value = self.min * (1.0 - fraction) + self.max * fraction;
        value.max(self.min).min(self.max)
    }

    /// Whether `value` lies in the interval.
    pub fn contains(self, value: f64) -> bool {
        self.min <= value && value <= self.max
    }
}

/// The table of settings: calls a macro with a row for each of them, in the order of the problem file. A row
/// has the variant of [`Setting`], the key in problem files, the key in results, the dimension, an attribute of the
/// latter key (results of older versions have no `aim_above_m`) and what it is.
macro_rules! for_each_setting {
    ($callback:ident) => {
        $callback! {
            Incidence incidence incidence_deg Angle []
                "Angle between the jet axis and the target plane, rad; pi/2 is perpendicular.",
            Azimuth azimuth azimuth_deg Angle []
                "Direction of the jet in the target plane, rad; 0 is along `target.along`.",
            Standoff standoff standoff_m Length []
                "Distance from the aim point back along the axis to the exit, m.",
            Speed speed speed_m_s Speed []
                "Speed of the shot at the exit, m/s.",
            AimAlong aim_along aim_along_m Length []
                "Shift of the aim point along azimuth 0, m.",
            AimAcross aim_across aim_across_m Length []
                "Shift of the aim point across it (along b = a x n), m.",
            AimAbove aim_above aim_above_m Length [serde(default)]
                "Shift of the aim point away from the target (along n), m.",
        }
    };
}
pub(crate) use for_each_setting;

impl SettingRanges {
    /// Whether any setting of the nozzle has a range.
    pub fn is_free(&self) -> bool {
        let ranges = Setting::OF_THE_NOZZLE.into_iter();
        let mut ranges = ranges.filter_map(|setting| self.range(setting));
        ranges.any(|range| !range.is_held())
    }
}

macro_rules! define_settings {
    ($($variant:ident $field:ident $key:ident $dimension:ident [$($serde:meta)?] $doc:literal,)+) => {
        /// The ranges that the search may use, in rad, m and m/s.
        #[derive(Clone, Debug, PartialEq)]
        pub struct SettingRanges {
            $(#[doc = $doc] pub $field: Range,)+
            /// Indices into the problem's contacts, in the order of the file.
            pub contact: Vec<usize>,
        }

        /// One value for every setting.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Settings {
            $(#[doc = $doc] pub $field: f64,)+
            /// Index into the problem's contacts.
            pub contact: usize,
            /// Static friction; matters only for a contact whose friction is tuned.
            pub static_friction: f64,
        }

        /// Half-widths of the box in which a shop really hits the settings asked for; 0 means exactly. They are
        /// in rad, m and, for the speed, relative to it.
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct Tolerance {
            $(#[doc = $doc] pub $field: f64,)+
            /// Absolute change of the coefficient of restitution; the result is kept within 0 to 1.
            pub restitution: f64,
            /// Relative change of both friction coefficients.
            pub friction: f64,
        }

        /// One of the settings that are numbers.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Setting {
            $(#[doc = $doc] $variant,)+
            /// Static friction, where a contact has a range of it.
            StaticFriction,
        }

        impl Setting {
            /// Those that say how the nozzle stands and shoots, in the order of the problem file.
            pub const OF_THE_NOZZLE: [Self; Self::ALL.len() - 1] = [$(Self::$variant),+];
            /// All of them.
            pub const ALL: [Self; [$(stringify!($field)),+].len() + 1] =
                [$(Self::$variant,)+ Self::StaticFriction];

            /// Its key in problem files and on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($field),)+
                    Self::StaticFriction => "mu_s",
                }
            }

            /// Its key in results, which ends with its unit.
            pub const fn record_key(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($key),)+
                    Self::StaticFriction => "mu_s",
                }
            }

            /// Its dimension; `None` for a plain number.
            pub const fn dimension(self) -> Option<Dimension> {
                match self {
                    $(Self::$variant => Some(Dimension::$dimension),)+
                    Self::StaticFriction => None,
                }
            }

            /// Its value in some settings, SI.
            pub const fn of(self, settings: &Settings) -> f64 {
                match self {
                    $(Self::$variant => settings.$field,)+
                    Self::StaticFriction => settings.static_friction,
                }
            }

            /// Some settings with another value of this one, SI.
            #[must_use]
            pub const fn with(self, settings: &Settings, value: f64) -> Settings {
                let mut changed = *settings;
                match self {
                    $(Self::$variant => changed.$field = value,)+
                    Self::StaticFriction => changed.static_friction = value,
                }
                changed
            }
        }

        impl Settings {
            /// All settings at 0, with the first contact.
            pub const ZERO: Self = Self { $($field: 0.0,)+ contact: 0, static_friction: 0.0 };
        }

        impl SettingRanges {
            /// The point at this share of all ranges, 0 to 1, with the first contact.
            pub fn at(&self, share: f64) -> Settings {
                Settings {
                    $($field: self.$field.at(share),)+
                    contact: self.contact.first().copied().unwrap_or_default(),
                    static_friction: 0.0,
                }
            }

            /// Sets the range of a setting of the nozzle; friction belongs to the contact.
            pub const fn set(&mut self, setting: Setting, range: Range) {
                match setting {
                    $(Setting::$variant => self.$field = range,)+
                    Setting::StaticFriction => {}
                }
            }

            /// The range of a setting of the nozzle; `None` for friction, which belongs to the contact.
            pub const fn range(&self, setting: Setting) -> Option<Range> {
                match setting {
                    $(Setting::$variant => Some(self.$field),)+
                    Setting::StaticFriction => None,
                }
            }
        }

        impl Tolerance {
            /// Half-width of a setting, SI; of the speed and of friction relative to them.
            pub const fn half_width(&self, setting: Setting) -> f64 {
                match setting {
                    $(Setting::$variant => self.$field,)+
                    Setting::StaticFriction => self.friction,
                }
            }
        }
    };
}
for_each_setting!(define_settings);

impl Setting {
    /// An SI value in the unit of results: deg for angles.
    pub fn to_record(self, value: f64) -> f64 {
        match self.dimension() {
            Some(Dimension::Angle) => degrees(value),
            _ => value,
        }
    }

    /// The SI value of one in the unit of results.
    pub fn from_record(self, value: f64) -> f64 {
        match self.dimension() {
            Some(Dimension::Angle) => value.to_radians(),
            _ => value,
        }
    }
}

impl Settings {
    /// All of them but the contact, for checksums.
    pub fn numbers(&self) -> [f64; Setting::ALL.len()] {
        Setting::ALL.map(|setting| setting.of(self))
    }
}

impl SettingRanges {
    /// Whether the jet always aims above the target: then it may run along it, or even away.
    pub fn aims_above(&self) -> bool {
        self.aim_above.min > 0.0
    }

    /// The middle of all ranges, with the first contact.
    pub fn middle(&self) -> Settings {
        self.at(0.5)
    }
}

impl Tolerance {
    /// Whether the nozzle may stand elsewhere than it is set.
    pub fn moves_nozzle(&self) -> bool {
        let moves = |setting: Setting| setting != Setting::Speed && self.half_width(setting) > 0.0;
        Setting::OF_THE_NOZZLE.into_iter().any(moves)
    }
}

#[cfg(test)]
mod tests;
