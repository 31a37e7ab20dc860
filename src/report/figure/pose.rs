//! The figure of J at one pose: its error against the time that it takes.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::axis::{Axis, LogAxis, Scale, percent};
use super::panel::Panel;
use super::sheet::{self, Area, Drawn, Fault, drawn, headline, key};
use super::style::{FAINT, GHOST, INK, LABEL, look_of};
use crate::chart::{Chart, Leaks, PoseCurve, Sampling, Walls};
use crate::report::finding;
use crate::report::number::{count, significant, time};

const SIZE: (u32, u32) = (2000, 1110);
/// Left ends of the panels, and what they have in common, px.
const LEFT: [i32; 3] = [180, 790, 1410];
const WIDTH: i32 = 550;
const TOP: i32 = 280;
const BOTTOM: i32 = 900;
const FOOT: u32 = 110;
/// Room beside and between the names of the legend, and from row to row, px.
const MARGIN: i32 = 40;
const LEGEND_ROW: i32 = 40;
/// Errors below this are rounding.
const LEAST_ERROR: f64 = 1e-9;

/// The figure as SVG; `None` when nothing was measured, or J does not scatter.
pub fn svg(chart: &Chart) -> Option<Result<String, Fault>> {
    let points = || chart.poses.iter().flat_map(|curve| &curve.points);
    if !scatters(chart) {
        return None;
    }
    let errors = points().map(|point| point.error);
    let y = LogAxis::over(errors.filter(|error| *error > LEAST_ERROR))?;
    let x = LogAxis::over(points().map(|point| point.seconds))?;
    Some(drawn(SIZE, |area| {
        let explanation = format!(
            "Error: root mean square of (J - J0) / J0 at the recommended settings; J0 = {} is known \
             to {} %. Time: median, one thread.",
            finding::objective(chart.reference.objective),
            significant(noise(chart) * 100.0, 2),
        );
        let sentences = [chart.title.clone(), finding::of_poses(chart), explanation];
        headline(
            area,
            "How well J of one pose is known after how much time",
            &sentences,
        )?;
        let (_, foot) = area.split_vertically(SIZE.1 - FOOT);
        panels(chart, area, x, y)?;
        legend(chart, &foot)
    }))
}

/// Whether there is more than rounding.
fn scatters(chart: &Chart) -> bool {
    // Points have another J.
    let is_of_shots = |curve: &&PoseCurve| !matches!(curve.walls, Walls::Points | Walls::Parry);
    let curves = chart.poses.iter().filter(is_of_shots);
    let mut points = curves.flat_map(|curve| &curve.points);
    points.any(|point| point.error > LEAST_ERROR)
}

/// Relative standard error of the reference.
fn noise(chart: &Chart) -> f64 {
    chart.reference.standard_error / chart.reference.objective
}

/// One panel for each way to draw shots.
fn panels(chart: &Chart, area: &Area, x: LogAxis, y: LogAxis) -> Drawn {
    for (left, sampling) in LEFT.into_iter().zip(Sampling::ALL) {
        let axes = [
            Axis {
                scale: Scale::Log(x),
                name: "time for J of one pose",
                label: time,
                towards_low: "faster",
            },
            // The first panel has the labels of the left axis.
            Axis {
                scale: Scale::Log(y),
                name: match left == LEFT[0] {
                    true => "error of J, % of J",
                    false => "",
                },
                label: percent,
                towards_low: "more accurate",
            },
        ];
        let corners = [(left, TOP), (left + WIDTH, BOTTOM)];
        let plot = Panel::new(area, corners, title(sampling), &axes)?;
        panel(chart, &plot, sampling, (x, y))?;
    }
    Ok(())
}

fn title(sampling: Sampling) -> &'static str {
    match sampling {
        Sampling::Random => "Plain random shots",
        Sampling::Sobol => "Scrambled Sobol shots",
        Sampling::SobolRim => "Sobol, with boundary samples",
    }
}

fn panel(chart: &Chart, plot: &Panel, sampling: Sampling, (x, y): (LogAxis, LogAxis)) -> Drawn {
    let curves = |sampling: Sampling| chart.poses.iter().filter(move |c| c.sampling == sampling);
    let first = curves(sampling).next();
    if sampling != Sampling::Random
        && let Some(random) = curves(Sampling::Random).next()
    {
        let points = points(random);
        plot.dashes(&points, GHOST.stroke_width(3))?;
        if let Some(&middle) = points.get(points.len() / 2) {
            plot.note("random", middle, (20, -16), HPos::Left, FAINT)?;
        }
    }
    let noise = noise(chart);
    if noise > y.from {
        plot.dashes(&[(x.from, noise), (x.to, noise)], GHOST.stroke_width(2))?;
    }
    for (index, curve) in curves(sampling).enumerate() {
        // The ways are in the same order in every panel.
        let look = look_of(index);
        plot.line(&points(curve), look)?;
        for point in points(curve) {
            plot.marker(point, look, 9.0)?;
        }
    }
    let Some(curve) = first else {
        return Ok(());
    };
    if sampling == Sampling::Random {
        shots(plot, fastest(curves(sampling)).unwrap_or(curve))?;
    }
    if sampling == Sampling::SobolRim {
        picked(chart, plot, curve)?;
    }
    Ok(())
}

/// The curve that lies leftmost.
fn fastest<'a>(curves: impl Iterator<Item = &'a PoseCurve>) -> Option<&'a PoseCurve> {
    let seconds = |curve: &PoseCurve| curve.points.last().map_or(0.0, |point| point.seconds);
    curves.min_by(|a, b| seconds(a).total_cmp(&seconds(b)))
}

/// Numbers of shots beside a curve; the first where the axis leaves room for it.
fn shots(plot: &Panel, curve: &PoseCurve) -> Drawn {
    let visible = curve
        .points
        .iter()
        .filter(|point| point.error > LEAST_ERROR);
    for (index, point) in visible.enumerate() {
        let (text, at) = (count(point.shots), (point.seconds, point.error));
        match index {
            0 => plot.note(&format!("{text} shots"), at, (4, -30), HPos::Left, FAINT)?,
            _ => plot.note(&text, at, (-16, 16), HPos::Right, FAINT)?,
        }
    }
    Ok(())
}

/// Marks the number of shots with which the search ended.
fn picked(chart: &Chart, plot: &Panel, curve: &PoseCurve) -> Drawn {
    let shots = chart.recommended.shots_per_pose;
    let is_picked = |point: &&crate::chart::PosePoint| point.shots == shots;
    let Some(point) = curve.points.iter().find(is_picked) else {
        return Ok(());
    };
    let at = (point.seconds, point.error);
    plot.ring(at, 20)?;
    plot.note("the search ended", at, (-28, 24), HPos::Right, INK)?;
    plot.note(
        &format!("with {} shots", count(shots)),
        at,
        (-28, 54),
        HPos::Right,
        INK,
    )
}

fn points(curve: &PoseCurve) -> Vec<(f64, f64)> {
    let visible = curve
        .points
        .iter()
        .filter(|point| point.error > LEAST_ERROR);
    visible.map(|point| (point.seconds, point.error)).collect()
}

fn legend(chart: &Chart, area: &Area) -> Drawn {
    let first = chart
        .poses
        .iter()
        .filter(|c| c.sampling == Sampling::ALL[0]);
    let (mut left, mut top) = (MARGIN, 30);
    for (index, curve) in first.enumerate() {
        let lost = |leaks: Leaks| {
            let (missed, aimed) = (count(leaks.missed), count(leaks.aimed));
            format!(" ({missed} of {aimed} rays lost at edges)")
        };
        let name = curve_name(curve) + &curve.leaks.map_or_else(String::new, lost);
        let width = 66 + sheet::width(&name, LABEL);
        if left + width > SIZE.0 as i32 - MARGIN {
            (left, top) = (MARGIN, top + LEGEND_ROW);
        }
        key(area, (left, top), look_of(index), &name)?;
        left += width + MARGIN;
    }
    Ok(())
}

/// What a curve was computed with.
pub fn curve_name(curve: &PoseCurve) -> String {
    let triangles = count(curve.triangles);
    match curve.walls {
        Walls::Exact => "exact walls".into(),
        Walls::Mesh => format!("the mesh as it is, {triangles} triangles"),
        Walls::Points => format!("points, {triangles} triangles"),
        Walls::Parry => "the same, rays cast by parry".into(),
        Walls::Facets { chord_angle_deg } => {
            format!("mesh, chords turn {chord_angle_deg}°, {triangles} triangles")
        }
    }
}
