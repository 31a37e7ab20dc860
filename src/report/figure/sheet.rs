//! The sheet that a figure is drawn on: texts, markers and arrows in pixels.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::style::{FAINT, INK, LABEL, Look, TITLE, bold, letters};
use crate::elementary::hypot;
use crate::report::layout::wrap;

/// A part of the figure.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// What plotters can fail with; writing into memory does not.
pub type Fault = DrawingAreaErrorKind<std::io::Error>;
/// Whether something could be drawn.
pub type Drawn = Result<(), Fault>;

/// A place, px.
pub type Place = (i32, i32);

/// Draws the SVG of a figure of this size.
pub fn drawn(size: (u32, u32), draw: impl FnOnce(&Area) -> Drawn) -> Result<String, Fault> {
    let mut svg = String::new();
    {
        let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        area.fill(&WHITE)?;
        draw(&area)?;
        area.present()?;
    }
    // Titles may hold anything, XML may not.
    let is_forbidden =
        |c: char| (c.is_control() && c != '\n') || matches!(c, '\u{fffe}' | '\u{ffff}');
    Ok(svg.replace(is_forbidden, " "))
}

/// The title, and below it sentences that say what is seen, each on lines of its own.
pub fn headline(area: &Area, title: &str, sentences: &[String]) -> Drawn {
    text(area, title, (40, 26), HPos::Left, &bold(TITLE), INK)?;
    let lines = sentences.iter().flat_map(|sentence| wrap(sentence, LINE));
    for (number, line) in lines.enumerate() {
        let place = (40, 80 + 32 * number as i32);
        let colour = if number == 0 { INK } else { FAINT };
        text(area, &line, place, HPos::Left, &letters(LABEL), colour)?;
    }
    Ok(())
}

/// Letters that fit on a line of the headline.
const LINE: usize = 160;

/// A line of text whose upper edge is at a place.
pub fn text(
    area: &Area,
    text: &str,
    place: Place,
    side: HPos,
    font: &FontDesc,
    colour: RGBColor,
) -> Drawn {
    area.draw_text(
        text,
        &styled(font, colour, Pos::new(side, VPos::Top)),
        place,
    )
}

/// A line of text beside a place, at its height.
pub fn beside(area: &Area, text: &str, place: Place, side: HPos, colour: RGBColor) -> Drawn {
    let style = styled(&letters(LABEL), colour, Pos::new(side, VPos::Center));
    area.draw_text(text, &style, place)
}

/// Letters in a colour, with a place to hold them by.
pub fn styled<'a>(font: &FontDesc<'a>, colour: RGBColor, pos: Pos) -> TextStyle<'a> {
    font.clone().color(&colour).pos(pos)
}

/// The line of a series.
pub fn line(area: &Area, places: Vec<Place>, look: Look) -> Drawn {
    let style = look.colour.stroke_width(4);
    if look.is_dashed {
        dashes(area, places, style)
    } else {
        area.draw(&PathElement::new(places, style))
    }
}

/// A dashed line.
pub fn dashes(area: &Area, places: Vec<Place>, style: ShapeStyle) -> Drawn {
    area.draw(&DashedPathElement::new(places, 10, 8, style))
}

/// A marker.
pub fn marker(area: &Area, (x, y): Place, look: Look, radius: f64) -> Drawn {
    let style = look.colour.filled();
    let corners = look.shape.corners(radius);
    if corners.is_empty() {
        return area.draw(&Circle::new((x, y), radius.round() as i32, style));
    }
    let corners: Vec<Place> = corners.iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
    area.draw(&Polygon::new(corners, style))
}

/// An arrow, since few fonts have one.
pub fn arrow(area: &Area, from: Place, to: Place, colour: RGBColor) -> Drawn {
    let (dx, dy) = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
    let length = hypot(dx, dy).max(1.0);
    let (ux, uy) = (dx / length, dy / length);
    let at = |along: f64, across: f64| {
        (
            (f64::from(to.0) + along * ux - across * uy).round() as i32,
            (f64::from(to.1) + along * uy + across * ux).round() as i32,
        )
    };
    area.draw(&PathElement::new(
        vec![from, at(-8.0, 0.0)],
        colour.stroke_width(3),
    ))?;
    area.draw(&Polygon::new(
        vec![at(0.0, 0.0), at(-14.0, 7.0), at(-14.0, -7.0)],
        colour.filled(),
    ))
}

/// One line of a legend: a marker on a piece of its line, and a name.
pub fn key(area: &Area, (x, y): Place, look: Look, name: &str) -> Drawn {
    line(area, vec![(x, y), (x + 52, y)], look)?;
    marker(area, (x + 26, y), look, 9.0)?;
    beside(area, name, (x + 66, y), HPos::Left, INK)
}

/// About how wide a text is, px: enough to set one beside another.
pub fn width(text: &str, size: f64) -> i32 {
    (text.chars().count() as f64 * size * 0.54).ceil() as i32
}
