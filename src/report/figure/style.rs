//! Colours that colour-blind people can tell apart, markers of different shapes, letters.

use plotters::style::{FontDesc, FontFamily, FontStyle, RGBColor};

/// For text and axes.
pub const INK: RGBColor = RGBColor(34, 34, 34);
/// For what explains.
pub const FAINT: RGBColor = RGBColor(105, 105, 105);
/// For lines of reference.
pub const GHOST: RGBColor = RGBColor(150, 150, 150);
/// For lines of the grid.
pub const GRID: RGBColor = RGBColor(224, 224, 224);
/// For what cannot be told apart.
pub const BAND: RGBColor = RGBColor(243, 243, 243);

// Figures are drawn twice as large as they are shown, because plotters rounds to whole pixels.

/// Letters of titles, px.
pub const TITLE: f64 = 36.0;
/// Letters of panels' titles and axes, px.
pub const HEADING: f64 = 26.0;
/// Letters of everything else, px.
pub const LABEL: f64 = 23.0;

/// Where the embedded font is missing, any other without serifs does.
const FAMILY: FontFamily = FontFamily::Name("Open Sans, sans-serif");
/// By this plotters divides sizes in SVG.
const SIZE_FACTOR: f64 = 1.24;

/// Regular letters of a size, px.
pub fn letters(size: f64) -> FontDesc<'static> {
    FontDesc::new(FAMILY, size * SIZE_FACTOR, FontStyle::Normal)
}

/// Bold letters of a size, px.
pub fn bold(size: f64) -> FontDesc<'static> {
    FontDesc::new(FAMILY, size * SIZE_FACTOR, FontStyle::Bold)
}

/// How the points of a series look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Colour of line and marker.
    pub colour: RGBColor,
    /// Shape of the marker.
    pub shape: Shape,
    /// Whether the line is dashed.
    pub is_dashed: bool,
}

/// Shape of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A disc.
    Circle,
    /// Upright.
    Triangle,
    /// Its sides are parallel to the axes.
    Square,
    /// A square on its corner.
    Diamond,
    /// A triangle on its corner.
    Drop,
}

const fn look(red: u8, green: u8, blue: u8, shape: Shape) -> Look {
    Look {
        colour: RGBColor(red, green, blue),
        shape,
        is_dashed: false,
    }
}

/// Okabe and Ito's colours.
pub const LOOKS: [Look; 7] = [
    look(0, 114, 178, Shape::Circle),
    look(213, 94, 0, Shape::Triangle),
    look(0, 158, 115, Shape::Square),
    look(204, 121, 167, Shape::Diamond),
    look(230, 159, 0, Shape::Drop),
    look(86, 180, 233, Shape::Triangle),
    look(34, 34, 34, Shape::Square),
];

/// The look of the series with this number: colours come again with other markers and dashed lines.
pub fn look_of(series: usize) -> Look {
    let round = series / LOOKS.len();
    Look {
        shape: LOOKS[(series + round) % LOOKS.len()].shape,
        is_dashed: round % 2 == 1,
        ..LOOKS[series % LOOKS.len()]
    }
}

impl Shape {
    /// Corners of the marker round its place, px; none for a disc.
    pub fn corners(self, radius: f64) -> Vec<(i32, i32)> {
        let scaled = |corners: &[(f64, f64)]| {
            let scale =
                |(x, y): &(f64, f64)| ((x * radius).round() as i32, (y * radius).round() as i32);
            corners.iter().map(scale).collect()
        };
        match self {
            Self::Circle => Vec::new(),
            Self::Triangle => scaled(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]),
            Self::Drop => scaled(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]),
            Self::Square => scaled(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
            Self::Diamond => scaled(&[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)]),
        }
    }
}
