//! The figure of a map: a quantity over two settings, where every verdict passes, where the nozzle
//! does not fit, and where shots stick.

mod key;

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::axis::Axis;
use super::field::{Field, Outline};
use super::labels::{Labels, half_width};
use super::levels::Levels;
use super::panel::Panel;
use super::sheet::{self, Area, Drawn, Fault, Place, drawn, headline};
use super::style::{GHOST, INK, LOOKS};
use crate::record::{CellRecord, MapTerm};
use crate::report::map::{AxisView, MapView};

const SIZE: (u32, u32) = (1800, 1530);
const HEAD: u32 = 190;
const PLOT: u32 = 1120;
/// Upper left and lower right corner of the axes, px, and what is left below them.
const AXES: [Place; 2] = [(150, 206), (1454, 1210)];
const BELOW: u32 = 100;
const BAR: u32 = 330;
/// Shares above this count as a region.
const HALF: f64 = 0.5;

/// The figure as SVG; `None` when the map has no extent.
pub fn svg(view: &MapView, term: MapTerm) -> Option<Result<String, Fault>> {
    let axes = view.axes();
    if axes.iter().any(|axis| axis.values.len() < 2) {
        return None;
    }
    Some(drawn(SIZE, |area| {
        let sentences = [
            view.problem.title.clone(),
            format!("held: {}", view.held()),
            view.extent(),
        ];
        headline(area, &view.title(term), &sentences)?;
        let (_, below) = area.split_vertically(HEAD);
        let (middle, foot) = below.split_vertically(PLOT);
        let (_, bar) = middle.split_horizontally(SIZE.0 - BAR);
        let picture = Picture::new(view, term, &axes, area)?;
        picture.draw()?;
        picture.colour_bar(&bar)?;
        picture.legend(&foot)
    }))
}

/// A map with its place on the sheet.
struct Picture<'a, 'b> {
    view: &'a MapView<'a>,
    term: MapTerm,
    axes: &'a [AxisView; 2],
    sheet: &'a Area<'b>,
    panel: Panel<'a, 'b>,
    /// `None` where the quantity is the same everywhere.
    levels: Option<Levels>,
}

impl<'a, 'b> Picture<'a, 'b> {
    fn new(
        view: &'a MapView,
        term: MapTerm,
        axes: &'a [AxisView; 2],
        sheet: &'a Area<'b>,
    ) -> Result<Self, Fault> {
        let [x_name, y_name] = axes.each_ref().map(AxisView::title);
        let [x, y] = axes.each_ref().map(ends);
        let shown = [
            Axis::linear(x.0..x.1, &x_name),
            Axis::linear(y.0..y.1, &y_name),
        ];
        Ok(Self {
            view,
            term,
            axes,
            sheet,
            panel: Panel::new(sheet, AXES, "", &shown)?,
            levels: Levels::of(view.map.cells.iter().filter_map(|cell| term.of(cell))),
        })
    }

    fn draw(&self) -> Drawn {
        let blocked = self.field(|cell| cell.is_known().then(|| share(cell.is_blocked())));
        let unknown = self.field(|cell| Some(share(!cell.is_known())));
        let is_covered = |place| {
            let fields = [&blocked, &unknown].into_iter().flatten();
            fields.into_iter().any(|field| field.reaches(HALF, place))
        };
        let mut labels = Labels::new(self.panel.corners, &is_covered);
        self.quantity(&mut labels)?;
        self.sticking(&mut labels)?;
        self.no_room(blocked.as_ref())?;
        self.passing()?;
        self.blank(unknown.as_ref())?;
        for (text, place) in &labels.taken {
            self.label(text, *place)?;
        }
        self.setting()?;
        self.frame()
    }

    /// A field over the plot.
    fn field(&self, of: impl Fn(&CellRecord) -> Option<f64>) -> Option<Field> {
        let values: Vec<Option<f64>> = self.view.map.cells.iter().map(of).collect();
        let columns = self.axes[0].values.len();
        Field::new(
            &values,
            columns,
            self.panel.corners[0],
            self.panel.corners[1],
        )
    }

    fn line(&self, line: Outline, style: ShapeStyle) -> Drawn {
        self.sheet.draw(&PathElement::new(line, style))
    }

    fn region(&self, outline: &Outline, colour: RGBColor) -> Drawn {
        self.sheet
            .draw(&Polygon::new(outline.clone(), colour.filled()))
    }

    /// Bands of colour with lines between them.
    fn quantity(&self, labels: &mut Labels) -> Drawn {
        let background = self
            .levels
            .as_ref()
            .map_or(WHITE, |levels| levels.colour(0));
        self.sheet
            .draw(&Rectangle::new(self.panel.corners, background.filled()))?;
        let Some(levels) = &self.levels else {
            return Ok(());
        };
        let scaled = |cell: &CellRecord| Some(levels.scaled(self.term.of(cell)?));
        let Some(field) = self.field(scaled) else {
            return Ok(());
        };
        for (index, &level) in levels.values.iter().enumerate() {
            for outline in field.regions(levels.scaled(level)) {
                self.region(&outline, levels.colour(index + 1))?;
            }
        }
        for (index, &level) in levels.values.iter().enumerate() {
            let lines = field.lines(levels.scaled(level));
            for line in &lines {
                self.line(line.clone(), WHITE.mix(0.55).stroke_width(2))?;
            }
            if let Some(longest) = lines.iter().max_by_key(|line| line.len()) {
                labels.put_on(longest, &levels.text(index));
            }
        }
        Ok(())
    }

    /// A text on a light ground.
    fn label(&self, text: &str, (x, y): Place) -> Drawn {
        let half = half_width(text);
        let ground = WHITE.mix(0.8).filled();
        self.sheet.draw(&Rectangle::new(
            [(x - half, y - 15), (x + half, y + 15)],
            ground,
        ))?;
        sheet::beside(self.sheet, text, (x, y), HPos::Center, INK)
    }

    /// Hatches where the nozzle does not fit.
    fn no_room(&self, blocked: Option<&Field>) -> Drawn {
        let Some(field) = blocked else {
            return Ok(());
        };
        for outline in field.regions(HALF) {
            self.region(&outline, WHITE)?;
        }
        let [(left, bottom), (right, top)] = self.panel.corners;
        for start in (left - (bottom - top)..right).step_by(22) {
            let mut piece: Option<[Place; 2]> = None;
            for step in (0..=bottom - top).step_by(2) {
                let place = (start + step, bottom - step);
                let is_blocked = (left..=right).contains(&place.0) && field.reaches(HALF, place);
                if is_blocked {
                    piece = Some([piece.map_or(place, |[from, _]| from), place]);
                } else if let Some(ends) = piece.take() {
                    self.hatch(ends)?;
                }
            }
            piece.map_or(Ok(()), |ends| self.hatch(ends))?;
        }
        for line in field.lines(HALF) {
            self.line(line, GHOST.stroke_width(3))?;
        }
        Ok(())
    }

    /// Leaves blank what is not known.
    fn blank(&self, unknown: Option<&Field>) -> Drawn {
        let outlines = unknown.map(|field| field.regions(HALF)).unwrap_or_default();
        outlines.iter().try_for_each(|it| self.region(it, WHITE))
    }

    fn hatch(&self, ends: [Place; 2]) -> Drawn {
        self.line(ends.to_vec(), GHOST.stroke_width(2))
    }

    /// The line on which half of the first hits stick. What is drawn later may hide it.
    fn sticking(&self, labels: &mut Labels) -> Drawn {
        let share = |cell: &CellRecord| cell.share_sticking.map(f64::from);
        let Some(field) = self.field(share) else {
            return Ok(());
        };
        let lines = field.lines(HALF);
        for line in &lines {
            self.line(line.clone(), WHITE.stroke_width(6))?;
            sheet::dashes(self.sheet, line.clone(), LOOKS[1].colour.stroke_width(4))?;
        }
        if let Some(longest) = lines.iter().max_by_key(|line| line.len()) {
            labels.put_beside(longest, "grip", |place| field.reaches(HALF, place));
            labels.put_beside(longest, "slip", |place| !field.reaches(HALF, place));
        }
        Ok(())
    }

    /// The line round the places where every verdict passes.
    fn passing(&self) -> Drawn {
        let passes = |cell: &CellRecord| cell.is_known().then(|| share(cell.passes()));
        let Some(field) = self.field(passes) else {
            return Ok(());
        };
        for line in field.lines(HALF) {
            self.line(line.clone(), WHITE.stroke_width(9))?;
            self.line(line, INK.stroke_width(5))?;
        }
        Ok(())
    }

    /// The settings round which the map was made, and how exactly they can be set.
    fn setting(&self) -> Drawn {
        let [x, y] = self.axes;
        let is_inside = |axis: &AxisView| (ends(axis).0..=ends(axis).1).contains(&axis.at);
        if !self.view.marks_settings || !is_inside(x) || !is_inside(y) {
            return Ok(());
        }
        let place = |sign: f64| {
            let [x, y] = [x, y].map(|axis| axis.at + sign * axis.tolerance);
            self.panel.place((x, y))
        };
        if x.tolerance > 0.0 || y.tolerance > 0.0 {
            let corners = [place(-1.0), place(1.0)];
            self.line(outline(corners), WHITE.stroke_width(7))?;
            self.line(outline(corners), INK.stroke_width(3))?;
        }
        marker(self.sheet, place(0.0))
    }

    fn frame(&self) -> Drawn {
        self.line(outline(self.panel.corners), GHOST.stroke_width(2))
    }
}

/// All of a place, or nothing.
fn share(is: bool) -> f64 {
    f64::from(u8::from(is))
}

/// The outermost values of an axis.
fn ends(axis: &AxisView) -> (f64, f64) {
    let values = &axis.values;
    (values[0], values[values.len() - 1])
}

/// The outline of a rectangle.
fn outline([(left, bottom), (right, top)]: [Place; 2]) -> Outline {
    vec![
        (left, bottom),
        (right, bottom),
        (right, top),
        (left, top),
        (left, bottom),
    ]
}

fn marker(area: &Area, place: Place) -> Drawn {
    area.draw(&Circle::new(place, 14, WHITE.filled()))?;
    area.draw(&Circle::new(place, 14, INK.stroke_width(4)))?;
    area.draw(&Circle::new(place, 5, INK.filled()))
}
