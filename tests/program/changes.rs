//! `--set` changes any key of a problem file.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::program::{self, GOOD, Run};

const KEYWAY: &str = "problems/keyway.yaml";

fn peenpose(arguments: &[&str]) -> Run {
    program::peenpose(arguments, Path::new(env!("CARGO_MANIFEST_DIR")))
}

/// What a run prints as JSON, but for its times and for what names the file.
fn answer(arguments: &[&str]) -> Value {
    let run = peenpose(&[arguments, &["--json", "--quiet"]].concat());
    assert!(run.status < 2, "{}", run.messages);
    let mut answer: Value = serde_json::from_str(&run.out).unwrap();
    answer["work"]["seconds"] = Value::Null;
    answer["command"] = Value::Null;
    answer["problem"]["file"] = Value::Null;
    answer
}

/// The same answer as that of the file in which it stands, to the last bit.
#[test]
fn a_changed_key_is_that_of_the_file() {
    let folder = TempDir::new().unwrap();
    let text = fs::read_to_string(KEYWAY).unwrap();
    let changed = folder.path().join("keyway.yaml");
    assert!(text.contains("oiled: { mu_s: 0.06, mu_d: 0.054, restitution: 0.25 }"));
    let with = text
        .replace(
            "oiled: { mu_s: 0.06, mu_d: 0.054, restitution: 0.25 }",
            "oiled: { mu_s: 0.06, mu_d: 0.054, restitution: 0.3 }",
        )
        .replace("accuracy: 1 %", "accuracy: 5 %");
    fs::write(&changed, &with).unwrap();
    let set = [
        "--set",
        "contacts.oiled.restitution=0.3",
        "--set",
        "solve.accuracy=5 %",
    ];
    let by_file = answer(&["solve", changed.to_str().unwrap()]);
    let by_set = answer(&[&["solve", KEYWAY], &set[..]].concat());
    assert_eq!(by_set["problem_sha256"], by_file["problem_sha256"]);
    assert!(by_set == by_file);
    let original = answer(&["solve", KEYWAY]);
    assert_ne!(original["best"]["objective"], by_set["best"]["objective"]);
}

/// The command of the sheet gives the same again, and settings go beside keys.
#[test]
fn an_evaluation_takes_settings_and_keys() {
    let set = [&["evaluate", KEYWAY, "--shots", "1024"][..], &GOOD].concat();
    let plain = answer(&set);
    let changed = [&set[..], &["--set", "jet.exit_diameter=3 mm"]].concat();
    let run = peenpose(&changed);
    assert!(run.out.contains("exit 3 mm"), "{}", run.out);
    let command = run
        .out
        .lines()
        .skip_while(|line| *line != "REPRODUCE")
        .nth(1)
        .unwrap();
    assert!(
        command.contains("--set 'jet.exit_diameter=3 mm'"),
        "{command}"
    );
    assert_ne!(
        plain["best"]["objective"],
        answer(&changed)["best"]["objective"]
    );
}

#[test]
fn what_cannot_be_changed_is_refused() {
    for (set, words) in [
        (
            "contacts.dry.restitutoin=0.3",
            &[
                "contacts.dry.restitutoin",
                "did you mean `restitution`?",
                "with what --set changes",
            ][..],
        ),
        ("contacts.dry.restitution", &["expected KEY=VALUE"]),
        (
            "contacts.dry.restitution=3",
            &["contacts.dry.restitution: `3`"],
        ),
        (
            "target.surface[0]=3",
            &["target.surface[0]: [0] would be in what is no list"],
        ),
        ("speed=3 m/s", &["speed", "settings"]),
    ] {
        let run = peenpose(&["solve", KEYWAY, "--set", set]);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{set}");
        for word in words {
            assert!(
                run.messages.contains(word),
                "{set}: {word} is not in\n{}",
                run.messages
            );
        }
    }
}
