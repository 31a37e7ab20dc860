//! Rays against prismatic parts, exact: the walls are planes and cylinders, not facets.

use nalgebra::{Point2, Point3, Rotation3, Vector2, Vector3};

use super::profile::{Curve, Profile};
use super::ray::{Crossing, Ray, Spot};
use crate::problem::part::{Ends, Place};

/// A cross-section drawn along z from 0 to a length, somewhere in the scene.
#[derive(Clone, Debug)]
pub struct Prism {
    walls: Vec<Wall>,
    caps: Vec<Cap>,
    length: f64,
    slack: f64,
    rotation: Rotation3<f64>,
    shift: Vector3<f64>,
    moved: bool,
}

#[derive(Clone, Copy, Debug)]
struct Wall {
    form: Form,
    surface: u32,
}

#[derive(Clone, Copy, Debug)]
enum Form {
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

#[derive(Clone, Copy, Debug)]
struct Cap {
    z: f64,
    /// Component of the normal on the front along z.
    facing: f64,
    surface: u32,
}

impl Prism {
    /// A prism whose surfaces have the indices `surface_base` onwards: first the profile's, then
    /// the caps'. `slack` is the distance within which two points count as one, m.
    pub fn new(
        profile: &Profile,
        length: f64,
        ends: Ends,
        place: &Place,
        surface_base: u32,
        slack: f64,
    ) -> Self {
        let walls = profile
            .pieces
            .iter()
            .map(|piece| Wall {
                form: Form::of(&piece.curve),
                surface: surface_base + piece.surface,
            })
            .collect();
        let mut next_surface = surface_base + profile.surfaces.len() as u32;
        let mut caps = Vec::new();
        for (closed, z, facing) in [
            (ends.near_closed, 0.0, 1.0),
            (ends.far_closed, length, -1.0),
        ] {
            if closed {
                caps.push(Cap {
                    z,
                    facing,
                    surface: next_surface,
                });
                next_surface += 1;
            }
        }
        Self {
            walls,
            caps,
            length,
            slack,
            rotation: place.rotation.to_rotation_matrix(),
            shift: place.shift,
            moved: *place != Place::default(),
        }
    }

    /// The first crossing of a ray nearer than `limit`, and the front normal there.
    ///
    /// `leaving` is the spot that the ray starts from when it lies on this part.
    pub fn first_crossing(
        &self,
        ray: &Ray,
        leaving: Option<Spot>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let local = if self.moved {
            Ray {
                origin: Point3::from(self.rotation.inverse() * (ray.origin.coords - self.shift)),
                direction: self.rotation.inverse() * ray.direction,
            }
        } else {
            *ray
        };
        let start = Start {
            piece: leaving.filter(|_| on_this_part).map(|spot| spot.piece),
            front: leaving.map(|spot| spot.front),
        };
        let mut best: Option<(Crossing, Vector3<f64>)> = None;
        let mut nearest = limit;
        let (origin, direction) = (local.origin.xy(), local.direction.xy());
        for (index, wall) in self.walls.iter().enumerate() {
            let piece = index as u32;
            let mut on_it = start.piece == Some(piece);
            if !on_it && start.front.is_some() && self.lies_on(wall, &local.origin) {
                let front = wall.form.front(&origin);
                let approach = direction.dot(&front);
                if start.enters(approach) {
                    if nearest > 0.0 {
                        nearest = 0.0;
                        best = Some((
                            Crossing {
                                distance: 0.0,
                                front: approach < 0.0,
                                piece,
                                surface: wall.surface,
                            },
                            Vector3::new(front.x, front.y, 0.0),
                        ));
                    }
                    continue;
                }
                on_it = true;
            }
            for t in wall.form.roots(&origin, &direction, on_it) {
                // NaN, for no crossing, is neither ahead nor nearer.
                let counts = t > 0.0 && t < nearest;
                if !counts {
                    continue;
                }
                let z = local.origin.z + t * local.direction.z;
                let point = origin + direction * t;
                if z < -self.slack
                    || z > self.length + self.slack
                    || !wall.form.spans(&point, self.slack)
                {
                    continue;
                }
                let front = wall.form.front(&point);
                let approach = direction.dot(&front);
                let farther = if start.sees(approach < 0.0) {
                    0.0
                } else {
                    // Seen from behind, it ends exactly where it ends.
                    if z < 0.0 || z > self.length || !wall.form.spans(&point, 0.0) {
                        continue;
                    }
                    self.slack
                };
                if t + farther >= nearest {
                    continue;
                }
                nearest = t + farther;
                best = Some((
                    Crossing {
                        distance: t,
                        front: approach < 0.0,
                        piece,
                        surface: wall.surface,
                    },
                    Vector3::new(front.x, front.y, 0.0),
                ));
            }
        }
        for (index, cap) in self.caps.iter().enumerate() {
            let piece = (self.walls.len() + index) as u32;
            if start.piece == Some(piece) {
                continue;
            }
            let approach = local.direction.z * cap.facing;
            let height = cap.z - local.origin.z;
            let on_it = start.front.is_some() && height.abs() <= self.slack && self.holds(origin);
            let t = if on_it {
                if !start.enters(approach) {
                    continue;
                }
                0.0
            } else {
                height / local.direction.z
            };
            let counts = (on_it || t > 0.0) && t < nearest;
            if !counts || !self.holds(origin + direction * t) {
                continue;
            }
            nearest = t;
            best = Some((
                Crossing {
                    distance: t,
                    front: approach < 0.0,
                    piece,
                    surface: cap.surface,
                },
                Vector3::new(0.0, 0.0, cap.facing),
            ));
        }
        best.map(|(crossing, normal)| (crossing, self.rotation * normal))
    }

    /// Whether a point counts as one of the wall.
    fn lies_on(&self, wall: &Wall, point: &Point3<f64>) -> bool {
        let within = -self.slack..=self.length + self.slack;
        wall.form.lies_on(&point.xy(), self.slack) && within.contains(&point.z)
    }

    /// Whether the closed cross-section holds a point: it lies on the outline, or a ray from it
    /// leaves an odd number of times.
    fn holds(&self, point: Point2<f64>) -> bool {
        let mut walls = self.walls.iter();
        if walls.any(|wall| wall.form.lies_on(&point, self.slack)) {
            return true;
        }
        // No outline that anybody draws has a line in this direction.
        let direction = Vector2::new(0.827_132, 0.561_983);
        let crossings = self.walls.iter().flat_map(|wall| {
            let roots = wall.form.roots(&point, &direction, false);
            roots
                .into_iter()
                .filter(move |&t| t > 0.0 && wall.form.spans(&(point + direction * t), 0.0))
        });
        crossings.count() % 2 == 1
    }
}

/// Where a ray starts, and what it therefore must not hit.
///
/// In a corner the start of a rebound lies on more than one wall, and rounding may put it on
/// either side of those that it did not come from. The shot is known to be on one side of them,
/// though: a wall on which the start lies is hit at once when the shot heads into it from that
/// side, and not at all otherwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    pub piece: Option<u32>,
    pub front: Option<bool>,
}

impl Start {
    /// Whether a wall that shows this side is one that the shot can reach without passing through
    /// another, as far as is known.
    #[inline]
    pub fn sees(&self, front: bool) -> bool {
        self.front.unwrap_or(true) == front
    }

    /// Whether a shot heads into a wall on which it starts, given the direction's component along
    /// the wall's front normal.
    #[inline]
    pub fn enters(&self, approach: f64) -> bool {
        approach != 0.0 && self.front == Some(approach < 0.0)
    }
}

impl Form {
    fn of(curve: &Curve) -> Self {
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
    fn roots(&self, origin: &Point2<f64>, direction: &Vector2<f64>, on_it: bool) -> [f64; 2] {
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
    fn spans(&self, point: &Point2<f64>, slack: f64) -> bool {
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
    fn lies_on(&self, point: &Point2<f64>, slack: f64) -> bool {
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
    fn front(&self, point: &Point2<f64>) -> Vector2<f64> {
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
