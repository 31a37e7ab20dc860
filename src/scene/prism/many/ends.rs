//! Which shots of many may touch something at the ends of a prism.

use super::{Best, Flights};
use crate::scene::lanes::{LANES, components, padded};
use crate::scene::primitive::Primitive;
use crate::scene::prism::Prism;

/// Shots that are looked at together: none of them near an end is common.
const GROUP: usize = 16;

/// Where shots that leave by an end pass it, and how far aside they may still touch something.
struct Exits {
    x: [f64; GROUP],
    y: [f64; GROUP],
    /// m; infinite for shots that come from outside.
    reach: [f64; GROUP],
}

impl Prism {
    /// The shots that come so near to an end that they may touch a cap or a rim.
    #[inline(always)]
    pub(super) fn near_ends(&self, flights: &Flights, best: &Best) -> [bool; LANES] {
        let mut near = [false; LANES];
        let has_caps = !self.caps.is_empty();
        let farthest = f64::from(f32::MAX).sqrt();
        for (i, near) in near.iter_mut().enumerate().take(padded(flights.count)) {
            let from = flights.origin[2][i];
            let rank = best.rank[i];
            let ahead = if rank < farthest { rank } else { farthest };
            let to = from + flights.direction[2][i] * ahead;
            let (low, high) = if from < to { (from, to) } else { (to, from) };
            let radius = if has_caps { flights.radius[i] } else { 0.0 };
            let margin = self.extent.slack + radius;
            *near = (low <= margin) | (high >= self.extent.length - margin);
        }
        if !has_caps {
            let groups = near.chunks_exact_mut(GROUP).enumerate();
            for (group, near) in groups.filter(|(_, near)| near.contains(&true)) {
                self.drop_clear_exits(flights, group * GROUP, near);
            }
        }
        near
    }

    /// Most shots leave far from any rim; `first` is the first of the group.
    #[inline(always)]
    fn drop_clear_exits(&self, flights: &Flights, first: usize, near: &mut [bool]) {
        let exits = self.exits(flights, first);
        let mut least = [f64::INFINITY; GROUP];
        for wall in &self.walls {
            match wall {
                Primitive::Plane(plane) => {
                    for (i, least) in least.iter_mut().enumerate() {
                        let square = plane.squared_distance([exits.x[i], exits.y[i]]);
                        *least = if square < *least { square } else { *least };
                    }
                }
                Primitive::Cylinder(cylinder) => {
                    for (i, least) in least.iter_mut().enumerate() {
                        let apart = cylinder.distance_to_whole([exits.x[i], exits.y[i]]);
                        let square = apart * apart;
                        *least = if square < *least { square } else { *least };
                    }
                }
            }
        }
        for (i, near) in near.iter_mut().enumerate() {
            let is_clear = least[i] > exits.reach[i] * exits.reach[i];
            *near &= !is_clear;
        }
    }

    #[inline(always)]
    fn exits(&self, flights: &Flights, first: usize) -> Exits {
        let zeros = [0.0; GROUP];
        let mut exits = Exits {
            x: zeros,
            y: zeros,
            reach: zeros,
        };
        for i in 0..GROUP {
            let [x, y, z] = components(flights.origin, first + i);
            let [u, v, w] = components(flights.direction, first + i);
            let outwards = w > 0.0;
            let end = if outwards { self.extent.length } else { 0.0 };
            let distance = (end - z) / w;
            exits.x[i] = x + u * distance;
            exits.y[i] = y + v * distance;
            // What lies in the end's plane at a distance D from where the shot passes it is nowhere nearer
            // than D |w| to its path.
            let is_inside = (z >= 0.0) & (z <= self.extent.length) & (w != 0.0);
            let reach = (flights.radius[first + i] + self.extent.slack) / w.abs();
            exits.reach[i] = if is_inside { reach } else { f64::INFINITY };
        }
        exits
    }
}
