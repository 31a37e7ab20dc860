//! The same question gives the same answer, bit for bit, whatever the number of threads.

use crate::common::program;
use std::path::Path;

use crate::common::shipped;
use peenpose::jet::{Samples, Stream};
use serde_json::Value;

fn record(file: &str, arguments: &[&str]) -> Value {
    let arguments = [&["solve", file, "--json"], arguments].concat();
    let run = program::peenpose(arguments, Path::new(env!("CARGO_MANIFEST_DIR")));
    assert_eq!(run.status, 0, "{}", run.messages);
    let mut record = run.json();
    let seconds = record["work"]["seconds"].take();
    assert!(seconds.as_f64().unwrap() > 0.0);
    record
}

#[test]
fn the_record_does_not_depend_on_threads_or_on_the_run() {
    for file in ["problems/keyway.yaml", "problems/plate.yaml"] {
        let one = record(file, &["--threads", "1"]);
        for arguments in [
            &["--threads", "1"][..],
            &["--threads", "2"],
            &["--threads", "5"],
            &[],
        ] {
            // Text of all digits: equal means bit for bit.
            assert_eq!(
                one.to_string(),
                record(file, arguments).to_string(),
                "{file} {arguments:?}"
            );
        }
    }
}

#[test]
fn the_mesh_does_not_either() {
    let file = "problems/keyway-blind.yaml";
    let one = record(file, &["--threads", "1"]);
    assert_eq!(
        one.to_string(),
        record(file, &["--threads", "2"]).to_string()
    );
}

#[test]
fn the_seed_of_the_file_is_the_one_of_the_argument() {
    let (held, given) = (
        record("problems/keyway.yaml", &[]),
        record("problems/keyway.yaml", &["--seed", "1"]),
    );
    assert_eq!(held.to_string(), given.to_string());
}

#[test]
fn other_seeds_give_other_shots_but_nearly_the_same_answer() {
    let mut scenario = shipped::scenario("keyway.yaml");
    let mut shots = |seed| {
        scenario.problem.seed = seed;
        Samples::new(&scenario.problem, Stream::Search, 64).shots
    };
    assert_ne!(shots(1), shots(2));
    assert_ne!(shots(1), shots(1 + (1 << 32)));
    assert_eq!(shots(3), shots(3));

    let total = |record: &Value| record["best"]["objective"]["total"].as_f64().unwrap();
    let first = record("problems/keyway.yaml", &[]);
    let totals: Vec<f64> = (2..6)
        .map(|seed: u64| {
            total(&record(
                "problems/keyway.yaml",
                &["--seed", &seed.to_string()],
            ))
        })
        .collect();
    for other in totals {
        assert_ne!(other, total(&first));
        assert!(
            (other / total(&first) - 1.0).abs() < 0.03,
            "{other} {}",
            total(&first)
        );
    }
}
