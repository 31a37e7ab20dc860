//! Mesh files: what is read, what is refused and in which words, what is reported.

mod sample;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::common::cases::cases;
use nalgebra::Point3;
use peenpose::control::Control;
use peenpose::problem::part::{Region, RegionPlace};
use peenpose::scene::mesh::Mesh;
use peenpose::scene::mesh_file::{Defect, LARGEST_FILE, MeshFault, MeshWarning, Place, read};
use peenpose::study::{Extras, Study};
use proptest::prelude::*;
use sample::{Sample, cube, torus};
use tempfile::TempDir;

const MILLIMETRE: f64 = 1e-3;

type Reading = Result<(Mesh, Vec<MeshWarning>), MeshFault>;

fn read_bytes(ending: &str, bytes: &[u8], regions: &[Region]) -> Reading {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("part").with_extension(ending);
    fs::write(&path, bytes).unwrap();
    read(&path, MILLIMETRE, regions)
}

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/meshes")
        .join(name)
}

/// Reads a text as a mesh that must be refused; gives place, defect and message.
fn refused(ending: &str, bytes: impl AsRef<[u8]>) -> (Place, Defect, String) {
    let fault = read_bytes(ending, bytes.as_ref(), &[]).unwrap_err();
    let message = fault.to_string();
    let (_, message) = message.split_once(&format!("part.{ending}")).unwrap();
    (fault.place, fault.defect, message.to_owned())
}

fn region(name: &str, min: [f64; 3], max: [f64; 3]) -> Region {
    let metres = |point: [f64; 3]| Point3::from(point.map(|value| value * MILLIMETRE));
    Region {
        name: name.to_owned(),
        place: RegionPlace::Box {
            min: metres(min),
            max: metres(max),
        },
    }
}

/// How many triangles each surface has.
fn surface_sizes(mesh: &Mesh) -> Vec<(&str, usize)> {
    let size = |number: usize| {
        let of_it = |surface: u32| surface as usize == number;
        mesh.triangles
            .iter()
            .filter(|triangle| of_it(triangle.surface))
            .count()
    };
    mesh.surfaces
        .iter()
        .enumerate()
        .map(|(number, name)| (name.as_str(), size(number)))
        .collect()
}

#[test]
fn every_format_gives_the_same_closed_mesh() {
    for (ending, bytes) in cube().everywhere() {
        let (mesh, warnings) = read_bytes(ending, &bytes, &[]).unwrap();
        assert_eq!(warnings, [], "{ending}");
        assert_eq!(mesh.vertices.len(), 8, "{ending}");
        assert_eq!(surface_sizes(&mesh), [("all", 12)]);
        assert!(mesh.is_closed());
        let topology = mesh.topology();
        assert!(topology.is_consistently_wound());
        assert!((topology.signed_volume - 1e-9).abs() < 1e-22);
    }
}

#[test]
fn text_formats_keep_all_digits() {
    let exact = [0.1 + 0.2, 1.0 / 3.0, 12.345_678_901_234_567];
    let mut sample = cube();
    sample.vertices[7] = exact;
    for (ending, bytes) in sample.everywhere() {
        if bytes.starts_with(b"solid in name only") {
            continue; // f32 by definition
        }
        let (mesh, _) = read_bytes(ending, &bytes, &[]).unwrap();
        let expected = Point3::from(exact.map(|value| value * MILLIMETRE));
        assert!(mesh.vertices.contains(&expected), "{ending}");
    }
}

#[test]
fn obj_groups_become_surfaces() {
    let (mesh, warnings) = read(&fixture("two-groups.obj"), 1.0, &[]).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(
        surface_sizes(&mesh),
        [("caps of the cube", 4), ("sides", 8)]
    );
    assert!((mesh.topology().signed_volume - 8.0).abs() < 1e-12);
}

#[test]
fn obj_objects_count_only_without_groups() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    let objects = format!("{vertices}f 1 2 3\no one\nf 1 2 4\no two\nf 2 3 4\no\nf 1 3 4\n");
    let (mesh, _) = read_bytes("obj", objects.as_bytes(), &[]).unwrap();
    assert_eq!(surface_sizes(&mesh), [("all", 2), ("one", 1), ("two", 1)]);
    let groups = format!("{vertices}o one\nf 1 2 3\nf 1 2 4\ng lip\no two\nf 2 3 4\ng\nf 1 3 4\n");
    let (mesh, _) = read_bytes("obj", groups.as_bytes(), &[]).unwrap();
    assert_eq!(surface_sizes(&mesh), [("all", 3), ("lip", 1)]);
}

#[test]
fn editors_leave_marks_that_do_no_harm() {
    let obj = "\u{feff}# from C:\\parts\\\r\nv 0 0 0\r\nv 1 0 0 # here\r\nv 0 1 0\r\nf 1 2 \\\r\n3 # there";
    let (mesh, _) = read_bytes("obj", obj.as_bytes(), &[]).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (3, 1));
}

#[test]
fn concave_faces_are_cut_inside_their_outline() {
    // an L with one corner in the middle of a straight side, in both windings and three planes
    let outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2], [0, 1]];
    for reversed in [false, true] {
        for axis in 0..3 {
            let mut text = String::new();
            for [u, v] in outline {
                let mut corner = [7; 3];
                (corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (u, v);
                let [x, y, z] = corner;
                writeln!(text, "v {x} {y} {z}").unwrap();
            }
            text.push_str(if reversed {
                "f 7 6 5 4 3 2 1\n"
            } else {
                "f 1 2 3 4 5 6 7\n"
            });
            let (mesh, warnings) = read_bytes("obj", text.as_bytes(), &[]).unwrap();
            assert_eq!(mesh.triangles.len(), 5);
            assert!(
                matches!(warnings[..], [MeshWarning::OpenEdges { count: 7, .. }]),
                "{warnings:?}"
            );
            let sign = if reversed { -1.0 } else { 1.0 };
            let areas: Vec<f64> = mesh
                .triangles
                .iter()
                .map(|triangle| sign * mesh.doubled_area(triangle)[axis] * 0.5e6)
                .collect();
            assert!(areas.iter().all(|area| *area > 0.1), "{areas:?}");
            assert!((areas.iter().sum::<f64>() - 3.0).abs() < 1e-9);
        }
    }
}

#[test]
fn solids_with_names_become_surfaces() {
    let (mesh, _) = read(&fixture("two-solids.stl"), 1.0, &[]).unwrap();
    assert_eq!(surface_sizes(&mesh), [("left wall", 1), ("right wall", 1)]);
    assert_eq!(mesh.vertices.len(), 4, "0 and -0 are one");
    let text = fs::read_to_string(fixture("two-solids.stl")).unwrap();
    let same = text.replace("right", "left");
    let (mesh, _) = read_bytes("stl", same.as_bytes(), &[]).unwrap();
    assert_eq!(surface_sizes(&mesh), [("all", 2)]);
    // What has no name of its own does not take the others' away.
    let nameless = text.replace(" right wall", "");
    let (mesh, _) = read_bytes("stl", nameless.as_bytes(), &[]).unwrap();
    assert_eq!(surface_sizes(&mesh), [("left wall", 1), ("all", 1)]);
}

#[test]
fn ply_passes_over_what_it_does_not_need() {
    let (mesh, warnings) = read(&fixture("quads.ply"), 1.0, &[]).unwrap();
    assert_eq!(warnings, []);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 12));
    assert!((mesh.topology().signed_volume - 1.0).abs() < 1e-12);
}

#[test]
fn other_readers_see_the_same_triangles() {
    let sample = torus(12, 8);
    for (ending, bytes) in sample.everywhere() {
        let (mesh, _) = read_bytes(ending, &bytes, &[]).unwrap();
        let theirs: Vec<[f32; 3]> = match ending {
            "ply" => continue,
            "stl" => mesh_loader::stl::from_slice(&bytes).unwrap().meshes,
            _ => {
                mesh_loader::obj::from_slice(&bytes, None::<&Path>, |_| Ok(Vec::new()))
                    .unwrap()
                    .meshes
            }
        }
        .iter()
        .flat_map(|part| {
            part.faces
                .iter()
                .flatten()
                .map(|corner| part.vertices[*corner as usize])
        })
        .collect();
        let ours = mesh
            .triangles
            .iter()
            .flat_map(|triangle| mesh.corners(triangle));
        assert_eq!(theirs.len(), 3 * mesh.triangles.len());
        for (ours, theirs) in ours.zip(theirs) {
            let theirs = Point3::from(theirs.map(|value| f64::from(value) * MILLIMETRE));
            assert!(nalgebra::distance(&ours, &theirs) < 3e-9, "{ours} {theirs}");
        }
    }
}

#[test]
fn regions_name_triangles_and_the_later_one_wins() {
    let bytes = cube().obj();
    let top = region("top", [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]);
    let half = region("half", [0.0, 0.0, 0.5], [1.0, 0.5, 1.0]);
    let (mesh, _) = read_bytes("obj", &bytes, std::slice::from_ref(&top)).unwrap();
    assert_eq!(surface_sizes(&mesh), [("all", 10), ("top", 2)]);
    let (mesh, _) = read_bytes("obj", &bytes, &[top.clone(), half.clone()]).unwrap();
    assert_eq!(surface_sizes(&mesh), [("all", 7), ("top", 1), ("half", 4)]);
    let everything = region("everything", [-1.0; 3], [2.0; 3]);
    let (mesh, _) = read_bytes("obj", &bytes, std::slice::from_ref(&everything)).unwrap();
    assert_eq!(surface_sizes(&mesh), [("everything", 12)]);

    let beside = region("lip", [2.0; 3], [3.0; 3]);
    let fault = read_bytes("obj", &bytes, &[beside]).unwrap_err();
    let message = fault.to_string();
    assert!(message.ends_with(
        "region `lip` holds the centre of no triangle; the mesh reaches from (0, 0, 0) to (1, 1, 1) \
         in the file's unit"
    ), "{message}");
    // Regions are in metres, and where a file in inches reaches is said in inches.
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("inches.obj");
    fs::write(&path, "v 1 2 3\nv 2 2 3\nv 1 4 3\nf 1 2 3\n").unwrap();
    let beside = region("lip", [0.5; 3], [1.0; 3]);
    let defect = read(&path, 0.0254, &[beside]).unwrap_err().defect;
    let Defect::EmptyRegion { min, max, .. } = defect else {
        panic!("{defect:?}")
    };
    assert!((min - Point3::new(1.0, 2.0, 3.0)).norm() < 1e-12);
    assert!((max - Point3::new(2.0, 4.0, 3.0)).norm() < 1e-12);
    let fault = read_bytes("obj", &bytes, &[half, everything]).unwrap_err();
    assert_eq!(
        fault.defect,
        Defect::CoveredRegion {
            region: "half".to_owned()
        }
    );
}

#[test]
fn files_that_are_no_meshes_are_refused() {
    let folder = TempDir::new().unwrap();
    let defect = |path: &Path| read(path, 1.0, &[]).unwrap_err().defect;
    assert_eq!(defect(&folder.path().join("none.stl")), Defect::Missing);
    assert!(matches!(defect(folder.path()), Defect::Unreadable { .. }));
    assert_eq!(refused("stl", "").1, Defect::Empty);
    let (_, defect, message) = refused("stp", "ISO-10303-21;");
    assert!(matches!(defect, Defect::UnknownFormat { .. }));
    assert_eq!(
        message,
        ": `.stp` is not a mesh format that is read here; export the part as .stl, .obj or .ply \
         (did you mean `.stl`?)"
    );
    for (ending, text) in [
        ("obj", "# nothing\nv 0 0 0\nv 1 0 0\nl 1 2\n"),
        ("stl", "solid nothing\nendsolid\n"),
        (
            "ply",
            "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nelement face 0\nproperty list uchar int vertex_index\nend_header\n",
        ),
    ] {
        assert_eq!(refused(ending, text).1, Defect::NoTriangles, "{ending}");
    }
    // Text longer than the header of a binary file is not one that promises anything.
    let letter = refused("stl", "Dear customer, please find attached\n".repeat(9));
    assert!(matches!(letter.1, Defect::Unexpected { .. }), "{letter:?}");
    assert_eq!(refused("stl", vec![0; 84]).1, Defect::NoTriangles);
    let flat = refused("obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n").1;
    assert_eq!(flat, Defect::AllDegenerate { triangles: 2 });
}

#[test]
fn a_file_beyond_the_limit_is_refused_unread() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("huge.stl");
    let file = fs::File::create(&path).unwrap();
    let refused = |bytes: u64| {
        file.set_len(bytes).unwrap(); // sparse
        read(&path, 1.0, &[]).unwrap_err().defect
    };
    let bytes = LARGEST_FILE + 1;
    assert_eq!(refused(bytes), Defect::TooLarge { bytes });
    // At the limit it is its contents that are wrong.
    let at_limit = refused(LARGEST_FILE);
    assert!(
        matches!(at_limit, Defect::WrongCount { promised: 0, .. }),
        "{at_limit:?}"
    );
}

#[test]
fn faults_of_text_files_name_their_line() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (ending, text, message) in [
        (
            "obj",
            "v 0 0 0\nv 1 nan 0\n".to_owned(),
            ", line 2: the coordinates (1, NaN, 0) are not finite numbers; repair the mesh or export it again",
        ),
        (
            "obj",
            "v 0 0\n".to_owned(),
            ", line 1: expected three coordinates with decimal points, found nothing",
        ),
        (
            "obj",
            "v 0,5 0 0\n".to_owned(),
            ", line 1: expected three coordinates with decimal points, found `0,5`",
        ),
        (
            "obj",
            "v 0 0 1e300\n".to_owned(),
            ", line 1: the coordinates (0e0, 0e0, 1e300) lie more than 1000 km out; check `lengths_in`, or the file is damaged",
        ),
        (
            "obj",
            format!("{triangle}f 1 2 4\n"),
            ", line 4: the face uses vertex 4, counted from 1, but only 3 vertices stand before it; the file is damaged or cut short",
        ),
        (
            "obj",
            format!("{triangle}f 1 2 0\n"),
            ", line 4: the face uses vertex 0, counted from 1, but only 3 vertices stand before it; the file is damaged or cut short",
        ),
        (
            "obj",
            format!("{triangle}f 1 2 -4\n"),
            ", line 4: the face uses vertex -4, counted from 1, but only 3 vertices stand before it; the file is damaged or cut short",
        ),
        (
            "obj",
            format!("{triangle}f 1 2\n"),
            ", line 4: expected a face of at least three corners, found `f 1 2`",
        ),
        (
            "obj",
            format!("{triangle}f 1 b 2\n"),
            ", line 4: expected the number of a vertex, found `b`",
        ),
        (
            "obj",
            "\u{1}\u{2}\n".to_owned(),
            ", line 1: expected an OBJ statement such as `v`, `f` or `g`, found `\u{fffd}\u{fffd}`",
        ),
        (
            "obj",
            "v\u{e9} 1 2 3\n".to_owned(),
            ", line 1: expected an OBJ statement such as `v`, `f` or `g`, found `v\u{e9} 1 2 3`",
        ),
        (
            "stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"
                .to_owned(),
            ", line 6: expected `vertex` and three coordinates, found `endloop`",
        ),
        (
            "stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n".to_owned(),
            ", line 5: the file ends where `vertex` should follow; it was cut short, copy or export it again",
        ),
        (
            "stl",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 inf 0\n".to_owned(),
            ", line 4: the coordinates (0, inf, 0) are not finite numbers; repair the mesh or export it again",
        ),
        (
            "stl",
            "solid a\n".to_owned(),
            ", line 1: the file ends where `facet normal` or `endsolid` should follow; it was cut short, copy or export it again",
        ),
        (
            "stl",
            "v 0 0 0\n".to_owned(),
            ", line 1: expected `solid` at the start of a text STL file or the 84 byte header of a binary one, found `v 0 0 0`",
        ),
    ] {
        assert_eq!(refused(ending, &text).2, message, "{text}");
    }
    let long = "f 1".to_owned() + &" 1".repeat(200_000);
    assert_eq!(refused("obj", long).1, Defect::LineTooLong);
    let many = format!("{triangle}f{}\n", " 1 2 3".repeat(2000));
    assert_eq!(
        refused("obj", many).1,
        Defect::TooManyCorners { corners: 6000 }
    );
}

#[test]
fn a_binary_stl_must_hold_what_it_promises() {
    let whole = cube().binary_stl("");
    let cut = refused("stl", &whole[..whole.len() - 60]);
    assert_eq!(
        cut.2,
        ": the header promises 12 triangles, the file holds 10; it was cut short, copy or export it again"
    );
    let cut = cube().binary_stl("solid")[..200].to_vec();
    assert_eq!(
        refused("stl", cut).1,
        Defect::WrongCount {
            promised: 12,
            held: 2,
            rest: 16
        }
    );
    let mut promising = vec![0; 84];
    promising[80..].fill(0xff);
    assert_eq!(
        refused("stl", &promising).1,
        Defect::WrongCount {
            promised: 4_294_967_295,
            held: 0,
            rest: 0
        }
    );
    // Bytes behind the last triangle are passed over, and said: the triangles are complete.
    for rest in [10, 100] {
        let longer = [whole.as_slice(), &vec![0; rest]].concat();
        let (mesh, warnings) = read_bytes("stl", &longer, &[]).unwrap();
        assert_eq!(mesh.triangles.len(), 12);
        assert!(!warnings.is_empty(), "{rest}");
    }
    let with_line_end = [whole.as_slice(), b"\r\n"].concat();
    assert!(read_bytes("stl", &with_line_end, &[]).is_ok());
    let mut not_finite = whole;
    not_finite[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(refused("stl", not_finite).0, Place::Triangle(2));
}

#[test]
fn faults_of_ply_files_say_what_is_missing() {
    let good = String::from_utf8(cube().ply("ascii")).unwrap();
    for (from, to, message) in [
        (
            "ply\n",
            "plain\n",
            ", line 1: expected `ply` as the first line, found `plain`",
        ),
        (
            "format ascii 1.0\n",
            "",
            ", line 8: the PLY header has no line `format ... 1.0`; export the part as a mesh with vertices and faces",
        ),
        (
            "ascii",
            "asci",
            ", line 2: expected format `ascii`, `binary_little_endian` or `binary_big_endian`, found `format asci 1.0`",
        ),
        (
            "element vertex 8",
            "element vertex many",
            ", line 3: expected a number of elements, found `element vertex many`",
        ),
        (
            "double z",
            "double w",
            ", line 9: the PLY header has no property `z` of the vertices; export the part as a mesh with vertices and faces",
        ),
        (
            "double z",
            "double y",
            ", line 6: expected a property that is not there twice, found `property double y`",
        ),
        (
            "double z",
            "real z",
            ", line 6: expected a PLY number type, found `property real z`",
        ),
        (
            "element face",
            "element tristrips",
            ", line 9: the PLY header has no element `face`; export the part as a mesh with vertices and faces",
        ),
        (
            "vertex_indices",
            "corners",
            ", line 9: the PLY header has no list of integers `vertex_indices` of the faces; export the part as a mesh with vertices and faces",
        ),
        (
            "end_header\n",
            "",
            ", line 9: expected a line of a PLY 1.0 header such as `element` or `property`, found `0 0 0`",
        ),
        (
            "end_header\n0 0 0",
            "end_header\n0 nan 0",
            ", line 10: the coordinates (0, NaN, 0) are not finite numbers; repair the mesh or export it again",
        ),
        (
            "end_header\n0 0 0",
            "end_header\n0 0",
            ", line 10: expected another number, found nothing",
        ),
        (
            "3 0 2 3",
            "3 0 2 8",
            ", line 18: the face uses vertex 8, counted from 0, but only 8 vertices stand before it; the file is damaged or cut short",
        ),
        (
            "3 0 2 3",
            "2 0 2",
            ", line 18: expected a face of at least three corners, found `2`",
        ),
        (
            "element vertex 8",
            "element vertex 99999999999",
            ", line 18: expected the end of the line, found `3`",
        ),
        (
            "element face 12",
            "element face 99999999999",
            ": the mesh has more than 20000000 triangles; export it with a coarser tolerance",
        ),
        (
            "3 1 7 5\n",
            "",
            ", line 28: the file ends where another face should follow; it was cut short, copy or export it again",
        ),
    ] {
        assert_eq!(refused("ply", good.replace(from, to)).2, message);
    }
    let lines = good.lines().count();
    let cut = good.lines().take(lines - 1).collect::<Vec<_>>().join("\n");
    let ending =
        "the file ends where another face should follow; it was cut short, copy or export it again";
    assert_eq!(
        refused("ply", cut).2,
        format!(", line {}: {ending}", lines - 1)
    );
    let vertices_only = good
        .lines()
        .take(lines - 12 - 1)
        .collect::<Vec<_>>()
        .join("\n");
    assert_eq!(
        refused("ply", vertices_only).2,
        format!(
            ", line {}: {}",
            lines - 13,
            ending.replace("face", "vertex")
        )
    );
    let binary = cube().ply("binary_little_endian");
    let header_ends = binary
        .windows(11)
        .position(|it| it == b"end_header\n")
        .unwrap()
        + 11;
    assert_eq!(
        refused("ply", &binary[..header_ends + 2 * 24]).2,
        format!(", vertex 2: {}", ending.replace("face", "vertex"))
    );
    assert_eq!(
        refused("ply", &binary[..header_ends + 2 * 24 + 5]).0,
        Place::Vertex(2)
    );
    assert_eq!(
        refused("ply", &binary[..binary.len() - 13]).2,
        format!(", face 11: {ending}")
    );
    assert_eq!(
        refused("ply", &binary[..binary.len() - 1]).0,
        Place::Face(11)
    );
}

#[test]
fn oddities_are_reported_with_a_place() {
    let warnings = |change: fn(&mut Sample)| {
        let mut sample = cube();
        change(&mut sample);
        let (mesh, warnings) = read_bytes("obj", &sample.obj(), &[]).unwrap();
        let texts: Vec<String> = warnings.iter().map(MeshWarning::to_string).collect();
        (mesh.triangles.len(), texts)
    };
    assert_eq!(
        warnings(|cube| cube.triangles.truncate(11)),
        (11, vec!["3 open edges in the mesh, one of them near (1, 0, 0.5): shots can leave there; close \
                   the mesh, or where the part is meant to be open, give `facing` should the free \
                   side of the target be taken for the other".to_owned()])
    );
    assert_eq!(
        warnings(|cube| cube.triangles.push([3, 2, 0])),
        (12, vec!["1 duplicate triangle is dropped, near (0.333333333, 0.666666667, 0); the first of \
                   each kept its surface, and the answer is the same without the others".to_owned()])
    );
    assert_eq!(
        warnings(|cube| cube.triangles.push([3, 2, 2])),
        (
            12,
            vec![
                "1 triangle of zero area is dropped, near (0.333333333, 1, 0); the answer is the \
                 same without"
                    .to_owned()
            ]
        )
    );
    assert_eq!(
        warnings(|cube| cube.triangles[0].reverse()),
        (
            12,
            vec![
                "1 triangle is turned to agree with the neighbours about the front, near \
                   (0.333333333, 0.666666667, 0); the answer is that of the mesh with fronts that \
                   agree"
                    .to_owned()
            ]
        )
    );
    assert_eq!(
        warnings(|cube| cube
            .triangles
            .iter_mut()
            .for_each(|triangle| triangle.reverse())),
        (
            12,
            vec![
                "a closed body is inside out: its normals point into the material (signed volume \
                 -1.000e-9 m3); they were turned: give `facing` for a target inside, or flip the \
                 normals in the file"
                    .to_owned()
            ]
        )
    );
    let (_, fork) = warnings(|cube| {
        cube.vertices.push([3.0, 3.0, 3.0]);
        cube.triangles.push([0, 1, 8]);
    });
    assert_eq!(
        fork[1],
        "1 edge is shared by more than two triangles, near (0.5, 0, 0): bodies touch or overlap \
         there, and shots bounce off all of their faces, those inside as well; export them as \
         separate parts or unite them"
    );
}

#[test]
fn a_flat_triangle_between_neighbours_is_no_hole() {
    // edge 0-1 of the cube is split on one side only; a triangle without area fills the gap
    let mut sample = cube();
    sample.vertices.push([0.5, 0.0, 0.0]);
    let split = sample
        .triangles
        .iter()
        .position(|triangle| *triangle == [0, 1, 5])
        .unwrap();
    sample.triangles[split] = [0, 8, 5];
    sample.triangles.extend([[8, 1, 5], [0, 1, 8]]);
    let (mesh, warnings) = read_bytes("obj", &sample.obj(), &[]).unwrap();
    assert_eq!(mesh.triangles.len(), 13);
    assert!(
        matches!(
            warnings[..],
            [MeshWarning::DegenerateTriangles { count: 1, .. }]
        ),
        "{warnings:?}"
    );
}

fn damaged() -> impl Strategy<Value = (&'static str, Vec<u8>)> {
    let formats = cube().everywhere();
    let endless = fs::read(fixture("two-groups.obj")).unwrap();
    let formats: Vec<_> = formats
        .into_iter()
        .chain([
            ("obj", endless),
            ("ply", fs::read(fixture("quads.ply")).unwrap()),
        ])
        .collect();
    let changes = prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6);
    let cut = prop::option::of(any::<prop::sample::Index>());
    (prop::sample::select(formats), changes, cut).prop_map(|((ending, mut bytes), changes, cut)| {
        for (position, byte) in changes {
            let position = position.index(bytes.len());
            bytes[position] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        (ending, bytes)
    })
}

proptest! {
    #![proptest_config(cases(1000))]

    /// Damaged files are read or refused, never a panic; what is read keeps its promises.
    #[test]
    fn damage_never_panics((ending, bytes) in damaged()) {
        match read_bytes(ending, &bytes, &[region("r", [0.2; 3], [2.0; 3])]) {
            Err(fault) => prop_assert!(!fault.to_string().is_empty()),
            Ok((mesh, warnings)) => {
                for warning in warnings {
                    prop_assert!(!warning.to_string().is_empty());
                }
                prop_assert!(mesh.vertices.iter().flat_map(Point3::iter).all(|value| value.is_finite()));
                prop_assert!(mesh.triangles.iter().all(|triangle| mesh.doubled_area(triangle).norm() > 0.0));
                prop_assert!(mesh.triangles.iter().all(|triangle| (triangle.surface as usize) < mesh.surfaces.len()));
                prop_assert_eq!(mesh.topology().duplicate_triangles, 0);
            }
        }
    }
}

/// Time and peak memory of a million triangles:
/// `cargo test --release --test geometry mesh_files -- --ignored --nocapture --test-threads 1`
#[test]
#[ignore = "takes half a minute"]
fn a_million_triangles() {
    let folder = TempDir::new().unwrap();
    let sample = torus(1000, 500);
    for (number, (ending, bytes)) in sample.everywhere().into_iter().enumerate() {
        fs::write(folder.path().join(format!("{number}.{ending}")), bytes).unwrap();
    }
    drop(sample);
    let mut paths: Vec<PathBuf> = fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    for path in paths {
        fs::write("/proc/self/clear_refs", "5").unwrap(); // forgets the peak so far
        let start = std::time::Instant::now();
        let (mesh, warnings) = read(&path, MILLIMETRE, &[]).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        let kind = path.file_name().unwrap().to_string_lossy().into_owned();
        println!("{kind}: {seconds:.2} s, at most {} MB", peak_memory());
        assert_eq!(
            (mesh.vertices.len(), mesh.triangles.len()),
            (500_000, 1_000_000)
        );
        assert_eq!(warnings, []);
    }
}

/// Peak resident memory of this process, MB.
fn peak_memory() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let peak = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))
        .unwrap();
    peak.split_whitespace()
        .next()
        .unwrap()
        .parse::<u64>()
        .unwrap()
        / 1000
}

#[test]
fn a_mesh_from_memory_is_the_mesh_of_the_file() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    let text = fs::read_to_string(root.join("keyway-blind.yaml")).unwrap();
    let bytes: Arc<[u8]> = fs::read(root.join("hub-blind-keyway.obj")).unwrap().into();
    let nowhere = Path::new("no/such/folder/problem.yaml");
    let from_disk = Study::from_text(&text, &root.join("keyway-blind.yaml")).unwrap();
    let meshes = [("hub-blind-keyway.obj", Arc::clone(&bytes))];
    let from_memory = Study::from_memory(&text, nowhere, &meshes).unwrap();
    let evaluated = |study: &Study| {
        let settings = study.problem().ranges.middle();
        let record = study.evaluate(&settings, 256, Extras::default(), &Control::default());
        let record = record.unwrap();
        (record.best, record.mesh_sha256)
    };
    assert_eq!(evaluated(&from_disk), evaluated(&from_memory));
    assert!(from_memory.clone().with_parry_rays().is_ok());

    // What is not among them is read from the disk, where there is nothing.
    let missing = Study::from_text(&text, nowhere).err().unwrap().to_string();
    assert!(missing.contains("hub-blind-keyway.obj"), "{missing}");
    let half = [("hub-blind-keyway.obj", bytes[..bytes.len() / 2].into())];
    let half = Study::from_memory(&text, nowhere, &half).err().unwrap();
    assert!(
        half.to_string().contains("hub-blind-keyway.obj, line"),
        "{half}"
    );
    let empty = [("hub-blind-keyway.obj", Arc::from([]))];
    let empty = Study::from_memory(&text, nowhere, &empty).err().unwrap();
    assert!(empty.to_string().contains("is empty"), "{empty}");
}

/// A point names the smooth face that it lies on, of a mesh without names as well; it lies on the drawing, of which the facets are a
/// little inside.
#[test]
fn a_point_names_the_face_that_it_lies_on() {
    let text = fs::read_to_string("problems/hub-blind-keyway.obj").unwrap();
    let unnamed: String = text
        .lines()
        .filter(|line| !line.starts_with("g "))
        .map(|line| format!("{line}\n"))
        .collect();
    let face = |name: &str, at: [f64; 3]| Region {
        name: name.to_owned(),
        place: RegionPlace::Face(Point3::from(at.map(|value| value * MILLIMETRE))),
    };
    let regions = [
        face("shaft", [25.0, 0.0, 30.0]),
        face("mouth", [0.0, -20.0, 60.0]),
        // Between fillets, into which they go over without an edge.
        face("bottom", [1.2, 18.3, 38.0]),
        face("side", [-4.0, 15.6, 38.0]),
    ];
    let (mesh, _) = read_bytes("obj", unnamed.as_bytes(), &regions).unwrap();
    let (named, _) = read_bytes("obj", text.as_bytes(), &[]).unwrap();
    let count = |mesh: &Mesh, name: &str| {
        let sizes = surface_sizes(mesh);
        sizes.iter().find(|(known, _)| *known == name).unwrap().1
    };
    assert_eq!(count(&mesh, "shaft"), count(&named, "outside"));
    assert_eq!(count(&mesh, "mouth"), count(&named, "face_far"));
    assert_eq!(count(&mesh, "bottom"), count(&named, "floor"));
    assert_eq!(count(&mesh, "side"), count(&named, "wall_neg"));
    assert_eq!(mesh.triangles.len(), named.triangles.len());
}
