//! Results that are kept in `tests/data/sheets`.

use std::path::{Path, PathBuf};

use peenpose::record::Record;

pub const NAMES: [&str; 7] = [
    "keyway",
    "long_keyway",
    "plate",
    "given_fails",
    "given_collides",
    "given_unknown",
    "no_room",
];

/// The file of one of them, `json` or `txt`.
pub fn file(name: &str, extension: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/sheets")
        .join(name)
        .with_extension(extension)
}

pub fn record(name: &str) -> Record {
    let text = std::fs::read_to_string(file(name, "json")).unwrap();
    Record::from_json(&text).unwrap()
}
