//! `peenpose schema`: the JSON Schema of problem files.

use std::process::ExitCode;

use peenpose::problem;

use crate::output::{Failure, text};

/// Prints the schema.
pub fn run() -> Result<ExitCode, Failure> {
    text(format!("{:#}\n", problem::schema()))
}
