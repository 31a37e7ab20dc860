//! Files as people have them: meshes that other programs wrote, units of the shop, characters from text
//! processors. Each is read, or refused with its true reason.

use crate::common::program;
use std::path::Path;

use peenpose::scenario::Scenario;

/// What comes of a file.
enum Outcome {
    /// It is read; a warning holds these words where there are any.
    Read(&'static str),
    /// It is refused in these words.
    Refused(&'static str),
}

use Outcome::{Read, Refused};

const FILES: [(&str, Outcome); 21] = [
    ("crk_0.0001", Read("within the precision of the file")),
    ("far_same", Read("")),
    ("far_ulp", Read("within the precision of the file")),
    ("inch_pose", Read("")),
    ("inch_within", Refused(" in")),
    ("nbsp_plain_number", Read("")),
    ("obj_cr", Read("")),
    (
        "obj_o_g_default",
        Read("the names of the file's objects (`o`)"),
    ),
    ("obj_trailing_bs", Read("")),
    (
        "obj_usemtl",
        Read("the names of the file's materials (`usemtl`)"),
    ),
    (
        "stl_attr_payload",
        Read("a program keeps for itself between the triangles"),
    ),
    ("stl_bom", Read("")),
    ("stl_count0_bin", Read("the header promises 0 triangles")),
    ("stl_cr", Read("")),
    ("stl_endsolid_glued", Read("")),
    ("stl_gzip", Refused("this is a gzip archive: unpack it")),
    (
        "stl_same_names",
        Read("solids of the same name are one surface: `ascii`"),
    ),
    (
        "stl_tail10_bin",
        Read("10 bytes behind the last triangle are passed over"),
    ),
    ("stl_utf16", Read("the file is UTF-16 text")),
    ("unicode_minus", Read("")),
    (
        "unit_behind_list",
        Refused("units belong to each number: [-90 deg, 90 deg]"),
    ),
];

#[test]
fn each_file_is_read_or_refused_with_its_true_reason() {
    for (name, outcome) in FILES {
        let path = format!("tests/found/{name}.yaml");
        match (outcome, Scenario::load(path.as_ref())) {
            (Read(words), Ok((scenario, _))) => {
                let warnings = scenario.scene.warnings().join("\n");
                assert!(warnings.contains(words), "{name}: {warnings}");
                assert!(
                    !words.is_empty() || warnings.is_empty(),
                    "{name}: {warnings}"
                );
            }
            (Refused(words), Err(rejection)) => {
                let told = rejection.to_string();
                assert!(told.contains(words), "{name}: {told}");
            }
            (Read(_), Err(rejection)) => panic!("{name}: {rejection}"),
            (Refused(words), Ok(_)) => panic!("{name} is read; expected: {words}"),
        }
    }
}

/// The same slot from all of these files, and the jet comes from above it.
#[test]
fn meshes_that_are_read_are_peened_from_the_free_side() {
    for name in [
        "crk_0.0001",
        "far_same",
        "far_ulp",
        "obj_cr",
        "obj_usemtl",
        "stl_same_names",
    ] {
        let path = format!("tests/found/{name}.yaml");
        let (scenario, _) = Scenario::load(path.as_ref()).expect("it is sound");
        let up = scenario.target.frame.normal.y;
        assert!(up > 0.999_999, "{name}: {up}");
    }
}

/// Lengths of the file are said in its unit.
#[test]
fn places_are_told_in_the_unit_of_the_file() {
    let run =
        |arguments: &[&str]| program::peenpose(arguments, Path::new(env!("CARGO_MANIFEST_DIR")));
    let sheet = run(&["solve", "tests/found/inch_pose.yaml"]);
    let exit = sheet.out.lines().find(|line| line.contains("exit point"));
    let exit = exit.expect("it is on the sheet");
    assert!(exit.ends_with(" in"), "{exit}");
    let told = run(&["check", "tests/found/inch_within.yaml"]);
    assert!(!told.messages.contains(" mm"), "{}", told.messages);
}
