//! Rays in closed rooms: none leaks, none is stuck, none hits the spot that it left.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::AddAssign;

use nalgebra::{Point2, Point3, UnitQuaternion, Vector2, Vector3};
use peenpose::problem::part::{Ends, Part, Place, Segment, Shape};
use peenpose::scene::ray::{HitId, Ray};
use peenpose::scene::{Scene, Walls};
use rayon::prelude::*;

/// A closed room and an independent measure of how far outside it a point lies.
struct Room {
    name: String,
    scene: Scene,
    place: Place,
    outline: Outline,
}

enum Outline {
    Box { half: Vector3<f64> },
    Keyway(Keyway),
}

/// The cross-section of a keyway, with exact arcs or with their chords.
struct Keyway {
    length: f64,
    root: f64,
    /// None for exact arcs.
    chord_angle: Option<f64>,
}

const BORE: f64 = 15e-3;
const HALF: f64 = 4e-3;
const FLOOR: f64 = 18.3e-3;

fn lip() -> f64 {
    (BORE * BORE - HALF * HALF).sqrt()
}

/// How far a point lies outside an arc, or outside the chord that stands in for it there.
fn beyond_arc(
    point: Vector2<f64>,
    radius: f64,
    (start, sweep): (f64, f64),
    chord_angle: Option<f64>,
) -> f64 {
    let Some(chord_angle) = chord_angle else {
        return point.norm() - radius;
    };
    let chords = (sweep / chord_angle - 1e-9).ceil();
    let step = sweep / chords;
    let turned = (point.y.atan2(point.x) - start).rem_euclid(TAU);
    let chord = (turned / step).floor().clamp(0.0, chords - 1.0);
    let (sin, cos) = (start + (chord + 0.5) * step).sin_cos();
    point.dot(&Vector2::new(cos, sin)) - radius * (step / 2.0).cos()
}

impl Keyway {
    fn beyond(&self, p: &Point3<f64>) -> f64 {
        let start = lip().atan2(-HALF);
        let sweep = TAU - 2.0 * (start - FRAC_PI_2);
        let bore = beyond_arc(p.coords.xy(), BORE, (start, sweep), self.chord_angle);
        let mut groove = (p.x.abs() - HALF).max(lip() - p.y).max(p.y - FLOOR);
        let corner = Vector2::new(p.x.abs() - (HALF - self.root), p.y - (FLOOR - self.root));
        if self.root > 0.0 && corner.min() > 0.0 {
            let fillet = beyond_arc(corner, self.root, (0.0, FRAC_PI_2), self.chord_angle);
            groove = groove.max(fillet);
        }
        bore.max(p.y - lip())
            .min(groove)
            .max(-p.z)
            .max(p.z - self.length)
    }

    fn shape(&self, floor_pieces: usize) -> Shape {
        let lip = lip();
        let mut profile = Vec::new();
        let mut line = |from: (f64, f64), to: (f64, f64), surface: &str| {
            profile.push(Segment {
                from: Point2::new(from.0, from.1),
                to: Point2::new(to.0, to.1),
                via: None,
                surface: surface.into(),
            });
        };
        let (flat, shoulder) = (HALF - self.root, FLOOR - self.root);
        let at = |k: usize| flat - 2.0 * flat * k as f64 / floor_pieces as f64;
        for k in 0..floor_pieces {
            line((at(k), FLOOR), (at(k + 1), FLOOR), &format!("floor{k}"));
        }
        line((-HALF, shoulder), (-HALF, lip), "wall_neg");
        line((HALF, lip), (HALF, shoulder), "wall_pos");
        let arc = |from: (f64, f64), via: (f64, f64), to: (f64, f64), surface: &str| Segment {
            from: Point2::new(from.0, from.1),
            to: Point2::new(to.0, to.1),
            via: Some(Point2::new(via.0, via.1)),
            surface: surface.into(),
        };
        profile.insert(
            floor_pieces + 1,
            arc((-HALF, lip), (0.0, -BORE), (HALF, lip), "bore"),
        );
        if self.root > 0.0 {
            let diagonal = self.root * std::f64::consts::FRAC_1_SQRT_2;
            profile.insert(
                floor_pieces,
                arc(
                    (-flat, FLOOR),
                    (-flat - diagonal, shoulder + diagonal),
                    (-HALF, shoulder),
                    "root_neg",
                ),
            );
            profile.push(arc(
                (HALF, shoulder),
                (flat + diagonal, shoulder + diagonal),
                (flat, FLOOR),
                "root_pos",
            ));
        }
        Shape::Extrude {
            profile,
            length: self.length,
            ends: Ends {
                near_closed: true,
                far_closed: true,
            },
        }
    }
}

impl Room {
    fn new(name: &str, shape: Shape, outline: Outline, place: Place, walls: Walls) -> Self {
        let part = Part {
            name: "room".into(),
            shape,
            place,
            on_nozzle: false,
            cut: Vec::new(),
        };
        Self {
            name: name.into(),
            scene: Scene::build(&[part], walls).unwrap(),
            place,
            outline,
        }
    }

    fn keyway(name: &str, root: f64, floor_pieces: usize, place: Place, walls: Walls) -> Self {
        let keyway = Keyway {
            length: 40e-3,
            root,
            chord_angle: match walls {
                Walls::Exact => None,
                Walls::TriangleMesh { chord_angle } | Walls::Parry { chord_angle } => {
                    Some(chord_angle)
                }
            },
        };
        let shape = keyway.shape(floor_pieces);
        Self::new(name, shape, Outline::Keyway(keyway), place, walls)
    }

    fn block(name: &str, half: Vector3<f64>, place: Place) -> Self {
        let shape = Shape::Box {
            min: Point3::from(-half),
            max: Point3::from(half),
        };
        Self::new(name, shape, Outline::Box { half }, place, Walls::Exact)
    }

    /// How far `point` lies outside, m; negative inside.
    fn beyond(&self, point: &Point3<f64>) -> f64 {
        let local = self.place.rotation.inverse() * (point - self.place.shift);
        match &self.outline {
            Outline::Box { half } => (local.coords.abs() - half).max(),
            Outline::Keyway(keyway) => keyway.beyond(&local),
        }
    }

    fn slack(&self) -> f64 {
        1e-12 * self.scene.size()
    }

    /// A point inside, not on a wall.
    fn point(&self, random: &mut Random) -> Point3<f64> {
        loop {
            let size = self.scene.size();
            let within = |random: &mut Random| size * (2.0 * random.uniform() - 1.0);
            let point = Point3::new(within(random), within(random), within(random));
            if self.beyond(&point) < -1e-3 * size {
                return point;
            }
        }
    }

    /// Every vertex, and every midpoint of an edge, of the triangles.
    fn aims(&self) -> Vec<Point3<f64>> {
        let mut aims: Vec<Point3<f64>> = Vec::new();
        for surface in 0..self.scene.surfaces().len() as u32 {
            for [a, b, c] in self.scene.surface_triangles(surface) {
                aims.extend([a, b, c]);
                aims.extend([(a, b), (b, c), (c, a)].map(|(p, q)| nalgebra::center(&p, &q)));
            }
        }
        let key = |p: &Point3<f64>| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
        aims.sort_by_key(key);
        aims.dedup_by_key(|p| key(p));
        // All of a coarse mesh, a part of a fine one.
        let step = aims.len().div_ceil(MOST_AIMS);
        aims.into_iter().step_by(step).collect()
    }

    /// Follows one ray for some casts.
    fn follow(&self, start: Ray, casts: usize, rebounds: Rebounds, random: &mut Random) -> Count {
        let mut count = Count::default();
        let mut ray = start;
        let mut leaving: Option<HitId> = None;
        let mut still = 0;
        for _ in 0..casts {
            count.casts += 1;
            let Some(hit) = self.scene.first_hit(&ray, leaving) else {
                count.leaks += 1;
                count.note(format!("{}: leaks: {ray:?} leaving {leaving:?}", self.name));
                return count;
            };
            if self.beyond(&hit.point) > self.slack() {
                count.outside += 1;
                count.note(format!("{}: gets outside: {ray:?} {hit:?}", self.name));
                return count;
            }
            if hit.distance <= self.slack() {
                still += 1;
                // A shot that grazes a round wall meets it again soon, but not at once.
                let at_once = hit.distance <= f64::EPSILON * self.scene.size();
                if leaving == Some(hit.hit_id) && at_once {
                    count.self_hits += 1;
                    count.note(format!("{}: hits where it left: {ray:?}", self.name));
                }
                if still == MOST_HITS_IN_A_CORNER {
                    count.stuck += 1;
                    count.note(format!("{}: stuck: {ray:?}", self.name));
                    return count;
                }
            } else {
                still = 0;
            }
            let direction = match rebounds {
                Rebounds::Specular => {
                    let into = ray.direction.dot(&hit.normal);
                    (ray.direction - hit.normal * (2.0 * into)).normalize()
                }
                Rebounds::Random => random.off(&hit.normal),
                Rebounds::Grazing => random.grazing(&hit.normal),
            };
            ray = Ray {
                origin: hit.point,
                direction,
            };
            leaving = Some(hit.hit_id);
        }
        count
    }
}

const MOST_AIMS: usize = 1000;

/// A shot leaves a corner after a few hits; random directions may take somewhat more.
const MOST_HITS_IN_A_CORNER: usize = 100;

#[derive(Clone, Copy, Debug)]
enum Rebounds {
    Specular,
    /// Lambert's cosine law.
    Random,
    /// Anywhere along the wall, off it by 1e-11 to 1 rad.
    Grazing,
}

const REBOUNDS: [Rebounds; 3] = [Rebounds::Specular, Rebounds::Random, Rebounds::Grazing];

/// What happened to some rays.
#[derive(Debug, Default)]
struct Count {
    casts: u64,
    leaks: u64,
    outside: u64,
    self_hits: u64,
    stuck: u64,
    /// The first rays that went wrong.
    notes: Vec<String>,
}

impl Count {
    fn note(&mut self, note: String) {
        if self.notes.len() < 5 {
            self.notes.push(note);
        }
    }

    fn faults(&self) -> u64 {
        self.leaks + self.outside + self.self_hits + self.stuck
    }

    fn assert_tight(&self) {
        assert_eq!(self.faults(), 0, "{self:#?}");
    }
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.casts += other.casts;
        self.leaks += other.leaks;
        self.outside += other.outside;
        self.self_hits += other.self_hits;
        self.stuck += other.stuck;
        other.notes.into_iter().for_each(|note| self.note(note));
    }
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In 0 to 1.
    fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn direction(&mut self) -> Vector3<f64> {
        let z = 2.0 * self.uniform() - 1.0;
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * cos, across * sin, z)
    }

    /// A direction off a wall, by the cosine law.
    fn off(&mut self, normal: &Vector3<f64>) -> Vector3<f64> {
        loop {
            let direction = (normal + self.direction()).normalize();
            if direction.dot(normal) > 1e-12 {
                return direction;
            }
        }
    }

    fn grazing(&mut self, normal: &Vector3<f64>) -> Vector3<f64> {
        let along = normal.cross(&self.direction()).normalize();
        let off = 10.0_f64.powf(-11.0 * self.uniform());
        (along + normal * off).normalize()
    }
}

fn rooms() -> Vec<Room> {
    let facets = |degrees: f64| Walls::TriangleMesh {
        chord_angle: degrees.to_radians(),
    };
    let here = Place::default();
    let turned = Place {
        rotation: UnitQuaternion::from_euler_angles(0.7, -0.4, 2.1),
        shift: Vector3::new(0.011, -0.007, 0.023),
    };
    let exact = Walls::Exact;
    vec![
        Room::keyway("keyway, exact", 0.0, 1, here, exact),
        Room::keyway("keyway, 1 deg", 0.0, 1, here, facets(1.0)),
        Room::keyway("keyway, 0.2 deg", 0.0, 1, here, facets(0.2)),
        Room::keyway("keyway, 5 deg", 0.0, 1, here, facets(5.0)),
        Room::keyway("keyway, 30 deg", 0.0, 1, here, facets(30.0)),
        Room::keyway("keyway with roots, exact", 1e-3, 1, here, exact),
        Room::keyway("keyway with roots, 10 deg", 1e-3, 1, here, facets(10.0)),
        Room::keyway("keyway, floor in 3, exact", 0.0, 3, here, exact),
        Room::keyway("keyway, floor in 3, 5 deg", 0.0, 3, here, facets(5.0)),
        Room::keyway("turned keyway, exact", 0.0, 1, turned, exact),
        Room::keyway("turned keyway, 5 deg", 0.0, 1, turned, facets(5.0)),
        Room::keyway("turned, floor in 3, 5 deg", 0.0, 3, turned, facets(5.0)),
        Room::block("box", Vector3::new(0.02, 0.013, 0.007), here),
        // Binary fractions, so that rays meet its edges and corners to the last bit.
        Room::block("cube", Vector3::repeat(1.0 / 64.0), here),
        Room::block("turned box", Vector3::new(0.02, 0.013, 0.007), turned),
    ]
}

/// Random rays in one room; each batch has its own random numbers.
fn random_rays(room: &Room, casts: u64) -> Count {
    const CASTS_OF_A_RAY: usize = 25;
    const RAYS_OF_A_BATCH: u64 = 100;
    let batches = casts.div_ceil(RAYS_OF_A_BATCH * CASTS_OF_A_RAY as u64);
    let counts = (0..batches).into_par_iter().map(|batch| {
        let mut random = Random(batch.wrapping_mul(0x5851_F42D_4C95_7F2D));
        let mut count = Count::default();
        for ray in 0..RAYS_OF_A_BATCH {
            let start = Ray {
                origin: room.point(&mut random),
                direction: random.direction(),
            };
            let rebounds = [Rebounds::Specular, Rebounds::Random][ray as usize % 2];
            count += room.follow(start, CASTS_OF_A_RAY, rebounds, &mut random);
        }
        count
    });
    total(counts)
}

fn total(counts: impl ParallelIterator<Item = Count>) -> Count {
    counts.reduce(Count::default, |mut all, one| {
        all += one;
        all
    })
}

fn all_rooms(casts: u64) -> Count {
    let rooms = rooms();
    let mut all = Count::default();
    for room in &rooms {
        let count = random_rays(room, casts / rooms.len() as u64);
        println!(
            "{:28} {:>10} casts, {} faults",
            room.name,
            count.casts,
            count.faults()
        );
        all += count;
    }
    all
}

/// Otherwise the tests below would blame the rays.
#[test]
fn the_rooms_are_closed() {
    for room in rooms() {
        let key = |p: &Point3<f64>| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
        let mut edges = HashMap::new();
        for surface in 0..room.scene.surfaces().len() as u32 {
            for [a, b, c] in room.scene.surface_triangles(surface) {
                for (p, q) in [(a, b), (b, c), (c, a)] {
                    *edges.entry((key(&p), key(&q))).or_insert(0) += 1;
                    *edges.entry((key(&q), key(&p))).or_insert(0) -= 1;
                }
            }
        }
        let open = edges.values().filter(|&&count| count != 0).count();
        assert_eq!(open, 0, "{}", room.name);
    }
}

/// How many casts can be told by the environment:
/// `PEENPOSE_CASTS=1e8 cargo test --release --test geometry closed_mesh::random -- --nocapture`
#[test]
fn random_rays_stay_in_closed_rooms() {
    let casts = std::env::var("PEENPOSE_CASTS").map_or(1e6, |count| count.parse().unwrap());
    let count = all_rooms(casts as u64);
    assert!(count.casts as f64 >= casts, "{count:?}");
    count.assert_tight();
}

#[test]
fn rays_at_vertices_and_edges_stay() {
    let mut all = Count::default();
    for room in rooms() {
        let aims = room.aims();
        assert!(aims.len() >= 26, "{}: {} aims", room.name, aims.len());
        let counts = aims.par_iter().enumerate().map(|(index, aim)| {
            let mut random = Random(index as u64);
            let mut count = Count::default();
            for _ in 0..10 {
                let origin = room.point(&mut random);
                for rebounds in REBOUNDS {
                    let start = Ray {
                        origin,
                        direction: (aim - origin).normalize(),
                    };
                    count += room.follow(start, 5, rebounds, &mut random);
                }
            }
            count
        });
        let count = total(counts);
        println!(
            "{:28} {:>8} casts, {} faults",
            room.name,
            count.casts,
            count.faults()
        );
        all += count;
    }
    all.assert_tight();
}

#[test]
fn axis_parallel_rays_over_vertices_stay() {
    let mut all = Count::default();
    for room in rooms() {
        let counts = room.aims().into_par_iter().enumerate().map(|(index, aim)| {
            let mut random = Random(index as u64);
            let mut count = Count::default();
            let inside = room.point(&mut random);
            // Every choice of coordinates shared with the vertex, except all and none.
            for shared in 1..7 {
                let mut origin = inside;
                for axis in (0..3).filter(|axis| shared >> axis & 1 == 1) {
                    origin[axis] = aim[axis];
                }
                if room.beyond(&origin) >= -1e-3 * room.scene.size() {
                    continue;
                }
                for axis in 0..3 {
                    for sign in [-1.0, 1.0] {
                        for rebounds in REBOUNDS {
                            let mut direction = Vector3::zeros();
                            direction[axis] = sign;
                            let start = Ray { origin, direction };
                            count += room.follow(start, 5, rebounds, &mut random);
                        }
                    }
                }
            }
            count
        });
        let count = total(counts);
        println!(
            "{:28} {:>8} casts, {} faults",
            room.name,
            count.casts,
            count.faults()
        );
        all += count;
    }
    assert!(all.casts > 100_000);
    all.assert_tight();
}

#[test]
fn rays_in_planes_of_symmetry_stay() {
    let mut all = Count::default();
    for room in rooms() {
        let mut random = Random(7);
        let mut count = Count::default();
        let (middle, normals) = match room.outline {
            Outline::Box { .. } => (
                Point3::origin(),
                vec![Vector3::x(), Vector3::y(), Vector3::z()],
            ),
            Outline::Keyway(ref keyway) => (
                Point3::new(0.0, 0.0, keyway.length / 2.0),
                vec![Vector3::x(), Vector3::z()],
            ),
        };
        for normal in normals {
            for step in 0..720 {
                // Every half degree, the axes and the diagonals among them.
                let (sin, cos) = (f64::from(step) * PI / 360.0).sin_cos();
                let across = if normal.z == 1.0 {
                    Vector3::y()
                } else {
                    Vector3::z()
                };
                let direction = across * cos + across.cross(&normal) * sin;
                let start = Ray {
                    origin: room.place.rotation * middle + room.place.shift,
                    direction: room.place.rotation * direction,
                };
                for rebounds in REBOUNDS {
                    count += room.follow(start, 20, rebounds, &mut random);
                }
            }
        }
        println!(
            "{:28} {:>8} casts, {} faults",
            room.name,
            count.casts,
            count.faults()
        );
        all += count;
    }
    all.assert_tight();
}

/// Straight into edges of two planes and corners of three, hit to the last bit, and back.
#[test]
fn rays_into_exact_corners_come_back() {
    let rooms = rooms();
    let cube = rooms.iter().find(|room| room.name == "cube").unwrap();
    let signs = [-1.0, 0.0, 1.0];
    let mut random = Random(3);
    let mut all = Count::default();
    for (x, y, z) in signs
        .into_iter()
        .flat_map(|x| signs.map(|y| (x, y)))
        .flat_map(|(x, y)| signs.map(|z| (x, y, z)))
    {
        let direction = Vector3::new(x, y, z);
        if direction.norm() == 0.0 {
            continue;
        }
        let walls = direction.abs().sum() as usize;
        let start = Ray {
            origin: Point3::origin(),
            direction: direction.normalize(),
        };
        for rebounds in REBOUNDS {
            all += cube.follow(start, 50, rebounds, &mut random);
        }
        // One hit on each wall of the corner, in one place, then back the same way.
        let (mut ray, mut leaving) = (start, None);
        for hit_number in 0..walls {
            let hit = cube.scene.first_hit(&ray, leaving).unwrap();
            assert_eq!(hit.distance == 0.0, hit_number > 0, "{direction:?} {hit:?}");
            let into = ray.direction.dot(&hit.normal);
            ray = Ray {
                origin: hit.point,
                direction: ray.direction - hit.normal * (2.0 * into),
            };
            leaving = Some(hit.hit_id);
        }
        assert!(
            (ray.direction + start.direction).norm() < 1e-15,
            "{direction:?}"
        );
    }
    all.assert_tight();
}
