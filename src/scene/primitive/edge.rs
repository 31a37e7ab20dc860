//! Edges between walls, along z, that stick out into free space.

use super::{Extent, Flight, Intersect, Intersection, dot};

/// An edge between two walls; only shots of finite size touch it.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    pub point: [f64; 2],
    /// Shots that are on this side of the bisector of the walls touch the second of them.
    pub towards_second: [f64; 2],
}

impl Edge {
    /// Whether a shot with this normal of contact touches the second of its walls.
    pub fn is_of_second(&self, normal: [f64; 2]) -> bool {
        dot(normal, self.towards_second) > 0.0
    }
}

impl Intersect for Edge {
    /// Points meet the walls beside it.
    #[inline(always)]
    fn meet<const LEAVES: bool>(&self, _: &Flight, _: &Extent) -> Intersection {
        Intersection {
            distance: f64::INFINITY,
            rank: f64::INFINITY,
            front: true,
            normal: [0.0; 2],
        }
    }

    #[inline(always)]
    fn touch(&self, flight: &Flight, extent: &Extent) -> Intersection {
        self.touched(flight, extent)
    }
}
