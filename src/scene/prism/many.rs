//! Many rays at once against a prism: wall by wall, all rays against each.

mod ends;

use std::hint::select_unpredictable;

use nalgebra::Vector3;

use super::{Nearest, Prism};
use crate::scene::departure::Departure;
use crate::scene::lanes::{LANES, Lane, any, components, index, padded, put};
use crate::scene::primitive::{Extent, Flight, Intersect, Primitive};
use crate::scene::ray::Ray;
use crate::scene::rays::{Hits, Rays};
use crate::triple::dot;

/// What the rays have met so far.
struct Best {
    distance: Lane,
    rank: Lane,
    /// Twice the index of the wall or cap, plus 1 on its front; negative for none on this prism.
    code: Lane,
    /// Index of the surface among those of the prism; of edges it has no meaning.
    surface: Lane,
    /// Normals on the fronts, in the frame of the prism.
    normal: [Lane; 3],
}

/// A wall or edge among those of its prism.
#[derive(Clone, Copy)]
struct Piece {
    index: f64,
    /// Index of its surface among those of the prism; of edges it has no meaning.
    surface: f64,
}

/// Where the rays are in the frame of the prism, and which of its walls they start from.
struct Flights<'a> {
    count: usize,
    origin: &'a [Lane; 3],
    direction: &'a [Lane; 3],
    radius: &'a Lane,
    /// Index of the wall or cap; negative for none of this prism.
    piece: Lane,
    on_front: [bool; LANES],
}

impl Prism {
    /// Takes the first crossings that are nearer than what the rays have hit so far; `part` is the
    /// index of this part in the scene. Normals are those on the fronts.
    #[inline(always)]
    pub fn cross(&self, part: u32, rays: &Rays, hits: &mut Hits) {
        let (origin, direction);
        let mut flights = Flights {
            count: rays.count,
            origin: &rays.origin,
            direction: &rays.direction,
            radius: &rays.radius,
            piece: [-1.0; LANES],
            on_front: [true; LANES],
        };
        if self.moved {
            let shift = self.shift.map(|x| -x);
            origin = self.turned(&shifted(&rays.origin, &shift, rays.count), rays.count, true);
            direction = self.turned(&rays.direction, rays.count, true);
            flights.origin = &origin;
            flights.direction = &direction;
        }
        let mut best = Best {
            distance: hits.distance,
            rank: hits.distance,
            code: [-1.0; LANES],
            surface: [0.0; LANES],
            normal: [[0.0; LANES]; 3],
        };
        if let Some(hit_ids) = &rays.leaving {
            for i in 0..padded(rays.count) {
                let here = hit_ids.part[i] == part;
                let piece = f64::from(hit_ids.piece[i]);
                flights.piece[i] = if here { piece } else { -1.0 };
            }
            flights.on_front = hit_ids.front;
        }
        let leaves = rays.leaving.is_some();
        if rays.are_spheres {
            self.touch_walls(&flights, &mut best);
            self.touch_ends_one_by_one(leaves, &flights, &mut best);
        } else {
            match leaves {
                true => self.cross_walls::<true>(&flights, &mut best),
                false => self.cross_walls::<false>(&flights, &mut best),
            }
            if !self.caps.is_empty() {
                self.cross_caps_one_by_one(leaves, &flights, &mut best);
            }
        }
        self.record_spots(part, rays, &best, hits);
        if self.moved {
            best.normal = self.turned(&best.normal, rays.count, false);
        }
        best.record_places(rays.count, hits);
    }

    #[inline(always)]
    fn cross_walls<const LEAVES: bool>(&self, flights: &Flights, best: &mut Best) {
        for (index, wall) in self.walls.iter().enumerate() {
            let piece = self.piece(index);
            match wall {
                Primitive::Plane(plane) => {
                    best.take::<_, LEAVES, false>(flights, piece, plane, &self.extent);
                }
                Primitive::Cylinder(cylinder) => {
                    best.take::<_, LEAVES, false>(flights, piece, cylinder, &self.extent);
                }
            }
        }
    }

    #[inline(always)]
    fn touch_walls(&self, flights: &Flights, best: &mut Best) {
        for (index, wall) in self.walls.iter().enumerate() {
            let piece = self.piece(index);
            match wall {
                Primitive::Plane(plane) => {
                    best.take::<_, true, true>(flights, piece, plane, &self.extent);
                }
                Primitive::Cylinder(cylinder) => {
                    best.take::<_, true, true>(flights, piece, cylinder, &self.extent);
                }
            }
        }
        for (index, edge) in (self.first_edge()..).zip(&self.edges) {
            let piece = Piece {
                index: f64::from(index),
                surface: 0.0,
            };
            best.take::<_, true, true>(flights, piece, edge, &self.extent);
        }
    }

    #[inline(always)]
    fn piece(&self, wall: usize) -> Piece {
        Piece {
            index: wall as f64,
            surface: f64::from(self.surfaces[wall] - self.first_surface),
        }
    }

    /// What is rare: contacts with caps, and with rims by shots that come near an end.
    #[inline(always)]
    fn touch_ends_one_by_one(&self, leaves: bool, flights: &Flights, best: &mut Best) {
        let near = self.near_ends(flights, best);
        for i in (0..flights.count).filter(|&i| near[i]) {
            let (ray, start) = flights.one(i, leaves);
            let mut nearest = Nearest::within(best.rank[i]);
            self.touch_ends(&ray, flights.radius[i], &start, &mut nearest);
            self.take_one(i, &nearest, best);
        }
    }

    fn cross_caps_one_by_one(&self, leaves: bool, flights: &Flights, best: &mut Best) {
        for i in 0..flights.count {
            let (ray, start) = flights.one(i, leaves);
            let mut nearest = Nearest::within(best.rank[i]);
            self.cross_caps(&ray, &start, &mut nearest);
            self.take_one(i, &nearest, best);
        }
    }

    /// Takes what one ray has met, if it has met anything.
    fn take_one(&self, i: usize, nearest: &Nearest, best: &mut Best) {
        let Some(piece) = nearest.piece else { return };
        let [x, y] = nearest.best.normal;
        best.distance[i] = nearest.best.distance;
        best.rank[i] = best.distance[i];
        best.code[i] = f64::from(2 * piece + u32::from(nearest.best.front));
        let surface = self.surface_touched(piece, [x, y]) - self.first_surface;
        best.surface[i] = f64::from(surface);
        put(&mut best.normal, i, [x, y, nearest.cap]);
    }

    /// Writes down what has been met, while normals are those in the frame of the prism.
    #[inline(always)]
    fn record_spots(&self, part: u32, rays: &Rays, best: &Best, hits: &mut Hits) {
        let count = rays.count;
        let hit_ids = &mut hits.hit_ids;
        for i in 0..padded(count) {
            let met = best.code[i] >= 0.0;
            let piece = index(best.code[i]) / 2;
            let surface = self.first_surface + index(best.surface[i]);
            hit_ids.part[i] = if met { part } else { hit_ids.part[i] };
            hit_ids.piece[i] = if met { piece } else { hit_ids.piece[i] };
            hits.surface[i] = if met { surface } else { hits.surface[i] };
        }
        // Apart, and without a choice: what has another size than the rest is worked on one by one.
        for i in 0..padded(count) {
            let met = best.code[i] >= 0.0;
            let front = index(best.code[i]) % 2 == 1;
            hit_ids.front[i] = (met & front) | (!met & hit_ids.front[i]);
        }
        let first_edge = f64::from(2 * self.first_edge());
        let is_edge = |code: f64| code >= first_edge;
        if !rays.are_spheres || !any(&best.code[..count], is_edge) {
            return;
        }
        for i in (0..count).filter(|&i| is_edge(best.code[i])) {
            let normal = [best.normal[0][i], best.normal[1][i]];
            hits.surface[i] = self.surface_touched(hits.hit_ids.piece[i], normal);
        }
    }

    /// Vectors turned with the prism, or `back` into its frame.
    #[inline(always)]
    fn turned(&self, vectors: &[Lane; 3], count: usize, back: bool) -> [Lane; 3] {
        let matrix = if back {
            self.rotation.transpose()
        } else {
            self.rotation
        };
        let row = |row: usize| [matrix[(row, 0)], matrix[(row, 1)], matrix[(row, 2)]];
        let (first, second, third) = (row(0), row(1), row(2));
        let mut turned = [[0.0; LANES]; 3];
        for i in 0..padded(count) {
            let vector = components(vectors, i);
            let components = [dot(first, vector), dot(second, vector), dot(third, vector)];
            put(&mut turned, i, components);
        }
        turned
    }
}

/// Points moved by a shift.
#[inline(always)]
fn shifted(points: &[Lane; 3], shift: &Vector3<f64>, count: usize) -> [Lane; 3] {
    let mut moved = *points;
    for (lane, &by) in moved.iter_mut().zip(shift.iter()) {
        for coordinate in &mut lane[..padded(count)] {
            *coordinate += by;
        }
    }
    moved
}

impl Flights<'_> {
    /// One of them, and what is known about its start.
    fn one(&self, i: usize, leaves: bool) -> (Ray, Departure) {
        let ray = Ray {
            origin: components(self.origin, i).into(),
            direction: components(self.direction, i).into(),
        };
        let piece = self.piece[i];
        let start = Departure {
            piece: (piece >= 0.0).then_some(piece as u32),
            front: leaves.then_some(self.on_front[i]),
            fronts_are_free: true,
        };
        (ray, start)
    }
}

impl Best {
    /// Writes down where the rays meet what they have met.
    #[inline(always)]
    fn record_places(&self, count: usize, hits: &mut Hits) {
        for i in 0..padded(count) {
            let met = self.code[i] >= 0.0;
            let old = components(&hits.normal, i);
            let new = components(&self.normal, i);
            hits.distance[i] = if met {
                self.distance[i]
            } else {
                hits.distance[i]
            };
            hits.above[i] = if met { 0.0 } else { hits.above[i] };
            hits.normal[0][i] = if met { new[0] } else { old[0] };
            hits.normal[1][i] = if met { new[1] } else { old[1] };
            hits.normal[2][i] = if met { new[2] } else { old[2] };
        }
    }

    /// Takes the meetings with one wall that are nearer.
    #[inline(always)]
    fn take<W: Intersect, const LEAVES: bool, const BALLS: bool>(
        &mut self,
        flights: &Flights,
        piece: Piece,
        wall: &W,
        extent: &Extent,
    ) {
        let double = piece.index + piece.index;
        for i in 0..padded(flights.count) {
            let flight = Flight {
                origin: components(flights.origin, i),
                direction: components(flights.direction, i),
                radius: flights.radius[i],
                from_here: flights.piece[i] == piece.index,
                on_front: flights.on_front[i],
            };
            let met = if BALLS {
                wall.touch(&flight, extent)
            } else {
                wall.meet::<LEAVES>(&flight, extent)
            };
            let nearer = met.rank < self.rank[i];
            // With `if` compilers may tell cases apart and write these one by one.
            let code = double + select_unpredictable(met.front, 1.0, 0.0);
            let [normal_x, normal_y, _] = &mut self.normal;
            for (best, new) in [
                (&mut self.distance[i], met.distance),
                (&mut self.rank[i], met.rank),
                (&mut self.code[i], code),
                (&mut self.surface[i], piece.surface),
                (&mut normal_x[i], met.normal[0]),
                (&mut normal_y[i], met.normal[1]),
            ] {
                *best = select_unpredictable(nearer, new, *best);
            }
        }
    }
}
