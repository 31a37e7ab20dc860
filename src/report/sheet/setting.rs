//! One setting: what it is called, its unit, and how it is rounded.

use crate::elementary::whole_power;
use crate::record::{DriftRecord, RangeRecord, Record, SettingsRecord, WindowRecord};
use crate::report::number::{fixed, plain};

/// A setting that is a number.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// What people call it.
    pub name: &'static str,
    /// Its key in a record.
    pub key: &'static str,
    /// Unit on the sheet.
    pub unit: &'static str,
    /// Units on the sheet for one in the record.
    scale: f64,
    /// Fewest decimals shown.
    pub decimals: usize,
    /// Its value in a record.
    of: fn(&SettingsRecord) -> f64,
}

/// All settings, in the order of the problem file.
pub const SETTINGS: [Setting; 7] = [
    Setting {
        name: "incidence",
        key: "incidence_deg",
        unit: "deg",
        scale: 1.0,
        decimals: 1,
        of: |settings| settings.incidence_deg,
    },
    Setting {
        name: "azimuth",
        key: "azimuth_deg",
        unit: "deg",
        scale: 1.0,
        decimals: 1,
        of: |settings| settings.azimuth_deg,
    },
    Setting {
        name: "standoff",
        key: "standoff_m",
        unit: "mm",
        scale: 1e3,
        decimals: 1,
        of: |settings| settings.standoff_m,
    },
    Setting {
        name: "speed",
        key: "speed_m_s",
        unit: "m/s",
        scale: 1.0,
        decimals: 2,
        of: |settings| settings.speed_m_s,
    },
    Setting {
        name: "aim_along",
        key: "aim_along_m",
        unit: "mm",
        scale: 1e3,
        decimals: 2,
        of: |settings| settings.aim_along_m,
    },
    Setting {
        name: "aim_across",
        key: "aim_across_m",
        unit: "mm",
        scale: 1e3,
        decimals: 2,
        of: |settings| settings.aim_across_m,
    },
    Setting {
        name: "aim_above",
        key: "aim_above_m",
        unit: "mm",
        scale: 1e3,
        decimals: 2,
        of: |settings| settings.aim_above_m,
    },
];

/// Most decimals shown.
const MOST_DECIMALS: usize = 4;
/// A step of the last decimal is no larger than this part of the window.
const ROUNDING: f64 = 0.1;

/// A setting and its window in the unit of the sheet, all with the same decimals.
pub struct Shown {
    /// The value.
    pub value: String,
    /// Lower end of the window, rounded inwards.
    pub low: String,
    /// Upper end of the window, rounded inwards.
    pub high: String,
}

impl Setting {
    /// Units on the sheet for one in the record.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Its value in the unit of the sheet.
    pub fn value(&self, settings: &SettingsRecord) -> f64 {
        (self.of)(settings) * self.scale
    }

    /// Its value as text, without its unit.
    pub fn text(&self, settings: &SettingsRecord) -> String {
        fixed(self.value(settings), self.decimals)
    }

    /// The range that was asked for.
    pub fn range<'a>(&self, record: &'a Record) -> Option<&'a RangeRecord> {
        let mut ranges = record.problem.ranges.iter();
        ranges.find(|range| range.setting == self.key)
    }

    /// Its window, if there is one.
    pub fn window<'a>(&self, record: &'a Record) -> Option<&'a WindowRecord> {
        let mut windows = record.windows.iter();
        windows.find(|window| window.setting == self.key)
    }

    /// How exactly a shop sets it, with its unit; `None` for exactly.
    pub fn tolerance(&self, record: &Record) -> Option<String> {
        let (value, unit) = self.set_within(record);
        (value > 0.0).then(|| format!("+-{} {unit}", plain(value)))
    }

    /// How exactly a shop sets it, half-width in the unit of the sheet.
    pub fn half_width(&self, record: &Record) -> f64 {
        match self.set_within(record) {
            (percent, "%") => percent / 100.0 * self.value(&record.best.settings),
            (value, _) => value,
        }
    }

    fn set_within(&self, record: &Record) -> (f64, &'static str) {
        let tolerance = &record.problem.tolerance;
        match self.key {
            "incidence_deg" => (tolerance.incidence_deg, self.unit),
            "azimuth_deg" => (tolerance.azimuth_deg, self.unit),
            "standoff_m" => (tolerance.standoff_m * self.scale, self.unit),
            "speed_m_s" => (tolerance.speed * 100.0, "%"),
            "aim_along_m" => (tolerance.aim_along_m * self.scale, self.unit),
            "aim_across_m" => (tolerance.aim_across_m * self.scale, self.unit),
            _ => (tolerance.aim_above_m * self.scale, self.unit),
        }
    }

    /// Whether the sheet has to mention it: aim offsets only where they are used.
    pub fn is_used(&self, record: &Record) -> bool {
        let is_aim = self.key.starts_with("aim");
        let is_open = self
            .range(record)
            .is_some_and(|range| range.min < range.max);
        !is_aim || is_open || self.value(&record.best.settings) != 0.0
    }

    /// Value and window as texts; the ends are rounded inwards, with as many decimals as it takes
    /// to keep the rounded value between them.
    pub fn shown(&self, record: &Record) -> Shown {
        let value = self.value(&record.best.settings);
        let Some(window) = self.window(record) else {
            return Shown {
                value: self.text(&record.best.settings),
                low: String::new(),
                high: String::new(),
            };
        };
        let (low, high) = (window.down.to * self.scale, window.up.to * self.scale);
        let end = |drift: &DriftRecord, inwards: f64, decimals: usize| match drift.turns {
            Some(_) => fixed(inwards, decimals),
            None => plain(drift.to * self.scale),
        };
        let mut decimals = self.decimals;
        loop {
            let step = whole_power(0.1, decimals as i32);
            let [shown, down, up] = [
                (value / step).round(),
                (low / step - 1e-6).ceil(),
                (high / step + 1e-6).floor(),
            ];
            let fine = step <= (high - low) * ROUNDING && down <= shown && shown <= up;
            if fine || decimals >= MOST_DECIMALS {
                return Shown {
                    value: fixed(value, decimals),
                    low: end(&window.down, down * step, decimals),
                    high: end(&window.up, up * step, decimals),
                };
            }
            decimals += 1;
        }
    }

    /// The ends of the window at which something turns.
    pub fn edges<'a>(&self, record: &'a Record) -> Vec<Edge<'a>> {
        let Some(window) = self.window(record) else {
            return Vec::new();
        };
        let shown = self.shown(record);
        let width = self
            .range(record)
            .map_or(0.0, |range| (range.max - range.min) * self.scale);
        let value = self.value(&record.best.settings);
        let edge = |drift: &'a DriftRecord, at: String, way: &'static str| {
            let turns = drift.turns.as_deref()?;
            let distance = (drift.to * self.scale - value).abs();
            Some(Edge {
                turns,
                at: format!("{} {way} {at} {}", self.name, self.unit),
                setting: self.name,
                distance: fixed(distance, fraction_digits(&at)) + " " + self.unit,
                of_range: if width > 0.0 { distance / width } else { 1.0 },
            })
        };
        [
            edge(&window.down, shown.low, "below"),
            edge(&window.up, shown.high, "above"),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}

fn fraction_digits(text: &str) -> usize {
    text.split_once('.').map_or(0, |(_, digits)| digits.len())
}

/// An end of a window at which something turns.
pub struct Edge<'a> {
    /// What turns: a goal, a surface or `clearance`.
    pub turns: &'a str,
    /// Where, as in `speed above 9.71 m/s`.
    pub at: String,
    /// Name of the setting.
    pub setting: &'static str,
    /// How far away, with its unit.
    pub distance: String,
    /// The same relative to the range that is searched.
    pub of_range: f64,
}

impl Edge<'_> {
    /// Where, without the name of the setting: `above 9.71 m/s`.
    pub fn side(&self) -> &str {
        self.at
            .strip_prefix(self.setting)
            .map_or(self.at.as_str(), str::trim_start)
    }
}
