//! `peenpose report`: all reports again, from a result alone.

use std::process::ExitCode;

use crate::args::ReportArgs;
use crate::folder::{self, Staged};
use crate::output::{self, Failure, both};
use crate::result::{self, RESULT};
use crate::start;

/// Writes the reports beside their result, and lists them.
pub fn run(args: &ReportArgs) -> Result<ExitCode, Failure> {
    start::use_threads(None)?;
    let record = result::read(&args.folder.join(RESULT))?;
    folder::prepare(Some(&args.folder))?;
    if record.evidence.is_none() {
        output::warn(&format!(
            "{} holds no hits, rebounds and places: their tables are not made; `--out` of this \
             version writes them",
            args.folder.join(RESULT).display()
        ));
    }
    let mut files = Staged::new(&args.folder);
    let made = result::add_reports(&record, &args.exposure, &mut files);
    let mut list = String::new();
    for name in files.names() {
        list += &format!("{}\n", args.folder.join(name).display());
    }
    both(made, files.put())?;
    output::text(list)
}
