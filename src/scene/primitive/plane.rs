//! Plane walls.

use super::{Extent, Flight, Intersect, Intersection, chosen, dot, minus};
use crate::precision::Real;

/// A plane wall, unbounded along z.
#[derive(Clone, Copy, Debug)]
pub struct Plane<R> {
    pub from: [R; 2],
    pub tangent: [R; 2],
    pub length: R,
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
    pub(super) fn front(&self) -> [R; 2] {
        [-self.tangent[1], self.tangent[0]]
    }

    /// Height over the front of the plane and place along it.
    #[inline(always)]
    pub fn place(&self, point: [R; 2]) -> (R, R) {
        let relative = minus(point, self.from);
        (dot(relative, self.front()), dot(relative, self.tangent))
    }

    /// Squared distance to a point of the cross-section.
    #[inline(always)]
    pub fn squared_distance(&self, to: [R; 2]) -> R {
        let (height, along) = self.place(to);
        let beyond = if along < R::ZERO {
            along
        } else if along > self.length {
            along - self.length
        } else {
            R::ZERO
        };
        height * height + beyond * beyond
    }

    #[inline(always)]
    pub fn approach(&self, direction: [R; 2]) -> R {
        dot(direction, self.front())
    }

    #[inline(always)]
    pub fn spans(&self, along: R, margin: R) -> bool {
        (along >= -margin) & (along <= self.length + margin)
    }
}

impl Plane<f64> {
    /// Distance to a point of the cross-section.
    #[inline]
    pub fn distance(&self, to: [f64; 2]) -> f64 {
        self.squared_distance(to).sqrt()
    }

    /// The point of its line in the cross-section that is nearest to another.
    pub fn nearest(&self, to: [f64; 2]) -> [f64; 2] {
        let (_, along) = self.place(to);
        let along = along.clamp(0.0, self.length);
        [
            self.from[0] + self.tangent[0] * along,
            self.from[1] + self.tangent[1] * along,
        ]
    }
}

impl<R: Real> Intersect<R> for Plane<R> {
    #[inline(always)]
    fn meet<const LEAVES: bool>(&self, flight: &Flight<R>, extent: &Extent<R>) -> Intersection<R> {
        let ([x, y, z], [u, v, _]) = (flight.origin, flight.direction);
        let (height, start) = self.place([x, y]);
        let approach = self.approach([u, v]);
        let distance = -height / approach;
        let front = approach < R::ZERO;
        let margin = flight.margin(front, extent);
        let spans = self.spans(start + distance * dot([u, v], self.tangent), margin);
        let ahead = Intersection {
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
        let nowhere = Intersection {
            rank: R::INFINITY,
            ..met
        };
        chosen(flight.from_here, nowhere, met)
    }

    #[inline(always)]
    fn touch(&self, flight: &Flight<R>, extent: &Extent<R>) -> Intersection<R> {
        self.touched(flight, extent)
    }
}
