//! One pair of linear axes with what is drawn between them.

use std::ops::Range;

use plotters::coord::ranged1d::Ranged;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::hits::Mark;
use super::marks::{Marked, arrange};
use super::sheet::{self, Area, Drawn, Fault, Place, styled};
use super::style::{GHOST, GRID, HEADING, INK, LABEL, bold, letters};
use crate::report::number::plain;

/// What a pair of axes shows.
pub struct Axes<'a> {
    /// Above the axes.
    pub title: &'a str,
    /// Ends of the lower axis.
    pub x: Range<f64>,
    /// What it shows, with its unit.
    pub x_name: &'a str,
    /// Ends of the left axis.
    pub y: Range<f64>,
    /// What it shows, with its unit.
    pub y_name: &'a str,
}

/// One pair of linear axes.
pub struct Plot<'a, 'b> {
    sheet: &'a Area<'b>,
    x: Range<f64>,
    y: Range<f64>,
    /// Lower left and upper right corner, px.
    corners: [Place; 2],
}

/// Room for the labels of the axes, px.
const LABELS_LEFT: u32 = 70;
const LABELS_BELOW: u32 = 40;
/// Labels of an axis, at most.
const MOST_LABELS: usize = 6;
/// Height of a row of names, px.
const ROW: i32 = 30;
/// Where names of axes stand, px from them.
const NAME_BELOW: i32 = 44;
const NAME_BESIDE: i32 = 96;

impl<'a, 'b> Plot<'a, 'b> {
    /// Draws axes into a rectangle of the sheet, given by its upper left and lower right corner, px.
    pub fn new(
        sheet: &'a Area<'b>,
        [(left, top), (right, bottom)]: [Place; 2],
        axes: &Axes,
    ) -> Result<Self, Fault> {
        let part = sheet.clone().shrink(
            (left - LABELS_LEFT as i32, top),
            (
                (right - left) as u32 + LABELS_LEFT,
                (bottom - top) as u32 + LABELS_BELOW,
            ),
        );
        let mut context = ChartBuilder::on(&part)
            .set_label_area_size(LabelAreaPosition::Left, LABELS_LEFT)
            .set_label_area_size(LabelAreaPosition::Bottom, LABELS_BELOW)
            .build_cartesian_2d(axes.x.clone(), axes.y.clone())?;
        context
            .configure_mesh()
            .bold_line_style(GRID.stroke_width(2))
            .light_line_style(TRANSPARENT)
            .axis_style(GHOST.stroke_width(2))
            .label_style(styled(&letters(LABEL), INK, Pos::default()))
            .x_labels(labels_that_fit(&axes.x, right - left))
            .y_labels(MOST_LABELS)
            .x_label_formatter(&|value| plain(*value))
            .y_label_formatter(&|value| plain(*value))
            .draw()?;
        let at = |x: f64, y: f64| context.backend_coord(&(x, y));
        let corners = [at(axes.x.start, axes.y.start), at(axes.x.end, axes.y.end)];
        let plot = Self {
            sheet,
            x: axes.x.clone(),
            y: axes.y.clone(),
            corners,
        };
        plot.names(axes)?;
        Ok(plot)
    }

    fn names(&self, axes: &Axes) -> Drawn {
        let [(left, bottom), (right, top)] = self.corners;
        let (heading, label) = (bold(HEADING), letters(LABEL));
        sheet::text(
            self.sheet,
            axes.title,
            (left, top - 40),
            HPos::Left,
            &heading,
            INK,
        )?;
        let below = (right, bottom + NAME_BELOW);
        sheet::text(self.sheet, axes.x_name, below, HPos::Right, &label, INK)?;
        let style = styled(&label, INK, Pos::new(HPos::Right, VPos::Top));
        self.sheet.draw_text(
            axes.y_name,
            &style.transform(FontTransform::Rotate270),
            (left - NAME_BESIDE, top),
        )
    }

    /// Where a point lies, px; points outside lie on the edge.
    pub fn place(&self, (x, y): (f64, f64)) -> Place {
        let [(left, bottom), (right, top)] = self.corners;
        let along = |value: f64, range: &Range<f64>, from: i32, to: i32| {
            let share = ((value - range.start) / (range.end - range.start)).clamp(0.0, 1.0);
            from + (share * f64::from(to - from)).round() as i32
        };
        (
            along(x, &self.x, left, right),
            along(y, &self.y, bottom, top),
        )
    }

    /// A rectangle between two points.
    pub fn rectangle(&self, corners: [(f64, f64); 2], style: impl Into<ShapeStyle>) -> Drawn {
        let corners = corners.map(|corner| self.place(corner));
        self.sheet.draw(&Rectangle::new(corners, style.into()))
    }

    /// A straight line; what lies outside is left out.
    pub fn segment(&self, ends: [(f64, f64); 2], style: impl Into<ShapeStyle>) -> Drawn {
        let Some(ends) = self.inside(ends) else {
            return Ok(());
        };
        let places: Vec<Place> = ends.iter().map(|&end| self.place(end)).collect();
        self.sheet.draw(&PathElement::new(places, style.into()))
    }

    /// The part of a straight line that lies between the axes.
    fn inside(&self, [from, to]: [(f64, f64); 2]) -> Option<[(f64, f64); 2]> {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for (origin, step, range) in [(from.0, dx, &self.x), (from.1, dy, &self.y)] {
            let [a, b] = [(range.start - origin) / step, (range.end - origin) / step];
            if step == 0.0 {
                if !range.contains(&origin) {
                    return None;
                }
            } else {
                start = start.max(a.min(b));
                end = end.min(a.max(b));
            }
        }
        let at = |share: f64| (from.0 + share * dx, from.1 + share * dy);
        (start < end).then(|| [at(start), at(end)])
    }

    /// Lines over the whole height of the values that lie between the axes, with their names at the
    /// upper end, off each other.
    pub fn marks(&self, marks: &[Mark]) -> Drawn {
        let [(left, _), (right, top)] = self.corners;
        let is_inside = |mark: &&Mark| self.x.contains(&mark.value) || mark.value == self.x.end;
        let inside: Vec<&Mark> = marks.iter().filter(is_inside).collect();
        let marked = inside.iter().map(|mark| Marked {
            x: self.place((mark.value, self.y.end)).0,
            name: &mark.name,
        });
        let marked: Vec<Marked> = marked.collect();
        for mark in &inside {
            self.line_at(mark.value, mark.is_dashed)?;
        }
        for (mark, standing) in marked.iter().zip(arrange(&marked, (left, right))) {
            let y = top + 6 + ROW * standing.row as i32;
            let corners = [(standing.left - 2, y), (standing.right + 2, y + ROW)];
            self.sheet
                .draw(&Rectangle::new(corners, WHITE.mix(0.75).filled()))?;
            let (side, x) = if standing.left < mark.x {
                (HPos::Right, standing.right)
            } else {
                (HPos::Left, standing.left)
            };
            sheet::text(self.sheet, mark.name, (x, y), side, &letters(LABEL), INK)?;
        }
        Ok(())
    }

    fn line_at(&self, x: f64, is_dashed: bool) -> Drawn {
        let ends = [(x, self.y.start), (x, self.y.end)].map(|end| self.place(end));
        let style = INK.stroke_width(3);
        if is_dashed {
            sheet::dashes(self.sheet, ends.to_vec(), style)
        } else {
            self.sheet.draw(&PathElement::new(ends.to_vec(), style))
        }
    }
}

/// How many labels fit side by side on a lower axis of this length, px.
fn labels_that_fit(range: &Range<f64>, length: i32) -> usize {
    const APART: i32 = 14;
    let coordinate: RangedCoordf64 = range.clone().into();
    let fits = |count: &usize| {
        let values = coordinate.key_points(*count);
        let widths = values.iter().map(|it| sheet::width(&plain(*it), LABEL));
        let (number, widest) = (values.len() as f64, widths.max().unwrap_or(0));
        let step = match values[..] {
            [first, second, ..] => (second - first) / (range.end - range.start),
            _ => 1.0 / number.max(1.0),
        };
        step * f64::from(length) >= f64::from(widest + APART)
    };
    (2..=MOST_LABELS).rev().find(fits).unwrap_or(2)
}
