//! The figure of searches: how good the answer is against the time that it takes.

use plotters::style::Color;
use plotters::style::text_anchor::HPos;

use super::axis::{Axis, LogAxis, Scale, percent};
use super::panel::Panel;
use super::sheet::{self, Area, Drawn, Fault, Place, drawn, headline, key};
use super::style::{BAND, FAINT, INK, LABEL, letters, look_of};
use crate::chart::Chart;
use crate::report::finding;
use crate::report::number::{count, significant, time};
use crate::report::series::{Group, Series};

const WIDTH: u32 = 2000;
const HEAD: u32 = 150;
/// The axes with their labels and names.
const PLOT: u32 = 960;
/// Upper left and lower right corner of the axes, px.
const AXES: [Place; 2] = [(180, 200), (1970, 1010)];
const ROW: i32 = 42;

/// The figure as SVG; `None` when nothing was measured, or every answer is the best known.
pub fn svg(chart: &Chart) -> Option<Result<String, Fault>> {
    let searches = chart.searches.as_ref()?;
    let series = Series::of(searches, chart.accuracy);
    let points = || series.iter().flat_map(Series::points);
    points().find(|(_, excess)| *excess > 0.0)?;
    // Answers as good as the best known have a place at the lower edge.
    let least = searches.noise().max(LEAST_EXCESS) / 2.0;
    let y = LogAxis::over(points().map(|(_, excess)| excess.max(least)))?;
    let x = LogAxis::over(points().map(|(seconds, _)| seconds))?;
    let foot = (ROW * (series.len() as i32 + 1) + ROW / 2) as u32;
    Some(drawn((WIDTH, HEAD + PLOT + foot), |area| {
        let sentences = [chart.title.clone(), finding::of_searches(chart, searches)];
        headline(
            area,
            "How good the answer is after how much time",
            &sentences,
        )?;
        let (_, foot) = area.split_vertically(HEAD + PLOT);
        let axes = [
            Axis {
                scale: Scale::Log(x),
                name: &format!("time to the answer, {} threads", chart.threads),
                label: time,
                towards_low: "faster",
            },
            Axis {
                scale: Scale::Log(y),
                name: "J of the answer above the best known, %",
                label: percent,
                towards_low: "more accurate",
            },
        ];
        let plot = Panel::new(area, AXES, "", &axes)?;
        noise(searches.noise(), &plot, (x, y))?;
        // The search lies above other methods.
        for (index, one) in series.iter().enumerate().rev() {
            if has_labels(one, &series) {
                draw(one, index, &plot)?;
            } else {
                sketch(one, index, &plot)?;
            }
        }
        legend(chart, &series, &foot)
    }))
}

/// Differences below this are rounding.
const LEAST_EXCESS: f64 = 1e-7;

/// What cannot be told apart.
fn noise(noise: f64, plot: &Panel, (x, y): (LogAxis, LogAxis)) -> Drawn {
    if noise <= y.from {
        return Ok(());
    }
    plot.rectangle([(x.from, y.from), (x.to, noise)], BAND.filled())?;
    let text = format!(
        "noise: answers closer than {} % cannot be told apart",
        significant(noise * 100.0, 1)
    );
    plot.note(&text, (x.from, noise), (16, 20), HPos::Left, FAINT)
}

/// More other methods than these would cover the figure with what they were told to do.
const MOST_LABELLED: usize = 3;

fn has_labels(one: &Series, all: &[Series]) -> bool {
    let beside = all.iter().filter(|series| series.is_beside).count();
    !one.is_beside || beside <= MOST_LABELLED
}

fn draw(series: &Series, index: usize, plot: &Panel) -> Drawn {
    let look = look_of(index);
    let medians = medians(series);
    plot.line(&medians, look)?;
    for group in &series.groups {
        for point in &group.points {
            plot.marker(*point, look, 5.0)?;
        }
    }
    // Series that come later have their labels on the other side.
    let (offset, side) = match index % 2 {
        0 => ((18, -22), HPos::Left),
        _ => ((-18, 22), HPos::Right),
    };
    for (group, median) in series.groups.iter().zip(medians) {
        plot.marker(median, look, 12.0)?;
        plot.note(&group.label, median, offset, side, look.colour)?;
        if group.is_picked {
            plot.ring(median, 23)?;
        }
    }
    Ok(())
}

/// A series of which only the medians are shown.
fn sketch(series: &Series, index: usize, plot: &Panel) -> Drawn {
    let look = look_of(index);
    let medians = medians(series);
    plot.line(&medians, look)?;
    medians
        .into_iter()
        .try_for_each(|median| plot.marker(median, look, 7.0))
}

fn medians(series: &Series) -> Vec<(f64, f64)> {
    series.groups.iter().map(Group::median).collect()
}

fn legend(chart: &Chart, series: &[Series], area: &Area) -> Drawn {
    for (index, series) in series.iter().enumerate() {
        key(
            area,
            (AXES[0].0, 16 + ROW * index as i32),
            look_of(index),
            &series.name,
        )?;
    }
    let explanation = format!(
        "large: medians, small: single seeds; ring: the accuracy that the file asks for, {} %; best known: the best of all {} answers",
        significant(chart.accuracy * 100.0, 1),
        count(
            chart
                .searches
                .as_ref()
                .map_or(0, |searches| searches.runs.len())
        ),
    );
    let place = (AXES[0].0, 4 + ROW * series.len() as i32);
    sheet::text(area, &explanation, place, HPos::Left, &letters(LABEL), INK)
}
