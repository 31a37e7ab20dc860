//! Whether two segments of a cross-section cross.

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use super::SAME_POINT;
use crate::problem::part::Segment;

/// Where two segments meet end to end, coordinates as they are typed make a smooth joint cross itself
/// nearby: that counts from this share of the shorter one on.
const JOINT: f64 = 0.05;

/// Whether both segments go on for more than a nanometre on either side of a point that they share.
pub(super) fn cross(one: &Segment, other: &Segment) -> bool {
    match (Arc::of(one), Arc::of(other)) {
        (None, None) => lines_cross(one, other),
        (Some(arc), None) => meet(one, other, &arc.crossings_of_line(other)),
        (None, Some(arc)) => meet(one, other, &arc.crossings_of_line(one)),
        (Some(arc), Some(with)) => meet(one, other, &arc.crossings_of(&with)),
    }
}

/// Whether the ends of each line are on different sides of the other.
fn lines_cross(one: &Segment, other: &Segment) -> bool {
    let parts = |line: &Segment, by: &Segment| {
        let along = line.to - line.from;
        let side = |point: Point2<f64>| along.perp(&(point - line.from)) / along.norm();
        let (from, to) = (side(by.from), side(by.to));
        from.min(to) < -SAME_POINT && from.max(to) > SAME_POINT
    };
    parts(one, other) && parts(other, one)
}

/// Whether any of these points of both carriers is on both segments, off their ends.
fn meet(one: &Segment, other: &Segment, points: &[Point2<f64>]) -> bool {
    let shorter = length(one).min(length(other));
    let is_off_ends = |of: &Segment, beside: &Segment, point: Point2<f64>| {
        [of.from, of.to].iter().all(|end| {
            let is_joint = [beside.from, beside.to]
                .iter()
                .any(|next| (next - end).norm() <= SAME_POINT);
            let margin = if is_joint {
                JOINT * shorter
            } else {
                SAME_POINT
            };
            (point - end).norm() > margin
        })
    };
    points.iter().any(|&point| {
        let on_both = [one, other].iter().all(|segment| is_beside(segment, point));
        on_both && is_off_ends(one, other, point) && is_off_ends(other, one, point)
    })
}

/// Whether a point of a segment's carrier is between the segment's ends.
fn is_beside(segment: &Segment, point: Point2<f64>) -> bool {
    if let Some(arc) = Arc::of(segment) {
        return arc.turned_to(point) < arc.sweep.abs();
    }
    let along = segment.to - segment.from;
    (0.0..along.norm_squared()).contains(&along.dot(&(point - segment.from)))
}

fn length(segment: &Segment) -> f64 {
    let chord = (segment.to - segment.from).norm();
    Arc::of(segment).map_or(chord, |arc| arc.radius * arc.sweep.abs())
}

/// A segment that is an arc.
struct Arc {
    centre: Point2<f64>,
    radius: f64,
    from: Point2<f64>,
    /// Counterclockwise if positive, rad.
    sweep: f64,
}

impl Arc {
    fn of(segment: &Segment) -> Option<Self> {
        let (from, to) = (segment.from, segment.to);
        let (a, b) = (segment.via? - from, to - from);
        // The centre is as far from all three points.
        let (aa, bb) = (a.norm_squared(), b.norm_squared());
        let outwards = Vector2::new(aa * b.y - bb * a.y, bb * a.x - aa * b.x);
        let radial = outwards / (2.0 * a.perp(&b));
        let mut arc = Self {
            centre: from + radial,
            radius: radial.norm(),
            from,
            sweep: a.perp(&b).signum(),
        };
        arc.sweep *= arc.turned_to(to);
        Some(arc)
    }

    /// The angle from the start to a point of the circle, as the arc turns, 0 to 2 pi.
    fn turned_to(&self, point: Point2<f64>) -> f64 {
        let (start, end) = (self.from - self.centre, point - self.centre);
        let turn = start.perp(&end).atan2(start.dot(&end));
        (turn * self.sweep.signum()).rem_euclid(TAU)
    }

    /// Where the whole circle meets the line through a segment, unless it hardly touches it.
    fn crossings_of_line(&self, line: &Segment) -> Vec<Point2<f64>> {
        let along = (line.to - line.from).normalize();
        let middle = line.from + along * along.dot(&(self.centre - line.from));
        self.either_side(middle, along)
    }

    /// Where two whole circles meet, unless they hardly touch.
    fn crossings_of(&self, other: &Self) -> Vec<Point2<f64>> {
        let between = other.centre - self.centre;
        let distance = between.norm();
        let nested = (self.radius - other.radius).abs();
        if distance < nested + SAME_POINT || distance > self.radius + other.radius - SAME_POINT {
            return Vec::new();
        }
        let along = between / distance;
        let squares = self.radius * self.radius - other.radius * other.radius;
        let middle = self.centre + along * (0.5 * (distance + squares / distance));
        self.either_side(middle, Vector2::new(-along.y, along.x))
    }

    /// The ends of a chord, by its middle and direction.
    fn either_side(&self, middle: Point2<f64>, along: Vector2<f64>) -> Vec<Point2<f64>> {
        let off = (middle - self.centre).norm();
        if off > self.radius - SAME_POINT {
            return Vec::new();
        }
        let half = ((self.radius - off) * (self.radius + off)).sqrt();
        vec![middle + along * half, middle - along * half]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(from: [f64; 2], to: [f64; 2]) -> Segment {
        Segment {
            from: from.into(),
            to: to.into(),
            via: None,
            surface: "any".to_owned(),
        }
    }

    fn arc(from: [f64; 2], via: [f64; 2], to: [f64; 2]) -> Segment {
        Segment {
            via: Some(via.into()),
            ..line(from, to)
        }
    }

    /// Both ways round, and both ways along each segment.
    fn crosses(one: &Segment, other: &Segment) -> bool {
        let turned = |segment: &Segment| Segment {
            from: segment.to,
            to: segment.from,
            ..segment.clone()
        };
        let found = cross(one, other);
        for (one, other) in [
            (other.clone(), one.clone()),
            (turned(one), other.clone()),
            (one.clone(), turned(other)),
        ] {
            assert_eq!(cross(&one, &other), found, "{one:?} {other:?}");
        }
        found
    }

    #[test]
    fn lines_cross_where_each_ends_on_both_sides_of_the_other() {
        for size in [1e-3, 1.0, 1e3] {
            let along = line([0.0, 0.0], [size, 0.0]);
            let reach =
                |from: f64, to: f64| crosses(&along, &line([0.5 * size, from], [0.5 * size, to]));
            assert!(reach(-size, size), "{size}");
            // What reaches less than a nanometre beyond only touches.
            assert!(reach(-1.1e-9, size), "{size}");
            assert!(reach(1.1e-9, -size), "{size}");
            assert!(!reach(-0.9e-9, size), "{size}");
            assert!(!reach(0.9e-9, -size), "{size}");
            assert!(!reach(0.0, size), "{size}");
            if size == 1.0 {
                assert!(!reach(-SAME_POINT, size));
                assert!(!reach(SAME_POINT, -size));
            }
            let beside = line([1.5 * size, -size], [1.5 * size, size]);
            assert!(!crosses(&along, &beside), "{size}");
        }
    }

    #[test]
    fn a_line_crosses_an_arc_where_it_meets_more_than_the_circle() {
        for size in [1e-3, 1.0] {
            let upper = arc([-size, 0.0], [0.0, size], [size, 0.0]);
            let upright = |x: f64, from: f64, to: f64| {
                crosses(
                    &line([x * size, from * size], [x * size, to * size]),
                    &upper,
                )
            };
            assert!(upright(0.0, 0.5, 2.0), "{size}");
            assert!(upright(0.9, 0.0, 2.0), "{size}");
            // Through the chord, through the other half of the circle, and past it.
            assert!(!upright(0.0, -0.5, 0.5), "{size}");
            assert!(!upright(0.0, -2.0, 0.5), "{size}");
            assert!(!upright(1.1, -2.0, 2.0), "{size}");
            // A tangent, and a line that ends on the arc.
            assert!(!upright(1.0, -1.0, 1.0), "{size}");
            assert!(!upright(0.0, 0.5, 1.0), "{size}");
            // More than half a circle goes the long way round.
            let half = 0.5_f64.sqrt() * size;
            let most = arc([half, -half], [0.0, size], [-half, -half]);
            assert!(
                crosses(&line([0.0, 0.0], [2.0 * size, 0.0]), &most),
                "{size}"
            );
            assert!(
                !crosses(&line([0.0, 0.0], [0.0, -2.0 * size]), &most),
                "{size}"
            );
        }
    }

    #[test]
    fn arcs_cross_where_both_go_on() {
        let upper = arc([-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]);
        let moved = |x: f64, y: f64| arc([x - 1.0, y], [x, y + 1.0], [x + 1.0, y]);
        assert!(crosses(&upper, &moved(0.5, 0.0)));
        assert!(crosses(&upper, &moved(1.0, 0.5)));
        // Side by side, above one another, one circle, one within the other.
        assert!(!crosses(&upper, &moved(2.0, 0.0)));
        assert!(!crosses(&upper, &moved(0.0, 1.5)));
        assert!(!crosses(&upper, &upper));
        assert!(!crosses(&upper, &arc([-0.5, 0.0], [0.0, 0.5], [0.5, 0.0])));
        // The circles meet, the arcs do not.
        let lower = arc([-0.5, 0.0], [0.5, -1.0], [1.5, 0.0]);
        assert!(!crosses(&upper, &lower));
    }

    #[test]
    fn a_joint_may_be_as_smooth_as_its_coordinates_are_typed() {
        // A line that is off the tangent by so many rad where a quarter of a circle begins.
        let quarter = arc(
            [0.0, 0.0],
            [0.5_f64.sqrt(), 1.0 - 0.5_f64.sqrt()],
            [1.0, 1.0],
        );
        let joint = |off: f64| {
            crosses(&line([-1.0, 0.0], [0.0, 0.0]), &quarter)
                || crosses(
                    &line([0.0, 0.0], [2.0 * off.cos(), 2.0 * off.sin()]),
                    &quarter,
                )
        };
        assert!(!joint(0.0));
        assert!(!joint(0.01));
        assert!(!joint(-0.01));
        assert!(joint(0.1));
    }
}
