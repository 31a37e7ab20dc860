use super::*;
use crate::problem::part::{Ends, Keyway};
use crate::scene::profile::Profile;
use crate::scene::tessellate;

/// The faces of a hole of 12 mm with both ends closed, without the names of its surfaces.
fn faces(chord_angle: f64) -> SmoothFaces {
    let ends = Ends {
        near_closed: true,
        far_closed: true,
    };
    let mut mesh = tessellate::prism(&Profile::circle(12e-3), 0.03, ends, chord_angle);
    mesh.triangles.iter_mut().for_each(|it| it.surface = 0);
    mesh.smooth_faces(SHARP)
}

#[test]
fn a_closed_hole_has_three_faces() {
    let faces = faces(0.1);
    assert_eq!(faces.list.len(), 3);
    let round = faces
        .list
        .iter()
        .find(|it| matches!(it.form, Form::Cylinder { .. }))
        .unwrap();
    let Form::Cylinder {
        axis,
        radius,
        is_hole,
    } = round.form
    else {
        unreachable!()
    };
    assert!(is_hole && (radius - 6e-3).abs() < 1e-9 && (axis.z.abs() - 1.0).abs() < 1e-9);
    assert!((round.area / (std::f64::consts::TAU * 6e-3 * 0.03) - 1.0).abs() < 1e-3);
    let flat = faces
        .list
        .iter()
        .filter(|it| matches!(it.form, Form::Plane { .. }));
    assert_eq!(flat.count(), 2);
    assert_eq!(
        faces.of.len(),
        faces.list.iter().map(|it| it.triangles).sum::<usize>()
    );
}

/// With fillets, into which floor and walls go over without an edge, and without.
#[test]
fn a_keyway_has_the_faces_of_its_drawing() {
    for (root_radius, chord_angle) in [(0.0, 0.02), (0.2e-3, 0.02), (1e-3, 0.1)] {
        assert_faces(root_radius, chord_angle);
    }
}

fn assert_faces(root_radius: f64, chord_angle: f64) {
    let keyway = Keyway {
        bore: 30e-3,
        width: 8e-3,
        depth: 3.3e-3,
        length: 40e-3,
        root_radius,
    };
    let profile = Profile::keyway(&keyway);
    let mut mesh = tessellate::prism(&profile, 0.04, Ends::default(), chord_angle);
    let names = mesh.surfaces.len();
    mesh.triangles.iter_mut().for_each(|it| it.surface = 0);
    let faces = mesh.smooth_faces(SHARP);
    assert_eq!(faces.list.len(), names);
    // A point on the floor is on one face, one on its edge on two.
    let near = |x: f64| {
        let (found, gap) = mesh.nearest_triangles(&Point3::new(x, 18.3e-3, 0.011), 1e-9);
        assert!(gap < 1e-9, "{gap}");
        let mut found: Vec<u32> = found.iter().map(|&it| faces.of[it]).collect();
        found.sort_unstable();
        found.dedup();
        found.len()
    };
    let edge = 4e-3 - root_radius;
    assert_eq!((near(1e-3), near(edge)), (1, 2));
}
