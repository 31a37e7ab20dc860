//! The same question gives the same answer, bit for bit, on other processors and with another C library.
//!
//! Processors are played by `qemu-x86_64` (Debian: qemu-user); the other library is the machine's own with
//! the last bit of its elementary functions turned over, compiled by `cc` and loaded before it.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use std::env;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

/// How a program is run.
enum On<'a> {
    ThisMachine,
    /// A processor of this model.
    Processor(&'a str),
    /// With a library before all others.
    Preloaded(&'a Path),
}

/// From before AVX and FMA.
const OLD: &str = "Nehalem";
/// With all that qemu knows, AVX2 and FMA among it.
const NEW: &str = "max";

/// One of each kind: prismatic walls with shots of a size, a mesh, a part with another inside.
const PROBLEMS: [&str; 3] = ["keyway", "keyway-blind", "deflector"];

fn output(program: &str, arguments: &[&str], on: &On) -> String {
    let mut command = match on {
        On::Processor(model) => {
            let mut qemu = Command::new("qemu-x86_64");
            qemu.args(["-cpu", model, program]);
            qemu
        }
        On::ThisMachine | On::Preloaded(_) => Command::new(program),
    };
    if let On::Preloaded(library) = on {
        command.env("LD_PRELOAD", library);
    }
    let output = command
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stderr(Stdio::inherit())
        .output()
        .unwrap_or_else(|error| panic!("{:?}: {error}; is it installed?", command.get_program()));
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{arguments:?}: {}",
        output.status
    );
    String::from_utf8(output.stdout).expect("text on stdout")
}

/// What the program says to a question, less what a clock measured.
fn record(question: &[&str], on: &On) -> String {
    let arguments = [question, &["--json"]].concat();
    let text = output(env!("CARGO_BIN_EXE_peenpose"), &arguments, on);
    let mut record: Value = serde_json::from_str(&text).expect("JSON on stdout");
    record["work"]["seconds"].take();
    assert!(
        record["best"]["objective"]["total"].is_f64(),
        "{question:?}"
    );
    // Text of all digits: equal means bit for bit.
    record.to_string()
}

/// Searches for an answer, coarsely, as emulated processors are slow.
fn assert_same_search(problem: &str, on: &On) {
    let file = format!("problems/{problem}.yaml");
    assert_same(&["solve", &file, "--accuracy", "10 %"], on);
}

fn assert_same(question: &[&str], on: &On) {
    let (here, there) = (record(question, &On::ThisMachine), record(question, on));
    let differs = here.bytes().zip(there.bytes()).position(|(a, b)| a != b);
    let around = |text: &str, at: usize| {
        let bytes = &text.as_bytes()[at.saturating_sub(80)..(at + 40).min(text.len())];
        String::from_utf8_lossy(bytes).into_owned()
    };
    if let Some(at) = differs {
        let (here, there) = (around(&here, at), around(&there, at));
        panic!("{question:?}:\n here {here}\nthere {there}");
    }
    assert_eq!(here.len(), there.len(), "{question:?}");
}

/// What one of the tests below, run by itself on something else, prints.
fn told(test: &str, on: &On) -> String {
    let program = env::current_exe().unwrap();
    let test = format!("same_bits::{test}");
    let arguments = [&*test, "--exact", "--ignored", "--nocapture"];
    let text = output(program.to_str().unwrap(), &arguments, on);
    let line = text.lines().find(|line| line.contains("told "));
    let line = line.unwrap_or_else(|| panic!("{text}"));
    line.split_once("told ").unwrap().1.to_owned()
}

#[test]
#[ignore = "tells others what this machine is"]
fn what_the_processor_is() {
    println!("\ntold avx2 {}", std::is_x86_feature_detected!("avx2"));
}

#[test]
#[ignore = "tells others what this machine computes"]
fn what_the_library_computes() {
    let x = black_box(0.7_f64);
    let bits = [x.sin(), x.cos(), x.exp(), x.ln(), x.powf(x), x.atan2(2.0)].map(f64::to_bits);
    println!("\ntold {bits:?}");
}

#[test]
#[ignore = "needs qemu-x86_64, and takes a minute"]
fn other_processors_give_the_same_bits() {
    // They are others, indeed.
    let processor = |model| told("what_the_processor_is", &On::Processor(model));
    assert_eq!(processor(OLD), "avx2 false");
    assert_eq!(processor(NEW), "avx2 true");
    assert_same_search("keyway", &On::Processor(OLD));
    // Other searches take an emulator minutes: it evaluates what they found.
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().to_str().expect("a path in Unicode");
    for problem in ["keyway", "keyway-blind"] {
        let file = format!("problems/{problem}.yaml");
        let solve = ["solve", &file, "--accuracy", "10 %", "--out", folder];
        output(env!("CARGO_BIN_EXE_peenpose"), &solve, &On::ThisMachine);
        let found = format!("{folder}/result.json");
        for model in [OLD, NEW] {
            let evaluate = ["evaluate", &file, "--from", &found, "--shots", "16384"];
            assert_same(&evaluate, &On::Processor(model));
        }
    }
}

#[test]
#[ignore = "needs a C compiler"]
fn another_c_library_gives_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let library: PathBuf = folder.path().join("libother.so");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/same_bits/other_libm.c");
    let compiled = Command::new("cc")
        .args(["-shared", "-fPIC", "-fno-builtin", "-o"])
        .args([&library, &source])
        .args(["-ldl", "-lm"])
        .status()
        .expect("a C compiler called cc");
    assert!(compiled.success());
    let other = On::Preloaded(&library);
    // It is another one, indeed.
    let computed = |on: &On| told("what_the_library_computes", on);
    assert_ne!(computed(&On::ThisMachine), computed(&other));
    for problem in PROBLEMS {
        assert_same_search(problem, &other);
    }
}
