//! How every command that computes begins.

use std::path::Path;

use peenpose::problem::Source;
use peenpose::setup::Setup;

use crate::output::{self, Failure};

/// What all of them can be told.
#[derive(clap::Args)]
pub struct StartArgs {
    /// Seed of all samples; the file's by default
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Threads; all cores by default. Only times depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// No progress bar, no warnings
    #[arg(long)]
    pub quiet: bool,
}

/// Reads a problem file and shows its warnings, after it is known that results can be written.
pub fn load(args: &StartArgs, file: &Path, out: Option<&Path>) -> Result<(Setup, Source), Failure> {
    args.threads.map_or(Ok(()), use_threads)?;
    output::prepare(out)?;
    let (mut setup, source) = Setup::load(file)?;
    if !args.quiet {
        output::warnings(&setup, &source);
        for warning in setup.scene.warnings() {
            output::warn(warning);
        }
    }
    if let Some(seed) = args.seed {
        setup.problem.seed = seed;
    }
    Ok((setup, source))
}

fn use_threads(threads: u16) -> Result<(), String> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.into())
        .build_global()
        .map_err(|error| format!("cannot start {threads} threads: {error}"))
}
