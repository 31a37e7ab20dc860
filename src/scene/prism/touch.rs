//! Shots of finite size against prismatic parts, exact: where they touch walls, edges, caps and the
//! rims at both ends.

use nalgebra::{Point3, Vector3};

use super::{Nearest, Prism};
use crate::scene::departure::Departure;
use crate::scene::primitive::{Flight, Intersect, Intersection, SLIDES};
use crate::scene::ray::{Crossing, HitId, Ray};

/// Steps along a ray towards a rim; each covers the distance that is free for certain.
const MOST_STEPS: usize = 256;

impl Prism {
    /// The first contact of a shot of some radius whose centre moves along a ray, nearer than
    /// `limit`, and the front normal there.
    pub fn first_touch(
        &self,
        ray: &Ray,
        radius: f64,
        leaving: Option<HitId>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let local = self.to_own_frame(ray);
        let start = Departure::of(leaving, on_this_part);
        let flight = |piece: u32| Flight {
            origin: local.origin.into(),
            direction: local.direction.into(),
            radius,
            from_here: start.piece == Some(piece),
            on_front: start.front.unwrap_or(true),
        };
        let mut nearest = Nearest::within(limit);
        for (piece, wall) in (0..).zip(&self.walls) {
            nearest.take(piece, &wall.touch(&flight(piece), &self.extent));
        }
        for (piece, edge) in (self.first_edge()..).zip(&self.edges) {
            nearest.take(piece, &edge.touch(&flight(piece), &self.extent));
        }
        self.touch_ends(&local, radius, &start, &mut nearest);
        let Nearest { best, piece, cap } = nearest;
        let crossing = Crossing {
            above: 0.0,
            distance: best.distance,
            front: best.front,
            piece: piece?,
            surface: self.surface_touched(piece?, best.normal),
        };
        let normal = Vector3::new(best.normal[0], best.normal[1], cap);
        Some((crossing, self.rotation * normal))
    }

    /// Index of the first edge; walls and caps come before, rims behind.
    #[inline(always)]
    pub(super) fn first_edge(&self) -> u32 {
        (self.walls.len() + self.caps.len()) as u32
    }

    pub(super) fn first_rim(&self) -> u32 {
        self.first_edge() + self.edges.len() as u32
    }

    /// The surface of a piece that is touched with this normal.
    pub(super) fn surface_touched(&self, piece: u32, normal: [f64; 2]) -> u32 {
        let edge = piece.wrapping_sub(self.first_edge()) as usize;
        match self.edges.get(edge) {
            Some(edge_here) => {
                let [first, second] = self.edge_surfaces[edge];
                if edge_here.is_of_second(normal) {
                    second
                } else {
                    first
                }
            }
            None if piece < self.first_edge() => self.surfaces[piece as usize],
            None => {
                let wall = (piece - self.first_rim()) as usize % self.walls.len();
                self.surfaces[wall]
            }
        }
    }

    /// Takes contacts with caps and rims where they are the nearest.
    pub(super) fn touch_ends(
        &self,
        ray: &Ray,
        radius: f64,
        start: &Departure,
        nearest: &mut Nearest,
    ) {
        for (piece, cap) in (self.walls.len() as u32..).zip(&self.caps) {
            if start.piece != Some(piece) {
                self.touch_cap(ray, radius, piece, cap, nearest);
            }
        }
        // Between the ends a wall is always nearer than its rim.
        let (length, slack) = (self.extent.length, self.extent.slack);
        for (end, z, low, high) in [
            (0, 0.0, -radius, slack),
            (1, length, length - slack, length + radius),
        ] {
            let limit = nearest.best.rank;
            if let Some(span) = between(ray, low, high).filter(|span| span[0] < limit) {
                self.touch_rim(ray, radius, (end, z), span, start, nearest);
            }
        }
    }

    fn touch_cap(
        &self,
        ray: &Ray,
        radius: f64,
        piece: u32,
        cap: &super::Cap,
        nearest: &mut Nearest,
    ) {
        let height = (ray.origin.z - cap.z) * cap.facing;
        let front = height >= 0.0;
        let approach = ray.direction.z * cap.facing;
        let closing = if front { -approach } else { approach };
        let gap = height.abs() - radius;
        let touches = gap <= self.extent.slack;
        let (distance, least) = if touches {
            (0.0, SLIDES)
        } else {
            (gap / closing, 0.0)
        };
        let ahead = closing > least && distance < nearest.best.rank;
        let place = || (ray.origin.xy() + ray.direction.xy() * distance).into();
        if ahead && self.holds(place()) {
            let meeting = Intersection {
                distance,
                rank: distance,
                front,
                normal: [0.0; 2],
            };
            nearest.take(piece, &meeting);
            nearest.cap = cap.facing;
        }
    }

    /// Goes along the ray by what is free until the shot touches the rim at one end.
    fn touch_rim(
        &self,
        ray: &Ray,
        radius: f64,
        (end, z): (u32, f64),
        [mut distance, last]: [f64; 2],
        start: &Departure,
        nearest: &mut Nearest,
    ) {
        let first = self.first_rim() + end * self.walls.len() as u32;
        let left = start.piece.and_then(|piece| piece.checked_sub(first));
        let left = left.filter(|&wall| (wall as usize) < self.walls.len());
        // At the corner of two walls it leaves the rims of both.
        let leaves_it = |centre: &Point3<f64>, least: f64| {
            left.is_some_and(|left| {
                self.distance_to_wall(left, centre) <= least + self.extent.slack
            })
        };
        let settled = 1e-3 * self.extent.slack;
        let last = last.min(nearest.best.rank);
        let begin = ray.origin + ray.direction * distance;
        let Some(within_reach) = self.within_reach(&begin, radius + (last - distance)) else {
            return;
        };
        for _ in 0..MOST_STEPS {
            if distance > last {
                return;
            }
            let centre = ray.origin + ray.direction * distance;
            let (wall, least) = match within_reach {
                Reach::One(wall) => (wall, self.distance_to_wall(wall, &centre)),
                Reach::Several => self.nearest_wall(&centre),
            };
            if least - radius > last - distance {
                return;
            }
            let [x, y] = self.walls[wall as usize].nearest([centre.x, centre.y]);
            let offset = centre - Point3::new(x, y, z);
            let apart = offset.norm();
            let gap = apart - radius;
            let closing = -offset.dot(&ray.direction) / apart;
            let from_contact = distance == 0.0 && gap <= self.extent.slack;
            let leaves_here = distance == 0.0 && leaves_it(&centre, least);
            let heads_for_it = closing > SLIDES && !leaves_here;
            if heads_for_it && (from_contact || gap.abs() <= settled) {
                let normal = offset / apart;
                let meeting = Intersection {
                    distance,
                    rank: distance,
                    front: true,
                    normal: [normal.x, normal.y],
                };
                let wall = match within_reach {
                    Reach::One(wall) => wall,
                    Reach::Several => self.wall_that_faces(&centre, least, meeting.normal),
                };
                nearest.take(first + wall, &meeting);
                nearest.cap = normal.z;
                return;
            }
            // Near contact Newton's steps are longer, and come back where they went too far; away from
            // a rim that is touched any step is free.
            let is_near = gap < 0.01 * radius && heads_for_it;
            distance += if is_near {
                gap / closing
            } else {
                gap.max(1e-3 * radius)
            };
        }
    }

    /// The walls within reach of a point in the cross-section: whoever comes from there and goes no
    /// farther need not look at others. `None` where there is none.
    fn within_reach(&self, from: &Point3<f64>, reach: f64) -> Option<Reach> {
        // More than rounding takes from a distance.
        let reach = reach + self.extent.slack;
        let walls = 0..self.walls.len() as u32;
        let mut walls = walls.filter(|&wall| self.distance_to_wall(wall, from) <= reach);
        let first = walls.next()?;
        Some(match walls.next() {
            None => Reach::One(first),
            Some(_) => Reach::Several,
        })
    }

    /// The wall that is nearest in the cross-section, and how far away it is there.
    fn nearest_wall(&self, to: &Point3<f64>) -> (u32, f64) {
        let mut found = (0, f64::INFINITY);
        for wall in 0..self.walls.len() as u32 {
            let apart = self.distance_to_wall(wall, to);
            if apart < found.1 {
                found = (wall, apart);
            }
        }
        found
    }

    /// Of the walls that are this near in the cross-section, as two are at their corner, the one
    /// whose normal is nearest to that of the contact, whichever sides are their fronts.
    fn wall_that_faces(&self, to: &Point3<f64>, least: f64, normal: [f64; 2]) -> u32 {
        let (mut found, mut most) = (0, -1.0);
        for wall in 0..self.walls.len() as u32 {
            if self.distance_to_wall(wall, to) <= least + self.extent.slack {
                let [x, y] = self.walls[wall as usize].front_nearest([to.x, to.y]);
                let facing = (x * normal[0] + y * normal[1]).abs();
                if facing > most {
                    (found, most) = (wall, facing);
                }
            }
        }
        found
    }

    /// In the cross-section.
    fn distance_to_wall(&self, wall: u32, to: &Point3<f64>) -> f64 {
        self.walls[wall as usize].distance([to.x, to.y])
    }
}

/// The walls whose rims a shot may touch.
enum Reach {
    One(u32),
    Several,
}

/// Between which distances a ray is between two heights.
pub(super) fn between(ray: &Ray, low: f64, high: f64) -> Option<[f64; 2]> {
    let (from, rate) = (ray.origin.z, ray.direction.z);
    if rate == 0.0 {
        return (low <= from && from <= high).then_some([0.0, f64::INFINITY]);
    }
    let (a, b) = ((low - from) / rate, (high - from) / rate);
    let (first, last) = (a.min(b).max(0.0), a.max(b));
    (first <= last).then_some([first, last])
}
