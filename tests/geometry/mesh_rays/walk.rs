//! Shots that fly about in a closed mesh, and what must not happen to them.

use std::ops::AddAssign;

use nalgebra::{Point3, Vector3};
use peenpose::impact::{Contact, rebound};
use peenpose::problem::equipment::{Body, Nozzle};
use peenpose::scene::ray::{Hit, Ray};

use crate::mesh_rays::random::Random;
use crate::mesh_rays::rooms::Room;

/// What happened to some shots.
#[derive(Debug, Default)]
pub struct Count {
    pub casts: u64,
    pub of_spheres: u64,
    /// Rays that hit nothing or the outer side; spheres that sink into walls or get behind them.
    pub leaks: u64,
    /// Hits where the shot left, or on the plane that it left, before it could have come back.
    pub self_hits: u64,
    pub stuck: u64,
    /// The first that went wrong.
    pub notes: Vec<String>,
}

impl Count {
    fn note(&mut self, note: String) {
        if self.notes.len() < 5 {
            self.notes.push(note);
        }
    }

    pub fn faults(&self) -> u64 {
        self.leaks + self.self_hits + self.stuck
    }
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.casts += other.casts;
        self.of_spheres += other.of_spheres;
        self.leaks += other.leaks;
        self.self_hits += other.self_hits;
        self.stuck += other.stuck;
        other.notes.into_iter().for_each(|note| self.note(note));
    }
}

/// How shots leave what they hit.
#[derive(Clone, Copy, Debug)]
enum Rebounds {
    Mirrored,
    Diffuse,
    Grazing,
    /// By the law of impact, with friction and spin.
    Impact,
}

const REBOUNDS: [Rebounds; 4] = [
    Rebounds::Mirrored,
    Rebounds::Diffuse,
    Rebounds::Grazing,
    Rebounds::Impact,
];

/// How many slacks spheres may sink into walls: one for rounding, and what they sink on a flight
/// along a wall that is too flat to count as heading in, 1e-12 of its length.
const SINKS: f64 = 4.0;

/// Rays that rise from a facet by no more than this angle run along it.
const ALONG: f64 = 1e-12;

/// Casts before the next aim.
const CASTS_OF_A_PATH: usize = 20;
/// In a wedge of 1 deg a mirrored shot hits 180 times before it comes out; out of the tip of a spike,
/// one random direction among many thousands leads.
const MOST_HITS_IN_A_CORNER: usize = 1_000_000;
/// Shots that lose speed with every impact rest below this share of it: in the tip of a spike they may
/// hit its sides in turn for ever.
const RESTS: f64 = 1e-6;

/// One shot after another in a room, each from where the one before has been.
pub struct Walk<'a> {
    room: &'a Room,
    random: Random,
    radius: f64,
    slack: f64,
    contact: Contact,
    /// The centre of the shot, as a nozzle would have it: distances are asked for with it.
    shot: Nozzle,
    /// The triangle last aimed at.
    aimed_at: usize,
    pub count: Count,
}

/// Where a shot sets out: in flight, or from a hit.
struct Start {
    at: Point3<f64>,
    left: Option<Hit>,
}

impl<'a> Walk<'a> {
    pub fn new(room: &'a Room, seed: u64, radius: f64) -> Self {
        Self {
            room,
            random: Random(seed),
            radius,
            slack: 1e-12 * room.scene.size(),
            contact: Contact::new(0.3, 0.27, 0.5).unwrap(),
            shot: Nozzle {
                body: vec![Body::Ball { radius }],
                clearance: 0.0,
            },
            aimed_at: 0,
            count: Count::default(),
        }
    }

    /// Follows shots until there have been so many casts.
    pub fn run(&mut self, casts: u64) {
        let inside = self.room.inside;
        let validation = || Start {
            at: inside,
            left: None,
        };
        let mut start = validation();
        while self.count.casts < casts {
            let direction = self.aim(&start);
            let rebounds = *self.random.of(&REBOUNDS);
            start = self
                .follow(start, direction, rebounds)
                .unwrap_or_else(validation);
        }
    }

    /// A direction to set out in: at vertices, edges and close to them, along planes and axes, and
    /// anywhere. From beside an edge often at what is next to it, so that shots graze that.
    fn aim(&mut self, start: &Start) -> Vector3<f64> {
        let triangles = &self.room.triangles;
        self.aimed_at = if self.random.bits().is_multiple_of(4) {
            let corner = self.random.of(&triangles[self.aimed_at]);
            *self.random.of(self.room.round(corner))
        } else {
            self.random.bits() as usize % triangles.len()
        };
        let [a, b, c] = triangles[self.aimed_at];
        let (share, other) = (self.random.uniform(), self.random.uniform());
        let towards = match self.random.bits() % 9 {
            0 => a - start.at,
            1 => a + (b - a) * share - start.at,
            2 => nalgebra::center(&a, &b) - start.at,
            3 => (b - a) * (2.0 * share - 1.0) + (c - a) * (other - 0.5),
            4 => b - a,
            5 => Vector3::ith((self.random.bits() % 3) as usize, share - 0.5),
            6 => a + (b - a + (c - a) * share) * (other / 2.0) - start.at,
            7 => a + (b - a) * share + (c - a) * 10_f64.powf(-3.0 - 10.0 * other) - start.at,
            _ => self.random.direction(),
        };
        let towards = towards.try_normalize(0.0);
        let towards = towards.unwrap_or_else(|| self.random.direction());
        match &start.left {
            Some(left) if towards.dot(&left.normal) <= ALONG => self.random.off(&left.normal),
            _ => towards,
        }
    }

    /// Follows one shot; gives the start of the next one, unless this one went wrong or came to rest.
    fn follow(
        &mut self,
        start: Start,
        direction: Vector3<f64>,
        rebounds: Rebounds,
    ) -> Option<Start> {
        let Start { at, mut left } = start;
        let mut ray = Ray {
            origin: at,
            direction,
        };
        let (mut velocity, mut rolling) = (direction, Vector3::zeros());
        let mut still = 0;
        for cast in 0.. {
            self.count.casts += 1;
            self.count.of_spheres += u64::from(self.radius > 0.0);
            let leaving = left.map(|hit| hit.hit_id);
            let found = if self.radius > 0.0 {
                self.room.scene.first_touch(&ray, self.radius, leaving)
            } else {
                self.room.scene.first_hit(&ray, leaving)
            };
            let fault = self.fault(&ray, left.as_ref(), found.as_ref());
            let hit = found.filter(|_| !fault)?;
            still = if hit.distance <= self.slack {
                still + 1
            } else {
                0
            };
            if still == MOST_HITS_IN_A_CORNER {
                self.count.stuck += 1;
                self.note("stuck", &ray, left.as_ref(), Some(&hit));
                return None;
            }
            let centre = hit.point + hit.normal * self.radius;
            if cast >= CASTS_OF_A_PATH && still == 0 {
                return Some(self.start_again(&ray, hit, centre));
            }
            (velocity, rolling) = self.leave(&ray, &hit, rebounds, (velocity, rolling));
            if velocity.norm() < RESTS {
                return None;
            }
            ray = Ray {
                origin: centre,
                direction: velocity.normalize(),
            };
            left = Some(hit);
        }
        unreachable!("shots come out of corners or get stuck there")
    }

    /// In the middle of a long flight, or at its end. In the middle, next to no wall: of a start nearer than
    /// rounding, nobody knows the side.
    fn start_again(&mut self, ray: &Ray, hit: Hit, centre: Point3<f64>) -> Start {
        let is_long = hit.distance > 1e3 * self.slack;
        if is_long && self.random.bits().is_multiple_of(2) {
            let share = 0.1 + 0.8 * self.random.uniform();
            let at = ray.origin + ray.direction * (hit.distance * share);
            let scene = &self.room.scene;
            let wall = scene.clearance(&self.shot, &at, &Vector3::x(), self.slack);
            if wall.is_none() {
                return Start { at, left: None };
            }
        }
        Start {
            at: centre,
            left: Some(hit),
        }
    }

    fn leave(
        &mut self,
        ray: &Ray,
        hit: &Hit,
        rebounds: Rebounds,
        (velocity, rolling): (Vector3<f64>, Vector3<f64>),
    ) -> (Vector3<f64>, Vector3<f64>) {
        let still = Vector3::zeros();
        match rebounds {
            Rebounds::Mirrored => {
                let into = ray.direction.dot(&hit.normal);
                (ray.direction - hit.normal * (2.0 * into), still)
            }
            Rebounds::Diffuse => (self.random.off(&hit.normal), still),
            Rebounds::Grazing => (self.random.grazing(&hit.normal), still),
            Rebounds::Impact => {
                let after = rebound(&self.contact, &velocity, &rolling, &hit.normal);
                after.map_or((velocity, rolling), |after| (after.velocity, after.rolling))
            }
        }
    }

    /// Whether this cast went wrong; counts what did.
    fn fault(&mut self, ray: &Ray, left: Option<&Hit>, found: Option<&Hit>) -> bool {
        let Some(hit) = found else {
            self.count.leaks += 1;
            self.note("leaks", ray, left, found);
            return true;
        };
        let at_once = left.is_some() && hit.distance <= self.slack;
        if at_once && left.is_some_and(|left| self.hits_again(left, hit)) {
            self.count.self_hits += 1;
            self.note("hits what it left", ray, left, found);
            return true;
        }
        let outside = if self.radius > 0.0 {
            self.sphere_is_outside(hit)
        } else {
            !self.room.shows(&hit.hit_id)
        };
        if outside || ray.direction.dot(&hit.normal) > ALONG {
            self.count.leaks += 1;
            self.note("gets outside", ray, left, found);
            return true;
        }
        false
    }

    /// Whether a sphere reaches further into a wall than the slack, or its centre is outside.
    fn sphere_is_outside(&mut self, hit: &Hit) -> bool {
        let centre = hit.point + hit.normal * self.radius;
        let scene = &self.room.scene;
        let deep = -SINKS * self.slack;
        let overlap = scene.clearance(&self.shot, &centre, &Vector3::x(), deep);
        if overlap.is_some() {
            return true;
        }
        let look = Ray {
            origin: centre,
            direction: self.random.direction(),
        };
        self.count.casts += 1;
        let seen = scene.first_hit(&look, None);
        seen.is_none_or(|seen| !self.room.shows(&seen.hit_id))
    }

    fn note(&mut self, what: &str, ray: &Ray, left: Option<&Hit>, found: Option<&Hit>) {
        let (name, radius) = (self.room.name, self.radius);
        let gap = found.and_then(|hit| {
            let centre = hit.point + hit.normal * radius;
            let scene = &self.room.scene;
            scene.clearance(&self.shot, &centre, &Vector3::x(), scene.size())
        });
        self.count.note(format!(
            "{name}, radius {radius:e}, slack {:e}: {what}: {ray:?}\n left {left:?}\n found {found:?}, \
             gap {gap:?}",
            self.slack
        ));
    }

    /// Whether a hit is where the shot left, or from behind on its plane. A sphere may leave the edge of
    /// a piece and hit its face.
    fn hits_again(&self, left: &Hit, hit: &Hit) -> bool {
        let turned = (left.normal - hit.normal).norm() * self.radius;
        let same_place = left.hit_id == hit.hit_id && turned <= 1e-3 * self.slack;
        same_place || (left.normal + hit.normal).norm() < 1e-6
    }
}
