//! What other programs are given, read back.

use peenpose::evidence::Evidence;
use peenpose::problem::setting::Settings;
use peenpose::record::{EvidenceRecord, Record, RoleRecord};
use peenpose::report::export::{Format, export};
use peenpose::scene::mesh_file;
use tempfile::TempDir;

use crate::common::shipped;

/// A record with a deflector, and with rebounds and paths that break a limit.
fn record() -> Record {
    let scenario = shipped::scenario("deflector.yaml");
    let text = std::fs::read_to_string("tests/data/sheets/keyway.json").unwrap();
    let mut record = Record::from_json(&text).unwrap();
    let settings = Settings {
        speed: 46.0,
        ..scenario.problem.ranges.middle()
    };
    let evidence = Evidence::of(
        &scenario,
        &settings,
        3000,
        &peenpose::control::Cancel::default(),
    );
    record.evidence = Some(EvidenceRecord::new(&scenario, &settings, &evidence));
    record
}

fn exported(record: &Record, format: Format) -> Vec<u8> {
    export(record, format).expect("evidence").unwrap()
}

fn triangles(evidence: &EvidenceRecord) -> usize {
    evidence
        .surfaces
        .iter()
        .map(|shape| shape.triangles.len())
        .sum()
}

/// Of a rod with round ends; a ball has no rod between them, and no pole has quads.
const TRIANGLES_OF_A_CAPSULE: usize = 2 * 32 * 17 - 2 * 32;

fn segments(evidence: &EvidenceRecord) -> usize {
    evidence
        .paths
        .iter()
        .map(|path| path.points_m.len() - 1)
        .sum()
}

#[test]
fn glb_is_sound_and_holds_everything() {
    let record = record();
    let evidence = record.evidence.as_ref().unwrap();
    let bytes = exported(&record, Format::Glb);
    let file = gltf::Gltf::from_slice(&bytes).expect("a valid file");
    let blob = file.blob.as_ref().unwrap();
    let buffer = file.buffers().next().unwrap();
    assert!(blob.len() >= buffer.length() && blob.len() < buffer.length() + 4);
    let names: Vec<&str> = file.nodes().map(|node| node.name().unwrap()).collect();
    for name in [
        "hole.wall (target)",
        "hole.wall",
        "pin.cut (deflector)",
        "nozzle, body 2",
        "hits",
    ] {
        assert!(names.contains(&name), "{name}: {names:?}");
    }
    assert_eq!(file.default_scene().unwrap().nodes().count(), names.len());
    let (mut faces, mut lines, mut points) = (0, 0, 0);
    for mesh in file.meshes() {
        let primitive = mesh.primitives().next().unwrap();
        let material = primitive.material();
        assert!(material.double_sided());
        // One sees through secondary surfaces, and through nothing else.
        let name = mesh.name().unwrap();
        let opacity = material.pbr_metallic_roughness().base_color_factor()[3];
        assert_eq!(
            opacity < 1.0,
            ["hole.wall", "hole.far"].contains(&name),
            "{name}"
        );
        let reader = primitive.reader(|_| Some(blob));
        let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        let bounds = primitive.bounding_box();
        for axis in 0..3 {
            let of_axis = || positions.iter().map(|p| p[axis]);
            assert_eq!(of_axis().fold(f32::INFINITY, f32::min), bounds.min[axis]);
            assert_eq!(
                of_axis().fold(f32::NEG_INFINITY, f32::max),
                bounds.max[axis]
            );
        }
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => Vec::new(),
        };
        assert!(
            indices
                .iter()
                .all(|&index| (index as usize) < positions.len())
        );
        match primitive.mode() {
            gltf::mesh::Mode::Triangles => faces += indices.len() / 3,
            gltf::mesh::Mode::Lines => lines += indices.len() / 2,
            gltf::mesh::Mode::Points => {
                assert_eq!(positions, evidence.hits.points_m);
                points += positions.len();
            }
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(faces, triangles(evidence) + 2 * TRIANGLES_OF_A_CAPSULE);
    assert_eq!(
        (lines, points),
        (segments(evidence), evidence.hits.points_m.len())
    );
}

#[test]
fn paths_have_the_colour_of_their_bounce() {
    let record = record();
    let evidence = record.evidence.as_ref().unwrap();
    let bytes = exported(&record, Format::Glb);
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let lines = |name: &str| {
        let mesh = file.meshes().find(|mesh| mesh.name() == Some(name));
        let primitive = mesh.unwrap().primitives().next().unwrap();
        primitive.indices().unwrap().count() / 2
    };
    let is_deflector = |name: &str| {
        let mut shapes = evidence.surfaces.iter();
        shapes.any(|shape| shape.name == name && shape.role == RoleRecord::Deflector)
    };
    // To the first hit: from the exit over the pin to the wall.
    let to_first: usize = evidence
        .paths
        .iter()
        .filter(|path| !path.breaks)
        .map(|path| {
            let deflected = path.impacts.iter().take_while(|i| is_deflector(&i.surface));
            deflected.count() + 1
        })
        .sum();
    assert_eq!(lines("paths to the first hit"), to_first);
    let breaking = evidence.paths.iter().filter(|path| path.breaks);
    let red: usize = breaking.map(|path| path.points_m.len() - 1).sum();
    assert!(red > 0);
    assert_eq!(lines("paths that break a limit"), red);
}

/// The numbers that follow a keyword in a VTK file, and those on the line of the keyword.
fn section(text: &str, keyword: &str, skip: usize) -> (Vec<usize>, Vec<f64>) {
    let mut lines = text.lines().skip_while(|line| !line.starts_with(keyword));
    let sizes = lines.next().expect(keyword).split_whitespace();
    let sizes = sizes.filter_map(|word| word.parse().ok()).collect();
    let lines = lines.skip(skip);
    let rows = lines.map_while(|line| {
        let numbers = line.split_whitespace().map(str::parse::<f64>);
        numbers.collect::<Result<Vec<f64>, _>>().ok()
    });
    (sizes, rows.flatten().collect())
}

#[test]
fn vtk_is_sound_and_holds_everything() {
    let record = record();
    let evidence = record.evidence.as_ref().unwrap();
    let text = String::from_utf8(exported(&record, Format::Vtk)).unwrap();
    let title = text.lines().nth(1).unwrap();
    assert!(title.contains("coordinates in m") && title.len() < 256);
    let (sizes, coordinates) = section(&text, "POINTS", 0);
    assert_eq!(coordinates.len(), 3 * sizes[0]);
    let mut cells = 0;
    let expected = [
        ("VERTICES", 1, evidence.hits.points_m.len()),
        ("LINES", 2, segments(evidence)),
        (
            "POLYGONS",
            3,
            triangles(evidence) + 2 * TRIANGLES_OF_A_CAPSULE,
        ),
    ];
    for (keyword, corners, count) in expected {
        let (header, numbers) = section(&text, keyword, 0);
        assert_eq!(header, [count, count * (corners + 1)], "{keyword}");
        assert_eq!(numbers.len(), header[1]);
        for cell in numbers.chunks(corners + 1) {
            assert_eq!(cell[0], corners as f64);
            assert!(cell[1..].iter().all(|&index| (index as usize) < sizes[0]));
        }
        cells += count;
    }
    assert!(text.contains(&format!("\nCELL_DATA {cells}\n")));
    let (_, pieces) = section(&text, "SCALARS piece", 1);
    let (_, impulses) = section(&text, "SCALARS normal_impulse_N_s", 1);
    assert_eq!((pieces.len(), impulses.len()), (cells, cells));
    let names = text.lines().filter(|line| line.contains("%20"));
    assert!(names.count() > 5);
    // The hits come first.
    for (kept, written) in evidence.hits.normal_impulse.iter().zip(&impulses) {
        assert_eq!(*kept, *written as f32);
    }
}

#[test]
fn ply_can_be_a_part_of_a_problem_again() {
    let record = record();
    let evidence = record.evidence.as_ref().unwrap();
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.ply");
    let bytes = exported(&record, Format::Ply);
    std::fs::write(&path, &bytes).unwrap();
    let (mesh, _) = mesh_file::read(&path, 1.0, &[]).unwrap();
    let count = triangles(evidence) + 2 * TRIANGLES_OF_A_CAPSULE;
    assert_eq!(mesh.triangles.len(), count);
    let (low, high) = mesh.bounds().unwrap();
    // The lance sticks out of the bore, which is 48 mm deep.
    assert!(
        (high.z - 0.048).abs() < 1e-6 && low.z < -0.02,
        "{low} {high}"
    );
    let header = String::from_utf8_lossy(&bytes[..400]).into_owned();
    assert!(header.contains("comment coordinates in m\n"));
    let hits = evidence.hits.points_m.len();
    let vertices = header.split("element vertex ").nth(1).unwrap();
    let vertices: usize = vertices.split_whitespace().next().unwrap().parse().unwrap();
    assert!(vertices > hits + mesh.vertices.len() - 1);
}

#[test]
fn a_record_without_evidence_has_nothing_to_export() {
    let mut record = record();
    record.evidence = None;
    for format in Format::ALL {
        assert!(export(&record, format).is_none());
    }
    assert_eq!(Format::with_ending("GLB"), Some(Format::Glb));
    assert_eq!(Format::with_ending("stl"), None);
}

#[test]
fn corners_and_impulses_that_a_record_does_not_have_are_left_out() {
    let sound = record();
    let mut odd = record();
    let evidence = odd.evidence.as_mut().unwrap();
    let points = evidence.surfaces[0].points_m.len() as u32;
    evidence.surfaces[0]
        .triangles
        .extend([[0, 1, points], [u32::MAX, 0, 1]]);
    evidence.hits.normal_impulse.push(1.0);
    for format in Format::ALL {
        assert!(
            exported(&odd, format) == exported(&sound, format),
            "{format:?}"
        );
    }
}
