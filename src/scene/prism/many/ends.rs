//! Which shots of many may touch something at the ends of a prism.

use super::{Best, Flights};
use crate::scene::lanes::{LANES, components, padded};
use crate::scene::primitive::Primitive;
use crate::scene::prism::Prism;

/// Shots that are looked at together: none of them near an end is common.
const GROUP: usize = 16;

/// Where shots pass the plane of an open end, and how far aside they may still touch its rim.
struct Passages {
    x: [f64; GROUP],
    y: [f64; GROUP],
    /// m; infinite for shots that never pass it.
    reach: [f64; GROUP],
}

impl Prism {
    /// The shots that come so near to an end that they may touch a cap or a rim.
    #[inline(always)]
    pub(super) fn near_ends(&self, flights: &Flights, best: &Best) -> [bool; LANES] {
        let ends = [0.0, self.extent.length];
        let is_closed = ends.map(|z| self.caps.iter().any(|cap| cap.z == z));
        let (mut near, mut far) = ([false; LANES], [false; LANES]);
        let farthest = f64::from(f32::MAX).sqrt();
        let both = near.iter_mut().zip(&mut far).enumerate();
        for (i, (near, far)) in both.take(padded(flights.count)) {
            let from = flights.origin[2][i];
            let rank = best.rank[i];
            let ahead = if rank < farthest { rank } else { farthest };
            let to = from + flights.direction[2][i] * ahead;
            let (low, high) = if from < to { (from, to) } else { (to, from) };
            let margin = |is_closed: bool| {
                let radius = if is_closed { flights.radius[i] } else { 0.0 };
                self.extent.slack + radius
            };
            *near = low <= margin(is_closed[0]);
            *far = high >= self.extent.length - margin(is_closed[1]);
        }
        for (end, near) in [&mut near, &mut far].into_iter().enumerate() {
            if is_closed[end] {
                continue;
            }
            let groups = near.chunks_exact_mut(GROUP).enumerate();
            for (group, near) in groups.filter(|(_, near)| near.contains(&true)) {
                self.drop_clear_passages(flights, group * GROUP, ends[end], near);
            }
        }
        for (near, far) in near.iter_mut().zip(far) {
            *near |= far;
        }
        near
    }

    /// Most shots pass an open end far from its rim; `first` is the first of the group.
    #[inline(always)]
    fn drop_clear_passages(&self, flights: &Flights, first: usize, end: f64, near: &mut [bool]) {
        let passages = self.passages(flights, first, end);
        let mut least = [f64::INFINITY; GROUP];
        for wall in &self.walls {
            match wall {
                Primitive::Plane(plane) => {
                    for (i, least) in least.iter_mut().enumerate() {
                        let square = plane.squared_distance([passages.x[i], passages.y[i]]);
                        *least = if square < *least { square } else { *least };
                    }
                }
                Primitive::Cylinder(cylinder) => {
                    for (i, least) in least.iter_mut().enumerate() {
                        let apart = cylinder.distance_to_whole([passages.x[i], passages.y[i]]);
                        let square = apart * apart;
                        *least = if square < *least { square } else { *least };
                    }
                }
            }
        }
        for (i, near) in near.iter_mut().enumerate() {
            let is_clear = least[i] > passages.reach[i] * passages.reach[i];
            *near &= !is_clear;
        }
    }

    #[inline(always)]
    fn passages(&self, flights: &Flights, first: usize, end: f64) -> Passages {
        let zeros = [0.0; GROUP];
        let mut passages = Passages {
            x: zeros,
            y: zeros,
            reach: zeros,
        };
        for i in 0..GROUP {
            let [x, y, z] = components(flights.origin, first + i);
            let [u, v, w] = components(flights.direction, first + i);
            let distance = (end - z) / w;
            passages.x[i] = x + u * distance;
            passages.y[i] = y + v * distance;
            // What lies in the end's plane at a distance D from where the line of flight passes it is nowhere nearer
            // than D |w| to that line.
            let reach = (flights.radius[first + i] + self.extent.slack) / w.abs();
            passages.reach[i] = if w != 0.0 { reach } else { f64::INFINITY };
        }
        passages
    }
}
