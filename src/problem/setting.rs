//! What may be chosen: the settings, their ranges, and how exactly a shop can set them.

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

/// The ranges that the search may use, in rad, m and m/s.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingRanges {
    /// Angle between the jet axis and the target plane, rad; pi/2 is perpendicular.
    pub incidence: Range,
    /// Direction of the jet in the target plane, rad, 0 along `target.along`.
    pub azimuth: Range,
    /// Distance from the aim point back along the axis to the exit, m.
    pub standoff: Range,
    /// Speed of the shot at the exit, m/s.
    pub speed: Range,
    /// Shift of the aim point along azimuth 0, m.
    pub aim_along: Range,
    /// Shift of the aim point across it (along b = a x n), m.
    pub aim_across: Range,
    /// Shift of the aim point away from the target (along n), m.
    pub aim_above: Range,
    /// Indices into the problem's contacts, in the order of the file.
    pub contact: Vec<usize>,
}

/// One value for every setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Angle between the jet axis and the target plane, rad.
    pub incidence: f64,
    /// Direction of the jet in the target plane, rad.
    pub azimuth: f64,
    /// Distance from the aim point back along the axis to the exit, m.
    pub standoff: f64,
    /// Speed of the shot at the exit, m/s.
    pub speed: f64,
    /// Shift of the aim point along azimuth 0, m.
    pub aim_along: f64,
    /// Shift of the aim point across it, m.
    pub aim_across: f64,
    /// Shift of the aim point away from the target, m.
    pub aim_above: f64,
    /// Index into the problem's contacts.
    pub contact: usize,
    /// Static friction; matters only for a contact whose friction is tuned.
    pub static_friction: f64,
}

impl Settings {
    /// All of them but the contact, for checksums.
    pub fn numbers(&self) -> [f64; 8] {
        let Self {
            incidence,
            azimuth,
            standoff,
            speed,
            aim_along,
            aim_across,
            aim_above,
            contact: _,
            static_friction,
        } = *self;
        [
            incidence,
            azimuth,
            standoff,
            speed,
            aim_along,
            aim_across,
            aim_above,
            static_friction,
        ]
    }
}

/// One of the settings that are numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Setting {
    /// See [`Settings::incidence`].
    Incidence,
    /// See [`Settings::azimuth`].
    Azimuth,
    /// See [`Settings::standoff`].
    Standoff,
    /// See [`Settings::speed`].
    Speed,
    /// See [`Settings::aim_along`].
    AimAlong,
    /// See [`Settings::aim_across`].
    AimAcross,
    /// See [`Settings::aim_above`].
    AimAbove,
    /// See [`Settings::static_friction`].
    StaticFriction,
}

impl Setting {
    /// Those that say how the nozzle stands and shoots, in the order of the problem file.
    pub const OF_THE_NOZZLE: [Self; 7] = [
        Self::Incidence,
        Self::Azimuth,
        Self::Standoff,
        Self::Speed,
        Self::AimAlong,
        Self::AimAcross,
        Self::AimAbove,
    ];

    /// Its key in problem files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Incidence => "incidence",
            Self::Azimuth => "azimuth",
            Self::Standoff => "standoff",
            Self::Speed => "speed",
            Self::AimAlong => "aim_along",
            Self::AimAcross => "aim_across",
            Self::AimAbove => "aim_above",
            Self::StaticFriction => "mu_s",
        }
    }

    /// Its value in some settings, SI.
    pub const fn of(self, settings: &Settings) -> f64 {
        match self {
            Self::Incidence => settings.incidence,
            Self::Azimuth => settings.azimuth,
            Self::Standoff => settings.standoff,
            Self::Speed => settings.speed,
            Self::AimAlong => settings.aim_along,
            Self::AimAcross => settings.aim_across,
            Self::AimAbove => settings.aim_above,
            Self::StaticFriction => settings.static_friction,
        }
    }

    /// The choice with this setting at another value, SI.
    #[must_use]
    pub const fn with(self, settings: &Settings, value: f64) -> Settings {
        let mut changed = *settings;
        match self {
            Self::Incidence => changed.incidence = value,
            Self::Azimuth => changed.azimuth = value,
            Self::Standoff => changed.standoff = value,
            Self::Speed => changed.speed = value,
            Self::AimAlong => changed.aim_along = value,
            Self::AimAcross => changed.aim_across = value,
            Self::AimAbove => changed.aim_above = value,
            Self::StaticFriction => changed.static_friction = value,
        }
        changed
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

    /// The point at this share of all ranges, 0 to 1, with the first contact.
    pub fn at(&self, share: f64) -> Settings {
        Settings {
            incidence: self.incidence.at(share),
            azimuth: self.azimuth.at(share),
            standoff: self.standoff.at(share),
            speed: self.speed.at(share),
            aim_along: self.aim_along.at(share),
            aim_across: self.aim_across.at(share),
            aim_above: self.aim_above.at(share),
            contact: self.contact.first().copied().unwrap_or_default(),
            static_friction: 0.0,
        }
    }

    /// The range of a setting of the nozzle; `None` for friction, which belongs to the contact.
    pub const fn range(&self, setting: Setting) -> Option<Range> {
        match setting {
            Setting::Incidence => Some(self.incidence),
            Setting::Azimuth => Some(self.azimuth),
            Setting::Standoff => Some(self.standoff),
            Setting::Speed => Some(self.speed),
            Setting::AimAlong => Some(self.aim_along),
            Setting::AimAcross => Some(self.aim_across),
            Setting::AimAbove => Some(self.aim_above),
            Setting::StaticFriction => None,
        }
    }
}

/// Half-widths of the box in which a shop really hits the settings asked for; 0 means exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tolerance {
    /// rad.
    pub incidence: f64,
    /// rad.
    pub azimuth: f64,
    /// m.
    pub standoff: f64,
    /// m.
    pub aim_along: f64,
    /// m.
    pub aim_across: f64,
    /// m.
    pub aim_above: f64,
    /// Relative.
    pub speed: f64,
    /// Absolute change of the coefficient of restitution; the result is kept within 0 to 1.
    pub restitution: f64,
    /// Relative change of both friction coefficients.
    pub friction: f64,
}

impl Tolerance {
    /// Whether the nozzle may stand elsewhere than it is set.
    pub fn moves_nozzle(&self) -> bool {
        let errors = [
            self.incidence,
            self.azimuth,
            self.standoff,
            self.aim_along,
            self.aim_across,
            self.aim_above,
        ];
        errors.iter().any(|&error| error > 0.0)
    }
}

#[cfg(test)]
mod tests;
