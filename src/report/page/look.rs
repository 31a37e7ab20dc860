//! Colours of the 3-D view and of its still picture, which colour-blind people can tell apart.

use serde::{Serialize, Serializer};

/// A colour by its red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

impl Colour {
    /// The same colour, darker by a factor.
    pub fn darker(self, factor: f64) -> Self {
        let part = |part: u8| (f64::from(part) * factor).round() as u8;
        Self(part(self.0), part(self.1), part(self.2))
    }
}

impl std::fmt::Display for Colour {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// How the flights of a shot look that follow a certain bounce.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Flight {
    /// Its colour.
    pub colour: Colour,
    /// What it is called.
    pub name: &'static str,
}

const fn flight(colour: Colour, name: &'static str) -> Flight {
    Flight { colour, name }
}

/// All colours.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Look {
    /// The target patch.
    pub target: Colour,
    /// The line where it is cut.
    pub target_cut: Colour,
    /// Secondary surfaces, in turn.
    pub surfaces: [Colour; 8],
    /// What belongs to the flight.
    pub deflector: Colour,
    /// The body of the nozzle.
    pub nozzle: Colour,
    /// The line where surfaces are cut.
    pub section: Colour,
    /// Flights by bounce, the last for all later ones: Okabe and Ito's colours.
    pub flights: [Flight; 4],
    /// Shots and impacts that break a limit.
    pub breaks: Colour,
    /// First hits on the target.
    pub hit: Colour,
    /// Impacts on other surfaces.
    pub rebound: Colour,
}

/// The colours in use.
pub const LOOK: Look = Look {
    target: Colour(240, 194, 60),
    target_cut: Colour(185, 127, 0),
    surfaces: [
        Colour(185, 200, 216),
        Colour(216, 203, 176),
        Colour(189, 211, 192),
        Colour(211, 191, 210),
        Colour(201, 201, 196),
        Colour(224, 191, 174),
        Colour(174, 205, 211),
        Colour(207, 211, 168),
    ],
    deflector: Colour(125, 135, 146),
    nozzle: Colour(74, 85, 96),
    section: Colour(43, 50, 58),
    flights: [
        flight(Colour(0, 114, 178), "to the first hit"),
        flight(Colour(230, 159, 0), "after the first hit"),
        flight(Colour(0, 158, 115), "after the second"),
        flight(Colour(204, 121, 167), "later"),
    ],
    breaks: Colour(208, 28, 28),
    hit: Colour(18, 50, 74),
    rebound: Colour(138, 90, 0),
};
