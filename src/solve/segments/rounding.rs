//! Settings rounded to what is worth programming.

use crate::feasibility::infeasibility;
use crate::problem::setting::{Setting, SettingRanges, Settings};
use crate::problem::stroke::{Hold, Stroke};
use crate::scenario::Station;

/// The nearest rounded settings that fit wherever these do: the clearance may be used up to the last bit.
pub fn rounded(
    settings: &Settings,
    stroke: &Stroke,
    ranges: &SettingRanges,
    stations: &[Station],
) -> Settings {
    let open: Vec<&Station> = stations.iter().filter(|it| fits(it, settings)).collect();
    let all = roundings(settings, stroke, ranges);
    let fitting = all
        .iter()
        .find(|it| open.iter().all(|station| fits(station, it)));
    *fitting.or(all.first()).unwrap_or(settings)
}

/// Whether the nozzle fits at a station.
pub fn fits(station: &Station, settings: &Settings) -> bool {
    infeasibility(&station.scenario, settings).is_none()
}

/// Settings rounded up or down in what is not held, the nearest ones first.
fn roundings(settings: &Settings, stroke: &Stroke, ranges: &SettingRanges) -> Vec<Settings> {
    let is_held = |setting: &Setting| match &stroke.hold {
        Hold::All => true,
        Hold::Some { settings, .. } => settings.contains(setting),
    };
    // Each with how far it is from the settings, in steps.
    let mut all = vec![(0.0, *settings)];
    for &(setting, step) in &stroke.steps {
        let range = ranges.range(setting);
        let Some(range) = range.filter(|_| !is_held(&setting)) else {
            continue;
        };
        let exact = setting.of(settings) / step;
        let both = |(far, rounded): (f64, Settings)| {
            [exact.floor(), exact.ceil()].map(|steps| {
                let value = (steps * step).clamp(range.min, range.max);
                (far + (steps - exact).abs(), setting.with(&rounded, value))
            })
        };
        all = all.into_iter().flat_map(both).collect();
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.into_iter().map(|(_, rounded)| rounded).collect()
}
