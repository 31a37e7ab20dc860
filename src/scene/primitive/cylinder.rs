//! Cylindrical walls.

use super::{Extent, Flight, Intersect, Intersection, chosen, dot, minus};

/// A cylindrical wall, unbounded along z.
#[derive(Clone, Copy, Debug)]
pub struct Cylinder {
    pub centre: [f64; 2],
    pub radius: f64,
    /// +1 when free space is inside the circle.
    pub side: f64,
    /// The arc is where (p - centre) . towards >= reach.
    pub towards: [f64; 2],
    pub reach: f64,
}

impl Cylinder {
    #[inline(always)]
    pub fn relative(&self, point: [f64; 2]) -> [f64; 2] {
        minus(point, self.centre)
    }

    #[inline(always)]
    pub fn offset(&self, origin: [f64; 2], direction: [f64; 2], distance: f64) -> [f64; 2] {
        let [x, y] = self.relative(origin);
        [x + direction[0] * distance, y + direction[1] * distance]
    }

    /// Distance between a point of the cross-section and the whole circle.
    #[inline(always)]
    pub fn distance_to_whole(&self, to: [f64; 2]) -> f64 {
        let relative = self.relative(to);
        (dot(relative, relative).sqrt() - self.radius).abs()
    }

    /// Unit normal on the front, at an offset from the centre.
    #[inline(always)]
    pub(super) fn front(&self, offset: [f64; 2]) -> [f64; 2] {
        let scale = -self.side / self.radius;
        [offset[0] * scale, offset[1] * scale]
    }

    #[inline(always)]
    pub fn lies_on(&self, relative: [f64; 2], slack: f64) -> bool {
        let excess = dot(relative, relative) - self.radius * self.radius;
        (excess.abs() <= (self.radius + self.radius) * slack)
            & (dot(relative, self.towards) >= self.reach - slack)
    }

    /// Distances at which a line crosses the whole cylinder, nearest first, and whether it comes
    /// from the front there; NaN for none. A line that starts `on_it` crosses it once more.
    #[inline(always)]
    pub fn roots(&self, origin: [f64; 2], direction: [f64; 2], on_it: bool) -> [(f64, bool); 2] {
        let relative = self.relative(origin);
        let (a, half_b) = (dot(direction, direction), dot(relative, direction));
        let c = if on_it {
            0.0
        } else {
            dot(relative, relative) - self.radius * self.radius
        };
        // Citardauq's form: the root near the start does not suffer from cancellation.
        let q = -(half_b + (half_b * half_b - a * c).sqrt().copysign(half_b));
        let (first, second) = (q / a, c / q);
        let swapped = second < first;
        let inside_is_free = self.side > 0.0;
        [
            (if swapped { second } else { first }, !inside_is_free),
            (if swapped { first } else { second }, inside_is_free),
        ]
    }

    #[inline(always)]
    fn ahead(
        &self,
        flight: &Flight,
        extent: &Extent,
        (distance, front): (f64, bool),
    ) -> Intersection {
        let ([x, y, _], [u, v, _]) = (flight.origin, flight.direction);
        let margin = flight.margin(front, extent);
        let offset = self.offset([x, y], [u, v], distance);
        let spans = dot(offset, self.towards) >= self.reach - margin;
        Intersection {
            distance,
            rank: flight.rank(distance, spans, margin, extent),
            front,
            normal: self.front(offset),
        }
    }
}

impl Cylinder {
    /// Distance to a point of the cross-section.
    #[inline]
    pub fn distance(&self, to: [f64; 2]) -> f64 {
        let relative = self.relative(to);
        let from_centre = dot(relative, relative).sqrt();
        if dot(relative, self.towards) * self.radius >= self.reach * from_centre {
            return (from_centre - self.radius).abs();
        }
        let [x, y] = self.nearest(to);
        let offset = [to[0] - x, to[1] - y];
        dot(offset, offset).sqrt()
    }

    /// The point of its arc in the cross-section that is nearest to another.
    pub fn nearest(&self, to: [f64; 2]) -> [f64; 2] {
        let relative = self.relative(to);
        let distance = dot(relative, relative).sqrt();
        let direction = if distance > 0.0 {
            [relative[0] / distance, relative[1] / distance]
        } else {
            self.towards
        };
        let cos_reach = (self.reach / self.radius).max(-1.0);
        let direction = if dot(direction, self.towards) >= cos_reach {
            direction
        } else {
            self.nearer_end(direction, cos_reach)
        };
        [
            self.centre[0] + self.radius * direction[0],
            self.centre[1] + self.radius * direction[1],
        ]
    }

    /// The direction of the end of the arc that is nearer to another direction.
    fn nearer_end(&self, direction: [f64; 2], cos_reach: f64) -> [f64; 2] {
        let [x, y] = self.towards;
        let sin_reach = (1.0 - cos_reach * cos_reach).sqrt();
        let across = (x * direction[1] - y * direction[0]).signum() * sin_reach;
        [cos_reach * x - across * y, cos_reach * y + across * x]
    }
}

impl Intersect for Cylinder {
    #[inline(always)]
    fn meet<const LEAVES: bool>(&self, flight: &Flight, extent: &Extent) -> Intersection {
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
        chosen(touches & (touching.rank == 0.0), touching, ahead)
    }

    #[inline(always)]
    fn touch(&self, flight: &Flight, extent: &Extent) -> Intersection {
        self.touched(flight, extent)
    }
}
