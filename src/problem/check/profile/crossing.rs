//! Whether two segments of a cross-section cross.

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use super::SAME_POINT;
use crate::elementary::atan2;
use crate::problem::curve::Curve;

/// Where two segments meet end to end, coordinates as they are typed make a smooth joint cross itself
/// nearby: that counts from this share of the shorter one on.
const JOINT: f64 = 0.05;

/// Whether both segments go on for more than a nanometre on either side of a point that they share.
pub(super) fn cross(one: &Curve, other: &Curve) -> bool {
    if let (Curve::Line { .. }, Curve::Line { .. }) = (one, other) {
        return parts(one, other) && parts(other, one);
    }
    let shorter = one.length().min(other.length());
    common_points(one, other).iter().any(|&point| {
        let is_on_both = lies_beside(one, point) && lies_beside(other, point);
        is_on_both
            && is_off_ends(one, other, point, shorter)
            && is_off_ends(other, one, point, shorter)
    })
}

/// Whether the ends of a line are on different sides of another one.
fn parts(line: &Curve, by: &Curve) -> bool {
    let along = line.tangent(0.0);
    let [start, _] = line.ends();
    let [from, to] = by.ends().map(|end| along.perp(&(end - start)));
    from.min(to) < -SAME_POINT && from.max(to) > SAME_POINT
}

/// Whether a point is away from the ends of a segment; farther from those that are the other one's, too.
fn is_off_ends(of: &Curve, other: &Curve, point: Point2<f64>, shorter: f64) -> bool {
    let is_same = |one: Point2<f64>, other: Point2<f64>| (one - other).norm() <= SAME_POINT;
    of.ends().into_iter().all(|end| {
        let is_joint = other.ends().into_iter().any(|next| is_same(end, next));
        let margin = if is_joint {
            JOINT * shorter
        } else {
            SAME_POINT
        };
        (point - end).norm() > margin
    })
}

/// Whether a point of the whole line or circle is between the segment's ends.
fn lies_beside(curve: &Curve, point: Point2<f64>) -> bool {
    match *curve {
        Curve::Line { from, to } => {
            let along = to - from;
            (0.0..along.norm_squared()).contains(&along.dot(&(point - from)))
        }
        Curve::Arc {
            centre,
            start,
            sweep,
            ..
        } => {
            let radial = point - centre;
            let turn = atan2(radial.y, radial.x) - start;
            (turn * sweep.signum()).rem_euclid(TAU) < sweep.abs()
        }
    }
}

/// Where the whole lines and circles of two segments meet, unless they hardly touch; not for two lines.
fn common_points(one: &Curve, other: &Curve) -> Vec<Point2<f64>> {
    match (*one, *other) {
        (Curve::Line { .. }, Curve::Line { .. }) => Vec::new(),
        (Curve::Arc { centre, radius, .. }, Curve::Line { from, to })
        | (Curve::Line { from, to }, Curve::Arc { centre, radius, .. }) => {
            let along = (to - from).normalize();
            let middle = from + along * along.dot(&(centre - from));
            ends_of_chord(centre, radius, middle, along)
        }
        (
            Curve::Arc { centre, radius, .. },
            Curve::Arc {
                centre: beside,
                radius: other,
                ..
            },
        ) => {
            let between = beside - centre;
            let distance = between.norm();
            let nested = (radius - other).abs();
            if distance < nested + SAME_POINT || distance > radius + other - SAME_POINT {
                return Vec::new();
            }
            let along = between / distance;
            let squares = radius * radius - other * other;
            let middle = centre + along * (0.5 * (distance + squares / distance));
            ends_of_chord(centre, radius, middle, Vector2::new(-along.y, along.x))
        }
    }
}

/// The ends of a chord of a circle, by its middle and direction.
fn ends_of_chord(
    centre: Point2<f64>,
    radius: f64,
    middle: Point2<f64>,
    along: Vector2<f64>,
) -> Vec<Point2<f64>> {
    let off = (middle - centre).norm();
    if off > radius - SAME_POINT {
        return Vec::new();
    }
    let half = ((radius - off) * (radius + off)).sqrt();
    vec![middle + along * half, middle - along * half]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::curve::tests::line;

    fn arc(from: [f64; 2], via: [f64; 2], to: [f64; 2]) -> Curve {
        let arc = Curve::arc_through(from.into(), via.into(), to.into());
        arc.expect("they lie on no line")
    }

    /// The same from its other end.
    fn turned(curve: &Curve) -> Curve {
        match *curve {
            Curve::Line { from, to } => Curve::Line { from: to, to: from },
            Curve::Arc {
                centre,
                radius,
                start,
                sweep,
            } => Curve::Arc {
                centre,
                radius,
                start: start + sweep,
                sweep: -sweep,
            },
        }
    }

    /// Both ways round, and both ways along each segment.
    fn crosses(one: &Curve, other: &Curve) -> bool {
        let found = cross(one, other);
        for (one, other) in [(*other, *one), (turned(one), *other), (*one, turned(other))] {
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
        // A line that is off the tangent by this many rad where a quarter of a circle begins.
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
