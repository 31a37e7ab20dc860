//! `peenpose report`: all reports again, from a result alone.

use std::process::ExitCode;

use crate::args::ReportArgs;
use crate::output::{self, Failure, RESULT};

/// Writes the reports beside their result, and lists them.
pub fn run(args: &ReportArgs) -> Result<ExitCode, Failure> {
    let record = output::read_record(&args.folder.join(RESULT))?;
    if record.evidence.is_none() {
        output::warn(&format!(
            "{} holds no hits, rebounds and places: their tables are not made; `--out` of this \
             version writes them",
            args.folder.join(RESULT).display()
        ));
    }
    let mut list = String::new();
    for name in output::reports(&record, &args.folder)? {
        list += &format!("{}\n", args.folder.join(name).display());
    }
    output::text(list)
}
