mod caps;
mod edges;
mod rims;

use nalgebra::Point2;

use super::*;
use crate::problem::curve::Curve;
use crate::scene::lanes::{LANES, put};
use crate::scene::profile::Piece;
use crate::scene::rays::{Hits, Rays};

/// A pipe of inner radius 5 and length 10 along z; free space is inside.
fn pipe(near_closed: bool, far_closed: bool) -> Prism {
    let curve = Curve::Arc {
        centre: Point2::origin(),
        radius: 5.0,
        start: 0.0,
        sweep: std::f64::consts::TAU,
    };
    let profile = Profile {
        pieces: vec![Piece { curve, surface: 0 }],
        surfaces: vec!["wall".to_owned()],
    };
    let ends = Ends {
        near_closed,
        far_closed,
    };
    Prism::new(&profile, 10.0, ends, &Place::default(), 7, 1e-9)
}

/// Of the shots.
const RADIUS: f64 = 0.5;

/// What shots touch first that fly side by side.
fn touched_by_many(prism: &Prism, flights: &[Ray]) -> Hits {
    let mut rays = Rays::none();
    rays.count = flights.len();
    rays.are_spheres = true;
    rays.radius = [RADIUS; LANES];
    for (i, flight) in flights.iter().enumerate() {
        put(&mut rays.origin, i, flight.origin.into());
        put(&mut rays.direction, i, flight.direction.into());
    }
    let mut hits = Hits::none();
    prism.cross(0, &rays, &mut hits);
    hits
}

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

/// Four walls from corner to corner, each a surface.
fn square(corners: [[f64; 2]; 4]) -> Profile {
    let corners = corners.map(Point2::from);
    let piece = |wall: usize| Piece {
        curve: Curve::Line {
            from: corners[wall],
            to: corners[(wall + 1) % 4],
        },
        surface: wall as u32,
    };
    Profile {
        pieces: (0..4).map(piece).collect(),
        surfaces: (0..4).map(|wall| format!("wall{wall}")).collect(),
    }
}
