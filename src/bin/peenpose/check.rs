//! `peenpose check`: all faults of files at once.

use std::process::ExitCode;

use peenpose::setup::Setup;

use crate::args::CheckArgs;
use crate::output::{Failure, text};

/// Checks files; the faults of all of them are the failure.
pub fn run(args: &CheckArgs) -> Result<ExitCode, Failure> {
    let mut failed = ExitCode::SUCCESS;
    let mut good = String::new();
    for path in &args.files {
        match Setup::load(path) {
            Ok((setup, _)) => {
                let problem = &setup.problem;
                good += &format!(
                    "{}: ok, {}: {} surfaces, {} triangles, {} contacts\n",
                    path.display(),
                    problem.title,
                    setup.scene.surfaces().len(),
                    setup.scene.triangles(),
                    problem.settings.contact.len(),
                );
                for warning in setup.scene.warnings() {
                    good += &format!("  warning: {warning}\n");
                }
            }
            Err(rejection) => failed = Failure::from(rejection).report(),
        }
    }
    text(good)?;
    Ok(failed)
}
