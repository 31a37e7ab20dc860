//! Methods of optimisation on the same shots: how often and how soon each comes within 1 % of the
//! least J, with the speed searched and with the speed taken out.
//!
//! `cargo bench -p peenpose-methods` prints the tables and writes `target/methods.csv`, which holds every
//! run at several numbers of evaluations, with the true excess over the best settings known; of each
//! problem it writes the same beside that file as `peenpose chart --beside` reads it.

#[path = "../../examples/common/mod.rs"]
mod common;

mod annealing;
mod bounded;
mod case;
mod gradient;
mod line;
mod model;
mod objective;
mod population;
mod sampling;
mod shipped;
mod simplex;
mod swarm;
mod table;

use std::error::Error;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use clap::Parser;

use case::{Case, Run, cases};
use common::known::Known;
use objective::Speed;

/// Methods of optimisation on the same shots.
#[derive(Parser)]
struct Arguments {
    /// Where all runs go.
    #[arg(default_value_os_t = common::root().join("target/methods.csv"))]
    table: PathBuf,
    /// Seeds of shots and of methods.
    #[arg(long, default_value_t = 20)]
    seeds: u64,
    /// Evaluations of a run.
    #[arg(long, default_value_t = 3000)]
    budget: usize,
    /// Only problems whose name contains this.
    #[arg(long, default_value = "")]
    only: String,
    /// Given by `cargo bench`.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let mut lines = vec![table::HEADER.to_string()];
    for case in cases(&Known::read()?, &arguments.only)? {
        let runs = all_runs(&case, &arguments);
        let excesses = table::true_excesses(&case, &runs);
        println!("{}", table::table(&case, &runs, &excesses));
        lines.extend(table::lines(&case, &runs, &excesses));
        let name = case.name.replace(", ", "-").replace(' ', "-");
        for speed in [Speed::Searched, Speed::Removed] {
            let file = format!("methods-{name}-{}.csv", table::word(speed));
            let beside = arguments.table.with_file_name(file);
            std::fs::write(&beside, table::beside(&runs, &excesses, speed))?;
            println!("written: {}", beside.display());
        }
        println!();
    }
    std::fs::write(&arguments.table, lines.join("\n") + "\n")?;
    println!("written: {}", arguments.table.display());
    Ok(())
}

/// The runs of all seeds. Every run has a core of its own, so that its seconds count.
fn all_runs(case: &Case, arguments: &Arguments) -> Vec<Run> {
    let next = AtomicU64::new(1);
    let all = Mutex::new(Vec::new());
    let work = || {
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed > arguments.seeds {
                return;
            }
            let runs = case.runs(seed, arguments.budget);
            all.lock().expect("no other thread has failed").extend(runs);
        }
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(work);
        }
    });
    let mut runs: Vec<Run> = all.into_inner().expect("no thread has failed");
    runs.sort_by_key(|run| run.seed);
    runs
}
