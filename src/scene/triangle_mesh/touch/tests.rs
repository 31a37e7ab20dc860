//! What the tree and the closed forms find is what a look at every triangle finds that follows the
//! distance to it by Newton's method.

mod edges;
mod rebounds;
mod search;
mod swept_triangles;

use std::f64::consts::TAU;
use std::hint;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use nalgebra::{Point3, Vector3};

use super::super::tests::{Random, heap, ray, room};
use crate::problem::part::Ends;
use crate::scene::mesh::{Mesh, Triangle};
use crate::scene::profile::Profile;
use crate::scene::ray::{Crossing, HitId, Ray};
use crate::scene::tessellate;
use crate::scene::triangle_mesh::TriangleMesh;
use search::Search;

type Found = Option<(Crossing, Vector3<f64>)>;

fn size(mesh: &Mesh) -> f64 {
    let corners = mesh.vertices.iter().map(|vertex| vertex.coords.amax());
    corners.fold(0.0, f64::max)
}

fn facets(mesh: &Mesh) -> TriangleMesh {
    TriangleMesh::new(mesh.clone(), 0, 1e-12 * size(mesh))
}

fn hit_id(crossing: &Crossing) -> HitId {
    HitId {
        part: 0,
        piece: crossing.piece,
        front: crossing.front,
    }
}

fn mirrored(direction: &Vector3<f64>, normal: &Vector3<f64>) -> Vector3<f64> {
    (direction - normal * (2.0 * direction.dot(normal))).normalize()
}

/// Follows spheres over a few rebounds; returns how often they touched.
fn compare(mesh: &Mesh, radius: f64, count: usize, random: &mut Random) -> usize {
    let size = size(mesh);
    let comparison = Comparison::of(mesh, radius);
    let mut touches = 0;
    for _ in 0..count {
        touches += comparison.follow(ray(mesh, size, random), random);
    }
    touches
}

/// A mesh and the search through all its triangles.
struct Comparison<'a> {
    facets: TriangleMesh,
    search: Search<'a>,
}

impl<'a> Comparison<'a> {
    fn of(mesh: &'a Mesh, radius: f64) -> Self {
        Self {
            facets: facets(mesh),
            search: Search {
                mesh,
                radius,
                slack: 1e-12 * size(mesh),
            },
        }
    }

    /// Follows a sphere over a few rebounds; returns how often it touched.
    fn follow(&self, mut ray: Ray, random: &mut Random) -> usize {
        let Self { facets, search } = self;
        let mut leaving = None;
        if search.nearest(&ray.origin) < 1e3 * search.slack {
            // A centre on a triangle is on neither side of it.
            return 0;
        }
        for touches in 0..4 {
            let found = facets.first_touch(&ray, search.radius, leaving, true, f64::INFINITY);
            search.check(&ray, leaving, found);
            let Some((crossing, normal)) = found else {
                return touches;
            };
            let limit = crossing.distance;
            let within = facets.first_touch(&ray, search.radius, leaving, true, limit);
            assert!(within.is_none_or(|(nearer, _)| nearer.distance < limit));
            ray = Ray {
                origin: ray.origin + ray.direction * crossing.distance,
                direction: match random.bits() % 3 {
                    0 => (normal + random.direction()).normalize(),
                    1 => (normal * 1e-3 + normal.cross(&random.direction())).normalize(),
                    _ => mirrored(&ray.direction, &normal),
                },
            };
            leaving = Some(hit_id(&crossing));
        }
        4
    }
}

#[test]
fn spheres_in_a_closed_room_touch_what_a_search_finds() {
    let mut random = Random(11);
    for (chord_angle, radius) in [(0.8, 0.15), (0.1, 0.05), (0.02, 0.25), (0.1, 0.45)] {
        let touches = compare(&room(chord_angle), radius, 300, &mut random);
        assert!(touches > 200, "{radius}: {touches}");
    }
    let block = tessellate::block(Point3::new(-1.0, -0.5, -0.25), Point3::new(1.0, 0.5, 0.25));
    for radius in [1e-3, 0.2, 3.0] {
        assert!(compare(&block, radius, 1000, &mut random) > 800);
    }
}

#[test]
fn spheres_in_a_heap_touch_what_a_search_finds() {
    let mut random = Random(12);
    for count in [1, 2, 5, 33, 400] {
        for radius in [1e-4, 0.05, 2.0] {
            let touches = compare(&heap(count, &mut random), radius, 300, &mut random);
            assert!(touches > 50, "{count}: {touches}");
        }
    }
}

#[test]
fn slivers_are_touched() {
    let mut random = Random(13);
    for width in [1e-3, 1e-6, 1e-9, 1e-13] {
        let mut mesh = Mesh::default();
        for index in 0..60 {
            let (from, along) = (random.vector(), random.direction());
            let aside = along.cross(&random.direction()).normalize() * width;
            let share = [0.0, 0.5, 1.0][index as usize % 3];
            let tip = from + along * share + aside;
            mesh.vertices
                .extend([from, from + along, tip].map(Point3::from));
            let corners = [3 * index, 3 * index + 1, 3 * index + 2];
            mesh.triangles.push(Triangle {
                corners,
                surface: 0,
            });
        }
        assert!(compare(&mesh, 0.1, 500, &mut random) > 200);
    }
}

/// Needles from a tip to a circle, with others to a second tip in place of a bottom.
fn double_cone(needles: u32, [above, below]: [f64; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    for needle in 0..needles {
        let angle = TAU * f64::from(needle) / f64::from(needles);
        mesh.vertices
            .push(Point3::new(angle.cos(), angle.sin(), 0.0));
        let next = (needle + 1) % needles;
        for corners in [[needles, needle, next], [needles + 1, next, needle]] {
            let surface = 0;
            mesh.triangles.push(Triangle { corners, surface });
        }
    }
    let tips = [above, below].map(|height| Point3::new(0.0, 0.0, height));
    mesh.vertices.extend(tips);
    mesh
}

/// Spheres on the tip of a cone, where they touch all its triangles, and near it.
#[test]
fn tips_of_cones_are_touched() {
    let mut random = Random(18);
    for (tips, radius) in [
        ([0.5, -0.2], 0.1),
        ([2.0, 0.5], 0.05),
        ([0.01, 0.0], 0.3),
        ([0.0, -1.0], 0.02),
    ] {
        let mesh = double_cone(200, tips);
        let comparison = Comparison::of(&mesh, radius);
        let mut touches = 0;
        for shot in 0..600 {
            let tip = Point3::new(0.0, 0.0, tips[shot % 2]);
            let direction = random.direction();
            let beside = random.vector() * radius * *random.of(&[0.0, 1e-6, 1e-3, 1.0]);
            let ray = Ray {
                origin: tip + beside - direction * *random.of(&[1.01 * radius, 3.0]),
                direction,
            };
            touches += comparison.follow(ray, &mut random);
        }
        assert!(touches > 600, "{tips:?}: {touches}");
    }
}

#[test]
fn size_and_place_of_a_mesh_do_not_matter_to_spheres() {
    let mut random = Random(14);
    for scale in [1e-9, 1e-3, 1e6] {
        for shift in [0.0, 100.0] {
            let mut mesh = room(0.1);
            for vertex in &mut mesh.vertices {
                *vertex = (*vertex + Vector3::repeat(shift)) * scale;
            }
            assert!(compare(&mesh, 0.2 * scale, 100, &mut random) > 50);
        }
    }
}

/// The distance to a block from outside, by its closed form.
#[test]
fn a_block_is_touched_where_the_rounded_block_begins() {
    let mut random = Random(15);
    let half = Vector3::new(1.0, 0.5, 0.25);
    let facets = facets(&tessellate::block(Point3::from(-half), Point3::from(half)));
    let radius = 0.3;
    let outside = |point: &Point3<f64>| (point.coords.abs() - half).map(|x| x.max(0.0)).norm();
    let mut touches = 0;
    for _ in 0..3000 {
        let direction = random.direction();
        let origin = Point3::from(random.vector() * 1.2 - direction * 4.0);
        let ray = Ray { origin, direction };
        // Golden section for the nearest approach, then bisection.
        let at = |t: f64| outside(&(origin + direction * t));
        let (mut low, mut high) = (0.0, 8.0);
        for _ in 0..200 {
            let (a, b) = (low + (high - low) * 0.382, low + (high - low) * 0.618);
            if at(a) < at(b) { high = b } else { low = a }
        }
        let nearest = low;
        let found = facets.first_touch(&ray, radius, None, false, f64::INFINITY);
        if (at(nearest) - radius).abs() < 1e-9 {
            continue;
        }
        assert_eq!(found.is_some(), at(nearest) < radius);
        let Some((crossing, normal)) = found else {
            continue;
        };
        let (mut low, mut high) = (0.0, nearest);
        for _ in 0..100 {
            let middle = f64::midpoint(low, high);
            if at(middle) > radius {
                low = middle
            } else {
                high = middle
            }
        }
        let sinking = -direction.dot(&normal);
        assert!((crossing.distance - high).abs() * sinking < 1e-13);
        let centre = origin + direction * crossing.distance;
        let nearest = centre.coords.sup(&-half).inf(&half);
        assert!((centre.coords - normal * radius - nearest).norm() < 1e-12);
        assert!(crossing.front, "the fronts of a block are outside");
        touches += 1;
    }
    assert!(touches > 500, "{touches}");
}

/// Spheres in a bore are points in one that is narrower by their radius.
#[test]
fn a_bore_of_facets_is_touched_from_inside_where_a_narrower_bore_is_crossed() {
    let mut random = Random(16);
    let sides = 48;
    let turn = TAU / f64::from(sides);
    let ends = Ends {
        near_closed: true,
        far_closed: true,
    };
    let facets = facets(&tessellate::prism(&Profile::circle(2.0), 3.0, ends, turn));
    let (radius, apothem) = (0.4, (turn / 2.0).cos());
    let mut ray = Ray {
        origin: Point3::new(0.1, -0.2, 1.5),
        direction: random.direction(),
    };
    let mut leaving = None;
    for _ in 0..5000 {
        let (origin, direction) = (ray.origin, ray.direction);
        let walls = (0..sides).map(|side| {
            let angle = (f64::from(side) + 0.5) * turn;
            (Vector3::new(angle.cos(), angle.sin(), 0.0), apothem)
        });
        let caps = [(Vector3::z(), 3.0), (-Vector3::z(), 0.0)];
        let (distance, outwards) = walls
            .chain(caps)
            .filter(|(outwards, _)| direction.dot(outwards) > 1e-9)
            .map(|(outwards, height)| {
                let gap = height - radius - origin.coords.dot(&outwards);
                (gap / direction.dot(&outwards), outwards)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap();
        let (crossing, normal) = facets
            .first_touch(&ray, radius, leaving, true, f64::INFINITY)
            .unwrap();
        assert!((crossing.distance - distance).abs() < 1e-9, "{ray:?}");
        if (normal + outwards).norm() > 1e-9 {
            // Two walls at once.
            let other = normal + outwards;
            assert!(other.norm() < 1.5 * turn || normal.z.abs() != outwards.z.abs());
        }
        ray = Ray {
            origin: origin + direction * crossing.distance,
            direction: (normal + random.direction() * 0.95).normalize(),
        };
        leaving = Some(hit_id(&crossing));
    }
}

#[test]
fn small_spheres_touch_what_points_cross() {
    let mut random = Random(17);
    let mesh = room(0.1);
    let facets = facets(&mesh);
    for radius in [1e-5, 1e-8, 1e-11, 0.0] {
        let mut crossings = 0;
        for _ in 0..500 {
            let ray = Ray {
                origin: Point3::from(random.vector() * 0.25 + Vector3::z() * 0.75),
                direction: random.direction(),
            };
            let (point, front) = facets
                .first_crossing(&ray, None, false, f64::INFINITY)
                .unwrap();
            let (sphere, _) = facets
                .first_touch(&ray, radius, None, false, f64::INFINITY)
                .unwrap();
            let sinking = ray.direction.dot(&front).abs();
            let nearer = point.distance - sphere.distance;
            // By an edge it is the other wall's angle.
            assert!(nearer >= -1e-11 && nearer < 3.0 * radius / (sinking - 0.1).max(1e-3) + 1e-11);
            crossings += usize::from(point.piece == sphere.piece);
        }
        assert!(crossings > 400, "{crossings}");
    }
}

/// What is made for the first sphere is made behind a lock. Were its making shared out to the pool,
/// the thread that holds the lock could take up another sphere while it waits for the others.
#[test]
fn who_prepares_a_mesh_takes_no_other_work() {
    let (done, wait) = mpsc::channel();
    thread::spawn(move || {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
        pool.unwrap()
            .install(|| (0..60).for_each(|_| meet_in_a_mesh()));
        done.send(()).unwrap();
    });
    assert_eq!(wait.recv_timeout(Duration::from_secs(100)), Ok(()));
}

/// Two of three threads are busy while the third prepares a mesh; work that needs the mesh lies
/// beside the first, and the second becomes free to help.
fn meet_in_a_mesh() {
    let facets = facets(&room(0.01));
    let touch = || {
        let ray = Ray {
            origin: Point3::origin(),
            direction: Vector3::x(),
        };
        let found = facets.first_touch(&ray, 0.1, None, false, f64::INFINITY);
        assert!(found.is_some());
    };
    let busy = AtomicUsize::new(0);
    let both_are_busy = || {
        busy.fetch_add(1, Ordering::SeqCst);
        while busy.load(Ordering::SeqCst) < 2 {
            hint::spin_loop();
        }
    };
    rayon::scope(|scope| {
        scope.spawn(|scope| {
            scope.spawn(|_| touch());
            both_are_busy();
            thread::sleep(Duration::from_millis(10));
        });
        scope.spawn(|_| {
            both_are_busy();
            thread::sleep(Duration::from_micros(200));
        });
        while busy.load(Ordering::SeqCst) < 2 {
            hint::spin_loop();
        }
        touch();
    });
}
