//! The program from outside: exit status, what goes to stdout and stderr, files, arguments.

use crate::common::program;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::common::program::{GOOD, Run};
use serde_json::{Value, json};
use tempfile::TempDir;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn peenpose(arguments: &[&str]) -> Run {
    program::peenpose(arguments, root())
}

/// The run must be refused: status 2, nothing on stdout, all of `words` on stderr.
fn refused(arguments: &[&str], words: &[&str]) {
    let run = peenpose(arguments);
    assert_eq!(run.status, 2, "{arguments:?}: {}", run.messages);
    assert_eq!(run.out, "", "{arguments:?}");
    for word in words {
        assert!(
            run.messages.contains(word),
            "{word:?} is not in:\n{}",
            run.messages
        );
    }
}

const KEYWAY: &str = "problems/keyway.yaml";
const PLATE: &str = "problems/plate.yaml";

fn evaluate(file: &str, settings: &[&str], more: &[&str]) -> Run {
    let arguments: Vec<&str> = ["evaluate", file]
        .iter()
        .chain(settings)
        .chain(more)
        .copied()
        .collect();
    peenpose(&arguments)
}

fn number(value: &Value, path: &str) -> f64 {
    value
        .pointer(path)
        .unwrap_or_else(|| panic!("no {path}"))
        .as_f64()
        .unwrap_or_else(|| panic!("{path} is no number"))
}

fn problem_files() -> Vec<String> {
    yaml_files("problems")
}

fn yaml_files(folder: &str) -> Vec<String> {
    let entries = root().join(folder).read_dir().unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut files: Vec<String> = paths
        .filter(|path| path.extension().is_some_and(|ending| ending == "yaml"))
        .map(|path| path.to_str().unwrap().to_owned())
        .collect();
    files.sort();
    files
}

#[test]
fn a_solution_as_json_has_every_key() {
    let run = peenpose(&["solve", KEYWAY, "--json"]);
    assert_eq!((run.status, run.messages.as_str()), (0, ""));
    let record = run.json();
    assert_eq!(record["status"], "converged");
    assert_eq!(record["version"], env!("CARGO_PKG_VERSION"));
    let sum = record["problem_sha256"].as_str().unwrap();
    assert!(sum.len() == 64 && sum.bytes().all(|digit| digit.is_ascii_hexdigit()));
    for key in ["poses", "shots_per_pose", "rays", "seconds"] {
        assert!(number(&record, &format!("/work/{key}")) > 0.0);
    }
    let choices = record["choices"].as_array().unwrap();
    assert_eq!(choices.len(), 3);
    assert_eq!(record["best"], choices[0]);
    let totals: Vec<f64> = choices
        .iter()
        .map(|c| number(c, "/objective/total"))
        .collect();
    // Contacts that tie within the accuracy asked for come in the order of the file.
    let tie = 1.02;
    assert!(totals.is_sorted_by(|a, b| *a <= b * tie), "{totals:?}");
    for answer in choices {
        complete_answer(answer);
    }
}

fn complete_answer(answer: &Value) {
    assert!(["dry", "damp", "oiled"].contains(&answer["contact"].as_str().unwrap()));
    for (key, range) in [
        ("incidence_deg", 30.0..=85.0),
        ("azimuth_deg", -90.0..=90.0),
        ("standoff_m", 6e-3..=20e-3),
        ("speed_m_s", 5.0..=40.0),
    ] {
        let value = number(answer, &format!("/settings/{key}"));
        assert!(range.contains(&value), "{key} {value}");
    }
    let vector = |path: &str, count: usize| -> Vec<f64> {
        let list = answer.pointer(path).unwrap().as_array().unwrap();
        assert_eq!(list.len(), count, "{path}");
        list.iter().map(|value| value.as_f64().unwrap()).collect()
    };
    let (exit, direction) = (vector("/pose/exit_m", 3), vector("/pose/direction", 3));
    let [x, y, z, w] = vector("/pose/quaternion_xyzw", 4)[..] else {
        panic!("four numbers");
    };
    // The exit lies a standoff before the aim point.
    let standoff = number(answer, "/settings/standoff_m");
    for (axis, aim) in [0.0, 18.3e-3, 20e-3].into_iter().enumerate() {
        assert!((exit[axis] + standoff * direction[axis] - aim).abs() < 1e-12);
    }
    // The quaternion turns the z axis to the direction of the jet.
    let turned = [
        2.0 * (x * z + w * y),
        2.0 * (y * z - w * x),
        1.0 - 2.0 * (x * x + y * y),
    ];
    for axis in 0..3 {
        assert!((turned[axis] - direction[axis]).abs() < 1e-12);
    }
    assert!((x * x + y * y + z * z + w * w - 1.0).abs() < 1e-12);
    let terms = ["normal_impulse", "tangential_impulse", "rebound", "miss"];
    let sum: f64 = terms
        .iter()
        .map(|term| number(answer, &format!("/objective/{term}")))
        .sum();
    let total = number(answer, "/objective/total");
    assert!((sum - total).abs() <= 1e-12 * total);
    let error = number(answer, "/objective/standard_error");
    assert!(error > 0.0 && error < 0.02 * total, "{error}");
    assert!(number(answer, "/clearance_m") >= 0.0);
    assert_eq!(answer["target"]["surface"], "hub.floor");
    let surfaces: Vec<&String> = answer["surfaces"].as_object().unwrap().keys().collect();
    assert_eq!(
        surfaces,
        ["hub.bore", "hub.floor", "hub.wall_neg", "hub.wall_pos"]
    );
    // One verdict for each goal and each secondary surface.
    let subjects: Vec<&str> = answer["verdicts"]
        .as_array()
        .unwrap()
        .iter()
        .map(|verdict| verdict["subject"].as_str().unwrap())
        .collect();
    for subject in [
        "normal_impulse",
        "tangential_impulse",
        "miss",
        "hub.bore",
        "hub.floor",
    ] {
        assert!(subjects.contains(&subject), "{subjects:?}");
    }
    assert_eq!(answer["passes"], true);
}

#[test]
fn the_status_says_whether_the_answer_passes() {
    assert_eq!(evaluate(KEYWAY, &GOOD, &[]).status, 0);
    // Twice the speed gives twice the impulse.
    let fast = evaluate(KEYWAY, &GOOD, &["--set", "speed=20m/s", "--json"]);
    assert_eq!((fast.status, fast.messages.as_str()), (1, ""));
    assert_eq!(fast.json()["best"]["passes"], false);
    refused(&["evaluate", KEYWAY, "--set", "speed=20"], &["has no unit"]);
}

#[test]
fn a_nozzle_in_the_wall_does_not_pass() {
    // At 3 mm the ball of 3 mm reaches below the floor; the jet itself is fine.
    let run = evaluate(KEYWAY, &GOOD, &["--set", "standoff=3mm", "--json"]);
    let best = &run.json()["best"];
    assert!(number(best, "/clearance_m") < 0.0);
    assert_eq!(best["feasible"], false);
    let verdicts = best["verdicts"].as_array().unwrap();
    let fails = |verdict: &&Value| verdict["passes"] == false;
    let failing: Vec<&Value> = verdicts.iter().filter(fails).collect();
    assert_eq!(failing.len(), 1);
    assert_eq!(failing[0]["subject"], "clearance");
    assert_eq!(best["passes"], false);
    assert_eq!(run.status, 1);
}

#[test]
fn the_sheet_goes_to_stdout() {
    let run = peenpose(&["solve", PLATE]);
    assert_eq!((run.status, run.messages.as_str()), (0, ""));
    assert!(!run.out.trim().is_empty());
    assert!(serde_json::from_str::<Value>(&run.out).is_err());
}

/// What `--out` writes for the plate, by name; its shots are all the same, so there is no figure of them.
const RESULTS: [&str; 11] = [
    "choices.csv",
    "hits.csv",
    "places.csv",
    "pose.csv",
    "rebounds.csv",
    "report.html",
    "result.json",
    "sheet.txt",
    "surfaces.csv",
    "verdicts.csv",
    "windows.csv",
];

#[test]
fn a_folder_gets_all_results_and_nothing_else() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("new/folder");
    let arguments = ["solve", PLATE, "--json", "--out", out.to_str().unwrap()];
    let run = peenpose(&arguments);
    assert_eq!((run.status, run.messages.as_str()), (0, ""));
    let names = || {
        let entries = out.read_dir().unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    };
    assert_eq!(names(), RESULTS);
    let written = std::fs::read_to_string(out.join("result.json")).unwrap();
    assert_eq!(written, run.out);
    let sheet = std::fs::read_to_string(out.join("sheet.txt")).unwrap();
    assert!(sheet.contains("All shots are the same: they hit plate.z_max first and grip."));
    assert!(sheet.contains("figures from 1 validation shot, which"));
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("Every setting is held at one value in the file."));
    // Again, over the old files.
    std::fs::write(out.join("result.json"), "old").unwrap();
    assert_eq!(peenpose(&arguments).status, 0);
    assert_eq!(names(), RESULTS);
    assert_ne!(
        std::fs::read_to_string(out.join("result.json")).unwrap(),
        "old"
    );
}

#[test]
fn reports_are_made_again_from_the_result_alone() {
    let folder = TempDir::new().unwrap();
    let (first, second) = (folder.path().join("first"), folder.path().join("second"));
    peenpose(&["solve", KEYWAY, "--out", first.to_str().unwrap()]);
    std::fs::create_dir(&second).unwrap();
    std::fs::copy(first.join("result.json"), second.join("result.json")).unwrap();
    let run = peenpose(&["report", second.to_str().unwrap()]);
    assert_eq!((run.status, run.messages.as_str()), (0, ""));
    let entries = first.read_dir().unwrap();
    let names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert!(names.iter().any(|name| name == "hits.svg"));
    for name in names {
        let [made, again] =
            [&first, &second].map(|folder| std::fs::read(folder.join(&name)).unwrap());
        assert!(made == again, "{name} differs");
        let path = second.join(&name).display().to_string();
        assert_eq!(
            run.out.lines().any(|line| line == path),
            name != "result.json"
        );
    }
}

#[test]
fn reports_of_older_results_are_fewer() {
    let folder = TempDir::new().unwrap();
    let old = root().join("tests/data/sheets/keyway.json");
    std::fs::copy(old, folder.path().join("result.json")).unwrap();
    let run = peenpose(&["report", folder.path().to_str().unwrap()]);
    assert_eq!(run.status, 0);
    assert!(
        run.messages.contains("holds no hits, rebounds and places"),
        "{}",
        run.messages
    );
    assert!(folder.path().join("surfaces.csv").exists());
    assert!(folder.path().join("report.html").exists());
    for name in ["hits.csv", "hits.svg", "rebounds.csv", "places.csv"] {
        assert!(!folder.path().join(name).exists());
    }
    let kept = std::fs::read_to_string(root().join("tests/data/sheets/keyway.txt")).unwrap();
    let sheet = std::fs::read_to_string(folder.path().join("sheet.txt")).unwrap();
    assert_eq!(sheet, kept);
    let export = folder.path().join("scene.glb");
    refused(
        &[
            "export",
            folder.path().to_str().unwrap(),
            "--out",
            export.to_str().unwrap(),
        ],
        &["holds no surfaces, paths and hits"],
    );
    assert!(!export.exists());
}

#[test]
fn reports_need_a_result() {
    let folder = TempDir::new().unwrap();
    let missing = folder.path().join("nowhere");
    refused(
        &["report", missing.to_str().unwrap()],
        &["cannot read", "nowhere"],
    );
    let path = folder.path().to_str().unwrap();
    refused(&["report", path], &["cannot read", "result.json"]);
    std::fs::write(folder.path().join("result.json"), "{}").unwrap();
    refused(
        &["report", path],
        &["result.json is not a result", "missing field"],
    );
}

#[test]
fn results_are_exported_for_other_programs() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().to_str().unwrap();
    peenpose(&["solve", PLATE, "--out", path]);
    for (name, start) in [("a.glb", "glTF"), ("b.vtk", "# vtk"), ("c.PLY", "ply")] {
        let file = folder.path().join("new").join(name);
        let run = peenpose(&["export", path, "--out", file.to_str().unwrap()]);
        assert_eq!((run.status, run.messages.as_str()), (0, ""));
        assert!(std::fs::read(&file).unwrap().starts_with(start.as_bytes()));
    }
    let result = folder.path().join("result.json");
    for name in ["scene.stl", "scene", ".glb"] {
        refused(
            &["export", result.to_str().unwrap(), "--out", name],
            &[name, "ends with one of .glb, .vtk, .ply"],
        );
    }
}

/// The rows of a table by the names of its columns.
fn table(path: &Path) -> Vec<std::collections::HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.deserialize().map(|row| row.unwrap()).collect()
}

#[test]
fn tables_say_what_the_result_says() {
    let (folder, _, record) = solved();
    let table = |name: &str| table(&folder.path().join(name).with_extension("csv"));
    let number = |text: &str| text.parse::<f64>().unwrap();
    for (row, verdict) in table("verdicts")
        .iter()
        .zip(record["best"]["verdicts"].as_array().unwrap())
    {
        assert_eq!(verdict["subject"], row["subject"].as_str());
        assert_eq!(verdict["share"].as_f64(), Some(number(&row["share"])));
    }
    let choices = table("choices");
    assert_eq!(choices.len(), 3);
    assert_eq!(record["best"]["contact"], choices[0]["contact"].as_str());
    assert_eq!(
        record["best"]["settings"]["speed_m_s"].as_f64(),
        Some(number(&choices[0]["speed_m_s"]))
    );
    // The matrix takes the origin to the exit and z to the axis, and is a rotation.
    let pose = &table("pose")[0];
    let cell = |name: &str| number(&pose[name]);
    for (row, axis) in (1..).zip(["x", "y", "z"]) {
        assert_eq!(cell(&format!("m{row}4_m")), cell(&format!("exit_{axis}_m")));
        assert_eq!(cell(&format!("m{row}3")), cell(&format!("axis_{axis}")));
    }
    let matrix = nalgebra::Matrix3::from_fn(|i, j| cell(&format!("m{}{}", i + 1, j + 1)));
    assert!((matrix.determinant() - 1.0).abs() < 1e-9);
    let [x, y, z, w] = ["x", "y", "z", "w"].map(|axis| cell(&format!("quaternion_{axis}")));
    let turned = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    assert!((turned.to_rotation_matrix().matrix() - matrix).norm() < 1e-9);
    assert_eq!(
        [cell("m41"), cell("m42"), cell("m43"), cell("m44")],
        [0.0, 0.0, 0.0, 1.0]
    );
    let hits = &record["evidence"]["hits"];
    let rows = table("hits");
    assert_eq!(rows.len(), hits["points_m"].as_array().unwrap().len());
    assert_eq!(
        hits["points_m"][7][2].as_f64(),
        Some(number(&rows[7]["z_m"]))
    );
    let surfaces = table("surfaces");
    assert_eq!(
        (
            surfaces[0]["surface"].as_str(),
            surfaces[0]["role"].as_str()
        ),
        ("hub.floor", "target")
    );
    assert_eq!(surfaces.len(), 5);
    assert_eq!(
        table("windows").len(),
        record["windows"].as_array().unwrap().len()
    );
    let places = table("places");
    assert!(
        places
            .iter()
            .any(|place| place["place"] == "lowest_normal_impulse" && place["unit"] == "N s")
    );
}

#[test]
fn results_have_lists_of_numbers_on_one_line() {
    let (_folder, path, record) = solved();
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.len() < 2_500_000, "{} bytes", text.len());
    assert!(text.contains("\n    \"pose\": {\n      \"exit_m\": ["));
    assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), record);
    // Neither is a line broken inside a list of numbers, nor are two keys on one line.
    for line in text.lines() {
        assert!(
            !line
                .trim_start()
                .starts_with(|c: char| c.is_ascii_digit() || c == '-')
        );
        assert!(
            line.matches("\": ").count() <= 1,
            "{}",
            &line[..80.min(line.len())]
        );
    }
    // Without a folder to write into there are no pictures to draw, and none of it.
    let plain = peenpose(&["solve", PLATE, "--json"]).json();
    assert!(plain.get("evidence").is_none());
}

#[cfg(unix)]
#[test]
fn results_are_for_everyone_whom_the_umask_lets() {
    use std::os::unix::fs::PermissionsExt;
    let folder = TempDir::new().unwrap();
    let ordinary = folder.path().join("ordinary");
    std::fs::write(&ordinary, "").unwrap();
    let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode();
    peenpose(&["solve", PLATE, "--out", folder.path().to_str().unwrap()]);
    for name in ["result.json", "sheet.txt"] {
        assert_eq!(mode(&folder.path().join(name)), mode(&ordinary));
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_a_failure() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    for out in [file.clone(), file.join("below")] {
        refused(
            &["solve", PLATE, "--out", out.to_str().unwrap()],
            &["cannot write", out.to_str().unwrap()],
        );
    }
    assert_eq!(std::fs::read_to_string(file).unwrap(), "");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_peenpose"));
    let full = std::fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let output = command
        .args(["solve", PLATE, "--json"])
        .current_dir(root())
        .stdout(Stdio::from(full))
        .stderr(Stdio::piped())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let messages = String::from_utf8(output.stderr).unwrap();
    assert!(messages.starts_with("error: cannot write"), "{messages}");
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_peenpose"))
        .args(["solve", KEYWAY, "--json"])
        .current_dir(root())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Gone before the first byte.
    drop(child.stdout.take());
    let mut messages = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut messages)
        .unwrap();
    assert_eq!(messages, "");
    assert_eq!(child.wait().unwrap().code(), Some(0));

    // Gone after the first line.
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_peenpose"))
        .args(["solve", KEYWAY, "--json"])
        .current_dir(root())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    BufReader::new(child.stdout.take().unwrap())
        .read_line(&mut first)
        .unwrap();
    assert_eq!(first, "{\n");
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.stderr, b"");
    assert_eq!(output.status.code(), Some(0));
}

/// A solution of the keyway in a folder.
fn solved() -> (TempDir, PathBuf, Value) {
    let folder = TempDir::new().unwrap();
    let run = peenpose(&[
        "solve",
        KEYWAY,
        "--json",
        "--out",
        folder.path().to_str().unwrap(),
    ]);
    assert_eq!(run.status, 0, "{}", run.messages);
    let path = folder.path().join("result.json");
    (folder, path, run.json())
}

#[test]
fn an_evaluation_of_a_solution_agrees_with_it() {
    let (_folder, path, solution) = solved();
    let from = ["--from", path.to_str().unwrap(), "--json"];
    let again = evaluate(KEYWAY, &from, &[]).json();
    assert_eq!(again["status"], "evaluated");
    assert_eq!(again["best"]["contact"], solution["best"]["contact"]);
    let total = |record: &Value| number(record, "/best/objective/total");
    let error = |record: &Value| number(record, "/best/objective/standard_error");
    // Other shots, so only within the errors.
    let fresh = evaluate(KEYWAY, &from, &["--seed", "77"]).json();
    let allowed = 5.0 * error(&fresh).hypot(error(&solution));
    assert!((total(&fresh) - total(&solution)).abs() < allowed);
    assert_ne!(total(&fresh), total(&again));
    // --set goes on top: half the speed, half the impulse.
    let speed = number(&solution, "/best/settings/speed_m_s");
    let slow = format!("speed={}m/s", speed / 2.0);
    let slow = evaluate(KEYWAY, &from, &["--set", &slow]).json();
    for key in ["incidence_deg", "azimuth_deg", "standoff_m"] {
        let path = format!("/best/settings/{key}");
        assert!((number(&slow, &path) - number(&again, &path)).abs() < 1e-12);
    }
    let mean = |record: &Value| number(record, "/best/target/normal_impulse_N_s/mean");
    assert!((2.0 * mean(&slow) / mean(&again) - 1.0).abs() < 1e-9);
    let dry = evaluate(KEYWAY, &from, &["--set", "contact=dry"]).json();
    assert_eq!(dry["best"]["contact"], "dry");
    assert_eq!(dry["best"]["contact_values"]["mu_s"], json!(0.3));
}

#[test]
fn an_evaluation_repeats_itself() {
    let run = evaluate(KEYWAY, &GOOD, &["--json", "--shots", "1000"]).json();
    // Shots come in 32 equal scramblings.
    assert_eq!(run["best"]["shots"], 1024);
    let command = run["command"].as_str().unwrap();
    let words: Vec<&str> = command.split(' ').skip(1).chain(["--json"]).collect();
    let mut again = peenpose(&words).json();
    let mut run = run;
    for record in [&mut run, &mut again] {
        record["work"]["seconds"] = Value::Null;
    }
    let close = |path: &str| {
        let (a, b) = (number(&run, path), number(&again, path));
        assert!((a - b).abs() <= 1e-9 * a.abs(), "{path}: {a} {b}");
    };
    close("/best/objective/total");
    close("/best/settings/incidence_deg");
    close("/best/target/normal_impulse_N_s/mean");
    assert_eq!(run["best"]["shots"], again["best"]["shots"]);
}

#[test]
fn what_the_file_holds_need_not_be_set() {
    let run = evaluate(PLATE, &["--set", "contact=mu_006", "--json"], &[]);
    assert_eq!(run.status, 0, "{}", run.messages);
    let impulse = number(&run.json(), "/best/target/normal_impulse_N_s/mean");
    assert!((impulse / 39.6769e-6 - 1.0).abs() < 1e-4);
    refused(
        &["evaluate", PLATE],
        &["leaves contact open", "--set contact="],
    );
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let with = |setting: &'static str, words: &[&str]| {
        let arguments: Vec<&str> = ["evaluate", KEYWAY]
            .into_iter()
            .chain(GOOD)
            .chain(["--set", setting])
            .collect();
        refused(&arguments, words);
    };
    with(
        "incidnce=60deg",
        &["no setting `incidnce`", "did you mean `incidence`"],
    );
    with(
        "Speed=10m/s",
        &["no setting `Speed`", "did you mean `speed`"],
    );
    with("incidence", &["expected NAME=VALUE"]);
    with("incidence=60", &["has no unit", "did you mean `60 deg`"]);
    with("incidence=60mm", &["is a length", "expected an angle"]);
    with("incidence=0deg", &["above 0 deg"]);
    with(
        "incidence=90.1deg",
        &["is too large", "from 0 deg to 90 deg"],
    );
    with("speed=-3m/s", &["must be more than 0"]);
    with("speed=1e300m/s", &["is too large", "10000 m/s"]);
    with("standoff=0mm", &["must be more than 0"]);
    with("aim_along=1e300m", &["is too large", "to 1000 m"]);
    with(
        "contact=oild",
        &["no contact `oild`", "did you mean `oiled`"],
    );
    with("contact=", &["no contact"]);
    with("mu_s=-1", &["must not be negative"]);
    with("mu_s=0.2", &["contact `oiled` is fixed"]);
    refused(
        &["evaluate", KEYWAY, "--set", "incidence=60deg"],
        &["leaves azimuth, standoff, speed, contact open", "--from"],
    );
}

#[test]
fn a_result_of_another_problem_is_taken_with_a_warning() {
    let folder = TempDir::new().unwrap();
    peenpose(&["solve", PLATE, "--out", folder.path().to_str().unwrap()]);
    let result = folder.path().join("result.json");
    let renamed = folder.path().join("renamed.yaml");
    let text = std::fs::read_to_string(PLATE).unwrap();
    let title = "title: Flat plate, 60 deg, 10 m/s";
    assert!(text.contains(title));
    std::fs::write(&renamed, text.replace(title, "title: Another")).unwrap();
    let told = |file: &str, more: &[&str]| {
        let asked = ["evaluate", file, "--from", result.to_str().unwrap()];
        let run = peenpose(&[&asked[..], more].concat());
        assert_eq!(run.status, 0);
        run.messages
    };
    let renamed = renamed.to_str().unwrap();
    let warned = told(renamed, &[]);
    assert!(
        warned.contains("answers another problem, `Flat plate, 60 deg, 10 m/s`"),
        "{warned}"
    );
    assert_eq!(told(renamed, &["--quiet"]), "");
    assert_eq!(told(PLATE, &[]), "");
}

#[test]
fn results_that_are_none_are_refused() {
    let from = |path: &str, words: &[&str]| {
        refused(&["evaluate", KEYWAY, "--from", path], words);
    };
    from("no/such.json", &["cannot read no/such.json"]);
    from("src", &["cannot read src"]);
    from("Cargo.toml", &["Cargo.toml is not a result"]);
    // A result of another problem, whose contacts have other names.
    let folder = TempDir::new().unwrap();
    peenpose(&["solve", PLATE, "--out", folder.path().to_str().unwrap()]);
    let path = folder.path().join("result.json");
    let path = path.to_str().unwrap();
    from(path, &[path, "there is no contact `mu_030`"]);
}

#[test]
fn every_shipped_problem_is_sound() {
    let files = problem_files();
    assert!(!files.is_empty());
    let arguments: Vec<&str> = ["check"]
        .into_iter()
        .chain(files.iter().map(String::as_str))
        .collect();
    let run = peenpose(&arguments);
    assert_eq!((run.status, run.messages.as_str()), (0, ""));
    for file in &files {
        assert!(run.out.contains(&format!("{file}: ok")), "{}", run.out);
    }
    assert!(!run.out.contains("warning"), "{}", run.out);
}

#[test]
fn a_bad_file_does_not_hide_good_ones() {
    let run = peenpose(&["check", PLATE, "no/such.yaml", KEYWAY]);
    assert_eq!(run.status, 2);
    assert!(run.out.contains("plate.yaml: ok") && run.out.contains("keyway.yaml: ok"));
    assert!(run.messages.contains("no/such.yaml"));
}

#[test]
fn all_bad_files_are_refused_in_one_run_each_at_its_place() {
    let files: Vec<String> = ["tests/bad", "tests/bad_geometry"]
        .into_iter()
        .flat_map(yaml_files)
        .collect();
    let arguments: Vec<&str> = ["check"]
        .into_iter()
        .chain(files.iter().map(String::as_str))
        .collect();
    let run = peenpose(&arguments);
    assert_eq!((run.status, run.out.as_str()), (2, ""));
    for file in &files {
        let place = format!("--> {file}:");
        assert!(run.messages.contains(&place), "{file}:\n{}", run.messages);
    }
}

#[test]
fn a_bad_file_is_solved_by_no_command() {
    let cases: [(&str, &[&str]); 5] = [
        (
            "tests/bad/repeated_keys.yaml",
            &[
                "shot.radius: is given twice",
                "shot: is given already in line 7",
            ],
        ),
        (
            "tests/bad/misplaced_keys.yaml",
            &["shot.divergence: belongs to jet"],
        ),
        (
            "tests/bad/wrong_case.yaml",
            &["`MM` is not a unit of length", "did you mean `mm`?"],
        ),
        ("tests/bad/nul_byte.yaml", &["nul_byte.yaml:2:9", "control"]),
        (
            "tests/bad_geometry/mesh_files.yaml",
            &["there is no such file", "cut short", "zero area"],
        ),
    ];
    for (file, words) in cases {
        refused(&["solve", file], words);
        refused(&["evaluate", file], words);
    }
}

#[test]
fn arguments_that_make_no_sense_are_refused() {
    refused(&[], &["Usage"]);
    refused(&["sovle", KEYWAY], &["solve"]);
    refused(&["solve"], &["FILE"]);
    refused(&["solve", KEYWAY, "--threads", "0"], &["--threads"]);
    refused(&["solve", KEYWAY, "--seed", "-1"], &["-1"]);
    refused(
        &["solve", KEYWAY, "--accuracy", "1"],
        &["has no unit", "did you mean `1 %`"],
    );
    refused(
        &["solve", KEYWAY, "--accuracy", "0 %"],
        &["must be more than 0", "up to 100 %"],
    );
    refused(
        &["solve", KEYWAY, "--accuracy", "101 %"],
        &["is too large", "up to 100 %"],
    );
    refused(&["evaluate", KEYWAY, "--shots", "0"], &["--shots"]);
    refused(&["solve", KEYWAY, "--jsn"], &["--json"]);
}

#[test]
fn help_and_version_go_to_stdout() {
    let help = peenpose(&["--help"]);
    assert_eq!((help.status, help.messages.as_str()), (0, ""));
    for word in ["solve", "evaluate", "check", "Exit status"] {
        assert!(help.out.contains(word), "{word}");
    }
    let version = peenpose(&["--version"]);
    assert_eq!(
        version.out.trim(),
        concat!("peenpose ", env!("CARGO_PKG_VERSION"))
    );
}
