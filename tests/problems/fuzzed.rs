//! What the fuzzer found, and a few seeds of each target, replayed; `docs/limits.md` says how it is
//! run for longer.

use std::fs;
use std::panic::catch_unwind;
use std::path::Path;

use peenpose::record::Record;
use serde_json::Value;

#[path = "../fuzz/src/lib.rs"]
mod targets;

/// Runs every input that is kept for a target.
fn replay(target: &str, run: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/fuzz/seeds")
        .join(target);
    let mut inputs = 0;
    for entry in fs::read_dir(&folder).expect("there are seeds") {
        let path = entry.expect("it can be listed").path();
        let input = fs::read(&path).expect("it can be read");
        let is_right = catch_unwind(|| run(&input)).is_ok();
        assert!(is_right, "{}", path.display());
        inputs += 1;
    }
    assert!(inputs > 0, "{} is empty", folder.display());
}

#[test]
fn problem_files_are_sound_or_have_faults_that_can_be_shown() {
    replay("problem", targets::problem::run);
}

#[test]
fn quantities_are_finite_or_refused() {
    replay("units", targets::units::run);
}

#[test]
fn mesh_files_become_sound_meshes_or_are_refused() {
    replay("mesh_file", targets::mesh_file::run);
}

#[test]
fn impacts_obey_mechanics() {
    replay("impact", targets::impact::run);
}

#[test]
fn rays_and_spheres_meet_what_a_look_at_every_triangle_finds() {
    replay("ray_caster", targets::ray_caster::run);
}

#[test]
fn searches_give_results_that_can_be_read_back() {
    replay("solve", targets::solve::run);
}

#[test]
fn records_can_be_shown_whatever_they_say() {
    replay("record", targets::record::run);
}

#[test]
fn checkpoints_are_refused_or_lead_to_the_same_answer() {
    replay("checkpoint", targets::checkpoint::run);
}

#[test]
fn tables_of_other_methods_are_sensible_or_refused() {
    replay("beside", targets::beside::run);
}

#[test]
fn numbers_beyond_the_precision_of_pictures_are_refused() {
    let read = |number: f64| {
        let mut whole = targets::record::whole();
        let place = whole.pointer_mut("/evidence/hits/plane_m/0/0");
        *place.expect("there are hits") = number.into();
        Record::from_json(&whole.to_string())
    };
    assert!(read(1e-3).is_ok());
    let error = read(1e300).expect_err("infinite in single precision");
    assert!(error.to_string().contains("out of range"), "{error}");
}

#[test]
fn the_dictionary_has_every_key_of_a_problem_file() {
    let dictionary = include_str!("../fuzz/problem.dict");
    let schema = peenpose::problem::schema();
    let mut keys = Vec::new();
    collect_keys(&schema, &mut keys);
    assert!(keys.len() > 50, "{keys:?}");
    for key in keys {
        assert!(dictionary.contains(&format!("\"{key}: \"")), "{key}");
    }
}

/// The keys of every group in a schema.
fn collect_keys(schema: &Value, keys: &mut Vec<String>) {
    let inner: Vec<&Value> = match schema {
        Value::Object(map) => map.values().collect(),
        Value::Array(list) => list.iter().collect(),
        _ => return,
    };
    if let Some(properties) = schema.get("properties").and_then(Value::as_object) {
        keys.extend(properties.keys().cloned());
    }
    inner
        .into_iter()
        .for_each(|inner| collect_keys(inner, keys));
}
