//! The planes and cylinders that cross-sections become: where lines cross them.

use nalgebra::{Point2, Vector2};

use super::profile::Curve;

/// The surface that one piece of a cross-section becomes, unbounded along z.
#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    Plane {
        from: Point2<f64>,
        tangent: Vector2<f64>,
        length: f64,
    },
    Cylinder {
        centre: Point2<f64>,
        radius: f64,
        /// +1 when free space is inside the circle.
        side: f64,
        /// The arc is where (p - centre) . towards >= reach.
        towards: Vector2<f64>,
        reach: f64,
    },
}

impl Form {
    pub fn of(curve: &Curve) -> Self {
        match *curve {
            Curve::Line { from, to } => Self::Plane {
                from,
                tangent: (to - from).normalize(),
                length: (to - from).norm(),
            },
            Curve::Arc {
                centre,
                radius,
                start,
                sweep,
            } => {
                let (sin, cos) = (start + sweep / 2.0).sin_cos();
                let whole = sweep.abs() >= std::f64::consts::TAU * (1.0 - 1e-15);
                Self::Cylinder {
                    centre,
                    radius,
                    side: sweep.signum(),
                    towards: Vector2::new(cos, sin),
                    reach: if whole {
                        f64::NEG_INFINITY
                    } else {
                        radius * (sweep / 2.0).cos()
                    },
                }
            }
        }
    }

    /// Distances at which a line crosses the unbounded plane or cylinder, in order; NaN for none.
    ///
    /// A line that starts `on_it` meets a plane nowhere else and a cylinder once more.
    #[inline]
    pub fn roots(&self, origin: &Point2<f64>, direction: &Vector2<f64>, on_it: bool) -> [f64; 2] {
        match *self {
            Self::Plane { .. } if on_it => [f64::NAN; 2],
            Self::Plane { from, tangent, .. } => {
                let front = perpendicular(tangent);
                [
                    (from - origin).dot(&front) / direction.dot(&front),
                    f64::NAN,
                ]
            }
            Self::Cylinder { centre, radius, .. } => {
                let offset = origin - centre;
                let (a, half_b) = (direction.norm_squared(), offset.dot(direction));
                if on_it {
                    return [-2.0 * half_b / a, f64::NAN];
                }
                let c = (offset.norm() - radius) * (offset.norm() + radius);
                let discriminant = half_b * half_b - a * c;
                // Citardauq's form: the root near the start does not suffer from cancellation.
                let q = -(half_b + discriminant.sqrt().copysign(half_b));
                let (first, second) = (q / a, c / q);
                if second < first {
                    [second, first]
                } else {
                    [first, second]
                }
            }
        }
    }

    /// Whether a point of the unbounded plane or cylinder lies on the wall.
    #[inline]
    pub fn spans(&self, point: &Point2<f64>, slack: f64) -> bool {
        match *self {
            Self::Plane {
                from,
                tangent,
                length,
            } => {
                let along = (point - from).dot(&tangent);
                along >= -slack && along <= length + slack
            }
            Self::Cylinder {
                centre,
                towards,
                reach,
                ..
            } => (point - centre).dot(&towards) >= reach - slack,
        }
    }

    /// Whether a point is within `slack` of the wall.
    #[inline]
    pub fn lies_on(&self, point: &Point2<f64>, slack: f64) -> bool {
        let near = match *self {
            Self::Plane { from, tangent, .. } => (point - from).perp(&tangent).abs() <= slack,
            Self::Cylinder { centre, radius, .. } => {
                let offset = (point - centre).norm_squared() - radius * radius;
                offset.abs() <= 2.0 * radius * slack
            }
        };
        near && self.spans(point, slack)
    }

    /// Unit normal on the front, at a point of the wall.
    #[inline]
    pub fn front(&self, point: &Point2<f64>) -> Vector2<f64> {
        match *self {
            Self::Plane { tangent, .. } => perpendicular(tangent),
            Self::Cylinder { centre, side, .. } => (centre - point).normalize() * side,
        }
    }
}

/// A quarter turn counter-clockwise.
#[inline]
fn perpendicular(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}
