//! `peenpose media`: the library of shot and contacts.

use std::process::ExitCode;

use peenpose::report;

use crate::args::MediaArgs;
use crate::output::{Failure, text};

/// Prints the library as a table or as JSON.
pub fn run(args: &MediaArgs) -> Result<ExitCode, Failure> {
    if !args.json {
        return text(report::library());
    }
    let json = report::library_json()
        .map_err(|error| format!("cannot write the library as JSON: {error}"))?;
    text(json + "\n")
}
