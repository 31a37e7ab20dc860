//! Rays against prismatic parts, exact: the walls are planes and cylinders, not facets.

mod many;
#[cfg(test)]
mod tests;
mod touch;

use nalgebra::{Matrix3, Point3, Vector3};

use super::departure::Departure;
use super::primitive::{Edge, Extent, Flight, Intersection, Primitive};
use super::profile::{Corner, Profile};
use super::ray::{Crossing, HitId, Ray};
use crate::problem::part::{Ends, Place};

/// A cross-section drawn along z from 0 to a length, somewhere in the scene.
#[derive(Clone, Debug)]
pub struct Prism {
    walls: Vec<Primitive>,
    caps: Vec<Cap>,
    /// Of each wall, then of each cap.
    surfaces: Vec<u32>,
    /// The first index of its surfaces in the scene.
    first_surface: u32,
    /// Those that stick out into free space.
    edges: Vec<Edge>,
    /// The surfaces of the two walls beside each edge.
    edge_surfaces: Vec<[u32; 2]>,
    extent: Extent,
    rotation: Matrix3<f64>,
    shift: Vector3<f64>,
    moved: bool,
}

#[derive(Clone, Copy, Debug)]
struct Cap {
    z: f64,
    /// Component of the normal on the front along z.
    facing: f64,
}

impl Prism {
    /// A prism whose surfaces have the indices `surface_base` onwards: first the profile's, then
    /// the caps'. `slack` is the distance within which two points count as one, m.
    pub fn new(
        profile: &Profile,
        length: f64,
        ends: Ends,
        place: &Place,
        surface_base: u32,
        slack: f64,
    ) -> Self {
        let pieces = &profile.pieces;
        let mut caps = Vec::new();
        if ends.near_closed {
            caps.push(Cap {
                z: 0.0,
                facing: 1.0,
            });
        }
        if ends.far_closed {
            caps.push(Cap {
                z: length,
                facing: -1.0,
            });
        }
        let of_caps = profile.surfaces.len()..profile.surfaces.len() + caps.len();
        let of_walls = pieces.iter().map(|piece| piece.surface);
        let corners = profile.convex_corners();
        let surface = |wall: usize| surface_base + pieces[wall].surface;
        let edge = |corner: &Corner| Edge {
            point: corner.point.into(),
            towards_second: corner.towards_second.into(),
        };
        Self {
            edges: corners.iter().map(edge).collect(),
            edge_surfaces: corners.iter().map(|c| c.walls.map(surface)).collect(),
            walls: pieces
                .iter()
                .map(|piece| Primitive::of(&piece.curve))
                .collect(),
            caps,
            surfaces: of_walls
                .chain(of_caps.map(|surface| surface as u32))
                .map(|surface| surface_base + surface)
                .collect(),
            first_surface: surface_base,
            extent: Extent { length, slack },
            rotation: *place.rotation.to_rotation_matrix().matrix(),
            shift: place.shift,
            moved: *place != Place::default(),
        }
    }

    /// The first crossing of a ray nearer than `limit`, and the front normal there.
    ///
    /// `leaving` is the spot that the ray starts from; `on_this_part` says whether it is on this
    /// prism.
    pub fn first_crossing(
        &self,
        ray: &Ray,
        leaving: Option<HitId>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let local = self.to_own_frame(ray);
        let start = Departure::of(leaving, on_this_part);
        let mut nearest = Nearest::within(limit);
        for (piece, wall) in (0..).zip(&self.walls) {
            let flight = Flight {
                origin: local.origin.into(),
                direction: local.direction.into(),
                radius: 0.0,
                from_here: start.piece == Some(piece),
                on_front: start.front.unwrap_or(true),
            };
            let meeting = match leaving {
                Some(_) => wall.meet::<true>(&flight, &self.extent),
                None => wall.meet::<false>(&flight, &self.extent),
            };
            nearest.take(piece, &meeting);
        }
        self.cross_caps(&local, &start, &mut nearest);
        let Nearest { best, piece, cap } = nearest;
        let crossing = Crossing {
            above: 0.0,
            distance: best.distance,
            front: best.front,
            piece: piece?,
            surface: self.surfaces[piece? as usize],
        };
        let normal = Vector3::new(best.normal[0], best.normal[1], cap);
        Some((crossing, self.rotation * normal))
    }

    fn to_own_frame(&self, ray: &Ray) -> Ray {
        if !self.moved {
            return *ray;
        }
        Ray {
            origin: Point3::from(self.rotation.transpose() * (ray.origin.coords - self.shift)),
            direction: self.rotation.transpose() * ray.direction,
        }
    }

    /// Takes the crossing with a cap where it is the nearest.
    fn cross_caps(&self, ray: &Ray, start: &Departure, nearest: &mut Nearest) {
        for (piece, cap) in (self.walls.len() as u32..).zip(&self.caps) {
            if start.piece == Some(piece) {
                continue;
            }
            let origin = ray.origin.xy();
            let approach = ray.direction.z * cap.facing;
            let height = cap.z - ray.origin.z;
            let starts_on_it = start.front.is_some()
                && height.abs() <= self.extent.slack
                && self.holds(origin.into());
            if starts_on_it && !start.enters(approach) {
                continue;
            }
            let distance = if starts_on_it {
                0.0
            } else {
                height / ray.direction.z
            };
            let ahead = (starts_on_it || distance > 0.0) && distance < nearest.best.rank;
            if ahead && self.holds((origin + ray.direction.xy() * distance).into()) {
                let meeting = Intersection {
                    distance,
                    rank: distance,
                    front: approach < 0.0,
                    normal: [0.0; 2],
                };
                nearest.take(piece, &meeting);
                nearest.cap = cap.facing;
            }
        }
    }

    /// Whether the closed cross-section holds a point: it lies on the outline, or a ray from it
    /// leaves an odd number of times.
    fn holds(&self, point: [f64; 2]) -> bool {
        let mut walls = self.walls.iter();
        if walls.any(|wall| wall.lies_on(point, self.extent.slack)) {
            return true;
        }
        // No outline that anybody draws has a line in this direction.
        let direction = [0.827_132, 0.561_983];
        let crossings = self
            .walls
            .iter()
            .map(|wall| wall.crossings(point, direction));
        crossings.sum::<usize>() % 2 == 1
    }
}

/// The nearest crossing so far.
struct Nearest {
    best: Intersection,
    piece: Option<u32>,
    /// Component along z of the normal on the front; not 0 on a cap.
    cap: f64,
}

impl Nearest {
    /// None yet; only nearer ones than `limit` count.
    fn within(limit: f64) -> Self {
        Self {
            best: Intersection {
                distance: limit,
                rank: limit,
                front: true,
                normal: [0.0; 2],
            },
            piece: None,
            cap: 0.0,
        }
    }

    /// Takes a crossing if it is nearer.
    #[inline]
    fn take(&mut self, piece: u32, meeting: &Intersection) {
        if meeting.rank < self.best.rank {
            self.best = *meeting;
            self.piece = Some(piece);
        }
    }
}
