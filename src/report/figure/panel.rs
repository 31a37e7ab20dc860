//! A panel: a pair of axes with what is drawn between them.

use plotters::coord::ranged1d::{BoldPoints, Ranged};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::{Axis, Scale};
use super::sheet::{self, Area, Drawn, Fault, Place, arrow, marker, styled};
use super::style::{FAINT, GHOST, GRID, HEADING, INK, LABEL, Look, bold, letters};

/// A pair of axes.
pub struct Panel<'a, 'b> {
    sheet: &'a Area<'b>,
    x: Scale,
    y: Scale,
    /// Lower left and upper right corner, px.
    pub corners: [Place; 2],
}

/// Room for the labels of the axes, px.
const LABELS_LEFT: u32 = 120;
const LABELS_BELOW: u32 = 40;
/// Labels of an axis at most, and its length for each, px.
const MOST_LABELS: usize = 10;
const FOR_A_LABEL: i32 = 60;
/// Least room between the labels of a lower axis, px.
const LABELS_APART: i32 = 14;
/// Where the title stands above the axes, and the names of these below them and beside the labels, px.
const TITLE_ABOVE: i32 = 40;
const NAME_BELOW: i32 = 46;
const NAME_BESIDE: i32 = 46;

impl<'a, 'b> Panel<'a, 'b> {
    /// Draws axes round a rectangle of the sheet, given by its upper left and lower right corner, px.
    pub fn new(
        sheet: &'a Area<'b>,
        [(left, top), (right, bottom)]: [Place; 2],
        title: &str,
        [x, y]: &[Axis; 2],
    ) -> Result<Self, Fault> {
        let (wide, high) = ((right - left) as u32, (bottom - top) as u32);
        let part = sheet.clone().shrink(
            (left - LABELS_LEFT as i32, top),
            (wide + LABELS_LEFT, high + LABELS_BELOW),
        );
        let mut context = ChartBuilder::on(&part)
            .set_label_area_size(LabelAreaPosition::Left, LABELS_LEFT)
            .set_label_area_size(LabelAreaPosition::Bottom, LABELS_BELOW)
            .build_cartesian_2d(x.scale.clone(), y.scale.clone())?;
        let label = |axis: &Axis, value: f64| match axis.name {
            "" => String::new(),
            _ => (axis.label)(value),
        };
        let count = most_labels(bottom - top);
        context
            .configure_mesh()
            .bold_line_style(GRID.stroke_width(2))
            .light_line_style(GRID.mix(0.45))
            .axis_style(GHOST.stroke_width(2))
            .label_style(styled(&letters(LABEL), INK, Pos::default()))
            .set_all_tick_mark_size(6)
            .x_labels(labels_that_fit(x, right - left))
            .y_labels(count)
            .x_label_formatter(&|value| label(x, *value))
            .y_label_formatter(&|value| label(y, *value))
            .draw()?;
        let panel = Self {
            sheet,
            x: x.scale.clone(),
            y: y.scale.clone(),
            corners: [(left, bottom), (right, top)],
        };
        let labels = y.scale.key_points(BoldPoints(count));
        let widths = labels.iter().map(|it| sheet::width(&label(y, *it), LABEL));
        panel.title(title)?;
        panel.name_below(x)?;
        panel.name_beside(y, widths.max().unwrap_or(0) + NAME_BESIDE)?;
        Ok(panel)
    }

    fn title(&self, title: &str) -> Drawn {
        let [(left, _), (_, top)] = self.corners;
        let place = (left, top - TITLE_ABOVE);
        sheet::text(self.sheet, title, place, HPos::Left, &bold(HEADING), INK)
    }

    fn name_below(&self, axis: &Axis) -> Drawn {
        let [(left, bottom), (right, _)] = self.corners;
        let (y, label) = (bottom + NAME_BELOW, letters(LABEL));
        sheet::text(self.sheet, axis.name, (right, y), HPos::Right, &label, INK)?;
        if axis.towards_low.is_empty() {
            return Ok(());
        }
        arrow(self.sheet, (left + 50, y + 14), (left, y + 14), FAINT)?;
        let (text, place) = (axis.towards_low, (left + 62, y));
        sheet::text(self.sheet, text, place, HPos::Left, &label, FAINT)
    }

    fn name_beside(&self, axis: &Axis, apart: i32) -> Drawn {
        let [(left, bottom), (_, top)] = self.corners;
        let x = left - apart;
        let upwards = |text: &str, place: Place, side: HPos, colour| {
            let style = styled(&letters(LABEL), colour, Pos::new(side, VPos::Top));
            self.sheet
                .draw_text(text, &style.transform(FontTransform::Rotate270), place)
        };
        upwards(axis.name, (x, top), HPos::Right, INK)?;
        if axis.towards_low.is_empty() || axis.name.is_empty() {
            return Ok(());
        }
        arrow(self.sheet, (x + 16, bottom - 50), (x + 16, bottom), FAINT)?;
        upwards(axis.towards_low, (x, bottom - 62), HPos::Left, FAINT)
    }

    /// Where a point lies, px; points outside lie on the edge.
    pub fn place(&self, (x, y): (f64, f64)) -> Place {
        let [(left, bottom), (right, top)] = self.corners;
        (self.x.map(&x, (left, right)), self.y.map(&y, (bottom, top)))
    }

    fn places(&self, points: &[(f64, f64)]) -> Vec<Place> {
        points.iter().map(|&point| self.place(point)).collect()
    }

    /// The line of a series through points.
    pub fn line(&self, points: &[(f64, f64)], look: Look) -> Drawn {
        sheet::line(self.sheet, self.places(points), look)
    }

    /// A dashed line through points.
    pub fn dashes(&self, points: &[(f64, f64)], style: impl Into<ShapeStyle>) -> Drawn {
        sheet::dashes(self.sheet, self.places(points), style.into())
    }

    /// A straight line; what lies outside linear axes is left out.
    pub fn segment(&self, ends: [(f64, f64); 2], style: impl Into<ShapeStyle>) -> Drawn {
        let Some(ends) = self.inside(ends) else {
            return Ok(());
        };
        let line = PathElement::new(self.places(&ends), style.into());
        self.sheet.draw(&line)
    }

    /// The part of a straight line that lies between the axes.
    fn inside(&self, [from, to]: [(f64, f64); 2]) -> Option<[(f64, f64); 2]> {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for (origin, step, scale) in [(from.0, dx, &self.x), (from.1, dy, &self.y)] {
            let range = scale.range();
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

    /// A rectangle between two points.
    pub fn rectangle(&self, corners: [(f64, f64); 2], style: impl Into<ShapeStyle>) -> Drawn {
        let corners = corners.map(|corner| self.place(corner));
        self.sheet.draw(&Rectangle::new(corners, style.into()))
    }

    /// Cells of one size in rows of so many from a corner, each in its colour; those without one are left out.
    pub fn cells(
        &self,
        corner: (f64, f64),
        sides: [f64; 2],
        columns: usize,
        colours: impl Iterator<Item = Option<RGBColor>>,
    ) -> Drawn {
        for (index, colour) in colours.enumerate() {
            let (column, row) = (index % columns, index / columns);
            let at = |further: usize| {
                (
                    corner.0 + sides[0] * (column + further) as f64,
                    corner.1 + sides[1] * (row + further) as f64,
                )
            };
            if let Some(colour) = colour {
                self.rectangle([at(0), at(1)], colour.filled())?;
            }
        }
        Ok(())
    }

    /// A marker at a point.
    pub fn marker(&self, point: (f64, f64), look: Look, radius: f64) -> Drawn {
        marker(self.sheet, self.place(point), look, radius)
    }

    /// A ring round a point.
    pub fn ring(&self, point: (f64, f64), radius: i32) -> Drawn {
        let style = INK.stroke_width(4);
        self.sheet
            .draw(&Circle::new(self.place(point), radius, style))
    }

    /// A text beside a point, this many pixels away.
    pub fn note(
        &self,
        text: &str,
        point: (f64, f64),
        (dx, dy): Place,
        side: HPos,
        colour: RGBColor,
    ) -> Drawn {
        let (x, y) = self.place(point);
        sheet::beside(self.sheet, text, (x + dx, y + dy), side, colour)
    }
}

/// How many labels an axis of this length may have, px.
fn most_labels(length: i32) -> usize {
    ((length / FOR_A_LABEL) as usize).clamp(2, MOST_LABELS)
}

/// How many labels fit side by side on a lower axis of this length, px.
fn labels_that_fit(axis: &Axis, length: i32) -> usize {
    let ends = axis.scale.range();
    let fits = |count: &usize| {
        let values = axis.scale.key_points(BoldPoints(*count));
        let labels = values.iter().map(|it| (axis.label)(*it));
        let widths = labels.map(|label| sheet::width(&label, LABEL));
        let (number, widest) = (values.len() as f64, widths.max().unwrap_or(0));
        let step = match values[..] {
            [first, second, ..] => (second - first) / (ends.end - ends.start),
            _ => 1.0 / number.max(1.0),
        };
        step * f64::from(length) >= f64::from(widest + LABELS_APART)
    };
    (2..=most_labels(length)).rev().find(fits).unwrap_or(2)
}
