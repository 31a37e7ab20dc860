//! Spheres that come to edges, where rounding and margins decide what they touch.

use nalgebra::{Point3, Vector3};

use super::Random;
use super::search::Search;
use crate::scene::mesh::{Mesh, Triangle};
use crate::scene::ray::Ray;
use crate::scene::triangle_mesh::TriangleMesh;

const RADIUS: f64 = 1.0;

fn mesh(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Mesh {
    let triangle = |&corners: &[u32; 3]| Triangle {
        corners,
        surface: 0,
    };
    Mesh {
        vertices: vertices.iter().map(|&vertex| vertex.into()).collect(),
        triangles: triangles.iter().map(triangle).collect(),
        ..Mesh::default()
    }
}

/// A roof of two slopes along x that are so nearly level that they might count as one face.
#[test]
fn no_sphere_falls_through_a_flat_ridge() {
    for slope in [1e-3, 5e-7, 1e-8, 1e-10, 1e-12, -1e-10, -5e-7] {
        let down = 5.0 * slope;
        let roof = mesh(
            &[
                [-9.0, 0.0, 0.0],
                [9.0, 0.0, 0.0],
                [0.0, -5.0, 0.0],
                [0.0, 5.0, -down],
            ],
            &[[1, 0, 2], [0, 1, 3]],
        );
        let facets = TriangleMesh::new(roof, 0, 1e-12 * 9.0);
        // The edge alone is touched where the sphere is above it by less than this.
        let width = (RADIUS * slope).abs();
        for step in -20..=40 {
            let y = width * f64::from(step) / 20.0;
            let ray = Ray::of([0.5, y, 3.0], [0.0, 0.0, -1.0]);
            let found = facets.first_touch(&ray, RADIUS, None, false, f64::INFINITY);
            let (crossing, normal) = found.unwrap_or_else(|| panic!("{slope} {step}"));
            let expected = 2.0 + slope * y.max(0.0);
            let bend = 2.0 * slope * slope + 1e-11;
            assert!(
                (crossing.distance - expected).abs() < bend,
                "{slope} {step}"
            );
            assert!((normal - Vector3::z()).norm() < 1.1 * width + 1e-11);
        }
    }
}

/// A roof with one level slope and one that falls at 45 degrees: its ridge is met by spheres from above.
#[test]
fn an_edge_belongs_to_the_face_whose_normal_is_nearer_whatever_their_order() {
    let vertices = [
        [-9.0, 0.0, 0.0],
        [9.0, 0.0, 0.0],
        [0.0, -5.0, 0.0],
        [0.0, 5.0, -5.0],
    ];
    let (level, falling) = ([1, 0, 2], [0, 1, 3]);
    let other_way_round = |[a, b, c]: [u32; 3]| [a, c, b];
    for level in [level, other_way_round(level)] {
        for (triangles, falling) in [([level, falling], 1), ([falling, level], 0)] {
            let facets = TriangleMesh::new(mesh(&vertices, &triangles), 0, 1e-12 * 9.0);
            for (y, is_falling) in [(0.1, false), (0.3, false), (0.45, true), (0.6, true)] {
                let ray = Ray::of([0.5, y, 3.0], [0.0, 0.0, -1.0]);
                let found = facets.first_touch(&ray, RADIUS, None, false, f64::INFINITY);
                let (crossing, normal) = found.expect("it falls on the ridge");
                assert!((normal.y - y).abs() < 1e-12, "{y}");
                let expected = if is_falling { falling } else { 1 - falling };
                assert_eq!(crossing.piece, expected, "{y} {triangles:?}");
            }
        }
    }
}

/// The slack is coarse, so that what margins decide happens often.
#[test]
fn spheres_at_a_slant_touch_open_edges() {
    let corners = [[-9.0, 0.0, 0.0], [9.0, 0.0, 0.0], [0.0, 12.0, 0.0]];
    let slack = 1e-5;
    let plate = mesh(&corners, &[[0, 1, 2]]);
    let facets = TriangleMesh::new(plate.clone(), 0, slack);
    let search = Search {
        mesh: &plate,
        radius: RADIUS,
        slack,
    };
    let mut random = Random(31);
    for sinking in [0.03, 0.1, 0.3, 0.6, 0.9] {
        for azimuth in [0.0, 0.4, 1.2, 1.57, 1.9, 2.7] {
            let across: f64 = (1.0_f64 - sinking * sinking).sqrt();
            let level = Vector3::new(across * f64::cos(azimuth), across * f64::sin(azimuth), 0.0);
            for side in [1.0, -1.0] {
                let direction = level - Vector3::z() * (sinking * side);
                for step in -30..=30 {
                    // Where its centre is when it comes to the plane of the face: past the edge y = 0
                    // by a few slacks on its way, and by what random adds.
                    let beside =
                        (f64::from(step) * 0.13 + random.vector().x * 0.1) * slack / sinking;
                    let there = Point3::new(0.3, beside, side * RADIUS);
                    let direction = direction.normalize();
                    let ray = Ray {
                        origin: there - direction * 3.0,
                        direction,
                    };
                    let found = facets.first_touch(&ray, RADIUS, None, false, f64::INFINITY);
                    search.check(&ray, None, found);
                }
            }
        }
    }
}
