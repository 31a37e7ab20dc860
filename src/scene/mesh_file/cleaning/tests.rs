use super::*;
use crate::scene::mesh_file::assembly::{ALL, Assembly};
use crate::scene::tessellate;

/// Faces by their corners; corners in one place are one.
fn mesh<const CORNERS: usize>(faces: &[[[f64; 3]; CORNERS]]) -> Mesh {
    let mut assembly = Assembly::new(1.0);
    let surface = assembly.surface(ALL);
    for face in faces {
        let corners = face.map(|corner| assembly.vertex(corner).expect("it is near"));
        assembly.face(&corners, surface).expect("it is small");
    }
    assembly.finish().expect("it has faces").mesh
}

/// A cube of side 1 with this lowest corner, whose fronts look inwards.
fn cube_inside_out(low: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let low = Point3::from(low);
    let block = tessellate::block(low, low.map(|it| it + 1.0));
    let inwards = |triangle: &Triangle| {
        let [a, b, c] = block.corners(triangle);
        [c, b, a].map(Into::into)
    };
    block.triangles.iter().map(inwards).collect()
}

fn warnings(mesh: &mut Mesh) -> Vec<MeshWarning> {
    clean(mesh, 1.0).expect("something is left").0
}

fn is_inside_out(warnings: &[MeshWarning]) -> bool {
    let mut warnings = warnings.iter();
    warnings.any(|warning| matches!(warning, MeshWarning::InsideOut { .. }))
}

#[test]
fn a_closed_mesh_whose_fronts_look_inwards_is_inside_out() {
    let found = warnings(&mut mesh(&cube_inside_out([0.0; 3])));
    let [
        MeshWarning::InsideOut {
            bodies: 1,
            signed_volume,
        },
    ] = found[..]
    else {
        panic!("{found:?}")
    };
    assert!((signed_volume + 1.0).abs() < 1e-12, "{signed_volume}");
}

/// Two bodies with a common edge are two shells all the same.
#[test]
fn bodies_that_touch_at_an_edge_are_inside_out_one_by_one() {
    let mut cubes = cube_inside_out([0.0; 3]);
    cubes.extend(cube_inside_out([1.0, 1.0, 0.0]));
    let found = warnings(&mut mesh(&cubes));
    assert!(
        matches!(
            found[..],
            [
                MeshWarning::NonManifoldEdges { count: 1, .. },
                MeshWarning::InsideOut { bodies: 2, .. }
            ]
        ),
        "{found:?}"
    );
}

#[test]
fn a_mesh_with_a_small_hole_is_damaged_and_one_with_a_large_hole_open() {
    // A bar of length 1 with a square for a cross-section, its fronts inwards, open at one end.
    for (width, is_small) in [(0.02, true), (0.2, false)] {
        let section = [[0.0, 0.0], [width, 0.0], [width, width], [0.0, width]];
        let end = |z: f64| section.map(|[x, y]| [x, y, z]);
        let (near, far) = (end(0.0), end(1.0));
        let sides = [0, 1, 2, 3].map(|corner| {
            let next = (corner + 1) % 4;
            [near[corner], far[corner], far[next], near[next]]
        });
        let [a, b, c, d] = near;
        let mut faces: Vec<[[f64; 3]; 3]> = vec![[a, b, c], [a, c, d]];
        faces.extend(
            sides
                .iter()
                .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]),
        );
        let found = warnings(&mut mesh(&faces));
        let small = found.iter().find_map(|warning| match warning {
            MeshWarning::OpenEdges {
                count: 4, small, ..
            } => Some(*small),
            _ => None,
        });
        assert_eq!(small, Some(is_small), "{found:?}");
        // Which side of an open mesh is in front tells nothing.
        assert_eq!(is_inside_out(&found), is_small, "{found:?}");
    }
}

/// A sheet of two sides in one plane, with diagonals that cross, so that no triangle is there twice.
#[test]
fn a_closed_mesh_that_encloses_nothing_is_not_inside_out() {
    let [a, b, c, d] = [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]].map(|[x, y]| [x, y, 0.0]);
    let found = warnings(&mut mesh(&[[a, b, c], [a, c, d], [b, a, d], [b, d, c]]));
    assert_eq!(found, []);
}

/// Squares of what is so small are 0 in a computer.
#[test]
fn triangles_too_small_for_their_area_to_be_a_number_are_dropped() {
    let tiny = [[0.0; 3], [1e-170, 0.0, 0.0], [0.0, 1e-170, 0.0]];
    let alone = clean(&mut mesh(&[tiny]), 1.0);
    assert_eq!(alone.err(), Some(Defect::AllDegenerate { triangles: 1 }));
}
