//! Rays against prismatic parts, exact: the walls are planes and cylinders, not facets.

use nalgebra::{Point2, Point3, Rotation3, Vector2, Vector3};

use super::form::Form;
use super::profile::Profile;
use super::ray::{Crossing, Ray, Spot};
use super::start::Start;
use crate::problem::part::{Ends, Place};

/// A cross-section drawn along z from 0 to a length, somewhere in the scene.
#[derive(Clone, Debug)]
pub struct Prism {
    walls: Vec<Wall>,
    caps: Vec<Cap>,
    length: f64,
    slack: f64,
    rotation: Rotation3<f64>,
    shift: Vector3<f64>,
    moved: bool,
}

#[derive(Clone, Copy, Debug)]
struct Wall {
    form: Form,
    surface: u32,
}

#[derive(Clone, Copy, Debug)]
struct Cap {
    z: f64,
    /// Component of the normal on the front along z.
    facing: f64,
    surface: u32,
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
        let walls = profile
            .pieces
            .iter()
            .map(|piece| Wall {
                form: Form::of(&piece.curve),
                surface: surface_base + piece.surface,
            })
            .collect();
        let mut next_surface = surface_base + profile.surfaces.len() as u32;
        let mut caps = Vec::new();
        for (closed, z, facing) in [
            (ends.near_closed, 0.0, 1.0),
            (ends.far_closed, length, -1.0),
        ] {
            if closed {
                caps.push(Cap {
                    z,
                    facing,
                    surface: next_surface,
                });
                next_surface += 1;
            }
        }
        Self {
            walls,
            caps,
            length,
            slack,
            rotation: place.rotation.to_rotation_matrix(),
            shift: place.shift,
            moved: *place != Place::default(),
        }
    }

    /// The first crossing of a ray nearer than `limit`, and the front normal there.
    ///
    /// `leaving` is the spot that the ray starts from when it lies on this part.
    pub fn first_crossing(
        &self,
        ray: &Ray,
        leaving: Option<Spot>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let local = self.to_own_frame(ray);
        let start = Start {
            piece: leaving.filter(|_| on_this_part).map(|spot| spot.piece),
            front: leaving.map(|spot| spot.front),
        };
        let mut nearest = Nearest {
            reach: limit,
            found: None,
        };
        for (index, wall) in self.walls.iter().enumerate() {
            self.cross_wall(index as u32, wall, &local, &start, &mut nearest);
        }
        for (index, cap) in self.caps.iter().enumerate() {
            let piece = (self.walls.len() + index) as u32;
            self.cross_cap(piece, cap, &local, &start, &mut nearest);
        }
        let (crossing, normal) = nearest.found?;
        Some((crossing, self.rotation * normal))
    }

    fn to_own_frame(&self, ray: &Ray) -> Ray {
        if !self.moved {
            return *ray;
        }
        let back = self.rotation.inverse();
        Ray {
            origin: Point3::from(back * (ray.origin.coords - self.shift)),
            direction: back * ray.direction,
        }
    }

    /// Takes the crossing with a wall if it is the nearest.
    #[inline]
    fn cross_wall(&self, piece: u32, wall: &Wall, ray: &Ray, start: &Start, nearest: &mut Nearest) {
        let (origin, direction) = (ray.origin.xy(), ray.direction.xy());
        let surface = wall.surface;
        let mut on_it = start.piece == Some(piece);
        if !on_it && start.front.is_some() && self.lies_on(wall, &ray.origin) {
            let front = wall.form.front(&origin);
            let approach = direction.dot(&front);
            if start.enters(approach) {
                nearest.take(0.0, 0.0, approach, flat(front), piece, surface);
                return;
            }
            on_it = true;
        }
        for t in wall.form.roots(&origin, &direction, on_it) {
            // NaN, for no crossing, is neither ahead nor nearer.
            let counts = t > 0.0 && t < nearest.reach;
            if !counts {
                continue;
            }
            let z = ray.origin.z + t * ray.direction.z;
            let point = origin + direction * t;
            let spans = |slack: f64| {
                z >= -slack && z <= self.length + slack && wall.form.spans(&point, slack)
            };
            if !spans(self.slack) {
                continue;
            }
            let front = wall.form.front(&point);
            let approach = direction.dot(&front);
            let is_seen = start.sees(approach < 0.0);
            // Seen from behind, it ends exactly where it ends, and yields to one seen at an edge.
            if is_seen || spans(0.0) {
                let farther = if is_seen { 0.0 } else { self.slack };
                nearest.take(t, farther, approach, flat(front), piece, surface);
            }
        }
    }

    /// Takes the crossing with a cap if it is the nearest.
    fn cross_cap(&self, piece: u32, cap: &Cap, ray: &Ray, start: &Start, nearest: &mut Nearest) {
        if start.piece == Some(piece) {
            return;
        }
        let origin = ray.origin.xy();
        let approach = ray.direction.z * cap.facing;
        let height = cap.z - ray.origin.z;
        let starts_on_it =
            start.front.is_some() && height.abs() <= self.slack && self.holds(origin);
        let t = if !starts_on_it {
            height / ray.direction.z
        } else if start.enters(approach) {
            0.0
        } else {
            return;
        };
        let counts = (starts_on_it || t > 0.0) && t < nearest.reach;
        if counts && self.holds(origin + ray.direction.xy() * t) {
            let normal = Vector3::new(0.0, 0.0, cap.facing);
            nearest.take(t, 0.0, approach, normal, piece, cap.surface);
        }
    }

    /// Whether a point counts as one of the wall.
    fn lies_on(&self, wall: &Wall, point: &Point3<f64>) -> bool {
        let within = -self.slack..=self.length + self.slack;
        wall.form.lies_on(&point.xy(), self.slack) && within.contains(&point.z)
    }

    /// Whether the closed cross-section holds a point: it lies on the outline, or a ray from it
    /// leaves an odd number of times.
    fn holds(&self, point: Point2<f64>) -> bool {
        let mut walls = self.walls.iter();
        if walls.any(|wall| wall.form.lies_on(&point, self.slack)) {
            return true;
        }
        // No outline that anybody draws has a line in this direction.
        let direction = Vector2::new(0.827_132, 0.561_983);
        let crossings = self.walls.iter().flat_map(|wall| {
            let roots = wall.form.roots(&point, &direction, false);
            roots
                .into_iter()
                .filter(move |&t| t > 0.0 && wall.form.spans(&(point + direction * t), 0.0))
        });
        crossings.count() % 2 == 1
    }
}

/// The nearest crossing so far, with the normal on the front there.
struct Nearest {
    /// Only nearer crossings are taken.
    reach: f64,
    found: Option<(Crossing, Vector3<f64>)>,
}

impl Nearest {
    /// Takes a crossing if it is nearer, counted as `farther` away than it is.
    #[inline]
    fn take(
        &mut self,
        distance: f64,
        farther: f64,
        approach: f64,
        front_normal: Vector3<f64>,
        piece: u32,
        surface: u32,
    ) {
        if distance + farther >= self.reach {
            return;
        }
        self.reach = distance + farther;
        let crossing = Crossing {
            distance,
            front: approach < 0.0,
            piece,
            surface,
        };
        self.found = Some((crossing, front_normal));
    }
}

/// A direction of the cross-section in space.
#[inline]
fn flat(direction: Vector2<f64>) -> Vector3<f64> {
    Vector3::new(direction.x, direction.y, 0.0)
}
