use super::*;
use crate::scene::mesh::Triangle;
use crate::scene::tessellate;

/// A block of 3 by 4 by 12 mm: its diagonal is 13 mm, so that 1.3e-7 m are joined.
fn block() -> Mesh {
    let mut mesh = tessellate::block(Point3::origin(), Point3::new(3e-3, 4e-3, 12e-3));
    // Coordinates in full, whose last digits say nothing.
    for vertex in &mut mesh.vertices {
        *vertex = vertex.map(|it| it * (1.0 + f64::EPSILON) + 1e-4 / 3.0);
    }
    mesh
}

/// Every triangle with corners of its own, each of which is off by up to so much in each direction.
fn cracked(mesh: &Mesh, off: f64) -> Mesh {
    let mut state = 1_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX) * 2.0 - 1.0
    };
    let mut cracked = Mesh {
        surfaces: mesh.surfaces.clone(),
        ..Mesh::default()
    };
    for triangle in &mesh.triangles {
        let corners = mesh.corners(triangle).map(|corner| {
            let corner = corner.map(|it| it + off * random());
            cracked.vertices.push(corner);
            cracked.vertices.len() as u32 - 1
        });
        cracked.triangles.push(Triangle {
            corners,
            ..*triangle
        });
    }
    cracked
}

fn triangle(corners: [u32; 3]) -> Triangle {
    Triangle {
        corners,
        surface: 0,
    }
}

#[test]
fn a_cracked_mesh_is_closed_as_it_was_meant() {
    let meant = block();
    for off in [0.0, 1e-12, 1e-9, 3e-8] {
        let mut mesh = cracked(&meant, off);
        let before = mesh.clone();
        let weld = weld(&mut mesh, 1e-3).expect("there are cracks");
        assert_eq!(weld.corners, 36 - 8, "{off}");
        assert!(mesh.is_closed() && mesh.topology().is_consistently_wound());
        assert_eq!(mesh.triangles.len(), meant.triangles.len());
        let volume = mesh.topology().signed_volume / meant.topology().signed_volume;
        assert!((volume - 1.0).abs() < 1e-4, "{volume}");
        let mut largest: f64 = 0.0;
        for (old, new) in before.triangles.iter().zip(&mesh.triangles) {
            assert_eq!(old.surface, new.surface);
            for (from, to) in before.corners(old).iter().zip(mesh.corners(new)) {
                largest = largest.max(distance(from, &to));
            }
        }
        assert_eq!(weld.apart, largest);
        assert!(largest <= 2.0 * 3.0_f64.sqrt() * off, "{largest}");
        assert_eq!(mesh.vertices, before.vertices);
    }
}

#[test]
fn what_is_farther_apart_than_the_precision_stays_so() {
    let mut mesh = cracked(&block(), 1e-6);
    let before = mesh.clone();
    if let Some(weld) = weld(&mut mesh, 1e-3) {
        // A few corners may be that near by chance.
        assert!(weld.apart <= 1.3e-7 && weld.corners < 4);
    }
    assert!(mesh.topology().open_edges >= before.topology().open_edges - 4);
}

#[test]
fn a_closed_mesh_is_left_as_it_is_however_near_its_corners_are() {
    // A step of 1e-9 m in a block: two corners nearer than the precision.
    let mut mesh = block();
    let corner = mesh.triangles[0].corners[0];
    let near = mesh.vertices[corner as usize] + nalgebra::Vector3::new(1e-9, 2e-9, -1e-9);
    let added = mesh.vertices.len() as u32;
    mesh.vertices.push(near);
    let [a, b, c] = mesh.triangles[0].corners;
    mesh.triangles[0] = triangle([added, b, c]);
    mesh.triangles
        .extend([triangle([a, b, added]), triangle([a, added, c])]);
    assert!(mesh.is_closed());
    let before = mesh.clone();
    assert!(weld(&mut mesh, 1e-3).is_none());
    assert_eq!(mesh, before);
}

/// Flaps one beside the other, each by less than the precision from the next.
#[test]
fn corners_in_a_row_do_not_draw_each_other_along() {
    let mut mesh = Mesh {
        surfaces: vec!["all".to_owned()],
        ..Mesh::default()
    };
    for number in 0..40_u32 {
        let x = f64::from(number) * 1e-7 + 1e-9 / 3.0;
        let tip = 10e-3 + f64::from(number) / 7.0 * 1e-3;
        let corners = [
            [x, 0.0, 0.0],
            [x, 12e-3, 0.0],
            [tip, f64::from(number) * 1e-3, 5e-3],
        ];
        mesh.vertices.extend(corners.map(Point3::from));
        mesh.triangles
            .push(triangle([3 * number, 3 * number + 1, 3 * number + 2]));
    }
    let before = mesh.clone();
    let limit = precision(&mesh, 1e-3);
    assert!((1e-7..1e-6).contains(&limit), "{limit}");
    let weld = weld(&mut mesh, 1e-3).expect("pairs are near");
    assert!(weld.corners >= 26 && weld.apart <= limit, "{}", weld.apart);
    for (old, new) in before.triangles.iter().zip(&mesh.triangles) {
        for (from, to) in before.corners(old).iter().zip(mesh.corners(new)) {
            assert!(distance(from, &to) <= limit);
        }
    }
    // Each edge has one partner.
    assert_eq!(mesh.topology().non_manifold_edges, 0);
}

/// A needle whose two long sides are both near the edge of a neighbour.
#[test]
fn no_triangle_loses_its_area() {
    let far = 12e-3 + 1e-9 / 3.0;
    let mut mesh = Mesh {
        vertices: [
            [0.0, 0.0, 0.0],
            [far, 2e-8, 0.0],
            [far, -2e-8, 0.0],
            // Two neighbours that meet the needle's end in one corner of theirs.
            [0.0, 3e-8, 0.0],
            [0.0, -3e-8, 0.0],
            [far, 0.0, 0.0],
            [6e-3, 5e-3, 0.0],
            [6e-3, -5e-3, 0.0],
        ]
        .map(Point3::from)
        .to_vec(),
        triangles: vec![
            triangle([0, 2, 1]),
            triangle([3, 5, 6]),
            triangle([4, 7, 5]),
        ],
        surfaces: vec!["all".to_owned()],
    };
    let weld = weld(&mut mesh, 1e-3).expect("one of the two is joined");
    assert_eq!(weld.corners, 2);
    let needle = mesh.triangles[0];
    assert!(mesh.doubled_area(&needle).norm() > 0.9 * 4e-8 * far);
    assert_eq!(mesh.topology().open_edges, 7);
}

#[test]
fn the_same_mesh_gives_the_same_bits() {
    let mesh = cracked(&block(), 3e-8);
    let welded = || {
        let mut mesh = mesh.clone();
        weld(&mut mesh, 1e-3)
            .map(|it| (it.corners, it.apart, it.near))
            .map(|found| (found, mesh))
    };
    assert_eq!(welded(), welded());
}
