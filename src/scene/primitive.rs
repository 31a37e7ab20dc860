//! The planes and cylinders that cross-sections become: where rays meet them.
//!
//! The arithmetic has no branches, so that compilers work on many rays at once.

mod cylinder;
mod edge;
mod plane;
#[cfg(test)]
mod tests;
mod touch;

use std::hint::select_unpredictable;

use crate::elementary::{cos, sin_cos};
use crate::problem::curve::Curve;
pub(super) use cylinder::Cylinder;
pub(super) use edge::Edge;
pub(super) use plane::Plane;
pub(super) use touch::SLIDES;

/// The surface that one piece of a cross-section becomes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Primitive {
    Plane(Plane),
    Cylinder(Cylinder),
}

/// A ray in the frame of its prism, and what is known about its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight {
    pub origin: [f64; 3],
    pub direction: [f64; 3],
    /// Of the shot, m; 0 for a point.
    pub radius: f64,
    /// Whether it starts on the wall that is asked.
    pub from_here: bool,
    /// Whether it runs on the front of what it starts from; without a start it does.
    pub on_front: bool,
}

/// Where walls end along z, and within what distance points count as one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub length: f64,
    pub slack: f64,
}

/// A wall of a prism.
pub(super) trait Intersect {
    /// Where a flight meets it. `LEAVES`: whether it starts on a surface.
    fn meet<const LEAVES: bool>(&self, flight: &Flight, extent: &Extent) -> Intersection;

    /// Where a shot of finite size touches it.
    fn touch(&self, flight: &Flight, extent: &Extent) -> Intersection;
}

/// Where a ray meets a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Intersection {
    /// Distance, m.
    pub distance: f64,
    /// The distance that counts when walls are compared; infinite when the ray does not meet it.
    pub rank: f64,
    /// Whether it comes from the front.
    pub front: bool,
    /// Unit normal on the front there, in the cross-section.
    pub normal: [f64; 2],
}

impl Extent {
    #[inline(always)]
    fn hold(&self, z: f64, margin: f64) -> bool {
        (z >= -margin) & (z <= self.length + margin)
    }
}

impl Flight {
    /// How far beyond its edges a wall counts: a little where the ray sees its front, as far as the
    /// ray runs on fronts. One that it sees from behind ends exactly where it ends.
    #[inline(always)]
    fn margin(&self, front: bool, extent: &Extent) -> f64 {
        if front == self.on_front {
            extent.slack
        } else {
            0.0
        }
    }

    /// The distance that counts for a crossing between the edges of a wall, if it is one: those
    /// seen from behind yield to one seen at an edge.
    #[inline(always)]
    fn rank(&self, distance: f64, spans: bool, margin: f64, extent: &Extent) -> f64 {
        let z = self.origin[2] + self.direction[2] * distance;
        // NaN, for no crossing, is not ahead.
        if (distance > 0.0) & spans & extent.hold(z, margin) {
            distance + (extent.slack - margin)
        } else {
            f64::INFINITY
        }
    }

    /// What follows where the ray starts within the slack of a wall that it does not come from: it
    /// meets that wall at once when it heads into it.
    #[inline(always)]
    fn touching(&self, normal: [f64; 2]) -> Intersection {
        let approach = dot([self.direction[0], self.direction[1]], normal);
        let front = approach < 0.0;
        let enters = (approach != 0.0) & (front == self.on_front);
        Intersection {
            distance: 0.0,
            rank: if enters { 0.0 } else { f64::INFINITY },
            front,
            normal,
        }
    }
}

impl Primitive {
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
                let (sine, cosine) = sin_cos(start + sweep / 2.0);
                let whole = sweep.abs() >= std::f64::consts::TAU * (1.0 - 1e-15);
                Self::Cylinder(Cylinder {
                    centre: centre.into(),
                    radius,
                    side: sweep.signum(),
                    towards: [cosine, sine],
                    reach: if whole {
                        f64::MIN
                    } else {
                        radius * cos(sweep / 2.0)
                    },
                })
            }
        }
    }

    /// Where a flight meets the wall. `LEAVES`: whether it starts on a surface.
    pub fn meet<const LEAVES: bool>(&self, flight: &Flight, extent: &Extent) -> Intersection {
        match self {
            Self::Plane(plane) => plane.meet::<LEAVES>(flight, extent),
            Self::Cylinder(cylinder) => cylinder.meet::<LEAVES>(flight, extent),
        }
    }

    /// Where a shot of finite size touches the wall.
    pub fn touch(&self, flight: &Flight, extent: &Extent) -> Intersection {
        match self {
            Self::Plane(plane) => plane.touch(flight, extent),
            Self::Cylinder(cylinder) => cylinder.touch(flight, extent),
        }
    }

    /// Distance between the wall and a point of the cross-section.
    #[inline]
    pub fn distance(&self, to: [f64; 2]) -> f64 {
        match self {
            Self::Plane(plane) => plane.distance(to),
            Self::Cylinder(cylinder) => cylinder.distance(to),
        }
    }

    /// The point of the wall, in the cross-section, that is nearest to another.
    pub fn nearest(&self, to: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Plane(plane) => plane.nearest(to),
            Self::Cylinder(cylinder) => cylinder.nearest(to),
        }
    }

    /// Unit normal on the front of the wall where it is nearest to a point of the cross-section.
    pub fn front_nearest(&self, to: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Plane(plane) => plane.front(),
            Self::Cylinder(cylinder) => cylinder.front(cylinder.relative(cylinder.nearest(to))),
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

/// One of two meetings, component by component.
#[inline(always)]
fn chosen(first: bool, one: Intersection, other: Intersection) -> Intersection {
    Intersection {
        distance: select_unpredictable(first, one.distance, other.distance),
        rank: select_unpredictable(first, one.rank, other.rank),
        front: select_unpredictable(first, one.front, other.front),
        normal: [
            select_unpredictable(first, one.normal[0], other.normal[0]),
            select_unpredictable(first, one.normal[1], other.normal[1]),
        ],
    }
}

#[inline(always)]
fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
