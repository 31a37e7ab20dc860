//! How every command that computes begins.

use std::num::NonZero;
use std::path::Path;
use std::thread::{available_parallelism, sleep};
use std::time::{Duration, Instant};

use peenpose::control::Clock;
use peenpose::problem::change::Change;
use peenpose::problem::fault::Fault;
use peenpose::study::Study;

use crate::folder;
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
    /// Who casts the rays: this program, or parry as the reference, for shots as points at meshes
    #[arg(long, value_name = "ENGINE", default_value = "own")]
    pub rays: Engine,
    /// No progress bar, no warnings
    #[arg(long)]
    pub quiet: bool,
}

/// Who casts the rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// This program: exact walls, trees of triangles, shots of finite size
    Own,
    /// The casts of the parry library
    Parry,
}

/// Reads a problem file and shows its warnings, after it is known that results can be written.
pub fn open(
    args: &StartArgs,
    file: &Path,
    changes: &[Change],
    out: Option<&Path>,
) -> Result<Study, Failure> {
    use_threads(args.threads)?;
    folder::prepare(out)?;
    let study = Study::open_changed(file, changes).inspect_err(|rejection| {
        if !changes.is_empty() && rejection.source.is_some() {
            output::note("lines are those of the file with what --set changes in it");
        }
    })?;
    if !args.quiet {
        output::warnings(&study);
        for warning in study.scenario().scene.warnings() {
            output::warn(warning);
        }
    }
    let study = match args.rays {
        Engine::Own => study,
        Engine::Parry => study.with_parry_rays().map_err(|faults| {
            Failure::all(&faults.iter().map(Fault::to_string).collect::<Vec<_>>())
        })?,
    };
    Ok(match args.seed {
        Some(seed) => study.with_seed(seed),
        None => study,
    })
}

/// A clock that begins now.
pub fn clock() -> Clock {
    let started = Instant::now();
    Clock::new(move || started.elapsed().as_secs_f64())
}

/// Starts the threads that compute, one for each core unless told otherwise. Where none are to be had it
/// is a failure here, before anything that cannot do without.
pub fn use_threads(asked: Option<u16>) -> Result<(), String> {
    let cores = available_parallelism().map_or(1, NonZero::get);
    let most = cores.saturating_mul(MOST_PER_CORE).max(LEAST_MOST);
    let threads = asked.map_or(cores, |asked| usize::from(asked).min(most));
    if let Some(asked) = asked.filter(|&asked| usize::from(asked) > most) {
        output::note(&format!(
            "--threads {asked}: more than {most} threads only wait for each other here; {most} are used"
        ));
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|error| {
            format!("cannot start {threads} threads: {error}; --threads asks for fewer")
        })?;
    // The progress bar and whoever waits for Ctrl-C need one each.
    let spare = || std::thread::Builder::new().spawn(|| sleep(Duration::from_millis(1)));
    let both = [spare(), spare()]
        .into_iter()
        .collect::<Result<Vec<_>, _>>();
    both.map(drop).map_err(|error| {
        format!("cannot start a thread beside {threads} others: {error}; --threads asks for fewer")
    })
}

/// More threads for each core only wait for each other,
const MOST_PER_CORE: usize = 16;
/// but this many are harmless.
const LEAST_MOST: usize = 256;
