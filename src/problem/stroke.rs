//! A stroke: where the nozzle travels while it peens, and what may change on the way.

use nalgebra::{Point3, Vector3};

use super::setting::{Setting, Settings};

/// A stroke as it was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Where the aim point travels.
    pub line: Line,
    /// Stations at which it is verified at least.
    pub stations: usize,
    /// What keeps one value all along.
    pub hold: Hold,
    /// Smallest change of a setting that is worth programming, SI; only of those that may change.
    pub steps: Vec<(Setting, f64)>,
    /// How fast it travels.
    pub feed: Feed,
    /// How often; as often as the feed needs where absent.
    pub passes: Option<u32>,
    /// How far the aim point travels beyond both ends, m; as far as coverage needs where absent.
    pub run_out: Option<f64>,
}

/// Where the aim point travels.
#[derive(Clone, Debug, PartialEq)]
pub enum Line {
    /// Straight from one point to another, m.
    Straight([Point3<f64>; 2]),
    /// Straight from point to point, m.
    Points(Vec<Point3<f64>>),
    /// Round an axis, as over a part that turns.
    Around(Helix),
}

impl Line {
    /// Where it begins, and the key that says so; `None` where that follows from the target's aim point.
    pub fn start(&self) -> Option<(Point3<f64>, &'static str)> {
        match self {
            Self::Straight([from, _]) => Some((*from, "stroke.along.from")),
            Self::Points(points) => Some((*points.first()?, "stroke.points[0]")),
            Self::Around(_) => None,
        }
    }
}

/// A helix whose middle is the target's aim point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix {
    /// A point of the axis, m.
    pub through: Point3<f64>,
    /// Unit vector along it.
    pub axis: Vector3<f64>,
    /// The first and the last angle, rad, 0 at the aim point.
    pub angles: [f64; 2],
    /// How far it moves along the axis in a turn, m.
    pub pitch: f64,
}

/// What keeps one value all along.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hold {
    /// Everything.
    All,
    /// These settings, and the contact where it is named.
    Some {
        /// Settings of the nozzle.
        settings: Vec<Setting>,
        /// Whether the contact is among them.
        contact: bool,
    },
}

/// How fast the spot travels over the part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feed {
    /// As fast as the wanted coverage lets it.
    Auto,
    /// m/s.
    Speed(f64),
    /// Turns of the part, 1/s.
    Turns(f64),
}

/// The span of a whole stroke: a place is -0.5 at its beginning and 0.5 at its end.
pub const WHOLE: [f64; 2] = [-0.5, 0.5];

/// The place on a stroke of a place on the part of it that has this span.
pub fn place_in([from, to]: [f64; 2], place: f64) -> f64 {
    from + (to - from) * (place + 0.5)
}

/// A piece of a stroke with settings of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Places of its ends: -0.5 at the beginning of the stroke, 0.5 at its end.
    pub span: [f64; 2],
    /// What is set there.
    pub settings: Settings,
}

impl Leg {
    /// One setting all along.
    pub fn whole(settings: &Settings) -> Self {
        Self {
            span: WHOLE,
            settings: *settings,
        }
    }

    /// The leg of a place; the first and the last one go on in the run-out.
    ///
    /// # Panics
    /// Without any leg.
    pub fn at(legs: &[Self], place: f64) -> &Self {
        let mut inside = legs.iter();
        inside
            .find(|leg| place <= leg.span[1])
            .unwrap_or(&legs[legs.len() - 1])
    }
}
