//! `peenpose check`: all faults of files at once, and what can hardly be meant.

use std::process::ExitCode;

use peenpose::study::Study;

use crate::args::CheckArgs;
use crate::output::{BAD_INPUT, Failure, text, warnings};
use crate::start;

/// Checks files; the faults of all of them are the failure.
pub fn run(args: &CheckArgs) -> Result<ExitCode, Failure> {
    start::use_threads(None)?;
    let mut failed = ExitCode::SUCCESS;
    let mut good = String::new();
    for path in &args.files {
        match Study::open(path) {
            Ok(study) => {
                let found = warnings(&study);
                let scenario = study.scenario();
                if args.deny_warnings && found > 0 {
                    failed = ExitCode::from(BAD_INPUT);
                    continue;
                }
                let problem = &scenario.problem;
                good += &format!(
                    "{}: ok, {}: {} surfaces, {} triangles, {} contacts\n",
                    path.display(),
                    problem.title,
                    scenario.scene.surfaces().len(),
                    scenario.scene.triangles(),
                    problem.ranges.contact.len(),
                );
                for warning in scenario.scene.warnings() {
                    good += &format!("  warning: {warning}\n");
                }
            }
            Err(rejection) => failed = Failure::from(rejection).report(),
        }
    }
    text(good)?;
    Ok(failed)
}
