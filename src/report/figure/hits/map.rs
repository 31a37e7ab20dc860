//! The maps: where hits lie, and what they deliver there.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::grid::Grid;
use super::{LEFT, MAP_HEIGHT, SIZE, TOP, WIDTH, limit_mark, tolerance_marks};
use crate::record::{HitsRecord, Record};
use crate::report::figure::axis::Axis;
use crate::report::figure::levels::round_step;
use crate::report::figure::marks::Mark;
use crate::report::figure::panel::Panel;
use crate::report::figure::scale::Scale;
use crate::report::figure::sheet::{self, Area, Drawn, Fault, Place};
use crate::report::figure::style::{GHOST, INK, LABEL};
use crate::report::number::{plain, rounded};

/// Where the colour bar stands beside a map, px, and how wide it is.
const BAR_APART: i32 = 24;
const BAR_WIDTH: i32 = 26;
/// Room that labels and name of the next map take on its left, px.
const BESIDE: i32 = 100;
/// The colours of N* reach at least so far from what is wanted, relative to it.
const LEAST_TOLERANCE: f64 = 0.01;

/// A map of a quantity over the target.
pub struct Map {
    title: &'static str,
    values: Vec<Option<f64>>,
    scale: Scale,
    /// Values that are marked on the colour bar.
    marks: Vec<Mark>,
}

pub fn maps(record: &Record, hits: &HitsRecord, grid: &Grid) -> [Map; 3] {
    let goals = &record.problem.goals;
    // A density needs an extent; what lies at one place is all of it.
    let area = if grid.is_one_place {
        1.0
    } else {
        grid.side * grid.side
    };
    let density = |cell: &[usize]| cell.len() as f64 / hits.shots as f64 / area * 100.0;
    let mean = |of: &[f32], cell: &[usize]| {
        let sum: f64 = cell.iter().map(|&index| f64::from(of[index])).sum();
        sum / cell.len() as f64 * 1e6
    };
    let density = grid.values(density);
    let normal = grid.values(|cell| mean(&hits.normal_impulse, cell));
    let tangential = grid.values(|cell| mean(&hits.tangential_impulse, cell));
    let wanted = goals.normal_impulse * 1e6;
    let off = |value: &Option<f64>| value.map_or(0.0, |value| (value - wanted).abs());
    let least = goals.normal_impulse_tolerance.max(LEAST_TOLERANCE) * wanted;
    let half = normal.iter().map(off).fold(least, f64::max) * 1.05;
    let limit = limit_mark(goals);
    let tangential_most = most(&tangential);
    [
        Map {
            title: if grid.is_one_place {
                "Hits, % of the shots, at one place"
            } else {
                "Hits, % of the shots per mm\u{b2}"
            },
            scale: Scale {
                range: 0.0..most(&density),
                gradient: colorous::CIVIDIS,
            },
            values: density,
            marks: Vec::new(),
        },
        Map {
            title: "Mean N*, µN·s",
            values: normal,
            scale: Scale {
                range: wanted - half..wanted + half,
                gradient: colorous::PURPLE_ORANGE,
            },
            marks: tolerance_marks(goals),
        },
        Map {
            title: "Mean f*, µN·s",
            scale: Scale {
                range: 0.0..limit
                    .as_ref()
                    .map(|limit| limit.value)
                    .filter(|limit| *limit < 2.0 * tangential_most)
                    .map_or(tangential_most, |limit| limit.max(tangential_most)),
                gradient: colorous::CIVIDIS,
            },
            values: tangential,
            marks: limit.into_iter().collect(),
        },
    ]
}

fn most(values: &[Option<f64>]) -> f64 {
    let most = values.iter().flatten().copied().fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

impl Map {
    pub fn draw<'a, 'b>(
        &self,
        area: &'a Area<'b>,
        index: usize,
        grid: &Grid,
    ) -> Result<Panel<'a, 'b>, Fault> {
        let (left, top) = (LEFT[index], TOP[0]);
        let corners = [(left, top), (left + WIDTH, top + MAP_HEIGHT)];
        let axes = [
            Axis::linear(grid.x.clone(), "along (azimuth 0), mm"),
            Axis::linear(grid.y.clone(), "across (azimuth 90°), mm"),
        ];
        let plot = Panel::new(area, corners, self.title, &axes)?;
        let colours = self.values.iter();
        let colours = colours.map(|value| value.map(|value| self.scale.colour(value)));
        let (corner, sides) = ((grid.x.start, grid.y.start), [grid.side; 2]);
        plot.cells(corner, sides, grid.columns, colours)?;
        self.bar(area, (left + WIDTH + BAR_APART, top))?;
        Ok(plot)
    }

    /// The colours with their values, the marked ones by name.
    fn bar(&self, area: &Area, (left, top): Place) -> Drawn {
        let (from, to) = (self.scale.range.start, self.scale.range.end);
        let height = |share: f64| top + MAP_HEIGHT - (share * f64::from(MAP_HEIGHT)).round() as i32;
        let corners = [(left, top), (left + BAR_WIDTH, top + MAP_HEIGHT)];
        self.scale.bar(area, corners)?;
        let right = left + BAR_WIDTH;
        // What is drawn beside it begins there.
        let next = LEFT.into_iter().find(|start| *start > right);
        let room = next.map_or(SIZE.0 as i32, |next| next - BESIDE) - right - 10;
        let place = |value: f64| height((value - from) / (to - from));
        let mut taken: Vec<i32> = Vec::new();
        let is_shown = |mark: &&Mark| (from..=to).contains(&mark.value);
        for mark in self.marks.iter().filter(is_shown) {
            let y = place(mark.value);
            area.draw(&PathElement::new(
                vec![(left - 4, y), (right + 4, y)],
                INK.stroke_width(4),
            ))?;
            // On a wide scale the marks are all at one place; the first is the one that counts.
            if taken.iter().all(|other| (other - y).abs() > 28) {
                let value = rounded(mark.value, 3);
                let both = format!("{value} {}", mark.name);
                let fits = sheet::width(&both, LABEL) <= room;
                let text = if fits { &both } else { &mark.name };
                sheet::beside(area, text, (right + 10, y), HPos::Left, INK)?;
            }
            taken.push(y);
        }
        for value in ticks(from, to) {
            let y = place(value);
            if taken.iter().all(|other| (other - y).abs() > 28) {
                area.draw(&PathElement::new(
                    vec![(right, y), (right + 6, y)],
                    GHOST.stroke_width(2),
                ))?;
                sheet::beside(area, &plain(value), (right + 10, y), HPos::Left, INK)?;
            }
        }
        Ok(())
    }
}

/// About five round values between two.
fn ticks(from: f64, to: f64) -> Vec<f64> {
    if to <= from {
        return Vec::new();
    }
    let step = round_step((to - from) / 7.0);
    let first = (from / step).ceil() as i64;
    (first..)
        .map(|tick| tick as f64 * step)
        .take_while(|tick| *tick <= to)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_few() {
        assert!(ticks(1.0, 1.0).is_empty());
        assert_eq!(ticks(0.0, 65.0), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
        assert_eq!(
            ticks(33.0, 47.0),
            [34.0, 36.0, 38.0, 40.0, 42.0, 44.0, 46.0]
        );
    }
}
