//! The figure of a trade-off: a line for each answer across target error, tangential risk and
//! rebound.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::levels::Levels;
use super::sheet::{self, Area, Drawn, Fault, Place, drawn, headline};
use super::style::{FAINT, GHOST, GRID, HEADING, INK, LABEL, Look, bold, letters, look_of};
use crate::elementary::extremes;
use crate::record::{FrontRecord, Record};

const SIZE: (u32, u32) = (1800, 1250);
const TOP: i32 = 300;
const BOTTOM: i32 = 1010;
/// Where values that are nothing stand.
const NOTHING: i32 = 1080;
const AXES: [i32; 3] = [420, 960, 1500];
const NAMES: [&str; 3] = ["target error", "tangential risk", "rebound"];
/// Room between the outermost values and the ends of an axis, as a share of it.
const MARGIN: f64 = 0.08;

/// An axis whose scale suits its values.
struct Axis {
    levels: Levels,
    /// On the scale of the levels.
    from: f64,
    to: f64,
}

impl Axis {
    /// `None` where all values are the same.
    fn over(values: &[f64]) -> Option<Self> {
        let levels = Levels::of(values.iter().copied())?;
        let shown = values.iter().filter(|value| **value > 0.0);
        let scaled = shown.map(|value| levels.scaled(*value));
        let (low, high) = extremes(scaled);
        if low == high {
            let values = values.iter().copied().filter(|value| *value > 0.0);
            return Some(Self {
                levels: Levels {
                    values: values.take(1).collect(),
                    ..levels
                },
                from: low - 1.0,
                to: high + 1.0,
            });
        }
        let margin = MARGIN * (high - low);
        Some(Self {
            levels,
            from: low - margin,
            to: high + margin,
        })
    }
}

/// The figure as SVG; `None` where there is nothing to trade.
pub fn svg(record: &Record) -> Option<Result<String, Fault>> {
    let front = &record.front;
    if front.len() < 2 {
        return None;
    }
    let axes = [0, 1, 2].map(|risk| {
        let values: Vec<f64> = front
            .iter()
            .map(|point| point.objectives()[risk].0)
            .collect();
        Axis::over(&values)
    });
    Some(drawn(SIZE, |area| {
        let sentences = [
            record.problem.title.clone(),
            "parts of J; lower is better; numbers as in the table TRADE-OFF of the sheet".into(),
        ];
        headline(
            area,
            "What can be had: better in one is worse in another",
            &sentences,
        )?;
        for (number, axis) in axes.iter().enumerate() {
            draw_axis(area, AXES[number], NAMES[number], axis.as_ref())?;
        }
        // The recommended one last, above the others.
        let mut order: Vec<usize> = (0..front.len()).collect();
        order.sort_by_key(|&index| front[index].recommended);
        let names = spread(front, axes[0].as_ref());
        for index in order {
            draw_answer(area, &front[index], index, &axes, names[index])?;
        }
        legend(area)
    }))
}

/// Values that are all the same stand in the middle, those that are nothing below the axis.
fn height(axis: Option<&Axis>, value: f64) -> i32 {
    let share = match axis {
        _ if value <= 0.0 => return NOTHING,
        Some(axis) => (axis.levels.scaled(value) - axis.from) / (axis.to - axis.from),
        None => 0.5,
    };
    BOTTOM - (share.clamp(0.0, 1.0) * f64::from(BOTTOM - TOP)).round() as i32
}

fn draw_axis(area: &Area, x: i32, name: &str, axis: Option<&Axis>) -> Drawn {
    sheet::text(area, name, (x, TOP - 74), HPos::Center, &bold(HEADING), INK)?;
    area.draw(&PathElement::new(
        vec![(x, TOP), (x, BOTTOM)],
        GHOST.stroke_width(3),
    ))?;
    // Lines come from the left to the last axis.
    let (side, aside) = if x == AXES[2] {
        (HPos::Left, 20)
    } else {
        (HPos::Right, -16)
    };
    if let Some(axis) = axis {
        for (index, &value) in axis.levels.values.iter().enumerate() {
            let y = height(Some(axis), value);
            let tick = vec![(x - 8, y), (x + 8, y)];
            area.draw(&PathElement::new(tick, GHOST.stroke_width(2)))?;
            sheet::beside(area, &axis.levels.text(index), (x + aside, y), side, FAINT)?;
        }
    }
    area.draw(&PathElement::new(
        vec![(x - 8, NOTHING), (x + 8, NOTHING)],
        GRID.stroke_width(3),
    ))?;
    let below = (x, NOTHING + 14);
    sheet::text(area, "nothing", below, HPos::Center, &letters(LABEL), FAINT)
}

fn look(point: &FrontRecord) -> Look {
    let colour = match (point.recommended, point.fails.is_empty()) {
        (true, _) => INK,
        (false, true) => look_of(0).colour,
        (false, false) => look_of(1).colour,
    };
    Look {
        colour,
        is_dashed: !point.fails.is_empty(),
        ..look_of(0)
    }
}

fn draw_answer(
    area: &Area,
    point: &FrontRecord,
    index: usize,
    axes: &[Option<Axis>; 3],
    name_at: i32,
) -> Drawn {
    let look = look(point);
    let objectives = point.objectives();
    let places = [0, 1, 2].map(|risk| {
        let y = height(axes[risk].as_ref(), objectives[risk].0);
        (AXES[risk], y)
    });
    let width = if point.recommended { 7 } else { 3 };
    let style = look.colour.stroke_width(width);
    if look.is_dashed {
        sheet::dashes(area, places.to_vec(), style)?;
    } else {
        area.draw(&PathElement::new(places.to_vec(), style))?;
    }
    for place in places {
        sheet::marker(area, place, look, 9.0)?;
    }
    let text = format!("{} {}", index + 1, point.contact);
    let at = (AXES[0] - 130, name_at);
    sheet::beside(area, &text, at, HPos::Right, look.colour)?;
    let line: Vec<Place> = vec![(at.0 + 8, at.1), (AXES[0] - 108, places[0].1)];
    area.draw(&PathElement::new(line, look.colour.mix(0.4)))
}

/// Heights of the names at the left, moved apart so that each can be read.
fn spread(front: &[FrontRecord], axis: Option<&Axis>) -> Vec<i32> {
    const LINE: i32 = 32;
    let mut order: Vec<(usize, i32)> = front
        .iter()
        .map(|point| height(axis, point.objectives()[0].0))
        .enumerate()
        .collect();
    order.sort_by_key(|(_, y)| *y);
    let mut free = i32::MIN;
    for (_, y) in &mut order {
        *y = free.max(*y);
        free = *y + LINE;
    }
    // What was pushed below the last line goes up again.
    let mut last = NOTHING + LINE;
    for (_, y) in order.iter_mut().rev() {
        *y = last.min(*y);
        last = *y - LINE;
    }
    let mut heights = vec![0; front.len()];
    for (index, y) in order {
        heights[index] = y;
    }
    heights
}

fn legend(area: &Area) -> Drawn {
    let y = SIZE.1 as i32 - 60;
    let entries = [
        ("recommended", INK, 7, false),
        ("passes every verdict", look_of(0).colour, 3, false),
        ("fails one", look_of(1).colour, 3, true),
    ];
    for (number, (text, colour, width, is_dashed)) in entries.into_iter().enumerate() {
        let x = 240 + 480 * number as i32;
        let line = vec![(x, y), (x + 60, y)];
        if is_dashed {
            sheet::dashes(area, line, colour.stroke_width(width))?;
        } else {
            area.draw(&PathElement::new(line, colour.stroke_width(width)))?;
        }
        sheet::beside(area, text, (x + 76, y), HPos::Left, INK)?;
    }
    Ok(())
}
