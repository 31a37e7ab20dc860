//! The histograms: how often a hit has which angle, N* and f*.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::{HISTOGRAM_HEIGHT, LEFT, ROOM, SIZE, TOP, WIDTH, limit_mark, tolerance_marks};
use crate::elementary::extremes;
use crate::record::{HitsRecord, Record};
use crate::report::figure::axis::Axis;
use crate::report::figure::marks::{self, Mark};
use crate::report::figure::panel::Panel;
use crate::report::figure::sheet::{self, Area, Drawn};
use crate::report::figure::style::{FAINT, LABEL, LOOKS, letters};
use crate::report::layout::wrap;
use crate::report::number::{decimals_for, fixed, impulse_asked, share, share_asked};
use crate::report::typeset::typeset;

/// Room beside the marks, relative to the extent of the values.
const ROOM_FOR_NAMES: f64 = 0.25;
/// A histogram shows at least this much of its values, relative to them.
const LEAST_SPAN: f64 = 1e-3;
/// How far the axis reaches, relative to the highest bar: names stand above it.
const HEADROOM: f64 = 1.4;
/// Room between what is said below two histograms, px.
const BESIDE: i32 = 60;
/// Bars of a histogram.
const BARS: usize = 32;

/// How often a quantity has which value.
pub struct Histogram {
    title: &'static str,
    name: &'static str,
    values: Vec<f64>,
    marks: Vec<Mark>,
    /// What is said below the title.
    remark: String,
}

pub fn histograms(record: &Record, hits: &HitsRecord) -> [Histogram; 3] {
    let goals = &record.problem.goals;
    let impulses = |of: &[f32]| {
        of.iter()
            .map(|value| f64::from(*value) * 1e6)
            .collect::<Vec<f64>>()
    };
    let angles: Vec<f64> = hits
        .angle_deg
        .iter()
        .map(|angle| f64::from(*angle))
        .collect();
    let normal = impulses(&hits.normal_impulse);
    let tangential = impulses(&hits.tangential_impulse);
    let wanted = goals.normal_impulse * 1e6;
    let share_of = |values: &[f64], breaks: &dyn Fn(f64) -> bool| {
        let number = values.iter().filter(|value| breaks(**value)).count();
        share(number as f64 / values.len() as f64)
    };
    let tolerance = goals.normal_impulse_tolerance;
    let off = share_of(&normal, &|value| (value / wanted - 1.0).abs() > tolerance);
    let sticking = hits.sticks.iter().filter(|sticks| **sticks).count();
    [
        Histogram {
            title: "Angle between flight and surface",
            name: "angle, °; 90 is perpendicular",
            remark: format!(
                "{} of these grip",
                share(sticking as f64 / hits.sticks.len().max(1) as f64)
            ),
            values: angles,
            marks: Vec::new(),
        },
        Histogram {
            title: "N*",
            name: "N*, µN·s",
            values: normal,
            remark: format!(
                "{off} off {} +- {}",
                impulse_asked(goals.normal_impulse),
                share_asked(tolerance)
            ),
            marks: tolerance_marks(goals),
        },
        Histogram {
            title: "f*",
            name: "f*, µN·s",
            remark: goals.tangential_impulse.map_or_else(
                || "no limit".into(),
                |limit| {
                    let over = share_of(&tangential, &|value| value > limit * 1e6);
                    format!("{over} over {}", impulse_asked(limit))
                },
            ),
            values: tangential,
            marks: limit_mark(goals).into_iter().collect(),
        },
    ]
}

impl Histogram {
    pub fn draw(&self, area: &Area, index: usize) -> Drawn {
        let (left, top) = (LEFT[index], TOP[1]);
        let corners = [(left, top), (left + WIDTH + 90, top + HISTOGRAM_HEIGHT)];
        let (lowest, highest) = extremes(self.values.iter().copied());
        let span = (highest - lowest).max(LEAST_SPAN * highest.abs()).max(1e-9);
        // Marks that are near are worth seeing.
        let near = |value: &f64| (lowest - span..=highest + span).contains(value);
        let marks = || self.marks.iter().map(|mark| mark.value).filter(near);
        let room = if marks().next().is_some() {
            ROOM_FOR_NAMES
        } else {
            ROOM
        } * span;
        let low = marks().fold(lowest, f64::min) - room;
        let high = marks().fold(highest, f64::max) + room;
        let width = (high - low) / BARS as f64;
        let mut counts = [0_usize; BARS];
        for value in &self.values {
            counts[(((value - low) / width) as usize).min(BARS - 1)] += 1;
        }
        let percent = |number: usize| number as f64 / self.values.len() as f64 * 100.0;
        let most = counts.into_iter().max().unwrap_or(1);
        let axes = [
            Axis::linear(low..high, self.name),
            Axis::linear(0.0..percent(most) * HEADROOM, "hits, %"),
        ];
        let plot = Panel::new(area, corners, self.title, &axes)?;
        for (bar, number) in counts
            .into_iter()
            .enumerate()
            .filter(|(_, number)| *number > 0)
        {
            let from = low + bar as f64 * width;
            let corners = [(from, 0.0), (from + width, percent(number))];
            plot.rectangle(corners, LOOKS[0].colour.filled())?;
        }
        let shown: Vec<&Mark> = self
            .marks
            .iter()
            .filter(|it| (low..=high).contains(&it.value))
            .collect();
        marks::draw(area, &plot, &shown)?;
        let decimals = decimals_for(span, 3);
        let [from, to] = [lowest, highest].map(|value| fixed(value, decimals));
        let extent = if from == to {
            format!("all {from}")
        } else {
            format!("{from} to {to}")
        };
        let remark = typeset(&format!("{extent}; {}", self.remark));
        let room = LEFT.get(index + 1).copied().unwrap_or(SIZE.0 as i32) - left - BESIDE;
        let letters_that_fit = room / sheet::width(&"0".repeat(10), LABEL).max(1) * 10;
        let lines = wrap(&remark, letters_that_fit.max(1) as usize);
        for (line, number) in lines.iter().zip(0..) {
            let place = (left, top + HISTOGRAM_HEIGHT + 76 + 28 * number);
            sheet::text(area, line, place, HPos::Left, &letters(LABEL), FAINT)?;
        }
        Ok(())
    }
}
