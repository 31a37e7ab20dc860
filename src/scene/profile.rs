//! Cross-sections of lines and arcs: the exact geometry of prismatic parts.

use nalgebra::{Point2, Vector2};

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

/// A straight line or a circular arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// From one point to another.
    Line {
        /// Start.
        from: Point2<f64>,
        /// End.
        to: Point2<f64>,
    },
    /// Part of a circle.
    Arc {
        /// Centre of the circle.
        centre: Point2<f64>,
        /// Radius of the circle.
        radius: f64,
        /// Direction of the start as seen from the centre, rad.
        start: f64,
        /// Angle swept, rad; positive counter-clockwise, at most 2 pi either way.
        sweep: f64,
    },
}

impl Curve {
    /// The arc from `from` through `via` to `to`; `None` when the three lie on a line.
    pub fn arc_through(from: Point2<f64>, via: Point2<f64>, to: Point2<f64>) -> Option<Self> {
        let (b, c) = (via - from, to - from);
        let twice_area = b.perp(&c);
        if twice_area.abs() <= 1e-12 * b.norm() * c.norm() {
            return None;
        }
        let offset = Vector2::new(
            c.y * b.norm_squared() - b.y * c.norm_squared(),
            b.x * c.norm_squared() - c.x * b.norm_squared(),
        ) / (2.0 * twice_area);
        let centre = from + offset;
        let direction = |p: Point2<f64>| (p.y - centre.y).atan2(p.x - centre.x);
        let start = direction(from);
        let turn = std::f64::consts::TAU;
        let forward = (direction(to) - start).rem_euclid(turn);
        // The three points run counter-clockwise exactly when the arc does.
        let sweep = if twice_area > 0.0 {
            forward
        } else {
            forward - turn
        };
        Some(Self::Arc {
            centre,
            radius: offset.norm(),
            start,
            sweep,
        })
    }

    /// The point at `fraction` (0 to 1) of its length.
    pub fn at(&self, fraction: f64) -> Point2<f64> {
        match *self {
            Self::Line { from, to } => from + (to - from) * fraction,
            Self::Arc {
                centre,
                radius,
                start,
                sweep,
            } => {
                let (sin, cos) = (start + sweep * fraction).sin_cos();
                centre + Vector2::new(cos, sin) * radius
            }
        }
    }

    /// Unit direction at `fraction` (0 to 1) of its length.
    pub fn tangent(&self, fraction: f64) -> Vector2<f64> {
        match *self {
            Self::Line { from, to } => (to - from).normalize(),
            Self::Arc { start, sweep, .. } => {
                let (sin, cos) = (start + sweep * fraction).sin_cos();
                Vector2::new(-sin, cos) * sweep.signum()
            }
        }
    }

    /// Length, m.
    pub fn length(&self) -> f64 {
        match *self {
            Self::Line { from, to } => (to - from).norm(),
            Self::Arc { radius, sweep, .. } => radius * sweep.abs(),
        }
    }

    /// Number of chords, none of which turns by more than `chord_angle` rad.
    pub fn chords(&self, chord_angle: f64) -> usize {
        match *self {
            Self::Line { .. } => 1,
            // A sweep that is a multiple of the angle up to rounding needs no extra chord.
            Self::Arc { sweep, .. } => ((sweep.abs() / chord_angle - 1e-9).ceil() as usize).max(1),
        }
    }
}

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
            let line = Curve::Line {
                from: segment.from,
                to: segment.to,
            };
            let curve = segment
                .via
                .and_then(|via| Curve::arc_through(segment.from, via, segment.to))
                .unwrap_or(line);
            profile.push(curve, &segment.surface);
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
        let start = lip.atan2(-half);
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
            let turn = incoming.perp(&outgoing).atan2(incoming.dot(&outgoing));
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
