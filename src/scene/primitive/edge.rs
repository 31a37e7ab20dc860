//! Edges between walls, along z, that stick out into free space.

use super::{Extent, Flight, Intersect, Intersection, dot};
use crate::precision::Real;

/// An edge between two walls; only shots of finite size touch it.
#[derive(Clone, Copy, Debug)]
pub struct Edge<R> {
    pub point: [R; 2],
    /// Shots that are on this side of the bisector of the walls touch the second of them.
    pub towards_second: [R; 2],
}

impl<R: Real> Edge<R> {
    /// The same edge in another precision.
    pub fn with<S: Real>(&self) -> Edge<S> {
        Edge {
            point: self.point.map(|x| S::of(x.wide())),
            towards_second: self.towards_second.map(|x| S::of(x.wide())),
        }
    }

    /// Whether a shot with this normal of contact touches the second of its walls.
    pub fn is_of_second(&self, normal: [R; 2]) -> bool {
        dot(normal, self.towards_second) > R::ZERO
    }
}

impl<R: Real> Intersect<R> for Edge<R> {
    /// Points meet the walls beside it.
    #[inline(always)]
    fn meet<const LEAVES: bool>(&self, _: &Flight<R>, _: &Extent<R>) -> Intersection<R> {
        Intersection {
            distance: R::INFINITY,
            rank: R::INFINITY,
            front: true,
            normal: [R::ZERO; 2],
        }
    }

    #[inline(always)]
    fn touch(&self, flight: &Flight<R>, extent: &Extent<R>) -> Intersection<R> {
        self.touched(flight, extent)
    }
}
