//! Plane walls.

use super::{Extent, Flight, Intersect, Intersection, chosen, dot, minus};

/// A plane wall, unbounded along z.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub from: [f64; 2],
    pub tangent: [f64; 2],
    pub length: f64,
}

impl Plane {
    /// A quarter turn counter-clockwise from the tangent.
    #[inline(always)]
    pub(super) fn front(&self) -> [f64; 2] {
        [-self.tangent[1], self.tangent[0]]
    }

    /// Height over the front of the plane and place along it.
    #[inline(always)]
    pub fn place(&self, point: [f64; 2]) -> (f64, f64) {
        let relative = minus(point, self.from);
        (dot(relative, self.front()), dot(relative, self.tangent))
    }

    /// Squared distance to a point of the cross-section.
    #[inline(always)]
    pub fn squared_distance(&self, to: [f64; 2]) -> f64 {
        let (height, along) = self.place(to);
        let beyond = if along < 0.0 {
            along
        } else if along > self.length {
            along - self.length
        } else {
            0.0
        };
        height * height + beyond * beyond
    }

    #[inline(always)]
    pub fn approach(&self, direction: [f64; 2]) -> f64 {
        dot(direction, self.front())
    }

    #[inline(always)]
    pub fn spans(&self, along: f64, margin: f64) -> bool {
        (along >= -margin) & (along <= self.length + margin)
    }
}

impl Plane {
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

impl Intersect for Plane {
    #[inline(always)]
    fn meet<const LEAVES: bool>(&self, flight: &Flight, extent: &Extent) -> Intersection {
        let ([x, y, z], [u, v, _]) = (flight.origin, flight.direction);
        let (height, start) = self.place([x, y]);
        let approach = self.approach([u, v]);
        let distance = -height / approach;
        let front = approach < 0.0;
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
            rank: f64::INFINITY,
            ..met
        };
        chosen(flight.from_here, nowhere, met)
    }

    #[inline(always)]
    fn touch(&self, flight: &Flight, extent: &Extent) -> Intersection {
        self.touched(flight, extent)
    }
}
