//! One ray against triangles.

use nalgebra::{Point3, Vector3};

use super::TriangleMesh;
use super::plane::{GRAZING, Plane};
use super::slide::Slide;
use crate::scene::LIFT;
use crate::scene::bvh8::{Entered, FlatRay, Point};
use crate::scene::departure::Departure;
use crate::scene::ray::{Crossing, HitId, Ray};
use crate::scene::triangle::{Shear, Weights, lies_on, passes_over};

impl TriangleMesh {
    /// The first crossing of a ray nearer than `limit`, and the front normal there. Of crossings
    /// at the same distance it is that of the triangle with the lowest index.
    ///
    /// `leaving` is the spot that the ray starts from; `on_this_part` says whether it is on this
    /// mesh.
    pub fn first_crossing(
        &self,
        ray: &Ray,
        leaving: Option<HitId>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let start = Departure::of(leaving, on_this_part).with_free_side(self.fronts_are_free);
        let sight = self.sight(ray);
        let entered = self.tree.entered(&sight.flat, limit);
        let nearest = self.nearest(ray, &sight, &entered, &start, limit)?;
        Some(self.told(ray, &nearest))
    }

    /// The corner points of a triangle, from where rays have just found it.
    #[inline(always)]
    fn corners_of(&self, facet: Facet) -> [Point3<f64>; 3] {
        self.bundles[facet.leaf as usize].corners(facet.lane)
    }

    /// The plane of such a triangle.
    #[inline(always)]
    fn plane_of(&self, facet: Facet) -> Plane {
        let bundle = &self.bundles[facet.leaf as usize];
        Plane::new(bundle.normal(facet.lane), bundle.corner(facet.lane, 0))
    }

    /// A ray as the boxes and the triangles see it.
    #[inline(always)]
    pub(super) fn sight(&self, ray: &Ray) -> PrecomputedRay {
        PrecomputedRay {
            flat: self.tree.flat(ray),
            shear: Shear::new(ray),
        }
    }

    /// All about the nearest crossing, and the front normal there.
    #[inline(always)]
    pub(super) fn told(&self, ray: &Ray, nearest: &Nearest) -> (Crossing, Vector3<f64>) {
        let &Nearest {
            t, front, facet, ..
        } = nearest;
        let index = facet.index;
        let plane = self.plane_of(facet);
        let crossing = Crossing {
            distance: t,
            above: plane.above(t, front, &ray.origin),
            front,
            piece: index,
            surface: self.surface(index),
        };
        (crossing, plane.normal)
    }

    /// The nearest crossing of a ray within `limit`.
    #[inline(always)]
    pub(super) fn nearest(
        &self,
        ray: &Ray,
        sight: &PrecomputedRay,
        entered: &Entered,
        start: &Departure,
        limit: f64,
    ) -> Option<Nearest> {
        let mut best = Nearest {
            t: limit,
            front: true,
            facet: Facet::default(),
            farther: 0.0,
            may_slide_off: false,
        };
        let mut slide = Slide::default();
        let mut walk = self.tree.walk(&sight.flat);
        walk.start(entered);
        while let Some((leaf, starts_inside)) = walk.next() {
            let bundle = &self.bundles[leaf as usize];
            let (weights, crossed) = bundle.weights(&sight.shear, self.doubtful_weight);
            let own = start.piece.map_or(0, |piece| bundle.lane_of(piece));
            let (mut lanes, mut near) = (crossed & !own, 0);
            if starts_inside && let Some(front) = start.front {
                let (on, left) = bundle.started_on(ray, front, self.slack, GRAZING);
                lanes = (crossed | on) & !(left | own);
                if lanes != 0 {
                    near = bundle.near(&ray.origin, self.slack);
                    lanes &= crossed | near;
                }
            }
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let index = bundle.triangles()[lane];
                let weights = weights.of(lane);
                let facet = Facet { index, leaf, lane };
                let found = if near >> lane & 1 == 1 {
                    self.crossing_from_near(facet, ray, sight, &weights, start)
                } else {
                    self.crossing(facet, ray, sight, &weights, weights.distance(), start)
                };
                if let Some(found) = found
                    && found.comes_before(&best)
                    && !(found.may_slide_off && self.slides_off(ray, found.t, &mut slide))
                {
                    best = found;
                    walk.end_at(best.cost());
                }
            }
        }
        (best.cost() < limit).then_some(best)
    }

    /// Where a ray that leaves a surface crosses a triangle on which it may start, if it has not left
    /// that behind (`TrianglePacket::started_on`).
    #[inline(always)]
    fn crossing_from_near(
        &self,
        facet: Facet,
        ray: &Ray,
        sight: &PrecomputedRay,
        weights: &Weights,
        start: &Departure,
    ) -> Option<Nearest> {
        let plane = self.plane_of(facet);
        let height = plane.height(&ray.origin);
        let approach = ray.direction.dot(&plane.normal);
        let starts_near = height.abs() <= self.slack;
        let distance = -height / approach;
        let leads_away = approach.abs() > GRAZING && distance < 0.0;
        if leads_away && !starts_near {
            return None;
        }
        if starts_near && lies_on(&ray.origin, &self.corners_of(facet), self.slack) {
            return start.enters(approach).then_some(Nearest {
                t: 0.0,
                front: approach < 0.0,
                facet,
                farther: 0.0,
                may_slide_off: false,
            });
        }
        if !weights.may_cross(self.doubtful_weight) {
            return None;
        }
        // So near, the weights may put it on the wrong side of the start.
        let is_clear = distance.is_finite() && distance.abs() > 0.0;
        let t = if is_clear {
            distance
        } else {
            weights.distance()
        };
        self.crossing(facet, ray, sight, weights, t, start)
    }

    /// Where a ray that may cross a triangle on which it does not start does so, unless it slides off there;
    /// `t` (m) is about where, for rays that graze it.
    #[inline(always)]
    fn crossing(
        &self,
        facet: Facet,
        ray: &Ray,
        sight: &PrecomputedRay,
        weights: &Weights,
        t: f64,
        start: &Departure,
    ) -> Option<Nearest> {
        let front = weights.front();
        let (margin, farther) = if start.sees(front) {
            (self.slack * LIFT, 0.0)
        } else {
            (0.0, self.slack)
        };
        let is_seen = margin > 0.0;
        let doubt = self.doubtful_weight;
        let corners = || self.corners_of(facet);
        let crosses = || weights.crosses(&sight.shear, corners, margin, doubt);
        let plane = self.plane_of(facet);
        let approach = ray.direction.dot(&plane.normal);
        // Which crossing comes first is to be told by where they end up: the weights hardly tell where
        // a ray along the plane meets it, or any ray a sliver.
        let (t, meets, may_slide_off) = if approach.abs() <= GRAZING {
            let corners = corners();
            let runs_along = Departure::runs_along(approach);
            let meets = if is_seen {
                crosses()
                    || (!runs_along && passes_over(ray, &sight.shear, &corners, front, margin))
            } else {
                !runs_along && crosses()
            };
            let t = plane.over_triangle(t, ray, &corners);
            (plane.refined(t, ray, &corners), meets && t > 0.0, false)
        } else {
            let t = plane.distance(ray);
            (t, t > 0.0 && crosses(), !is_seen && weights.is_near_edge())
        };
        meets.then_some(Nearest {
            t,
            front,
            facet,
            farther,
            may_slide_off,
        })
    }
}

/// A ray as boxes and as triangles see it.
pub(super) struct PrecomputedRay {
    pub flat: FlatRay<Point>,
    shear: Shear,
}

/// A triangle and where it is among the bundles.
#[derive(Clone, Copy, Default)]
pub(super) struct Facet {
    index: u32,
    leaf: u32,
    lane: usize,
}

pub(super) struct Nearest {
    t: f64,
    front: bool,
    facet: Facet,
    /// Where a ray passes over the edge between a facet that it sees and one that it sees from
    /// behind, the one behind counts as farther.
    farther: f64,
    /// It is none if the ray slides off at an edge there.
    may_slide_off: bool,
}

impl Nearest {
    #[inline(always)]
    fn cost(&self) -> f64 {
        self.t + self.farther
    }

    /// Whether it is nearer than another one, or as near and on a triangle with a lower index.
    #[inline(always)]
    fn comes_before(&self, other: &Self) -> bool {
        let (cost, so_far) = (self.cost(), other.cost());
        cost < so_far || (cost == so_far && self.facet.index < other.facet.index)
    }
}
