//! The lines and arcs that cross-sections are made of.

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use crate::elementary::{atan2, sin_cos};

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
        let direction = |p: Point2<f64>| atan2(p.y - centre.y, p.x - centre.x);
        let start = direction(from);
        let turn = TAU;
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

    /// The least x of any of its points.
    pub fn least_x(&self) -> f64 {
        let [from, to] = self.ends();
        let least = from.x.min(to.x);
        match *self {
            Self::Arc {
                centre,
                radius,
                start,
                sweep,
            } => {
                let to_the_left = (std::f64::consts::PI - start) * sweep.signum();
                match to_the_left.rem_euclid(TAU) <= sweep.abs() {
                    true => centre.x - radius,
                    false => least,
                }
            }
            Self::Line { .. } => least,
        }
    }

    /// The points that it starts and ends at.
    pub fn ends(&self) -> [Point2<f64>; 2] {
        match *self {
            Self::Line { from, to } => [from, to],
            Self::Arc { .. } => [self.at(0.0), self.at(1.0)],
        }
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
                let (sin, cos) = sin_cos(start + sweep * fraction);
                centre + Vector2::new(cos, sin) * radius
            }
        }
    }

    /// Unit direction at `fraction` (0 to 1) of its length.
    pub fn tangent(&self, fraction: f64) -> Vector2<f64> {
        match *self {
            Self::Line { from, to } => (to - from).normalize(),
            Self::Arc { start, sweep, .. } => {
                let (sin, cos) = sin_cos(start + sweep * fraction);
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

#[cfg(test)]
pub(crate) mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn is_near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-12
    }

    pub fn line(from: [f64; 2], to: [f64; 2]) -> Curve {
        Curve::Line {
            from: from.into(),
            to: to.into(),
        }
    }

    #[test]
    fn arcs_go_through_three_points() {
        // A circle of radius 5 round (1, 2), over its upper half and over its lower half.
        for (via, turn) in [([4.0, 6.0], 1.0), ([-2.0, 6.0], 1.0), ([4.0, -2.0], -1.0)] {
            let arc = Curve::arc_through([6.0, 2.0].into(), via.into(), [-4.0, 2.0].into());
            let arc = arc.expect("they lie on no line");
            let Curve::Arc {
                centre,
                radius,
                start,
                sweep,
            } = arc
            else {
                panic!("an arc is round");
            };
            assert!((centre - Point2::new(1.0, 2.0)).norm() < 1e-12);
            assert!(is_near(radius, 5.0) && is_near(start, 0.0));
            assert!(is_near(sweep, turn * PI));
            assert!(is_near(arc.length(), 5.0 * PI));
            let middle = Point2::new(1.0, 2.0 + turn * 5.0);
            assert!((arc.at(0.5) - middle).norm() < 1e-12);
            assert!((arc.tangent(0.0) - Vector2::new(0.0, turn)).norm() < 1e-12);
            assert!((arc.tangent(0.5) + Vector2::x()).norm() < 1e-12);
            assert!((arc.tangent(1.0) + Vector2::new(0.0, turn)).norm() < 1e-12);
        }
        let straight = [[0.0, 0.0], [1.0, 2.0], [2.0, 4.0]].map(Point2::from);
        assert_eq!(
            Curve::arc_through(straight[0], straight[1], straight[2]),
            None
        );
        let line = line([1.0, 1.0], [4.0, 5.0]);
        assert!(is_near(line.length(), 5.0));
        assert!((line.tangent(0.3) - Vector2::new(0.6, 0.8)).norm() < 1e-12);
        assert_eq!(line.at(0.5), Point2::new(2.5, 3.0));
    }

    /// Of every size, wherever its circle is.
    #[test]
    fn arcs_begin_and_end_where_they_are_said_to() {
        // From the right of a circle to its top and to its left, over either side.
        let quarters = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].map(Vector2::from);
        for size in [1e-8, 1.0, 1e3] {
            for centre in [[0.0, 0.0], [7.0, -3.0], [-0.5, 20.0]] {
                let centre = Point2::from(centre) * size;
                let at = |quarter: usize| centre + quarters[quarter % 4] * size;
                for first in 0..4 {
                    for (via, last, sweep) in [(1, 2, PI), (1, 3, 1.5 * PI), (2, 1, -1.5 * PI)] {
                        let (from, via, to) = (at(first), at(first + via), at(first + last));
                        let arc = Curve::arc_through(from, via, to).expect("they lie on no line");
                        let off = (arc.at(0.0) - from).norm() + (arc.at(1.0) - to).norm();
                        assert!(off < 1e-12 * size, "{size}, {centre}, {first}: {off}");
                        let length = size * sweep.abs();
                        assert!((arc.length() / length - 1.0).abs() < 1e-12);
                        let turn = arc.tangent(0.0).dot(&quarters[(first + 1) % 4]);
                        assert!((turn - sweep.signum()).abs() < 1e-12);
                    }
                }
            }
        }
    }
}
