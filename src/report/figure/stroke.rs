//! The figure of a stroke: what verdicts use up along it, and what it dents of the target.

use std::ops::Range;

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::axis::Axis;
use super::panel::Panel;
use super::scale::Scale;
use super::sheet::{self, Area, Drawn, Fault, drawn, headline};
use super::style::{INK, look_of};
use crate::elementary::extremes;
use crate::record::{DentedMapRecord, Record, StrokeRecord, VerdictRecord};
use crate::report::number::{plain, share};
use crate::report::sheet::subject::utilisation;

const WIDTH: u32 = 2000;
/// Upper left corner of the axes, px, and their size.
const LEFT: i32 = 140;
const TOP: i32 = 230;
const ACROSS: i32 = 1400;
const CURVES: i32 = 380;
/// Between the panels, px.
const BETWEEN: i32 = 150;
const BELOW: i32 = 90;
/// How high a map may be, px.
const MAP: Range<i32> = 120..700;
/// Where legend and colour bar stand, px.
const BESIDE: i32 = LEFT + ACROSS + 40;
const BAR_WIDTH: i32 = 26;
/// How far the curves go at least and at most, % of what is allowed.
const LEAST_USED: f64 = 110.0;
const MOST_USED: f64 = 300.0;

/// The figure as SVG; `None` for a spot, or where the nozzle does not fit.
pub fn svg(record: &Record) -> Option<Result<String, Fault>> {
    let stroke = record.stroke.as_ref()?;
    if stroke.stations.len() < 2 {
        return None;
    }
    let map = stroke.dented_map.as_ref().filter(|map| map.columns > 0);
    let height = map.map_or(0, |map| BETWEEN + map_height(map));
    let size = (WIDTH, (TOP + CURVES + height + BELOW) as u32);
    Some(drawn(size, |area| {
        headline(area, "The stroke", &sentences(record, stroke))?;
        curves(area, stroke)?;
        map.map_or(Ok(()), |map| dented(area, map, names(stroke)))
    }))
}

fn sentences(record: &Record, stroke: &StrokeRecord) -> [String; 2] {
    let mut what = format!(
        "Each verdict at {} stations where the nozzle stands still; 100 % is what is allowed.",
        stroke.stations.len()
    );
    if let Some(dented) = &stroke.dented {
        what += &format!(
            " Below, what all passes together dent: {} of the target on the mean.",
            share(dented.mean)
        );
    }
    [record.problem.title.clone(), what]
}

/// How much of what is allowed a verdict uses up, %.
fn used(verdict: &VerdictRecord) -> f64 {
    utilisation(verdict) * 100.0
}

fn curves(area: &Area, stroke: &StrokeRecord) -> Drawn {
    let places = stroke.stations.iter().map(|station| station.at_m * 1e3);
    let (from, to) = extremes(places);
    let all = stroke.stations.iter().flat_map(|station| &station.verdicts);
    let most = all.map(used).fold(LEAST_USED, f64::max).min(MOST_USED);
    let axes = [
        Axis::linear(from..to, "from the beginning of the stroke, mm"),
        Axis::linear(0.0..most, "% of what is allowed"),
    ];
    let corners = [(LEFT, TOP), (LEFT + ACROSS, TOP + CURVES)];
    let plot = Panel::new(area, corners, "Share of what is allowed, %", &axes)?;
    plot.dashes(&[(from, 100.0), (to, 100.0)], INK.stroke_width(3))?;
    let mut subjects: Vec<&str> = Vec::new();
    for verdict in stroke.stations.iter().flat_map(|it| &it.verdicts) {
        if !subjects.contains(&verdict.subject.as_str()) {
            subjects.push(&verdict.subject);
        }
    }
    for (index, subject) in subjects.iter().enumerate() {
        let look = look_of(index);
        let points = stroke.stations.iter().filter_map(|station| {
            let mut verdicts = station.verdicts.iter();
            let verdict = verdicts.find(|verdict| verdict.subject == *subject)?;
            Some((station.at_m * 1e3, used(verdict)))
        });
        let points: Vec<(f64, f64)> = points.collect();
        plot.line(&points, look)?;
        for point in points {
            plot.marker(point, look, 8.0)?;
        }
        sheet::key(area, (BESIDE, TOP + 16 + 38 * index as i32), look, subject)?;
    }
    Ok(())
}

fn rows(map: &DentedMapRecord) -> usize {
    map.dented.len() / map.columns
}

/// As high as its proportions ask for, within bounds.
fn map_height(map: &DentedMapRecord) -> i32 {
    let [along, across] = map.sides_m;
    let proportion = rows(map) as f64 * across / (map.columns as f64 * along);
    let height = (f64::from(ACROSS) * proportion).round() as i32;
    height.clamp(MAP.start, MAP.end)
}

/// What the axes of the map show.
fn names(stroke: &StrokeRecord) -> [&'static str; 2] {
    match stroke.axis {
        Some(_) => [
            "round the axis from the aim point, mm",
            "along the axis, mm",
        ],
        None => ["along the stroke, mm", "across it, mm"],
    }
}

fn dented(area: &Area, map: &DentedMapRecord, [x_name, y_name]: [&str; 2]) -> Drawn {
    let top = TOP + CURVES + BETWEEN;
    let bottom = top + map_height(map);
    let sides = map.sides_m.map(|it| it * 1e3);
    let corner = map.corner_m.map(|it| it * 1e3);
    let [x, y] = [(0, map.columns), (1, rows(map))]
        .map(|(axis, count)| corner[axis]..corner[axis] + sides[axis] * count as f64);
    let axes = [Axis::linear(x, x_name), Axis::linear(y, y_name)];
    let corners = [(LEFT, top), (LEFT + ACROSS, bottom)];
    let plot = Panel::new(area, corners, "Dented, % of the area", &axes)?;
    let scale = scale(map);
    let values = map.dented.iter();
    let colours = values.map(|value| value.map(|value| scale.colour(f64::from(value) * 100.0)));
    plot.cells(corner.into(), sides, map.columns, colours)?;
    bar(area, &scale, (top, bottom))
}

/// The colours show the values that there are, %.
fn scale(map: &DentedMapRecord) -> Scale {
    let values = map.dented.iter().flatten();
    let least = values.map(|value| f64::from(*value) * 100.0);
    let least = least.fold(100.0, f64::min);
    Scale {
        // Where all is dented alike, the scale is a narrow one.
        range: least.min(99.0).floor()..100.0,
        gradient: colorous::CIVIDIS,
    }
}

fn bar(area: &Area, scale: &Scale, (top, bottom): (i32, i32)) -> Drawn {
    scale.bar(area, [(BESIDE, top), (BESIDE + BAR_WIDTH, bottom)])?;
    for share in [0.0, 0.5, 1.0] {
        let y = bottom - (f64::from(bottom - top) * share).round() as i32;
        let place = (BESIDE + BAR_WIDTH + 10, y);
        let text = format!("{} %", plain(scale.value(share)));
        sheet::beside(area, &text, place, HPos::Left, INK)?;
    }
    Ok(())
}
