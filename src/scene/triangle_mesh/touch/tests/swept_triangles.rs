//! What is told of four triangles at once is what is true of each.

use nalgebra::{Point3, Vector3};

use super::super::contact::{Sphere, SweptTriangle};
use super::super::convex_edges::ConvexEdges;
use super::super::plate;
use super::super::swept_triangles::{Ready, SweptTriangles, WideSphere};
use super::Random;
use crate::scene::ray::Ray;

const SLACK: f64 = 1e-9;
const NO_FOLDS: ConvexEdges = ConvexEdges {
    front: 0,
    behind: 0,
};

fn ready(corners: [[f64; 3]; 3], folds: ConvexEdges) -> Ready {
    Ready {
        plate: plate(corners.map(Point3::from), [0, 1, 2], SLACK),
        folds,
    }
}

/// Legs of 4 along x and 3 along y, in the plane z = 0, with a square corner at the origin.
const LEGS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]];

/// The same four times over, without folds, with folds in front, behind, and without a clear plane.
fn four() -> [Ready; 4] {
    let folded = |front: bool| ConvexEdges {
        front: if front { ConvexEdges::ALL.front } else { 0 },
        behind: if front { 0 } else { ConvexEdges::ALL.behind },
    };
    let [plain, front, behind, mut unclear] =
        [NO_FOLDS, folded(true), folded(false), NO_FOLDS].map(|folds| ready(LEGS, folds));
    unclear.plate.clear = false;
    [plain, front, behind, unclear]
}

#[test]
fn each_triangle_of_a_bundle_is_as_it_was() {
    let mut random = Random(21);
    for count in 1..=4 {
        let triangles: Vec<Ready> = (0..count)
            .map(|_| {
                let corners = [0, 1, 2].map(|_| random.vector().into());
                let mut bits = || (random.bits() & 0b11_1111) as u8;
                let (front, behind) = (bits(), bits());
                let mut ready = ready(corners, ConvexEdges { front, behind });
                ready.plate.clear = front & 1 == 0;
                ready.plate.backwards = behind & 0b111;
                ready
            })
            .collect();
        let plates = SweptTriangles::new(&triangles);
        for (lane, Ready { plate, folds }) in triangles.iter().enumerate() {
            let (found, found_folds) = plates.plate(lane, plate.corners);
            assert_eq!(found_folds, *folds);
            let parts = |plate: &SweptTriangle| {
                let SweptTriangle {
                    corners,
                    normal,
                    inward,
                    backwards,
                    clear,
                } = *plate;
                (corners, normal, inward, backwards, clear)
            };
            assert_eq!(parts(&found), parts(plate));
        }
    }
}

/// Which of the four a sphere of radius 1 may touch.
fn touched(origin: [f64; 3], direction: [f64; 3], limit: f64, all_folds: bool) -> u32 {
    let direction = Vector3::from(direction).normalize();
    let ray = Ray::of(origin, direction.into());
    let sphere = WideSphere::new(&Sphere::new(&ray, 1.0, SLACK));
    SweptTriangles::new(&four())
        .reached(&sphere, limit, all_folds)
        .touched
}

const UNCLEAR: u32 = 0b1000;
const CLEAR: u32 = 0b0111;
const IN_FRONT: u32 = 0b0010;
const BEHIND: u32 = 0b0100;

#[test]
fn faces_are_reached_by_what_comes_down_on_them() {
    let (down, up) = ([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]);
    let all = CLEAR | UNCLEAR;
    for side in [1.0, -1.0] {
        let (towards, away) = if side > 0.0 { (down, up) } else { (up, down) };
        let above = |x: f64, y: f64| [x, y, 5.0 * side];
        assert_eq!(touched(above(1.0, 1.0), towards, 9.0, false), all);
        // At 4 at the earliest.
        assert_eq!(touched(above(1.0, 1.0), towards, 4.1, false), all);
        assert_eq!(touched(above(1.0, 1.0), towards, 3.9, false), UNCLEAR);
        assert_eq!(touched(above(1.0, 1.0), away, 9.0, false), UNCLEAR);
        // Half a radius beside each edge the edge alone may be touched, where it stands out.
        let folded = if side > 0.0 { IN_FRONT } else { BEHIND };
        let other = CLEAR & !folded & !0b1;
        for (x, y) in [(2.0, -0.5), (-0.5, 1.5), (2.0 + 0.3, 1.5 + 0.4)] {
            let found = touched(above(x, y), towards, 9.0, false);
            assert_eq!(found & !other, folded | UNCLEAR, "{x} {y} {side}");
            // Those that stand out on the far side only, not before the centre is there.
            let found = touched(above(x, y), towards, 4.9, false);
            assert_eq!(found, folded | UNCLEAR, "{x} {y} {side}");
            assert_eq!(touched(above(x, y), towards, 9.0, true), all);
        }
        for (x, y) in [(2.0, -1.1), (-1.1, 1.5), (2.0 + 0.7, 1.5 + 0.9)] {
            assert_eq!(touched(above(x, y), towards, 9.0, true), UNCLEAR);
        }
    }
}

/// By far more than rounding moves the place where they come to its plane.
#[test]
fn faces_are_reached_a_little_beyond_their_edges() {
    let down = [0.0, 0.0, -1.0];
    for inside in [1e-6, 1e-10, 0.0, -1e-10] {
        for (x, y) in [(2.0, inside), (inside, 1.5)] {
            let found = touched([x, y, 5.0], down, 9.0, false);
            assert_eq!(found, CLEAR | UNCLEAR, "{x} {y}");
        }
    }
}

#[test]
fn edges_on_the_far_side_are_reached_behind_the_plane() {
    // It passes the plane after 4, 1.6 beside the first edge, and touches the edge after 5.
    for (side, folded) in [(1.0, BEHIND), (-1.0, IN_FRONT)] {
        let slanted = |limit: f64, all_folds: bool| {
            let origin = [1.0, -4.8, 2.4 * side];
            touched(origin, [0.0, 0.8, -0.6 * side], limit, all_folds)
        };
        assert_eq!(slanted(9.0, false), folded | UNCLEAR);
        assert_eq!(slanted(9.0, true), CLEAR | UNCLEAR);
        assert_eq!(slanted(3.9, false), UNCLEAR);
        // The same from nearer: it touches the edge after 1.5.
        let origin = [1.0, -2.0, 0.3 * side];
        let found = touched(origin, [0.0, 0.8, -0.6 * side], 1.6, false);
        assert_eq!(found, folded | UNCLEAR);
    }
}

#[test]
fn what_passes_level_reaches_edges_only() {
    for (height, folded) in [(0.5, IN_FRONT), (-0.5, BEHIND)] {
        let along = |height: f64, limit: f64, all_folds: bool| {
            touched([-5.0, 1.0, height], [1.0, 0.0, 0.0], limit, all_folds)
        };
        assert_eq!(along(height, 9.0, false), folded | UNCLEAR);
        assert_eq!(along(height, 9.0, true), CLEAR | UNCLEAR);
        // It is within a radius of the first edge after 4.
        assert_eq!(along(height, 3.9, true), UNCLEAR);
        assert_eq!(along(2.2 * height, 9.0, true), UNCLEAR);
    }
}

#[test]
fn it_is_told_when_planes_come_into_reach() {
    let reached = |z: f64, limit: f64, triangles: &[Ready]| {
        let ray = Ray::of([-2.0, 1.0, z], [0.6, 0.0, -0.8]);
        let sphere = WideSphere::new(&Sphere::new(&ray, 1.0, SLACK));
        SweptTriangles::new(triangles).reached(&sphere, limit, false)
    };
    let clear = &four()[..3];
    // 4 down at 0.8 a step.
    let found = reached(5.0, 9.0, clear);
    assert!(
        found.enters[..3]
            .iter()
            .all(|enters| (enters - 5.0).abs() < 1e-8)
    );
    assert_eq!((found.touched & CLEAR, found.near & CLEAR), (CLEAR, 0));
    let found = reached(0.9, 9.0, clear);
    assert_eq!((found.enters[0], found.near & CLEAR), (0.0, CLEAR));
    // Nothing is known of when the plane is not clear, not even that it is too far.
    for (z, limit, near) in [(5.0, 9.0, UNCLEAR), (0.9, 9.0, 0b1111), (5.0, 1.0, UNCLEAR)] {
        let found = reached(z, limit, &four());
        assert_eq!(found.enters, [0.0; 4], "{z} {limit}");
        assert_eq!(
            (found.near, found.touched & UNCLEAR),
            (near, UNCLEAR),
            "{z} {limit}"
        );
    }
}

#[test]
fn whatever_is_touched_is_reached() {
    // Of any size, and from so near that spheres reach the plane at once.
    for (scale, farthest) in [(1.0, 2.0), (1e-3, 2.0), (1e-3, 0.7), (300.0, 0.7)] {
        whatever_is_touched_is_reached_from(farthest, scale);
    }
}

fn whatever_is_touched_is_reached_from(farthest: f64, scale: f64) {
    let mut random = Random(22);
    let (mut touches, mut tried) = (0, 0);
    for _ in 0..20_000 {
        let corners = [0, 1, 2].map(|_| (random.vector() * scale).into());
        let folds = match random.bits() % 5 {
            0 => ConvexEdges::ALL,
            1 => NO_FOLDS,
            2 => ConvexEdges {
                front: 0b10_1010,
                behind: 0b01_0101,
            },
            3 => ConvexEdges {
                behind: 0,
                ..ConvexEdges::ALL
            },
            _ => ConvexEdges {
                front: 0,
                ..ConvexEdges::ALL
            },
        };
        let triangle = ready(corners, folds);
        let ray = Ray {
            origin: (random.vector() * (farthest * scale)).into(),
            direction: random.direction(),
        };
        let sphere = Sphere::new(&ray, 0.3 * scale, SLACK);
        let limit = 3.0 * scale;
        let touch = sphere.touch(&triangle.plate, folds, limit);
        let touch = touch.filter(|touch| (0.0..limit).contains(&touch.distance));
        let found =
            SweptTriangles::new(&[triangle]).reached(&WideSphere::new(&sphere), limit, false);
        if let Some(touch) = touch {
            assert_eq!(found.touched & 1, 1, "{corners:?} {ray:?}");
            assert!(found.enters[0] <= touch.distance);
            touches += 1;
        }
        tried += found.touched & 1;
    }
    assert!(touches > 500, "{touches}");
    assert!(tried < 3 * touches, "{tried} {touches}");
}
