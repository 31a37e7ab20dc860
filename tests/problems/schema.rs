//! The JSON Schema of problem files against the check, and what is made from it.
//!
//! A schema can see structure: unknown and missing keys, values of the wrong kind, missing and wrong
//! units, names that the program itself knows. It cannot see what numbers may be, what names of the
//! file refer to, or what two groups mean together; those files of tests/bad are listed in
//! `ONLY_THE_CHECK_SEES`.

#[path = "../../examples/problem_file_docs/markdown.rs"]
mod markdown;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crate::common::cases::cases;
use jsonschema::Validator;
use peenpose::problem;
use peenpose::units::{self, Dimension, UnitFault};
use proptest::prelude::*;
use serde_json::{Map, Value, json};

static SCHEMA: LazyLock<Value> = LazyLock::new(problem::schema);
static VALIDATOR: LazyLock<Validator> = LazyLock::new(|| validator(&SCHEMA));

fn validator(schema: &Value) -> Validator {
    jsonschema::draft202012::new(schema).unwrap()
}

/// Every key that a problem file may have at least once, as sparsely as it can be.
const SPARSE: &str = "
format: 1
lengths_in: mm
scene:
  hub: { keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm } }
  hole: { bore: { diameter: 12 mm, length: 48 mm, ends: { far: closed } }, place: { on: scene } }
  mask: { box: { min: [-20, -15, 45], max: [20, 10, 50] }, place: scene }
  slot:
    extrude:
      length: 40 mm
      profile:
        - { from: [-3, 30], line_to: [-3, 26], surface: wall }
        - { arc_to: [3, 26], via: [0, 23], surface: floor }
  part: { mesh: part.obj, regions: { lip: { min: [0, 0, 0], max: [1, 1, 1] } } }
target: { surface: hub.floor, within: { min: [-3, 18, 15], max: [3, 19, 25] } }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1.5 mm, divergence: 4 deg }
nozzle: { body: [ { ball: { radius: 3 mm } }, { capsule: { length: 60 mm, radius: 2 mm } } ] }
contacts:
  use: [steel-on-steel-dry]
  dry: { mu_s: 0.30, mu_d: 0.27, restitution: 0.25 }
  tuned: { mu_s: [0.1, 0.3], mu_d_ratio: 0.9, restitution: { value: 0.5, at: 10 m/s, exponent: 0.25 } }
  oiled: { use: steel-on-steel-oiled }
settings:
  incidence: [30 deg, 85 deg]
  azimuth: [-90 deg, 90 deg]
  standoff: [6 mm, 20 mm]
  speed: [5 m/s, 40 m/s]
goals:
  normal_impulse: { target: 40 uN.s }
  tangential_impulse: { limit: 8 uN.s }
  rebound: { allow: 10 uN.s }
  miss: {}
surfaces:
  hub.bore: { contact: { mu_s: 0.8, mu_d: 0.7, restitution: 0.4 } }
paths: {}
tolerance: {}
solve: {}
";

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn yaml_files(name: &str) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = folder(name)
        .read_dir()
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "yaml"))
        .collect();
    files.sort();
    files
}

fn json_of(yaml: &str) -> Value {
    serde_saphyr::from_str(yaml).unwrap()
}

/// Whole problems of every kind.
fn problems() -> Vec<(String, Value)> {
    let shipped = [yaml_files("problems"), yaml_files("src/bin/peenpose/init")].concat();
    let mut problems: Vec<(String, Value)> = shipped
        .iter()
        .map(|path| {
            let text = fs::read_to_string(path).unwrap();
            (path.display().to_string(), json_of(&text))
        })
        .collect();
    assert!(problems.len() >= 10);
    problems.push(("sparse".into(), json_of(SPARSE)));
    problems
}

/// What the check says of a problem; JSON is YAML.
fn faults(problem: &Value) -> Vec<String> {
    let reading = problem::read_text(&problem.to_string(), Path::new("test.yaml")).unwrap();
    reading.faults.iter().map(ToString::to_string).collect()
}

fn complaints(problem: &Value) -> Vec<String> {
    let errors = VALIDATOR.iter_errors(problem);
    errors
        .map(|error| format!("{}: {error}", error.instance_path()))
        .collect()
}

#[test]
fn whole_problems_are_valid() {
    for (name, problem) in problems() {
        assert_eq!(faults(&problem), [""; 0], "{name}");
        assert_eq!(complaints(&problem), [""; 0], "{name}");
    }
}

#[test]
fn shipped_files_name_the_schema_that_lies_beside_them() {
    let name = "peenpose.schema.json";
    let first = format!("# yaml-language-server: $schema={name}");
    for path in [yaml_files("problems"), yaml_files("src/bin/peenpose/init")].concat() {
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(
            text.lines().next(),
            Some(first.as_str()),
            "{}",
            path.display()
        );
    }
    let kept = fs::read_to_string(folder("problems").join(name)).unwrap();
    assert!(
        kept == format!("{:#}\n", *SCHEMA),
        "out of date: cargo run -- schema > problems/{name}"
    );
}

#[test]
fn the_documentation_is_made_from_the_schema() {
    let kept = fs::read_to_string(folder("docs/problem-file.md")).unwrap();
    assert!(
        kept == markdown::renewed(&kept).unwrap(),
        "out of date: cargo run --example problem_file_docs"
    );
}

/// Calls `visit` with the keys that lead to every key of a value.
fn each_key(value: &Value, path: &mut Vec<String>, visit: &mut impl FnMut(&[String])) {
    let mut child = |key: String, value: &Value, is_key: bool| {
        path.push(key);
        if is_key {
            visit(path);
        }
        each_key(value, path, visit);
        path.pop();
    };
    match value {
        Value::Object(entries) => {
            entries
                .iter()
                .for_each(|(key, value)| child(key.clone(), value, true));
        }
        Value::Array(items) => {
            let items = items.iter().enumerate();
            items.for_each(|(index, value)| child(index.to_string(), value, false));
        }
        _ => {}
    }
}

fn pointer(path: &[String]) -> String {
    path.iter()
        .map(|key| format!("/{}", key.replace('/', "~1")))
        .collect()
}

fn group<'v>(problem: &'v mut Value, path: &[String]) -> &'v mut Map<String, Value> {
    problem
        .pointer_mut(&pointer(path))
        .unwrap()
        .as_object_mut()
        .unwrap()
}

#[test]
fn schema_and_check_miss_the_same_keys() {
    let missing = [
        "is missing",
        "has no shape",
        "leads nowhere",
        "has no parts",
        "has no contacts",
        "says nothing of",
    ];
    let (mut refused, mut accepted) = (0, 0);
    for (name, problem) in problems() {
        each_key(&problem, &mut Vec::new(), &mut |path| {
            let mut without = problem.clone();
            let (key, above) = path.split_last().unwrap();
            group(&mut without, above).shift_remove(key);
            // Whether there are coordinates, and which segment is the first, is beyond a schema.
            if path == ["lengths_in"] || (key == "from" && above.last().unwrap() == "0") {
                return;
            }
            let faults = faults(&without);
            let misses = faults
                .iter()
                .any(|fault| missing.iter().any(|m| fault.contains(m)));
            let complaints = complaints(&without);
            assert_eq!(
                misses,
                !complaints.is_empty(),
                "{name}: {path:?}\n{faults:?}\n{complaints:?}"
            );
            if misses {
                refused += 1;
            } else {
                accepted += 1;
            }
        });
    }
    assert!(refused > 200 && accepted > 200, "{refused} {accepted}");
}

#[test]
fn schema_and_check_refuse_the_same_unknown_keys() {
    for (name, problem) in problems() {
        each_key(&problem, &mut Vec::new(), &mut |path| {
            let mut misspelt = problem.clone();
            let (key, above) = path.split_last().unwrap();
            let group = group(&mut misspelt, above);
            let value = group[key].clone();
            group.insert(format!("{key}_"), value);
            // Under any name but `use`, names of contacts are no contact.
            let unknown = faults(&misspelt).iter().any(|fault| {
                fault.contains("unknown key") || fault.ends_with("expected a group of keys")
            });
            let refused = complaints(&misspelt);
            assert_eq!(unknown, !refused.is_empty(), "{name}: {path:?} {refused:?}");
        });
    }
}

/// The schema of what stands at a place, without references and alternatives that do not fit.
fn schema_of(schema: &Value, value: &Value) -> Value {
    if let Some(name) = schema["$ref"].as_str() {
        return schema_of(SCHEMA.pointer(&name[1..]).unwrap(), value);
    }
    let forms = schema["anyOf"].as_array().into_iter().flatten();
    let fitting = forms
        .map(|form| schema_of(form, value))
        .find(|form| form["type"] == "object" && value.is_object());
    fitting.unwrap_or_else(|| schema.clone())
}

/// Calls `visit` with every group of keys and its schema.
fn each_group(
    value: &Value,
    schema: &Value,
    path: &mut Vec<String>,
    visit: &mut impl FnMut(&[String], &Value),
) {
    let schema = schema_of(schema, value);
    let mut child = |key: String, value: &Value, schema: &Value| {
        path.push(key);
        each_group(value, schema, path, visit);
        path.pop();
    };
    match value {
        Value::Object(entries) => {
            for (key, value) in entries {
                let known = schema["properties"].get(key);
                child(
                    key.clone(),
                    value,
                    known.unwrap_or(&schema["additionalProperties"]),
                );
            }
            visit(path, &schema);
        }
        Value::Array(items) => {
            for (index, value) in items.iter().enumerate() {
                child(index.to_string(), value, &schema["items"]);
            }
        }
        _ => {}
    }
}

#[test]
fn defaults_are_what_the_check_takes_for_an_absent_key() {
    let sparse = json_of(SPARSE);
    let read = |problem: &Value| {
        let reading = problem::read_text(&problem.to_string(), Path::new("test.yaml")).unwrap();
        format!(
            "{:?}",
            reading
                .problem
                .unwrap_or_else(|| panic!("{problem}: {:?}", reading.faults))
        )
    };
    let as_it_is = read(&sparse);
    let mut written = 0;
    each_group(&sparse, &SCHEMA, &mut Vec::new(), &mut |path, schema| {
        for (key, property) in schema["properties"].as_object().into_iter().flatten() {
            let Some(default) = property.get("default") else {
                continue;
            };
            let mut with = sparse.clone();
            if group(&mut with, path)
                .insert(key.clone(), default.clone())
                .is_none()
            {
                written += 1;
                assert_eq!(read(&with), as_it_is, "{path:?} {key}: {default}");
            }
        }
    });
    assert!(written > 40, "{written}");
}

#[test]
fn every_example_is_a_valid_value_of_its_key() {
    let mut examples = 0;
    let groups = SCHEMA["$defs"]
        .as_object()
        .unwrap()
        .values()
        .chain([&*SCHEMA]);
    for group in groups {
        for (key, property) in group["properties"].as_object().into_iter().flatten() {
            let mut alone = property.clone();
            alone["$defs"] = SCHEMA["$defs"].clone();
            let valid = validator(&alone);
            let shown = property["examples"].as_array().into_iter().flatten();
            for example in shown.chain(property.get("default")) {
                assert!(valid.is_valid(example), "{key}: {example}");
                examples += 1;
            }
        }
    }
    assert!(examples > 100, "{examples}");
}

#[test]
fn examples_in_the_text_are_valid() {
    let text = fs::read_to_string(folder("docs/problem-file.md")).unwrap();
    let mut whole = 0;
    for block in text.split("```yaml\n").skip(1) {
        let block = block.split("```").next().unwrap();
        // Alternatives stand one below the other.
        for group in block
            .split("# or\n")
            .filter(|group| !group.starts_with('#'))
        {
            let Value::Object(groups) = json_of(group) else {
                panic!("{group}");
            };
            let mut problem = json_of(SPARSE);
            problem.as_object_mut().unwrap().extend(groups);
            assert_eq!(complaints(&problem), [""; 0], "{group}");
            whole += 1;
        }
    }
    assert!(whole >= 8, "{whole}");
}

/// Files of tests/bad with faults that are not of structure: numbers that do not fit, names of the
/// file, and YAML that the program does not take but others do.
const ONLY_THE_CHECK_SEES: [&str; 28] = [
    "azimuth_wide",
    "bare_coordinates",
    "block_text",
    "box_far_out",
    "curly_quotes",
    "deflecting_target",
    "dent_hit",
    "directions_without_length",
    "flat_boxes",
    "incidence_above",
    "keyway",
    "mass_flow",
    "merge_key",
    "no_contact",
    "no_length_unit",
    "ranges_upside_down",
    "root_beyond_walls",
    "root_too_large",
    "stroke_twice_there",
    "surface_of_nozzle_part",
    "tolerance_reaches_zero",
    "tolerance_too_far",
    "tolerance_wider_than_aims",
    "unknown_contact",
    "unknown_surface",
    "upside_down",
    "within_upside_down",
    "zero_sizes",
];

#[test]
fn faults_of_structure_are_seen_in_the_bad_files() {
    let mut unseen = Vec::new();
    let mut seen = 0;
    for path in yaml_files("tests/bad") {
        let Ok(text) = String::from_utf8(fs::read(&path).unwrap()) else {
            continue;
        };
        // What is no YAML, editors show without a schema.
        let Ok(problem) = serde_saphyr::from_str::<Value>(&text) else {
            continue;
        };
        if VALIDATOR.is_valid(&problem) {
            unseen.push(path.file_stem().unwrap().to_str().unwrap().to_owned());
        } else {
            seen += 1;
        }
    }
    assert_eq!(unseen, ONLY_THE_CHECK_SEES);
    assert!(seen >= 15, "{seen}");
}

fn quantity() -> impl Strategy<Value = String> {
    let number = "[-+]?[0-9]{0,3}[.]?[0-9]{0,2}([eE][-+]?[0-9]{0,2})?";
    let units: Vec<&str> = Dimension::ALL
        .into_iter()
        .flat_map(Dimension::unit_names)
        .chain([
            "µm", "μN·s", "uNs", "mN s", "N*s", "°", "kg/m^3", "g/cm³", "kg/m^^3", "MM", "", "N..s",
        ])
        .collect();
    (number, " {0,2}", proptest::sample::select(units), "[ m^]?")
        .prop_map(|(number, gap, unit, tail)| format!("{number}{gap}{unit}{tail}"))
}

static PATTERNS: LazyLock<Vec<(Dimension, Validator)>> = LazyLock::new(|| {
    let of = |dimension: Dimension| {
        let schema = json!({ "type": "string", "pattern": dimension.pattern() });
        (dimension, validator(&schema))
    };
    Dimension::ALL.into_iter().map(of).collect()
});

proptest! {
    #![proptest_config(cases(4096))]

    #[test]
    fn patterns_take_what_units_take(text in quantity()) {
        for (dimension, pattern) in &*PATTERNS {
            let parsed = units::parse(*dimension, &text);
            let read = matches!(parsed, Ok(_) | Err(UnitFault::TooLarge { .. }));
            prop_assert_eq!(pattern.is_valid(&json!(text)), read, "{:?} {:?}", dimension, text);
        }
    }
}

#[test]
fn bare_numbers_are_no_quantities() {
    for (dimension, pattern) in &*PATTERNS {
        assert!(
            !pattern.is_valid(&json!(0.5)) && !pattern.is_valid(&json!("0.5")),
            "{dimension:?}"
        );
    }
}
