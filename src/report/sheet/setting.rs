//! One setting: what it is called, its unit, and how it is rounded.

use crate::digits;
use crate::elementary::whole_power;
use crate::problem::setting;
use crate::record::{
    DriftRecord, RangeRecord, Record, SettingsRecord, ToleranceRecord, WindowRecord,
};
use crate::report::number::{coordinate, decimals_for, fixed, plain};
use crate::units::Dimension;

/// A setting that is a number, as the sheet shows it.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    of: setting::Setting,
    /// What people call it.
    pub name: &'static str,
    /// Its key in a record.
    pub key: &'static str,
    /// Unit on the sheet.
    pub unit: &'static str,
    /// Units on the sheet for one in the record.
    scale: f64,
    /// Fewest decimals shown, where five digits allow them.
    pub decimals: usize,
}

/// All settings of the nozzle, in the order of the problem file.
pub const SETTINGS: [Setting; setting::Setting::OF_THE_NOZZLE.len()] = {
    macro_rules! shown {
        ($($variant:ident $field:ident $key:ident $dimension:ident [$($serde:meta)?] $doc:literal,)+) => {
            [$(Setting::new(setting::Setting::$variant)),+]
        };
    }
    setting::for_each_setting!(shown)
};

/// A step of the last decimal is no larger than this part of the window.
const ROUNDING: f64 = 0.1;
/// Digits beyond the usual five for a window that is narrower than these show.
const FURTHER: usize = 4;

/// What a setting shows for its value where that makes no difference.
const ANY: &str = "any";
/// From here on the jet is perpendicular to the target, deg.
const PERPENDICULAR: f64 = 90.0 - 1e-7;

/// A setting and its window in the unit of the sheet, all with the same decimals.
pub struct Shown {
    /// The value; `any` where it makes no difference.
    pub value: String,
    /// Lower end of the window, rounded inwards; empty without a window.
    pub low: String,
    /// Upper end of the window, rounded inwards; empty without a window.
    pub high: String,
}

impl Shown {
    /// The window with its unit: `10 to 20 mm`, or `exactly 12 mm` where it has no width.
    pub fn window(&self, unit: &str) -> String {
        if self.low == self.high {
            format!("exactly {} {unit}", self.low)
        } else {
            format!("{} to {} {unit}", self.low, self.high)
        }
    }
}

impl Setting {
    const fn new(of: setting::Setting) -> Self {
        let (unit, scale) = match of.dimension() {
            Some(Dimension::Angle) => ("deg", 1.0),
            Some(Dimension::Length) => ("mm", 1e3),
            Some(_) => ("m/s", 1.0),
            None => ("", 1.0),
        };
        let is_coarse = matches!(
            of,
            setting::Setting::Incidence | setting::Setting::Azimuth | setting::Setting::Standoff
        );
        Self {
            of,
            name: of.name(),
            key: of.record_key(),
            unit,
            scale,
            decimals: if is_coarse { 1 } else { 2 },
        }
    }

    /// Units on the sheet for one in the record.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Its value in a record, in the unit of its key.
    pub fn in_record(&self, settings: &SettingsRecord) -> f64 {
        settings.get(self.of).unwrap_or_default()
    }

    /// Its value in the unit of the sheet.
    pub fn value(&self, settings: &SettingsRecord) -> f64 {
        self.in_record(settings) * self.scale
    }

    /// Its value as text, without its unit; `any` where it makes no difference.
    pub fn text(&self, settings: &SettingsRecord) -> String {
        if self.is_any_at(settings) {
            return ANY.into();
        }
        fixed(self.value(settings), self.decimals)
    }

    /// The same with its unit.
    pub fn text_with_unit(&self, settings: &SettingsRecord) -> String {
        match self.text(settings) {
            text if text == ANY => text,
            text => format!("{text} {}", self.unit),
        }
    }

    /// The unit behind its value.
    pub fn unit_of(&self, record: &Record) -> &'static str {
        if self.is_any(record) { "" } else { self.unit }
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
        self.half_width_at(self.value(&record.best.settings), &record.problem.tolerance)
    }

    fn set_within(&self, record: &Record) -> (f64, &'static str) {
        let half_width = record.problem.tolerance.half_width(self.of);
        match self.of {
            setting::Setting::Speed => (half_width * 100.0, "%"),
            _ => (half_width * self.scale, self.unit),
        }
    }

    /// How exactly a shop sets it, half-width in the unit of the sheet, round a value in that unit.
    pub fn half_width_at(&self, value: f64, tolerance: &ToleranceRecord) -> f64 {
        let half_width = tolerance.half_width(self.of);
        match self.of {
            setting::Setting::Speed => half_width * value,
            _ => half_width * self.scale,
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

    /// Whether its value makes no difference: the azimuth of a jet that is perpendicular to the
    /// target, unless the window says otherwise.
    pub fn is_any(&self, record: &Record) -> bool {
        let turns =
            |window: &WindowRecord| window.down.turns.is_some() || window.up.turns.is_some();
        self.is_any_at(&record.best.settings) && !self.window(record).is_some_and(turns)
    }

    /// The same by the settings alone.
    pub fn is_any_at(&self, settings: &SettingsRecord) -> bool {
        self.key == "azimuth_deg" && settings.incidence_deg >= PERPENDICULAR
    }

    /// Value and window as texts. The ends are rounded inwards, with as many decimals as it takes
    /// for the value to stand between them; a window without width is the value itself.
    pub fn shown(&self, record: &Record) -> Shown {
        let settings = &record.best.settings;
        let Some(window) = self.window(record) else {
            return Shown {
                value: self.text(settings),
                low: String::new(),
                high: String::new(),
            };
        };
        let mut shown = self.shown_in(self.value(settings), window);
        if self.is_any(record) {
            shown.value = ANY.into();
        }
        shown
    }

    fn shown_in(&self, value: f64, window: &WindowRecord) -> Shown {
        let [low, high] = [&window.down, &window.up].map(|end| end.to * self.scale);
        let largest = value.abs().max(low.abs()).max(high.abs());
        let usual = decimals_for(largest, digits::MOST);
        let least = self.decimals.min(usual);
        let is_fine = |&decimals: &usize| step(decimals) <= (high - low) * ROUNDING;
        let first = (least..=usual).find(is_fine).unwrap_or(usual);
        let mut each = first..=usual;
        let nearest = each.find_map(|decimals| self.rounded_in(value, window, decimals, false));
        let mut further = usual..=usual + FURTHER;
        nearest
            .or_else(|| further.find_map(|decimals| self.rounded_in(value, window, decimals, true)))
            .unwrap_or_else(|| Shown {
                value: plain(value),
                low: plain(value),
                high: plain(value),
            })
    }

    /// Value and window with this many decimals; nothing where the value as rounded does not stand
    /// between the ends. Where it may be moved it is brought between them.
    fn rounded_in(
        &self,
        value: f64,
        window: &WindowRecord,
        decimals: usize,
        may_be_moved: bool,
    ) -> Option<Shown> {
        // What is a rounding error off a step stands on it.
        const ON_IT: f64 = 1e-6;
        let step = step(decimals);
        let end = |drift: &DriftRecord, inwards: fn(f64) -> f64| {
            let to = drift.to * self.scale;
            match drift.turns {
                Some(_) => coordinate(inwards(to / step) * step, decimals),
                None => plain(to),
            }
        };
        let low = end(&window.down, |steps| (steps - ON_IT).ceil());
        let high = end(&window.up, |steps| (steps + ON_IT).floor());
        let (from, to): (f64, f64) = (low.parse().ok()?, high.parse().ok()?);
        let between = if may_be_moved {
            value.max(from).min(to)
        } else {
            value
        };
        let value = coordinate(between, decimals);
        let shown: f64 = value.parse().ok()?;
        (from < to && from <= shown && shown <= to).then_some(Shown { value, low, high })
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

fn step(decimals: usize) -> f64 {
    whole_power(0.1, decimals as i32)
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
