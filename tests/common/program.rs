//! The program from outside.

use std::ffi::OsStr;
use std::path::Path;
use std::time::Duration;

use assert_cmd::Command;
use serde_json::Value;

/// Settings near the best of the keyway.
pub const GOOD: [&str; 10] = [
    "--set",
    "incidence=67deg",
    "--set",
    "azimuth=0deg",
    "--set",
    "standoff=8mm",
    "--set",
    "speed=9.4m/s",
    "--set",
    "contact=oiled",
];

/// What the program did.
pub struct Run {
    pub status: i32,
    pub out: String,
    pub messages: String,
}

impl Run {
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.out).expect("JSON on stdout")
    }
}

/// Runs the program in a folder; it must neither panic nor be killed.
pub fn peenpose<A: AsRef<OsStr>>(arguments: impl IntoIterator<Item = A>, folder: &Path) -> Run {
    let output = Command::new(env!("CARGO_BIN_EXE_peenpose"))
        .args(arguments)
        .current_dir(folder)
        .timeout(Duration::from_secs(300))
        .output()
        .unwrap();
    let run = Run {
        status: output.status.code().expect("it was not killed"),
        out: String::from_utf8(output.stdout).unwrap(),
        messages: String::from_utf8(output.stderr).unwrap(),
    };
    assert!(!run.messages.contains("panicked"), "{}", run.messages);
    run
}
