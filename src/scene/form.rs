//! The planes and cylinders that cross-sections become: where rays meet them.
//!
//! The arithmetic has no branches, so that compilers work on many rays at once.

use super::profile::Curve;
use crate::precision::Real;

/// The surface that one piece of a cross-section becomes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Form {
    Plane(Plane<f64>),
    Cylinder(Cylinder<f64>),
}

/// A plane wall, unbounded along z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane<R> {
    from: [R; 2],
    tangent: [R; 2],
    length: R,
}

/// A cylindrical wall, unbounded along z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cylinder<R> {
    centre: [R; 2],
    radius: R,
    /// +1 when free space is inside the circle.
    side: R,
    /// The arc is where (p - centre) . towards >= reach.
    towards: [R; 2],
    reach: R,
}

/// A ray in the frame of its prism, and what is known about its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight<R> {
    pub origin: [R; 3],
    pub direction: [R; 3],
    /// Whether it starts on the wall that is asked.
    pub from_here: bool,
    /// Whether it runs on the front of what it starts from; without a start it does.
    pub on_front: bool,
}

/// Where walls end along z, and within what distance points count as one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent<R> {
    pub length: R,
    pub slack: R,
}

/// A wall of a prism.
pub(super) trait Wall<R> {
    /// Where a flight meets it. `LEAVES`: whether it starts on a surface.
    fn meet<const LEAVES: bool>(&self, flight: &Flight<R>, extent: &Extent<R>) -> Meeting<R>;
}

/// Where a ray meets a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting<R> {
    /// Distance, m.
    pub distance: R,
    /// The distance that counts when walls are compared; infinite when the ray does not meet it.
    pub rank: R,
    /// Whether it comes from the front.
    pub front: bool,
    /// Unit normal on the front there, in the cross-section.
    pub normal: [R; 2],
}

impl<R: Real> Extent<R> {
    #[inline(always)]
    fn hold(&self, z: R, margin: R) -> bool {
        (z >= -margin) & (z <= self.length + margin)
    }
}

impl<R: Real> Flight<R> {
    /// How far beyond its edges a wall counts: a little where the ray sees its front, as far as the
    /// ray runs on fronts. One that it sees from behind ends exactly where it ends.
    #[inline(always)]
    fn margin(&self, front: bool, extent: &Extent<R>) -> R {
        if front == self.on_front {
            extent.slack
        } else {
            R::ZERO
        }
    }

    /// The distance that counts for a crossing between the edges of a wall, if it is one: those
    /// seen from behind yield to one seen at an edge.
    #[inline(always)]
    fn rank(&self, distance: R, spans: bool, margin: R, extent: &Extent<R>) -> R {
        let z = self.origin[2] + self.direction[2] * distance;
        // NaN, for no crossing, is not ahead.
        if (distance > R::ZERO) & spans & extent.hold(z, margin) {
            distance + (extent.slack - margin)
        } else {
            R::INFINITY
        }
    }

    /// What follows where the ray starts within the slack of a wall that it does not come from: it
    /// meets that wall at once when it heads into it.
    #[inline(always)]
    fn touching(&self, normal: [R; 2]) -> Meeting<R> {
        let approach = dot([self.direction[0], self.direction[1]], normal);
        let front = approach < R::ZERO;
        let enters = (approach != R::ZERO) & (front == self.on_front);
        Meeting {
            distance: R::ZERO,
            rank: if enters { R::ZERO } else { R::INFINITY },
            front,
            normal,
        }
    }
}

impl Form {
    pub fn of(curve: &Curve) -> Self {
        match *curve {
            Curve::Line { from, to } => Self::Plane(Plane {
                from: from.into(),
                tangent: (to - from).normalize().into(),
                length: (to - from).norm(),
            }),
            Curve::Arc {
                centre,
                radius,
                start,
                sweep,
            } => {
                let (sin, cos) = (start + sweep / 2.0).sin_cos();
                let whole = sweep.abs() >= std::f64::consts::TAU * (1.0 - 1e-15);
                Self::Cylinder(Cylinder {
                    centre: centre.into(),
                    radius,
                    side: sweep.signum(),
                    towards: [cos, sin],
                    reach: if whole {
                        f64::MIN
                    } else {
                        radius * (sweep / 2.0).cos()
                    },
                })
            }
        }
    }

    /// Where a flight meets the wall. `LEAVES`: whether it starts on a surface.
    pub fn meet<const LEAVES: bool>(
        &self,
        flight: &Flight<f64>,
        extent: &Extent<f64>,
    ) -> Meeting<f64> {
        match self {
            Self::Plane(plane) => plane.meet::<LEAVES>(flight, extent),
            Self::Cylinder(cylinder) => cylinder.meet::<LEAVES>(flight, extent),
        }
    }

    /// How often a line from a point of the cross-section crosses the wall ahead.
    pub fn crossings(&self, origin: [f64; 2], direction: [f64; 2]) -> usize {
        match self {
            Self::Plane(plane) => {
                let (height, along) = plane.place(origin);
                let distance = -height / plane.approach(direction);
                let at = along + distance * dot(direction, plane.tangent);
                usize::from(distance > 0.0 && at >= 0.0 && at <= plane.length)
            }
            Self::Cylinder(cylinder) => {
                let roots = cylinder.roots(origin, direction, false);
                let ahead = roots.into_iter().filter(|&(distance, _)| {
                    let offset = cylinder.offset(origin, direction, distance);
                    distance > 0.0 && dot(offset, cylinder.towards) >= cylinder.reach
                });
                ahead.count()
            }
        }
    }

    /// Whether a point is within `slack` of the wall.
    pub fn lies_on(&self, point: [f64; 2], slack: f64) -> bool {
        match self {
            Self::Plane(plane) => {
                let (height, along) = plane.place(point);
                height.abs() <= slack && plane.spans(along, slack)
            }
            Self::Cylinder(cylinder) => cylinder.lies_on(cylinder.relative(point), slack),
        }
    }
}

impl<R: Real> Plane<R> {
    /// The same wall in another precision.
    pub fn with<S: Real>(&self) -> Plane<S> {
        Plane {
            from: self.from.map(|x| S::of(x.wide())),
            tangent: self.tangent.map(|x| S::of(x.wide())),
            length: S::of(self.length.wide()),
        }
    }

    /// A quarter turn counter-clockwise from the tangent.
    #[inline(always)]
    fn front(&self) -> [R; 2] {
        [-self.tangent[1], self.tangent[0]]
    }

    /// Height over the front of the plane and place along it.
    #[inline(always)]
    fn place(&self, point: [R; 2]) -> (R, R) {
        let relative = minus(point, self.from);
        (dot(relative, self.front()), dot(relative, self.tangent))
    }

    #[inline(always)]
    fn approach(&self, direction: [R; 2]) -> R {
        dot(direction, self.front())
    }

    #[inline(always)]
    fn spans(&self, along: R, margin: R) -> bool {
        (along >= -margin) & (along <= self.length + margin)
    }
}

impl<R: Real> Wall<R> for Plane<R> {
    #[inline(always)]
    fn meet<const LEAVES: bool>(&self, flight: &Flight<R>, extent: &Extent<R>) -> Meeting<R> {
        let ([x, y, z], [u, v, _]) = (flight.origin, flight.direction);
        let (height, start) = self.place([x, y]);
        let approach = self.approach([u, v]);
        let distance = -height / approach;
        let front = approach < R::ZERO;
        let margin = flight.margin(front, extent);
        let spans = self.spans(start + distance * dot([u, v], self.tangent), margin);
        let ahead = Meeting {
            distance,
            rank: flight.rank(distance, spans, margin, extent),
            front,
            normal: self.front(),
        };
        if !LEAVES {
            return ahead;
        }
        let touches = (height.abs() <= extent.slack)
            & self.spans(start, extent.slack)
            & extent.hold(z, extent.slack);
        let met = chosen(touches, flight.touching(self.front()), ahead);
        // A line that starts on a plane meets it nowhere else.
        let nowhere = Meeting {
            rank: R::INFINITY,
            ..met
        };
        chosen(flight.from_here, nowhere, met)
    }
}

impl<R: Real> Cylinder<R> {
    /// The same wall in another precision.
    pub fn with<S: Real>(&self) -> Cylinder<S> {
        Cylinder {
            centre: self.centre.map(|x| S::of(x.wide())),
            radius: S::of(self.radius.wide()),
            side: S::of(self.side.wide()),
            towards: self.towards.map(|x| S::of(x.wide())),
            reach: S::of(self.reach.wide()),
        }
    }

    #[inline(always)]
    fn relative(&self, point: [R; 2]) -> [R; 2] {
        minus(point, self.centre)
    }

    #[inline(always)]
    fn offset(&self, origin: [R; 2], direction: [R; 2], distance: R) -> [R; 2] {
        let [x, y] = self.relative(origin);
        [x + direction[0] * distance, y + direction[1] * distance]
    }

    /// Unit normal on the front, at an offset from the centre.
    #[inline(always)]
    fn front(&self, offset: [R; 2]) -> [R; 2] {
        let scale = -self.side / self.radius;
        [offset[0] * scale, offset[1] * scale]
    }

    #[inline(always)]
    fn lies_on(&self, relative: [R; 2], slack: R) -> bool {
        let excess = dot(relative, relative) - self.radius * self.radius;
        (excess.abs() <= (self.radius + self.radius) * slack)
            & (dot(relative, self.towards) >= self.reach - slack)
    }

    /// Distances at which a line crosses the whole cylinder, nearest first, and whether it comes
    /// from the front there; NaN for none. A line that starts `on_it` crosses it once more.
    #[inline(always)]
    fn roots(&self, origin: [R; 2], direction: [R; 2], on_it: bool) -> [(R, bool); 2] {
        let relative = self.relative(origin);
        let (a, half_b) = (dot(direction, direction), dot(relative, direction));
        let c = if on_it {
            R::ZERO
        } else {
            dot(relative, relative) - self.radius * self.radius
        };
        // Citardauq's form: the root near the start does not suffer from cancellation.
        let q = -(half_b + (half_b * half_b - a * c).sqrt().copysign(half_b));
        let (first, second) = (q / a, c / q);
        let swapped = second < first;
        let inside_is_free = self.side > R::ZERO;
        [
            (if swapped { second } else { first }, !inside_is_free),
            (if swapped { first } else { second }, inside_is_free),
        ]
    }

    #[inline(always)]
    fn ahead(
        &self,
        flight: &Flight<R>,
        extent: &Extent<R>,
        (distance, front): (R, bool),
    ) -> Meeting<R> {
        let ([x, y, _], [u, v, _]) = (flight.origin, flight.direction);
        let margin = flight.margin(front, extent);
        let offset = self.offset([x, y], [u, v], distance);
        let spans = dot(offset, self.towards) >= self.reach - margin;
        Meeting {
            distance,
            rank: flight.rank(distance, spans, margin, extent),
            front,
            normal: self.front(offset),
        }
    }
}

impl<R: Real> Wall<R> for Cylinder<R> {
    #[inline(always)]
    fn meet<const LEAVES: bool>(&self, flight: &Flight<R>, extent: &Extent<R>) -> Meeting<R> {
        let ([x, y, z], [u, v, _]) = (flight.origin, flight.direction);
        let relative = self.relative([x, y]);
        let touches = LEAVES
            & self.lies_on(relative, extent.slack)
            & extent.hold(z, extent.slack)
            & !flight.from_here;
        let on_it = LEAVES & (flight.from_here | touches);
        let [near, far] = self.roots([x, y], [u, v], on_it);
        let near = self.ahead(flight, extent, near);
        let far = self.ahead(flight, extent, far);
        let ahead = chosen(far.rank < near.rank, far, near);
        if !LEAVES {
            return ahead;
        }
        let touching = flight.touching(self.front(relative));
        chosen(touches & (touching.rank == R::ZERO), touching, ahead)
    }
}

/// One of two meetings, component by component.
#[inline(always)]
fn chosen<R: Real>(first: bool, one: Meeting<R>, other: Meeting<R>) -> Meeting<R> {
    Meeting {
        distance: if first { one.distance } else { other.distance },
        rank: if first { one.rank } else { other.rank },
        front: if first { one.front } else { other.front },
        normal: [
            if first {
                one.normal[0]
            } else {
                other.normal[0]
            },
            if first {
                one.normal[1]
            } else {
                other.normal[1]
            },
        ],
    }
}

#[inline(always)]
fn dot<R: Real>(a: [R; 2], b: [R; 2]) -> R {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
fn minus<R: Real>(a: [R; 2], b: [R; 2]) -> [R; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
