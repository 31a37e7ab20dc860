//! Bad files: each says what its comments announce, and every rule is broken by one of them.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use crate::common::announced;
use peenpose::problem::change::Change;
use peenpose::problem::fault_code::FaultCode;
use peenpose::problem::size::{LONGEST_KEY, LONGEST_TEXT, MOST_ITEMS};
use peenpose::scenario::{Rejection, Scenario};
use peenpose::scene::mesh_file::{LARGEST_FILE, LONGEST_NAME, MOST_CORNERS, MOST_SURFACES};
use peenpose::study::Study;

/// Problem files with faults of the file, and with faults of its parts and meshes.
const FOLDERS: [&str; 2] = ["tests/bad", "tests/bad_geometry"];

fn bad_files() -> Vec<PathBuf> {
    let entries = FOLDERS.map(|folder| fs::read_dir(folder).unwrap());
    let paths = entries.into_iter().flatten().map(|it| it.unwrap().path());
    let is_problem = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "yaml");
    let mut files: Vec<PathBuf> = paths.filter(is_problem).collect();
    files.sort();
    files
}

fn rejection(path: &Path) -> Box<Rejection> {
    let refused = Scenario::load(path).err();
    refused.unwrap_or_else(|| panic!("{} is sound", path.display()))
}

#[test]
fn bad_files_say_what_their_comments_announce() {
    for path in bad_files() {
        let rejection = rejection(&path);
        let found: Vec<_> = rejection
            .faults
            .iter()
            .map(|fault| {
                let at = fault.at.unwrap();
                (at.line, at.column, fault.to_string())
            })
            .collect();
        let bytes = fs::read(&path).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        let text = text.trim_start_matches('\u{feff}');
        assert_eq!(found, announced(text), "{}", path.display());
        assert!(!found.is_empty(), "{}", path.display());
        // What is shown of a fault holds its place and what is wrong.
        let shown = rejection.render(false);
        for ((line, column, _), fault) in found.iter().zip(&rejection.faults) {
            let place = format!("{}:{line}:{column}\n", path.display());
            assert!(shown.contains(&place), "{place} is not in:\n{shown}");
            assert!(
                shown.contains(&fault.message),
                "{fault} is not in:\n{shown}"
            );
        }
    }
}

#[test]
fn no_mistake_is_reported_twice() {
    let mut mistakes = BTreeSet::new();
    for path in bad_files() {
        let mut in_file = BTreeSet::new();
        for fault in rejection(&path).faults {
            let place = fault.at.map(|at| (at.start, at.end));
            let is_new = in_file.insert((fault.key.clone(), fault.rule, place));
            assert!(is_new, "{}: {fault}", path.display());
            mistakes.insert((fault.rule, fault.key, fault.message));
        }
    }
    assert!(mistakes.len() >= 400, "{}", mistakes.len());
}

/// A binary STL of two triangles with bytes between them that no attribute counts.
fn with_loose_bytes() -> Vec<u8> {
    let mut bytes = [vec![b' '; 80], 2_u32.to_le_bytes().to_vec()].concat();
    for height in [1.0_f32, 2.0] {
        let normal = [0.0, 0.0, 1.0];
        let corners = [0.0, 0.0, height, 1.0, 0.0, height, 0.0, 1.0, height];
        bytes.extend(
            normal
                .iter()
                .chain(&corners)
                .flat_map(|it| it.to_le_bytes()),
        );
        bytes.extend([0, 0]);
        bytes.extend(*b"loose by");
    }
    bytes
}

/// The rules that are broken by files too large to keep, or by none.
fn broken_by_made_files() -> Vec<FaultCode> {
    let folder = tempfile::tempdir().unwrap();
    let problem = fs::read_to_string("tests/bad_geometry/sound/plate.yaml").unwrap();
    let path = folder.path().join("problem.yaml");
    fs::write(&path, &problem).unwrap();
    let mesh = folder.path().join("plate.obj");
    let mut broken = Vec::new();
    let mut load = |path: &Path| broken.extend(rejection(path).faults.iter().map(|it| it.rule));

    load(&folder.path().join("none.yaml"));
    File::create(&mesh)
        .and_then(|file| file.set_len(LARGEST_FILE + 1))
        .unwrap();
    load(&path);
    fs::write(&mesh, "0".repeat(1 << 19)).unwrap();
    load(&path);
    let face = " 1 2 3".repeat(MOST_CORNERS);
    fs::write(&mesh, format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf{face}\n")).unwrap();
    load(&path);
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let group = |number: usize| {
        let (row, column) = (number / 100, number % 100);
        format!("v {row} {column} 1\ng g{number}\nf 1 2 -1\n")
    };
    let groups: String = (0..=MOST_SURFACES).map(group).collect();
    fs::write(&mesh, format!("{points}{groups}")).unwrap();
    load(&path);
    let name = "g".repeat(LONGEST_NAME + 1);
    fs::write(&mesh, format!("{points}g {name}\nf 1 2 3\n")).unwrap();
    load(&path);
    let stl = folder.path().join("plate.stl");
    fs::write(&stl, with_loose_bytes()).unwrap();
    fs::write(&path, problem.replace("plate.obj", "plate.stl")).unwrap();
    load(&path);
    let too_long = [
        "#".repeat(1_000_001),
        format!("contacts: [{}]", "1,".repeat(MOST_ITEMS + 1)),
        format!("{}: 1", "k".repeat(LONGEST_KEY + 1)),
        format!("title: {}", "t".repeat(LONGEST_TEXT + 1)),
    ];
    for text in too_long {
        fs::write(&path, text).unwrap();
        load(&path);
    }
    let change = Change::new("target.surface[0]", "1").unwrap();
    let rejection = Study::open_changed(Path::new(KEYWAY), &[change])
        .err()
        .unwrap();
    broken.extend(rejection.faults.iter().map(|it| it.rule));
    broken
}

const KEYWAY: &str = "problems/keyway.yaml";

/// What takes gigabytes or minutes to break.
const TOO_DEAR_TO_BREAK: [FaultCode; 2] =
    [FaultCode::SceneTooLarge, FaultCode::MeshFacesTooWinding];

#[test]
fn every_rule_is_broken_by_a_bad_file() {
    let mut broken: BTreeSet<FaultCode> = broken_by_made_files().into_iter().collect();
    for path in bad_files() {
        broken.extend(rejection(&path).faults.iter().map(|fault| fault.rule));
    }
    let rules: BTreeSet<FaultCode> = FaultCode::ALL.iter().copied().collect();
    let unbroken: Vec<&FaultCode> = rules.difference(&broken).collect();
    assert!(
        unbroken.iter().copied().eq(&TOO_DEAR_TO_BREAK),
        "no bad file breaks {unbroken:?}"
    );
}
