//! What stands beside and below a map: its colour bar and its legend.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::super::sheet::{self, Area, Drawn, Place};
use super::super::style::{FAINT, GHOST, GRID, HEADING, INK, LABEL, LOOKS, bold, letters};
use super::{BELOW, PLOT, Picture, marker};
use crate::record::CellRecord;
use crate::report::map::quantity;
use crate::report::number::plain;

impl Picture<'_, '_> {
    /// The colours with the levels between them.
    pub(super) fn colour_bar(&self, area: &Area) -> Drawn {
        let name = quantity(self.term);
        let (name, part) = name.split_once(' ').unwrap_or((&name, ""));
        sheet::text(area, name, (20, 12), HPos::Left, &bold(HEADING), INK)?;
        sheet::text(area, part, (20, 44), HPos::Left, &letters(LABEL), FAINT)?;
        let Some(levels) = &self.levels else {
            let known = self
                .view
                .map
                .cells
                .iter()
                .find_map(|cell| self.term.of(cell));
            let text = known.map_or_else(
                || "nowhere to be had".into(),
                |value| format!("{} everywhere", plain(value)),
            );
            return sheet::text(area, &text, (20, 84), HPos::Left, &letters(LABEL), INK);
        };
        let bands = levels.values.len() as i32 + 1;
        let (top, bottom) = (110, PLOT as i32 - BELOW as i32);
        let edge = |band: i32| bottom - (bottom - top) * band / bands;
        for band in 0..bands {
            let corners = [(20, edge(band + 1)), (80, edge(band))];
            let colour = levels.colour(band as usize);
            area.draw(&Rectangle::new(corners, colour.filled()))?;
        }
        area.draw(&Rectangle::new(
            [(20, top), (80, bottom)],
            GHOST.stroke_width(2),
        ))?;
        for index in 0..levels.values.len() {
            let place = (94, edge(index as i32 + 1));
            sheet::beside(area, &levels.text(index), place, HPos::Left, INK)?;
        }
        if levels.is_logarithmic {
            let place = (20, bottom + 20);
            sheet::text(
                area,
                "logarithmic",
                place,
                HPos::Left,
                &letters(LABEL),
                FAINT,
            )?;
        }
        Ok(())
    }

    /// What the lines and marks mean.
    pub(super) fn legend(&self, area: &Area) -> Drawn {
        let cells = &self.view.map.cells;
        let any = |is: fn(&CellRecord) -> bool| cells.iter().any(is);
        let passing = match (
            any(CellRecord::passes),
            any(|it| it.is_known() && !it.passes()),
        ) {
            (true, true) => "inside the thick line every verdict passes",
            (true, false) => "every verdict passes everywhere",
            (false, _) => "nowhere does every verdict pass",
        };
        let sticks = |cell: &CellRecord| cell.share_sticking.is_some_and(|share| share >= 0.5);
        let slips = |cell: &CellRecord| cell.share_sticking.is_some_and(|share| share < 0.5);
        let sticking = match (any(sticks), any(slips)) {
            (true, true) => "dashed: half of the first hits grip, half slide",
            (true, false) => "most first hits grip everywhere",
            (false, true) => "most first hits slip everywhere",
            (false, false) => "nowhere is the target hit",
        };
        let entries: [(&dyn Fn(Place) -> Drawn, &str); 4] = [
            (
                &|at| marker(area, at),
                "the settings; the box is how exactly they can be set",
            ),
            (
                &|(x, y)| {
                    let line = vec![(x - 26, y), (x + 26, y)];
                    area.draw(&PathElement::new(line, INK.stroke_width(5)))
                },
                passing,
            ),
            (
                &|(x, y)| {
                    if !(any(sticks) && any(slips)) {
                        return Ok(());
                    }
                    let style = LOOKS[1].colour.stroke_width(4);
                    sheet::dashes(area, vec![(x - 26, y), (x + 26, y)], style)
                },
                sticking,
            ),
            (
                &|(x, y)| {
                    let corners = [(x - 26, y - 14), (x + 26, y + 14)];
                    area.draw(&Rectangle::new(corners, GRID.stroke_width(2)))?;
                    for shift in [-26, -4, 18] {
                        let from = (x + shift, y + 14);
                        let to = (
                            x + shift.min(-2) + 28,
                            y + 14 - (shift.min(-2) + 28 - shift),
                        );
                        area.draw(&PathElement::new(vec![from, to], GHOST.stroke_width(2)))?;
                    }
                    Ok(())
                },
                "no room for the nozzle",
            ),
        ];
        let is_shown = [
            self.view.marks_settings,
            true,
            true,
            any(CellRecord::is_blocked),
        ];
        let shown = entries.iter().zip(is_shown).filter(|(_, shown)| *shown);
        for (number, ((sample, text), _)) in shown.enumerate() {
            let (column, row) = (number as i32 % 2, number as i32 / 2);
            let (x, y) = (180 + 800 * column, 50 + 54 * row);
            sample((x, y))?;
            sheet::beside(area, text, (x + 46, y), HPos::Left, INK)?;
        }
        Ok(())
    }
}
