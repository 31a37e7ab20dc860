//! One pair of logarithmic axes with what is drawn between them.

use plotters::coord::combinators::{LogCoord, WithKeyPoints};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::LogAxis;
use super::sheet::{self, Area, Drawn, Fault, Place, arrow, marker, styled};
use super::style::{FAINT, GHOST, GRID, HEADING, INK, LABEL, Look, bold, letters};

type Log = WithKeyPoints<LogCoord<f64>>;

/// One pair of logarithmic axes.
pub struct Plot<'a, 'b> {
    sheet: &'a Area<'b>,
    context: ChartContext<'a, SVGBackend<'b>, Cartesian2d<Log, Log>>,
    axes: &'a Axes<'a>,
}

/// What a pair of axes shows.
pub struct Axes<'a> {
    /// Above the axes.
    pub title: &'a str,
    /// The lower axis.
    pub x: LogAxis,
    /// What it shows, with its unit.
    pub x_name: &'a str,
    /// How its ticks are labelled.
    pub x_label: fn(f64) -> String,
    /// The left axis.
    pub y: LogAxis,
    /// What it shows, with its unit; without a name the axis has no labels either.
    pub y_name: Option<&'a str>,
    /// How its ticks are labelled.
    pub y_label: fn(f64) -> String,
}

/// Room round the axes, px.
const LEFT: u32 = 150;
const LEFT_WITHOUT_LABELS: u32 = 30;
const BELOW: u32 = 100;
const ABOVE: u32 = 50;
const RIGHT: u32 = 30;
/// Where the names of axes stand, px from them.
const NAME_BELOW: i32 = 48;
const NAME_BESIDE: i32 = 138;

impl<'a, 'b> Plot<'a, 'b> {
    /// Draws axes into a part of the sheet.
    pub fn new(sheet: &'a Area<'b>, part: &'a Area<'b>, axes: &'a Axes) -> Result<Self, Fault> {
        let left = axes.y_name.map_or(LEFT_WITHOUT_LABELS, |_| LEFT);
        let context = ChartBuilder::on(part)
            .set_label_area_size(LabelAreaPosition::Left, left)
            .set_label_area_size(LabelAreaPosition::Bottom, BELOW)
            .margin_top(ABOVE)
            .margin_right(RIGHT)
            .build_cartesian_2d(axes.x.coordinate(), axes.y.coordinate())?;
        let mut plot = Self {
            sheet,
            context,
            axes,
        };
        plot.grid()?;
        plot.names()?;
        Ok(plot)
    }

    /// Where a point lies, px.
    pub fn place(&self, point: (f64, f64)) -> Place {
        let axes = self.axes;
        self.context.backend_coord(&(
            point.0.clamp(axes.x.from, axes.x.to),
            point.1.clamp(axes.y.from, axes.y.to),
        ))
    }

    fn places(&self, points: &[(f64, f64)]) -> Vec<Place> {
        points.iter().map(|&point| self.place(point)).collect()
    }

    fn grid(&mut self) -> Drawn {
        let axes = self.axes;
        let x_label = |value: &f64| (axes.x_label)(*value);
        let y_label = |value: &f64| match axes.y_name {
            Some(_) => (axes.y_label)(*value),
            None => String::new(),
        };
        self.context
            .configure_mesh()
            .bold_line_style(GRID.stroke_width(2))
            .light_line_style(GRID.mix(0.45))
            .axis_style(GHOST.stroke_width(2))
            .label_style(styled(&letters(LABEL), INK, Pos::default()))
            .set_all_tick_mark_size(6)
            .x_label_formatter(&x_label)
            .y_label_formatter(&y_label)
            .draw()
    }

    /// Title, names of the axes, and which way is better.
    fn names(&self) -> Drawn {
        let (left, bottom) = self.place((0.0, 0.0));
        let (right, top) = self.place((f64::INFINITY, f64::INFINITY));
        let (heading, label) = (bold(HEADING), letters(LABEL));
        sheet::text(
            self.sheet,
            self.axes.title,
            (left, top - 42),
            HPos::Left,
            &heading,
            INK,
        )?;
        let below = bottom + NAME_BELOW;
        let name = self.axes.x_name;
        sheet::text(self.sheet, name, (right, below), HPos::Right, &label, INK)?;
        arrow(
            self.sheet,
            (left + 50, below + 14),
            (left, below + 14),
            FAINT,
        )?;
        sheet::text(
            self.sheet,
            "faster",
            (left + 62, below),
            HPos::Left,
            &label,
            FAINT,
        )?;
        let Some(name) = self.axes.y_name else {
            return Ok(());
        };
        let beside = left - NAME_BESIDE;
        let upwards = |text: &str, place: Place, side: HPos, colour| {
            let style = styled(&label, colour, Pos::new(side, VPos::Top));
            self.sheet
                .draw_text(text, &style.transform(FontTransform::Rotate270), place)
        };
        upwards(name, (beside, top), HPos::Right, INK)?;
        arrow(
            self.sheet,
            (beside + 16, bottom - 50),
            (beside + 16, bottom),
            FAINT,
        )?;
        upwards("more accurate", (beside, bottom - 62), HPos::Left, FAINT)
    }

    /// The line of a series through points.
    pub fn line(&self, points: &[(f64, f64)], look: Look) -> Drawn {
        sheet::line(self.sheet, self.places(points), look)
    }

    /// A dashed line through points.
    pub fn dashes(&self, points: &[(f64, f64)], style: impl Into<ShapeStyle>) -> Drawn {
        sheet::dashes(self.sheet, self.places(points), style.into())
    }

    /// A band over the whole width, from the lower edge to a value.
    pub fn band(&self, to: f64, colour: RGBColor) -> Drawn {
        let corners = [self.place((0.0, 0.0)), self.place((f64::INFINITY, to))];
        self.sheet.draw(&Rectangle::new(corners, colour.filled()))
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
        let style = styled(&letters(LABEL), colour, Pos::new(side, VPos::Center));
        self.sheet.draw_text(text, &style, (x + dx, y + dy))
    }
}
