//! Where the centre of a shot of finite size is when the shot touches a wall.
//!
//! A wall and everything within a radius of it is a body with parallel faces and round edges; a
//! shot touches the wall where its centre enters that body. A line that leaves a convex body never
//! comes back to it. So a shot that touches a plane, an edge or the outside of a cylinder at its
//! start meets it at once when it heads into it, and never otherwise.

use super::{Cylinder, Edge, Extent, Flight, Meeting, Plane, chosen, dot, minus};
use crate::precision::Real;

/// Cosine of the angle to the normal below which a shot that touches a surface slides along it.
const SLIDES: f64 = 1e-12;

/// A line in the cross-section that passes a circle round the origin.
struct Passage<R> {
    /// Squared speed in the cross-section.
    a: R,
    /// Half the rate at which the squared distance from the centre grows at the start.
    b: R,
    /// Squared distance from the centre.
    square: R,
}

impl<R: Real> Passage<R> {
    #[inline(always)]
    fn new(relative: [R; 2], direction: [R; 2]) -> Self {
        Self {
            a: dot(direction, direction),
            b: dot(relative, direction),
            square: dot(relative, relative),
        }
    }

    /// Where it enters a circle; NaN for nowhere.
    #[inline(always)]
    fn entry(&self, radius: R) -> R {
        let c = self.square - radius * radius;
        c / ((self.b * self.b - self.a * c).sqrt() - self.b)
    }

    /// Where it leaves a circle; NaN for nowhere. A line that starts `on_it` leaves it where it
    /// comes to it again.
    #[inline(always)]
    fn exit(&self, radius: R, on_it: bool) -> R {
        let c = if on_it {
            R::ZERO
        } else {
            self.square - radius * radius
        };
        let root = (self.b * self.b - self.a * c).sqrt();
        if self.b > R::ZERO {
            -c / (root + self.b)
        } else {
            (root - self.b) / self.a
        }
    }
}

impl<R: Real> Flight<R> {
    /// A meeting at a distance, if that is ahead, the wall is there and goes on so far along z.
    #[inline(always)]
    fn contact(
        &self,
        distance: R,
        spans: bool,
        front: bool,
        normal: [R; 2],
        extent: &Extent<R>,
    ) -> Meeting<R> {
        let z = self.origin[2] + self.direction[2] * distance;
        // NaN, for no contact, is not ahead.
        let meets = (distance >= R::ZERO) & spans & extent.hold(z, extent.slack);
        Meeting {
            distance,
            rank: if meets { distance } else { R::INFINITY },
            front,
            normal,
        }
    }
}

impl<R: Real> Plane<R> {
    /// Where a shot touches it.
    #[inline(always)]
    pub(super) fn touched(&self, flight: &Flight<R>, extent: &Extent<R>) -> Meeting<R> {
        let ([x, y, _], [u, v, _]) = (flight.origin, flight.direction);
        let (height, start) = self.place([x, y]);
        let front = height >= R::ZERO;
        let approach = self.approach([u, v]);
        let closing = if front { -approach } else { approach };
        let gap = height.abs() - flight.radius;
        let touches = gap <= extent.slack;
        let distance = if touches { R::ZERO } else { gap / closing };
        let least = if touches { R::of(SLIDES) } else { R::ZERO };
        let spans = self.spans(start + distance * dot([u, v], self.tangent), extent.slack);
        let heads_for_it = (closing > least) & !flight.from_here;
        flight.contact(distance, spans & heads_for_it, front, self.front(), extent)
    }
}

impl<R: Real> Cylinder<R> {
    /// Where a shot touches it.
    #[inline(always)]
    pub(super) fn touched(&self, flight: &Flight<R>, extent: &Extent<R>) -> Meeting<R> {
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
        flight: &Flight<R>,
        extent: &Extent<R>,
        relative: [R; 2],
        passage: &Passage<R>,
        inside: bool,
    ) -> Meeting<R> {
        let offset_radius = self.radius - flight.radius;
        let inner = offset_radius - extent.slack;
        let touches = inside
            & (passage.square >= inner * inner)
            & self.spans(relative, passage.square.sqrt(), extent)
            & !flight.from_here;
        let at_once = touches & (passage.b > R::of(SLIDES) * offset_radius);
        let outer = offset_radius + extent.slack;
        let on_it = inside & (flight.from_here | (touches & (passage.square <= outer * outer)));
        let exit = passage.exit(offset_radius, on_it);
        let distance = if at_once { R::ZERO } else { exit };
        let [u, v, _] = flight.direction;
        let place = [relative[0] + u * distance, relative[1] + v * distance];
        let comes_back = at_once | !on_it | (passage.b < R::ZERO);
        let spans =
            (offset_radius > extent.slack) & comes_back & self.spans(place, offset_radius, extent);
        self.contact_at(flight, extent, distance, spans, place, offset_radius)
    }

    /// Where a shot outside the circle touches it.
    #[inline(always)]
    fn touch_round(
        &self,
        flight: &Flight<R>,
        extent: &Extent<R>,
        relative: [R; 2],
        passage: &Passage<R>,
        inside: bool,
    ) -> Meeting<R> {
        let offset_radius = self.radius + flight.radius;
        let outer = offset_radius + extent.slack;
        let touches = passage.square <= outer * outer;
        let entry = passage.entry(offset_radius);
        let distance = if touches { R::ZERO } else { entry };
        let [u, v, _] = flight.direction;
        let place = [relative[0] + u * distance, relative[1] + v * distance];
        let least = if touches { R::of(SLIDES) } else { R::ZERO } * offset_radius;
        let heads_for_it = (passage.b < -least) & !inside & !flight.from_here;
        let apart = if touches {
            passage.square.sqrt()
        } else {
            offset_radius
        };
        let spans = heads_for_it & self.spans(place, apart, extent);
        let contact = self.contact_at(flight, extent, distance, spans, place, offset_radius);
        Meeting {
            front: !contact.front,
            ..contact
        }
    }

    /// Whether the arc is where a circle with another radius is at an offset from the centre.
    #[inline(always)]
    fn spans(&self, offset: [R; 2], radius: R, extent: &Extent<R>) -> bool {
        dot(offset, self.towards) * self.radius >= (self.reach - extent.slack) * radius
    }

    #[inline(always)]
    fn contact_at(
        &self,
        flight: &Flight<R>,
        extent: &Extent<R>,
        distance: R,
        spans: bool,
        place: [R; 2],
        offset_radius: R,
    ) -> Meeting<R> {
        let scale = -self.side / offset_radius;
        let normal = [place[0] * scale, place[1] * scale];
        flight.contact(distance, spans, self.side > R::ZERO, normal, extent)
    }
}

impl<R: Real> Edge<R> {
    /// Where a shot touches it.
    #[inline(always)]
    pub(super) fn touched(&self, flight: &Flight<R>, extent: &Extent<R>) -> Meeting<R> {
        let relative = minus([flight.origin[0], flight.origin[1]], self.point);
        let [u, v, _] = flight.direction;
        let passage = Passage::new(relative, [u, v]);
        let outer = flight.radius + extent.slack;
        let touches = passage.square <= outer * outer;
        let entry = passage.entry(flight.radius);
        let distance = if touches { R::ZERO } else { entry };
        let least = if touches { R::of(SLIDES) } else { R::ZERO } * flight.radius;
        let heads_for_it = (passage.b < -least) & !flight.from_here;
        let place = [relative[0] + u * distance, relative[1] + v * distance];
        let scale = R::ONE / dot(place, place).sqrt();
        let normal = [place[0] * scale, place[1] * scale];
        flight.contact(distance, heads_for_it, true, normal, extent)
    }
}
