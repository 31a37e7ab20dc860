//! Where the centre of a shot of finite size is when the shot touches a wall.
//!
//! A wall and everything within a radius of it is a body with parallel faces and round edges; a
//! shot touches the wall where its centre enters that body. A line that leaves a convex body never
//! comes back to it. So a shot that touches a plane, an edge or the outside of a cylinder at its
//! start meets it at once when it heads into it, and never otherwise.
//!
//! Normals have any length here: whoever takes one of many makes a unit vector of it.

use super::{Cylinder, Edge, Extent, Flight, Intersection, Plane, chosen, dot, minus};

/// Cosine of the angle to the normal below which a shot that touches a surface slides along it.
pub(in crate::scene) const SLIDES: f64 = 1e-12;

/// A line in the cross-section that passes a circle round the origin.
struct Passage {
    /// Squared speed in the cross-section.
    a: f64,
    /// Half the rate at which the squared distance from the centre grows at the start.
    b: f64,
    /// Squared distance from the centre.
    square: f64,
}

impl Passage {
    #[inline(always)]
    fn new(relative: [f64; 2], direction: [f64; 2]) -> Self {
        Self {
            a: dot(direction, direction),
            b: dot(relative, direction),
            square: dot(relative, relative),
        }
    }

    /// Where it enters a circle; NaN for nowhere.
    #[inline(always)]
    fn entry(&self, radius: f64) -> f64 {
        let c = self.square - radius * radius;
        c / ((self.b * self.b - self.a * c).sqrt() - self.b)
    }

    /// Where it leaves a circle; NaN for nowhere. A line that starts `on_it` leaves it where it
    /// comes to it again.
    #[inline(always)]
    fn exit(&self, radius: f64, on_it: bool) -> f64 {
        let c = if on_it {
            0.0
        } else {
            self.square - radius * radius
        };
        let root = (self.b * self.b - self.a * c).sqrt();
        let outwards = self.b > 0.0;
        let dividend = if outwards { -c } else { root - self.b };
        dividend / if outwards { root + self.b } else { self.a }
    }
}

impl Flight {
    /// A meeting at a distance, if that is ahead, the wall is there and goes on so far along z.
    #[inline(always)]
    fn contact(
        &self,
        distance: f64,
        spans: bool,
        front: bool,
        normal: [f64; 2],
        extent: &Extent,
    ) -> Intersection {
        let z = self.origin[2] + self.direction[2] * distance;
        // NaN, for no contact, is not ahead.
        let meets = (distance >= 0.0) & spans & extent.hold(z, extent.slack);
        Intersection {
            distance,
            rank: if meets { distance } else { f64::INFINITY },
            front,
            normal,
        }
    }
}

impl Plane {
    /// Where a shot touches it.
    #[inline(always)]
    pub(super) fn touched(&self, flight: &Flight, extent: &Extent) -> Intersection {
        let ([x, y, _], [u, v, _]) = (flight.origin, flight.direction);
        let (height, start) = self.place([x, y]);
        let front = height >= 0.0;
        let approach = self.approach([u, v]);
        let closing = if front { -approach } else { approach };
        let gap = height.abs() - flight.radius;
        let touches = gap <= extent.slack;
        let distance = if touches { 0.0 } else { gap / closing };
        let least = if touches { SLIDES } else { 0.0 };
        let spans = self.spans(start + distance * dot([u, v], self.tangent), extent.slack);
        let heads_for_it = (closing > least) & !flight.from_here;
        flight.contact(distance, spans & heads_for_it, front, self.front(), extent)
    }
}

impl Cylinder {
    /// Where a shot touches it.
    #[inline(always)]
    pub(super) fn touched(&self, flight: &Flight, extent: &Extent) -> Intersection {
        let relative = self.relative([flight.origin[0], flight.origin[1]]);
        let direction = [flight.direction[0], flight.direction[1]];
        let passage = Passage::new(relative, direction);
        let inside = passage.square < self.radius * self.radius;
        let hollow = self.touch_hollow(flight, extent, relative, &passage, inside);
        let round = self.touch_round(flight, extent, relative, &passage, inside);
        chosen(round.rank < hollow.rank, round, hollow)
    }

    /// Where a shot inside the circle touches it.
    #[inline(always)]
    fn touch_hollow(
        &self,
        flight: &Flight,
        extent: &Extent,
        relative: [f64; 2],
        passage: &Passage,
        inside: bool,
    ) -> Intersection {
        let offset_radius = self.radius - flight.radius;
        let inner = offset_radius - extent.slack;
        let touches = inside
            & (passage.square >= inner * inner)
            & self.faces(relative, passage.square, extent)
            & !flight.from_here;
        let at_once = touches & (passage.b > SLIDES * offset_radius);
        let outer = offset_radius + extent.slack;
        let on_it = inside & (flight.from_here | (touches & (passage.square <= outer * outer)));
        let exit = passage.exit(offset_radius, on_it);
        let distance = if at_once { 0.0 } else { exit };
        let [u, v, _] = flight.direction;
        let place = [relative[0] + u * distance, relative[1] + v * distance];
        let faces = at_once | self.faces(place, offset_radius * offset_radius, extent);
        let comes_back = at_once | !on_it | (passage.b < 0.0);
        let spans = (offset_radius > extent.slack) & comes_back & faces;
        let normal = [place[0] * -self.side, place[1] * -self.side];
        flight.contact(distance, spans, self.side > 0.0, normal, extent)
    }

    /// Where a shot outside the circle touches it.
    #[inline(always)]
    fn touch_round(
        &self,
        flight: &Flight,
        extent: &Extent,
        relative: [f64; 2],
        passage: &Passage,
        inside: bool,
    ) -> Intersection {
        let offset_radius = self.radius + flight.radius;
        let outer = offset_radius + extent.slack;
        let touches = passage.square <= outer * outer;
        let entry = passage.entry(offset_radius);
        let distance = if touches { 0.0 } else { entry };
        let [u, v, _] = flight.direction;
        let place = [relative[0] + u * distance, relative[1] + v * distance];
        let least = if touches { SLIDES } else { 0.0 } * offset_radius;
        let heads_for_it = (passage.b < -least) & !inside & !flight.from_here;
        let square = if touches {
            passage.square
        } else {
            offset_radius * offset_radius
        };
        let spans = heads_for_it & self.faces(place, square, extent);
        let normal = [place[0] * -self.side, place[1] * -self.side];
        flight.contact(distance, spans, self.side < 0.0, normal, extent)
    }

    /// Whether the arc lies in the direction of an offset from the centre, given with its square.
    #[inline(always)]
    fn faces(&self, offset: [f64; 2], square: f64, extent: &Extent) -> bool {
        let along = dot(offset, self.towards) * self.radius;
        let reach = self.reach - extent.slack;
        let squares = along * along - reach * reach * square;
        // along >= reach sqrt(square), without the root.
        if reach >= 0.0 {
            (along >= 0.0) & (squares >= 0.0)
        } else {
            (along >= 0.0) | (squares <= 0.0)
        }
    }
}

impl Edge {
    /// Where a shot touches it.
    #[inline(always)]
    pub(super) fn touched(&self, flight: &Flight, extent: &Extent) -> Intersection {
        let relative = minus([flight.origin[0], flight.origin[1]], self.point);
        let [u, v, _] = flight.direction;
        let passage = Passage::new(relative, [u, v]);
        let outer = flight.radius + extent.slack;
        let touches = passage.square <= outer * outer;
        let entry = passage.entry(flight.radius);
        let distance = if touches { 0.0 } else { entry };
        let least = if touches { SLIDES } else { 0.0 } * flight.radius;
        let heads_for_it = (passage.b < -least) & !flight.from_here;
        let normal = [relative[0] + u * distance, relative[1] + v * distance];
        flight.contact(distance, heads_for_it, true, normal, extent)
    }
}
