//! The figure of effects: what happens without each.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::axis::{LogAxis, percent};
use super::sheet::{self, Area, Drawn, Fault, beside, drawn, headline, marker};
use super::style::{FAINT, GHOST, GRID, HEADING, INK, LABEL, Look, Shape, bold, letters, look_of};
use crate::chart::{Chart, Effect};
use crate::report::finding::{self, share, signed_share};

const WIDTH: i32 = 2000;
const HEAD: i32 = 260;
const ROW: i32 = 62;
const FOOT: i32 = 70;
const NAMES: i32 = 400;
/// Width of a column, and of its part that has an axis.
const COLUMN: i32 = 530;
const AXIS: i32 = 370;
/// Standard errors below which a change is noise.
const CONFIDENCE: f64 = 2.0;

/// A quantity that each effect changes.
struct Column<'a> {
    title: [&'a str; 2],
    /// Value and standard error; `None` where the nozzle does not fit.
    of: fn(&Effect) -> Option<(f64, f64)>,
    look: Look,
}

/// The figure as SVG; `None` when nothing was measured.
pub fn svg(chart: &Chart) -> Option<Result<String, Fault>> {
    let effects = &chart.effects;
    if effects.is_empty() {
        return None;
    }
    let columns = [
        Column {
            title: ["J at the recommended settings", "changes without it by"],
            of: |effect| Some((effect.change, effect.change_standard_error)),
            look: look_of(0),
        },
        Column {
            title: ["a search without it finds an", "answer that is worse by"],
            of: |effect| {
                let regret = (effect.regret, effect.regret_standard_error);
                effect.fits.then_some(regret)
            },
            look: look_of(1),
        },
    ];
    let height = HEAD + ROW * effects.len() as i32 + FOOT;
    Some(drawn((WIDTH as u32, height as u32), |area| {
        let sentences = [chart.title.clone(), finding::of_effects(effects)];
        headline(
            area,
            "What leaving out an effect changes and saves",
            &sentences,
        )?;
        names(effects, area)?;
        for (number, column) in columns.iter().enumerate() {
            changes(effects, column, NAMES + COLUMN * number as i32, area)?;
        }
        costs(effects, NAMES + COLUMN * columns.len() as i32, area)
    }))
}

fn line(row: usize) -> i32 {
    HEAD + ROW * row as i32 + ROW / 2
}

fn names(effects: &[Effect], area: &Area) -> Drawn {
    sheet::text(
        area,
        "left out",
        (40, HEAD - 80),
        HPos::Left,
        &bold(HEADING),
        INK,
    )?;
    for (row, effect) in effects.iter().enumerate() {
        beside(area, &effect.name, (40, line(row)), HPos::Left, INK)?;
    }
    Ok(())
}

fn heading(area: &Area, title: [&str; 2], left: i32) -> Drawn {
    for (number, text) in title.iter().enumerate() {
        let place = (left, HEAD - 80 + 32 * number as i32);
        sheet::text(area, text, place, HPos::Left, &bold(LABEL), INK)?;
    }
    Ok(())
}

/// A column of changes on a logarithmic axis; their signs are told by the markers and the numbers.
fn changes(effects: &[Effect], column: &Column, left: i32, area: &Area) -> Drawn {
    heading(area, column.title, left)?;
    let is_noise = |(value, error): (f64, f64)| value.abs() <= CONFIDENCE * error;
    let sizes = effects
        .iter()
        .filter_map(column.of)
        .map(|(value, error)| value.abs().max(error));
    let axis = LogAxis::over(sizes);
    let bottom = line(effects.len()) - ROW / 2;
    if let Some(axis) = axis {
        let at = |value: f64| left + (axis.fraction(value) * f64::from(AXIS)).round() as i32;
        for decade in axis.labelled(4) {
            grid_line(area, at(decade), bottom, &percent(decade))?;
        }
        for (row, effect) in effects.iter().enumerate() {
            let Some((value, error)) = (column.of)(effect).filter(|(value, _)| *value != 0.0)
            else {
                continue;
            };
            let noise = is_noise((value, error));
            let shape = if value > 0.0 {
                Shape::Triangle
            } else {
                Shape::Drop
            };
            let colour = if noise { GHOST } else { column.look.colour };
            let place = (at(value.abs()), line(row));
            area.draw(&PathElement::new(
                vec![(left, place.1), place],
                colour.stroke_width(3),
            ))?;
            let look = Look {
                colour,
                shape,
                is_dashed: false,
            };
            marker(area, place, look, 11.0)?;
        }
    }
    for (row, effect) in effects.iter().enumerate() {
        let (text, colour) = match (column.of)(effect) {
            None => ("no fit".into(), INK),
            Some((0.0, _)) => ("nothing".into(), FAINT),
            Some((value, error)) if is_noise((value, error)) => {
                (format!("±{}: noise", share(CONFIDENCE * error)), FAINT)
            }
            Some((value, _)) => (signed_share(value), INK),
        };
        let place = (left + AXIS + 14, line(row));
        beside(area, &text, place, HPos::Left, colour)?;
    }
    Ok(())
}

/// The time for a pose without each effect, on a linear axis.
fn costs(effects: &[Effect], left: i32, area: &Area) -> Drawn {
    heading(
        area,
        ["time for a pose without it,", "% of that with it"],
        left,
    )?;
    let most = effects
        .iter()
        .map(|effect| effect.relative_cost)
        .fold(1.0, f64::max);
    let at = |cost: f64| left + (cost / most * f64::from(AXIS)).round() as i32;
    let bottom = line(effects.len()) - ROW / 2;
    for tick in [0.0, 0.5, 1.0] {
        grid_line(area, at(tick), bottom, &percent(tick))?;
    }
    for (row, effect) in effects.iter().enumerate() {
        let look = look_of(2);
        let place = (at(effect.relative_cost), line(row));
        area.draw(&PathElement::new(
            vec![(left, place.1), place],
            look.colour.stroke_width(3),
        ))?;
        marker(area, place, look, 10.0)?;
        let (cost, place) = (share(effect.relative_cost), (left + AXIS + 34, line(row)));
        beside(area, &cost, place, HPos::Left, INK)?;
    }
    Ok(())
}

fn grid_line(area: &Area, x: i32, bottom: i32, label: &str) -> Drawn {
    area.draw(&PathElement::new(
        vec![(x, HEAD), (x, bottom)],
        GRID.stroke_width(2),
    ))?;
    sheet::text(
        area,
        label,
        (x, bottom + 8),
        HPos::Center,
        &letters(LABEL),
        FAINT,
    )
}
