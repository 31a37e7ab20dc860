//! Extreme but legal problems, and what they cost: each is answered in finite numbers or refused with
//! a reason, within the memory that is documented.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::common::program::{Run, peenpose};
use peenpose::evaluate::{evaluate, evaluate_adaptively, evaluate_streamed};
use peenpose::feasibility::infeasibility;
use peenpose::jet::{Draw, Replicates, ValidationSample, purpose};
use peenpose::problem;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::spread_settings;
use serde_json::Value;
use tempfile::TempDir;

const PLATE: &str = "
format: 1
title: Plate
lengths_in: mm
scene:
  plate: { box: { min: [-50, -50, -10], max: [50, 50, 0] } }
target: { surface: plate.z_max, aim: [0, 0, 0], along: [1, 0, 0] }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1 mm, divergence: 4 deg, speed_spread: 5 % }
contacts:
  dry: { mu_s: 0.3, mu_d: 0.27, restitution: 0.25 }
settings: { incidence: [30 deg, 85 deg], azimuth: 0 deg, standoff: 10 mm, speed: [5 m/s, 40 m/s] }
goals: { normal_impulse: { target: 40 uN.s, tolerance: 15 % } }
";
const KEYWAY: &str = include_str!("../../problems/keyway.yaml");
const HELD: [&str; 10] = [
    "--set",
    "incidence=80deg",
    "--set",
    "azimuth=0deg",
    "--set",
    "standoff=10mm",
    "--set",
    "speed=9m/s",
    "--set",
    "contact=dry",
];
const RADIUS: &str = "radius: 0.5 mm";
const STANDOFF: &str = "standoff: 10 mm";
const SPEED: &str = "[5 m/s, 40 m/s]";
const TARGET: &str = "target: 40 uN.s";
const DRY: &str = "mu_s: 0.3, mu_d: 0.27, restitution: 0.25";

/// The text with some parts exchanged, each of which it must have.
fn edited(text: &str, edits: &[(&str, &str)]) -> String {
    edits.iter().fold(text.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "no {old}");
        text.replacen(old, new, 1)
    })
}

/// Where numbers may be absent, and why.
fn may_be_absent(key: &str, holder: &Value) -> bool {
    match key {
        // No limit was asked for.
        "allow_N_s" | "tangential_impulse_N_s" | "rebound_N_s" | "unknowns" => true,
        // Nothing hits it.
        "normal_impulse_N_s" => holder["share_of_shots"] == 0.0,
        "share_sticking" => holder["terms"].is_null() || holder["terms"][3] != 0.0,
        "rebound_angle_deg" => holder["normal_impulse_N_s"] == 0.0,
        // The nozzle does not fit, or has no body.
        "terms" => holder["fails"]
            .as_array()
            .is_some_and(|fails| fails.len() == 1),
        "clearance_m" | "clearance_surface" => true,
        // Restitution does not depend on the speed.
        "restitution_at_m_s" => holder["restitution_exponent"].is_null(),
        "restitution_exponent" => holder["restitution_at_m_s"].is_null(),
        // No verdict turns in the whole range.
        "turns" => holder["within"] == 0.0,
        _ => false,
    }
}

/// How many numbers a result has; none may be infinite, or absent without a reason.
fn count_numbers(value: &Value, place: &str) -> usize {
    match value {
        Value::Object(fields) => {
            let mut count = 0;
            for (key, field) in fields {
                let place = format!("{place}.{key}");
                if field.is_null() {
                    assert!(may_be_absent(key, value), "{place} of {value}");
                }
                count += count_numbers(field, &place);
            }
            count
        }
        Value::Array(items) => {
            let count = |item: &Value| {
                assert!(!item.is_null(), "{place}[] of {value}");
                count_numbers(item, place)
            };
            items.iter().map(count).sum()
        }
        Value::Number(number) => {
            assert!(number.as_f64().unwrap().is_finite(), "{place}");
            1
        }
        _ => 0,
    }
}

/// What the program says of a problem.
fn run(command: &str, text: &str, more: &[&str], folder: &Path) -> Run {
    fs::write(folder.join("problem.yaml"), text).unwrap();
    let arguments = [&[command, "problem.yaml", "--json", "--quiet"], more].concat();
    peenpose(arguments, folder)
}

/// The answer to a problem, which passes or fails but is not refused.
fn answered(text: &str) -> Value {
    let folder = TempDir::new().unwrap();
    let run = run("solve", text, &[], folder.path());
    assert!(run.status <= 1, "{}", run.messages);
    let result = run.json();
    assert!(count_numbers(&result, "") > 100);
    result
}

#[test]
fn extreme_shot_and_speeds_are_answered_in_finite_numbers() {
    let dust = [(RADIUS, "radius: 0.5 um"), (TARGET, "target: 4e-14 N.s")];
    let balls = [
        (RADIUS, "radius: 0.5 m"),
        (TARGET, "target: 40000 N.s"),
        (STANDOFF, "standoff: 2 m"),
    ];
    let cases: [&[(&str, &str)]; 8] = [
        &dust,
        &balls,
        &[(SPEED, "[1 m/s, 1000 m/s]")],
        &[(SPEED, "1 m/s")],
        &[(SPEED, "1000 m/s")],
        &[(STANDOFF, "standoff: 1000 m")],
        &[(DRY, "mu_s: 10, mu_d: 10, restitution: 0")],
        &[(DRY, "mu_s: 0, mu_d: 0, restitution: 1")],
    ];
    for edits in cases {
        let result = answered(&edited(PLATE, edits));
        assert!(result["best"]["objective"]["total"].is_f64(), "{edits:?}");
    }
}

/// Where the incidence is free, its valley is flat: J is the same within the accuracy asked for.
#[test]
fn the_answer_does_not_depend_on_the_size_of_shots() {
    let dust = [(RADIUS, "radius: 0.5 um"), (TARGET, "target: 4e-14 N.s")];
    let held = edited(PLATE, &[("[30 deg, 85 deg]", "80 deg")]);
    for (text, key, off) in [
        (held.as_str(), "/best/settings/speed_m_s", 1e-6),
        (held.as_str(), "/best/objective/total", 1e-6),
        (PLATE, "/best/objective/total", 0.01),
    ] {
        let [small, usual] = [edited(text, &dust), text.to_owned()].map(|text| {
            answered(&text)
                .pointer(key)
                .and_then(Value::as_f64)
                .unwrap()
        });
        assert!((small / usual - 1.0).abs() < off, "{key} {small} {usual}");
    }
}

#[test]
fn many_contacts_and_many_parts_are_answered() {
    let mut contacts = String::new();
    for number in 1..=64 {
        let friction = f64::from(number) / 100.0;
        let values = format!("mu_s: {friction}, mu_d: {friction}, restitution: 0.25");
        writeln!(contacts, "  c{number}: {{ {values} }}").unwrap();
    }
    let few_shots = "goals: { normal_impulse: { target: 40 uN.s } }\nsolve: { accuracy: 10 % }";
    let goals = "goals: { normal_impulse: { target: 40 uN.s, tolerance: 15 % } }";
    let dry = "  dry: { mu_s: 0.3, mu_d: 0.27, restitution: 0.25 }\n";
    let result = answered(&edited(PLATE, &[(dry, &contacts), (goals, few_shots)]));
    assert_eq!(result["choices"].as_array().unwrap().len(), 64);

    let mut parts = String::new();
    for number in 0..100 {
        let (low, high) = (20 * number - 1000, 20 * number - 990);
        let corners = format!("min: [{low}, 100, -10], max: [{high}, 110, 0]");
        writeln!(parts, "  p{number}: {{ box: {{ {corners} }} }}").unwrap();
    }
    let all = format!("{parts}target: {{");
    let result = answered(&edited(PLATE, &[("target: {", &all)]));
    assert_eq!(result["best"]["surfaces"].as_object().unwrap().len(), 606);
}

#[test]
fn beyond_what_can_be_computed_is_refused_with_a_reason() {
    let folder = TempDir::new().unwrap();
    let cases = [
        (RADIUS, "radius: 2 km", "is not a unit of length"),
        (RADIUS, "radius: 2000 m", "is too large"),
        (RADIUS, "radius: 0.01 nm", "is not a unit of length"),
        (RADIUS, "radius: 1e-12 m", "is too small"),
        (SPEED, "1e5 m/s", "is too large"),
        (TARGET, "target: 1e-300 N.s", "is too small"),
        (TARGET, "target: 1e300 N.s", "is too large"),
    ];
    for (old, new, reason) in cases {
        let run = run("solve", &edited(PLATE, &[(old, new)]), &[], folder.path());
        assert_eq!(run.status, 2, "{new}");
        assert!(run.messages.contains(reason), "{new}: {}", run.messages);
    }
    let too_many = [&HELD[..], &["--shots", "10000001"]].concat();
    let run = run("evaluate", PLATE, &too_many, folder.path());
    assert_eq!(run.status, 2);
    assert!(
        run.messages.contains("10000001 is not in 1..=10000000"),
        "{}",
        run.messages
    );
}

#[test]
fn a_result_whose_terms_are_beyond_single_precision_can_be_read_again() {
    let folder = TempDir::new().unwrap();
    let ball = [
        (RADIUS, "radius: 0.1 m"),
        (TARGET, "target: 1e-18 N.s"),
        (STANDOFF, "standoff: 300 mm"),
    ];
    let run = run(
        "solve",
        &edited(PLATE, &ball),
        &["--out", "out"],
        folder.path(),
    );
    assert_eq!(run.status, 1, "{}", run.messages);
    let text = fs::read_to_string(folder.path().join("out/result.json")).unwrap();
    assert!(count_numbers(&serde_json::from_str(&text).unwrap(), "") > 1000);
    let report = peenpose(["report", "out"], folder.path());
    assert_eq!(report.status, 0, "{}", report.messages);
}

#[test]
fn no_number_of_a_full_result_is_absent_without_a_reason() {
    let folder = TempDir::new().unwrap();
    for name in ["keyway", "plate"] {
        let problem = format!("{}/problems/{name}.yaml", env!("CARGO_MANIFEST_DIR"));
        let run = peenpose(["solve", &problem, "--out", name, "--quiet"], folder.path());
        assert_eq!(run.status, 0, "{}", run.messages);
        let text = fs::read_to_string(folder.path().join(name).join("result.json")).unwrap();
        assert!(count_numbers(&serde_json::from_str(&text).unwrap(), name) > 100);
    }
}

#[test]
fn j_is_finite_at_every_pose_that_fits() {
    let mut feasible = 0;
    let faster = edited(
        KEYWAY,
        &[("speed: [5 m/s, 40 m/s]", "speed: [1 m/s, 1000 m/s]")],
    );
    let problem = problem::read_text(&faster, Path::new("keyway.yaml"))
        .unwrap()
        .problem
        .unwrap();
    let scenario = Scenario::new(problem, Walls::Exact).unwrap();
    for contact in 0..scenario.problem.contacts.len() {
        for settings in spread_settings(&scenario, contact, 256) {
            if infeasibility(&scenario, &settings).is_some_and(|it| it.violation > 0.0) {
                continue;
            }
            feasible += 1;
            let shots = Replicates::new(&scenario.problem, 0, 128);
            let evaluation = evaluate(&scenario, &settings, &shots);
            assert!(evaluation.terms.total().is_finite(), "{settings:?}");
            assert!(evaluation.standard_error.is_finite(), "{settings:?}");
        }
    }
    assert!(feasible > 100, "{feasible}");
}

#[test]
fn shots_that_are_forgotten_once_fired_give_the_same_figures() {
    for (text, name) in [(KEYWAY, "keyway.yaml"), (PLATE, "plate.yaml")] {
        let problem = problem::read_text(text, Path::new(name)).unwrap().problem;
        let scenario = Scenario::new(problem.unwrap(), Walls::Exact).unwrap();
        let settings = spread_settings(&scenario, 0, 1)[0];
        let kept = ValidationSample::new(&scenario.problem, purpose::ANSWERS, 1000);
        let drawn = Draw::new(&scenario.problem, purpose::ANSWERS, 1000);
        let [kept, drawn] = [
            evaluate_adaptively(&scenario, &settings, &kept),
            evaluate_streamed(&scenario, &settings, &drawn),
        ];
        assert_eq!(format!("{kept:?}"), format!("{drawn:?}"));
        assert_eq!((drawn.shots, drawn.boundary_shots), (1024, 512));
    }
}

/// Runs the program on two threads with so much memory for its data.
#[cfg(target_os = "linux")]
fn runs_within(megabytes: usize, arguments: &[&str], folder: &Path) -> bool {
    let shell = format!("ulimit -d {}; exec \"$0\" \"$@\"", megabytes * 1024);
    let output = std::process::Command::new("sh")
        .args(["-c", &shell, env!("CARGO_BIN_EXE_peenpose")])
        .args(arguments)
        .env("RAYON_NUM_THREADS", "2")
        .current_dir(folder)
        .output()
        .unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    match output.status.code() {
        Some(0 | 1) => true,
        None => {
            assert!(messages.contains("memory allocation"), "{messages}");
            false
        }
        Some(code) => panic!("{code}: {messages}"),
    }
}

#[cfg(target_os = "linux")]
#[test]
fn memory_of_a_search_and_of_many_shots_is_bounded() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("keyway.yaml"), KEYWAY).unwrap();
    let within = |megabytes, arguments: &[&str]| runs_within(megabytes, arguments, folder.path());
    assert!(within(104, &["solve", "keyway.yaml", "--out", "out"]));

    let many = [
        "evaluate",
        "keyway.yaml",
        "--from",
        "out/result.json",
        "--shots",
        "1000000",
    ];
    assert!(within(104, &many));
    // So the limit does bind: there is no million shots in no space.
    assert!(!within(32, &many));
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes a quarter of a minute"]
fn ten_million_shots_are_evaluated_within_their_memory() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("keyway.yaml"), KEYWAY).unwrap();
    let within = |megabytes, arguments: &[&str]| runs_within(megabytes, arguments, folder.path());
    assert!(within(104, &["solve", "keyway.yaml", "--out", "out"]));
    let from = ["--from", "out/result.json"];
    let most = [
        &["evaluate", "keyway.yaml"],
        &from[..],
        &["--shots", "10000000"],
    ]
    .concat();
    assert!(within(900, &most));
    assert!(!within(400, &most));
}

/// A sheet with waves, 100 mm wide, of twice the square of `steps` triangles, as binary STL.
#[cfg(target_os = "linux")]
fn waves(steps: u32) -> Vec<u8> {
    let corner = |i: u32, j: u32| {
        let [x, y] = [i, j].map(|k| 100.0 * k as f32 / steps as f32 - 50.0);
        [x, y, 0.5 * (x / 3.0).sin() * (y / 4.0).cos() - 0.5]
    };
    let mut stl = vec![0; 80];
    stl.extend((2 * steps * steps).to_le_bytes());
    for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
        let [a, b, c, d] =
            [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| corner(i, j));
        for corners in [[a, b, c], [a, c, d]] {
            stl.extend([0; 12]);
            stl.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
            stl.extend([0; 2]);
        }
    }
    stl
}

#[cfg(target_os = "linux")]
#[test]
fn memory_of_a_million_triangles_is_bounded() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("waves.stl"), waves(708)).unwrap();
    let edits = [
        (
            "box: { min: [-50, -50, -10], max: [50, 50, 0] }",
            "mesh: waves.stl",
        ),
        (
            "plate.z_max, aim: [0, 0, 0]",
            "plate.all, aim: [0, 0, -0.5], facing: [0, 0, 1]",
        ),
    ];
    fs::write(folder.path().join("waves.yaml"), edited(PLATE, &edits)).unwrap();
    let evaluate = [&["evaluate", "waves.yaml", "--shots", "1000"], &HELD[..]].concat();
    assert!(runs_within(640, &evaluate, folder.path()));
}
