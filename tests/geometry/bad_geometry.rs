//! Bad input through the program: exit status 2 (or 1 where the question is sound but has no
//! answer), a message that names the place, and never a panic.

use crate::common::program;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::common::program::Run;
use tempfile::TempDir;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn peenpose(arguments: &[&str], path: &Path) -> Run {
    let arguments = arguments.iter().map(OsStr::new);
    program::peenpose(arguments.chain([path.as_os_str()]), root())
}

/// A folder with a problem file and the meshes beside it.
struct Folder {
    folder: TempDir,
}

impl Folder {
    fn new() -> Self {
        let folder = TempDir::new().unwrap();
        for entry in root().join("tests/bad_geometry").read_dir().unwrap() {
            let path = entry.unwrap().path();
            if path
                .extension()
                .is_some_and(|ending| ending == "obj" || ending == "stl")
            {
                std::fs::copy(&path, folder.path().join(path.file_name().unwrap())).unwrap();
            }
        }
        Self { folder }
    }

    fn file(&self, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder.path().join("bad.yaml");
        std::fs::write(&path, content).unwrap();
        path
    }
}

/// `solve` and `check` refuse the text; both say where, and all of `words`.
fn refused(content: impl AsRef<[u8]>, line: Option<usize>, words: &[&str]) {
    let folder = Folder::new();
    let path = folder.file(content);
    for command in ["solve", "check"] {
        let run = peenpose(&[command], &path);
        assert_eq!(run.status, 2, "{command} {words:?}: {}", run.messages);
        assert_eq!(run.out, "", "{command}: {words:?}");
        for word in words {
            assert!(
                run.messages.contains(word),
                "{word:?} is not in:\n{}",
                run.messages
            );
        }
        if let Some(line) = line {
            let place = format!("{}:{line}:", path.display());
            let column = run
                .messages
                .split(&place)
                .nth(1)
                .unwrap_or_else(|| panic!("{words:?}: no place {place} in:\n{}", run.messages));
            assert!(column.starts_with(|c: char| c.is_ascii_digit()));
        }
    }
}

/// The text with the first `old` replaced, and the line in which that stands.
fn edited(text: &str, old: &str, new: &str) -> (String, usize) {
    let at = text.find(old).unwrap_or_else(|| panic!("no {old:?}"));
    let line = 1 + text[..at].matches('\n').count();
    (text.replacen(old, new, 1), line)
}

fn keyway() -> String {
    std::fs::read_to_string(root().join("problems/keyway.yaml")).unwrap()
}

fn mesh() -> String {
    std::fs::read_to_string(root().join("tests/bad_geometry/sound/plate.yaml")).unwrap()
}

#[test]
fn the_undamaged_files_are_sound() {
    for text in [keyway(), mesh()] {
        let folder = Folder::new();
        let run = peenpose(&["check"], &folder.file(text));
        assert_eq!(run.status, 0, "{}", run.messages);
    }
}

#[test]
fn files_that_are_no_problem() {
    refused("", Some(1), &["the file is empty"]);
    refused("# nothing but a comment\n", Some(1), &["empty"]);
    refused("- 1\n- 2\n", None, &["error"]);
    refused("just words\n", None, &["error"]);
    refused(
        "format: 1\n  title: [unclosed\n",
        None,
        &["error", "bad.yaml:"],
    );
    refused(b"format: 1\ntitle: \xff\xfe\n", Some(2), &["not UTF-8"]);
    refused(b"\x00\x01\x02\x03", None, &["error"]);
    refused(
        "format: 1\n",
        Some(1),
        &["scene", "target", "contacts", "settings"],
    );
    refused("x".repeat(1_000_001), None, &["too large"]);
    refused("[".repeat(100_000), None, &["error"]);
    refused("a: ".repeat(100_000), None, &["error"]);
}

#[test]
fn an_alias_bomb_does_not_go_off() {
    let mut bomb = String::from("format: 1\na0: &a0 [x, x, x, x, x, x, x, x, x]\n");
    for level in 1..20 {
        let below = format!("*a{}", level - 1);
        let list = [below.as_str(); 9].join(", ");
        bomb += &format!("a{level}: &a{level} [{list}]\n");
    }
    refused(bomb, None, &["error", "bad.yaml:"]);
}

#[test]
fn a_missing_file_and_a_folder() {
    for (path, words) in [
        ("no/such.yaml", "there is no such file"),
        ("src", "it is a folder"),
    ] {
        for command in ["solve", "check", "evaluate"] {
            let run = peenpose(&[command], &root().join(path));
            assert_eq!(run.status, 2);
            assert!(run.messages.contains(words), "{}", run.messages);
            assert!(run.messages.contains(path), "{}", run.messages);
        }
    }
}

#[test]
fn single_faults_of_a_keyway() {
    let cases: &[(&str, &str, &[&str])] = &[
        // old text, new text, what the message must say
        (
            "speed_spread: 5 %",
            "speed_spred: 5 %",
            &["speed_spred", "did you mean `speed_spread`"],
        ),
        (
            "radius: 0.5 mm",
            "radius: 0.5",
            &["shot.radius", "has no unit", "did you mean `0.5 mm`"],
        ),
        (
            "divergence: 4 deg",
            "divergence: 4 mm",
            &["jet.divergence", "is a length", "angle"],
        ),
        (
            "radius: 0.5 mm",
            "radius: -0.5 mm",
            &["shot.radius", "from 0.001 um"],
        ),
        ("radius: 0.5 mm", "radius: .nan mm", &["shot.radius"]),
        ("radius: 0.5 mm", "radius: 1e999 mm", &["shot.radius"]),
        ("bore: 30 mm", "bore: 0 mm", &["scene.hub.keyway.bore"]),
        (
            "width: 8 mm",
            "width: 31 mm",
            &["scene.hub.keyway.width", "as wide as the bore"],
        ),
        (
            "length: 40 mm }",
            "length: 40 mm, root_radius: 5 mm }",
            &["root_radius", "half the width"],
        ),
        ("[6 mm, 20 mm]", "[20 mm, 6 mm]", &["settings.standoff"]),
        (
            "[30 deg, 85 deg]",
            "[30 deg, 95 deg]",
            &["settings.incidence", "up to 90 deg"],
        ),
        (
            "[-90 deg, 90 deg]",
            "[-190 deg, 190 deg]",
            &["settings.azimuth", "full turn"],
        ),
        (
            "mu_d: 0.27",
            "mu_d: 0.37",
            &["contacts.dry.mu_d", "exceeds static friction 0.3"],
        ),
        (
            "restitution: 0.25",
            "restitution: 1.25",
            &["contacts.dry.restitution", "0 to 1"],
        ),
        (
            "hub.floor",
            "hub.flor",
            &["there is no surface", "did you mean `hub.floor`"],
        ),
        (
            "hub.floor",
            "hup.floor",
            &["there is no part `hup`", "did you mean `hub.floor`"],
        ),
        ("hub.floor", "hub", &["is a part, not a surface"]),
        (
            "{ min: [-3, 18, 15], max: [3, 19, 25] }",
            "{ min: [-3, 18, 150], max: [3, 19, 160] }",
            &["the target is empty", "z 0.000 to 40.000 mm"],
        ),
        (
            "aim: [0, 18.3, 20]",
            "aim: [0, 10, 20]",
            &["target.aim", "is not on the target"],
        ),
        (
            "aim: [0, 18.3, 20]",
            "aim: [0, 18.3, 30]",
            &["target.aim", "is not on the target"],
        ),
        (
            "along: [0, 0, 1]",
            "along: [0, 1, 0]",
            &["target.along", "is perpendicular"],
        ),
        ("along: [0, 0, 1]", "along: [0, 0, 0]", &["target.along"]),
        (
            "tolerance: { incidence: 2 deg",
            "tolerance: { incidence: 40 deg",
            &["tolerance.incidence", "is wider than the range"],
        ),
        (
            "contact: [dry, damp, oiled]",
            "contact: [dry, oild]",
            &["no contact `oild`", "did you mean `oiled`"],
        ),
        (
            "contact: [dry, damp, oiled]",
            "contact: []",
            &["names no contact"],
        ),
        ("lengths_in: mm", "lengths_in: furlong", &["lengths_in"]),
        ("format: 1", "format: 2", &["format"]),
        (
            "shot: { radius: 0.5 mm, density: 7000 kg/m3 }",
            "shot: 5",
            &["shot"],
        ),
        ("shot: {", "shot: { radius: 1 mm, ", &["radius", "twice"]),
        (
            "density: 7000 kg/m3",
            "density: [7000 kg/m3]",
            &["shot.density"],
        ),
        ("impacts: 6", "impacts: 0", &["paths.impacts"]),
        ("impacts: 6", "impacts: many", &["paths.impacts"]),
        ("accuracy: 1 %", "accuracy: 0 %", &["solve.accuracy"]),
        ("seed: 1", "seed: -1", &["solve.seed"]),
        (
            "target: 40 uN.s",
            "target: 0 uN.s",
            &["goals.normal_impulse.target"],
        ),
    ];
    let text = keyway();
    for (old, new, words) in cases {
        let (bad, line) = edited(&text, old, new);
        refused(bad, Some(line), words);
    }
}

#[test]
fn a_missing_key_is_named() {
    for (key, words) in [
        ("shot:", "shot"),
        ("settings:", "settings"),
        ("goals:", "goals"),
        ("contacts:", "contacts"),
    ] {
        let text = keyway();
        let kept: Vec<&str> = {
            let mut inside = false;
            let lines = text.lines().filter(|line| {
                if !line.starts_with([' ', '#']) && !line.is_empty() {
                    inside = line.starts_with(key);
                }
                !inside
            });
            lines.collect()
        };
        refused(kept.join("\n"), None, &[words, "missing"]);
    }
}

#[test]
fn single_faults_of_a_mesh() {
    let cases: &[(&str, &[&str])] = &[
        ("not-a-number.obj", &["not-a-number.obj", "not finite"]),
        (
            "no-triangles.obj",
            &["no-triangles.obj", "holds no triangles"],
        ),
        ("empty.obj", &["empty.obj", "is empty"]),
        ("needles.obj", &["needles.obj", "zero area"]),
        (
            "truncated.stl",
            &["truncated.stl", "promises 2 triangles, the file holds 1"],
        ),
        ("nowhere.obj", &["nowhere.obj", "there is no such file"]),
        ("bad.yaml", &["is not a mesh format"]),
        ("../plate.obj", &["leaves the folder"]),
        ("sub/../../plate.obj", &["leaves the folder"]),
        ("/etc/passwd", &["leaves the folder"]),
        (".", &["mesh"]),
    ];
    for (file, words) in cases {
        let (bad, line) = edited(&mesh(), "plate.obj", file);
        refused(bad, Some(line), words);
    }
    let (bad, line) = edited(&mesh(), "plate.top", "plate.topp");
    refused(
        bad,
        Some(line),
        &[
            "there is no surface `plate.topp`",
            "did you mean `plate.top`",
        ],
    );
    let (bad, line) = edited(
        &mesh(),
        "plate.obj }",
        "plate.obj, lengths_in: light_years }",
    );
    refused(bad, Some(line), &["lengths_in"]);
}

#[test]
fn an_unknown_surface_with_rules_of_its_own() {
    let text = mesh() + "surfaces: { plate.tip: { allow: 1 uN.s } }\n";
    let line = text.lines().count();
    refused(text, Some(line), &["plate.tip", "did you mean `plate.top`"]);
}

#[test]
fn a_target_that_deflects() {
    let rule = "surfaces: { hub.floor: { role: deflector } }\npaths:";
    let (text, line) = edited(&keyway(), "paths:", rule);
    refused(
        text,
        Some(line),
        &["surfaces.hub.floor.role", "this is the target"],
    );
}

#[test]
fn faults_of_several_blocks_come_in_one_run() {
    let text = std::fs::read_to_string(root().join("tests/bad_geometry/several.yaml")).unwrap();
    let folder = Folder::new();
    let path = folder.file(&text);
    let run = peenpose(&["check"], &path);
    assert_eq!(run.status, 2);
    // Blocks of messages, in the order of the text.
    let messages: Vec<&str> = run.messages.split("error: ").skip(1).collect();
    let expected = [
        ("housing:", "there is no such file"),
        ("lid:", "not finite"),
        ("target:", "did you mean `plate.top`"),
        ("jet:", "has no unit"),
    ];
    assert_eq!(messages.len(), expected.len(), "{}", run.messages);
    for (message, (start, words)) in messages.iter().zip(expected) {
        let at = text.lines().position(|line| line.trim().starts_with(start));
        let place = format!("{}:{}:", path.display(), 1 + at.unwrap());
        assert!(message.contains(&place), "no {place} in:\n{message}");
        assert!(message.contains(words), "no {words:?} in:\n{message}");
    }
}

#[test]
fn a_nozzle_that_fits_nowhere_is_an_answer() {
    let (text, _) = edited(
        &keyway(),
        "standoff: [6 mm, 20 mm]",
        "standoff: [1 mm, 2 mm]",
    );
    let text = text.replace("standoff: 1 mm, speed: 3 %", "standoff: 0.1 mm, speed: 3 %");
    let folder = Folder::new();
    let path = folder.file(text);
    let out = folder.folder.path().join("results");
    let run = peenpose(&["solve", "--json", "--out", out.to_str().unwrap()], &path);
    assert_eq!(run.status, 1, "{}", run.messages);
    let record = run.json();
    assert_eq!(record["status"], "no_feasible_pose");
    assert_eq!(record["choices"].as_array().unwrap().len(), 3);
    for answer in record["choices"].as_array().unwrap() {
        assert_eq!(answer["feasible"], false);
        assert_eq!(answer["passes"], false);
        assert!(answer["clearance_m"].as_f64().unwrap() < 0.0);
        assert!(
            answer["clearance_surface"]
                .as_str()
                .unwrap()
                .starts_with("hub.")
        );
        let standoff = answer["settings"]["standoff_m"].as_f64().unwrap();
        assert!((1e-3..=2e-3).contains(&standoff));
        assert_eq!(answer["pose"]["exit_m"].as_array().unwrap().len(), 3);
    }
    assert_eq!(record["windows"].as_array().unwrap().len(), 0);
    let sheet = std::fs::read_to_string(out.join("sheet.txt")).unwrap();
    assert!(!sheet.trim().is_empty());
    assert_eq!(
        std::fs::read_to_string(out.join("result.json")).unwrap(),
        run.out
    );
}
