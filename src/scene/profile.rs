//! Cross-sections of lines and arcs: the exact geometry of prismatic parts.

use nalgebra::{Point2, Vector2};

use crate::elementary::atan2;
use crate::problem::curve::Curve;
use crate::problem::part::{Keyway, Segment};

/// A cross-section; free space lies to the left of every piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The pieces in order.
    pub pieces: Vec<Piece>,
    /// Names of the surfaces that the pieces belong to.
    pub surfaces: Vec<String>,
}

/// One piece of a cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Its form.
    pub curve: Curve,
    /// Index of its surface.
    pub surface: u32,
}

/// Where two pieces of a cross-section meet at an edge that sticks out into free space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The place.
    pub point: Point2<f64>,
    /// Indices of the two pieces.
    pub walls: [usize; 2],
    /// Points to the side of the bisector on which the second piece is.
    pub towards_second: Vector2<f64>,
}

impl Corner {
    /// The end of an outline that is not closed.
    fn free(point: Point2<f64>, wall: usize) -> Self {
        Self {
            point,
            walls: [wall; 2],
            towards_second: Vector2::x(),
        }
    }
}

/// Pieces whose directions differ by less than this, rad, go on smoothly.
const SMOOTH: f64 = 1e-9;

impl Profile {
    fn empty() -> Self {
        Self {
            pieces: Vec::new(),
            surfaces: Vec::new(),
        }
    }

    fn push(&mut self, curve: Curve, surface: &str) {
        let known = self.surfaces.iter().position(|name| name == surface);
        let index = known.unwrap_or_else(|| {
            self.surfaces.push(surface.to_owned());
            self.surfaces.len() - 1
        });
        self.pieces.push(Piece {
            curve,
            surface: index as u32,
        });
    }

    /// A full circle round the origin, seen from inside; surface `wall`.
    pub fn circle(diameter: f64) -> Self {
        let mut profile = Self::empty();
        let circle = Curve::Arc {
            centre: Point2::origin(),
            radius: diameter / 2.0,
            start: 0.0,
            sweep: std::f64::consts::TAU,
        };
        profile.push(circle, "wall");
        profile
    }

    /// The outline of an extruded part.
    pub fn outline(segments: &[Segment]) -> Self {
        let mut profile = Self::empty();
        for segment in segments {
            profile.push(segment.curve(), &segment.surface);
        }
        profile
    }

    /// The cross-section of a keyway, counter-clockwise from the floor.
    pub fn keyway(keyway: &Keyway) -> Self {
        let radius = keyway.bore / 2.0;
        let half = keyway.width / 2.0;
        let floor = radius + keyway.depth;
        let lip = (radius * radius - half * half).sqrt();
        let root = keyway.root_radius;
        let line = |x0: f64, y0: f64, x1: f64, y1: f64| Curve::Line {
            from: Point2::new(x0, y0),
            to: Point2::new(x1, y1),
        };
        let fillet = |x: f64, start: f64| Curve::Arc {
            centre: Point2::new(x, floor - root),
            radius: root,
            start,
            sweep: std::f64::consts::FRAC_PI_2,
        };
        let mut profile = Self::empty();
        profile.push(line(half - root, floor, -(half - root), floor), "floor");
        if root > 0.0 {
            profile.push(
                fillet(-(half - root), std::f64::consts::FRAC_PI_2),
                "root_neg",
            );
        }
        profile.push(line(-half, floor - root, -half, lip), "wall_neg");
        let start = atan2(lip, -half);
        let bore = Curve::Arc {
            centre: Point2::origin(),
            radius,
            start,
            sweep: std::f64::consts::TAU - 2.0 * (start - std::f64::consts::FRAC_PI_2),
        };
        profile.push(bore, "bore");
        profile.push(line(half, lip, half, floor - root), "wall_pos");
        if root > 0.0 {
            profile.push(fillet(half - root, 0.0), "root_pos");
        }
        profile
    }

    /// The corners at which free space takes more than a half turn, and the ends of open outlines.
    pub fn convex_corners(&self) -> Vec<Corner> {
        let curves = || self.pieces.iter().map(|piece| &piece.curve);
        let meet =
            |a: Point2<f64>, b: Point2<f64>| (a - b).amax() <= 1e-9 * (a.coords.amax() + 1e-9);
        let mut corners = Vec::new();
        for (first, before) in curves().enumerate() {
            let end = before.at(1.0);
            let second = curves().position(|after| meet(after.at(0.0), end));
            let Some(second) = second else {
                corners.push(Corner::free(end, first));
                continue;
            };
            let after = &self.pieces[second].curve;
            let (incoming, outgoing) = (before.tangent(1.0), after.tangent(0.0));
            let turn = atan2(incoming.perp(&outgoing), incoming.dot(&outgoing));
            let is_cusp = turn >= std::f64::consts::PI - SMOOTH;
            if is_cusp || turn < -SMOOTH {
                corners.push(Corner {
                    point: end,
                    walls: [first, second],
                    towards_second: incoming + outgoing,
                });
            }
        }
        for (first, curve) in curves().enumerate() {
            let start = curve.at(0.0);
            if !curves().any(|before| meet(before.at(1.0), start)) {
                corners.push(Corner::free(start, first));
            }
        }
        corners
    }

    /// The points along each piece, both ends included, when arcs become chords that turn by at
    /// most `chord_angle` rad.
    pub fn chords(&self, chord_angle: f64) -> Vec<Vec<Point2<f64>>> {
        self.pieces
            .iter()
            .map(|piece| {
                let count = piece.curve.chords(chord_angle);
                (0..=count)
                    .map(|k| piece.curve.at(k as f64 / count as f64))
                    .collect()
            })
            .collect()
    }
}

#[cfg(test)]
mod tests;
