//! The suite of search problems: how often an answer is the best that is known, passes, and says so truly.
//!
//! Every problem is solved with many seeds. J of each answer is compared with that of the best settings known on
//! common validation shots; these are in `tests/data/suite.csv`.
//!
//! ```text
//! cargo run --release --example suite -- target/suite.csv
//! cargo run --release --example suite -- target/suite.csv --seeds 5 --only window
//! ```

#[path = "../common/mod.rs"]
mod common;
mod row;

use std::error::Error;
use std::path::PathBuf;

use clap::Parser;
use common::suite::{self, KnownBest};
use row::{HEADER, Row, Run};

/// How often answers are the best that is known, pass, and say so truly.
#[derive(Parser)]
struct Arguments {
    /// Where the table goes.
    table: PathBuf,
    /// Seeds that every problem is solved with.
    #[arg(long, default_value_t = 20)]
    seeds: u64,
    /// The first of them.
    #[arg(long, default_value_t = 1)]
    first: u64,
    /// Common validation shots that answers are compared on: so many that one rare shot is worth less than the accuracy.
    #[arg(long, default_value_t = 1 << 21)]
    shots: usize,
    /// Only problems whose name contains this.
    #[arg(long, default_value = "")]
    only: String,
    /// Accuracy instead of the file's, %.
    #[arg(long)]
    accuracy: Option<f64>,
    /// Tells the settings of every run, too.
    #[arg(long)]
    runs: bool,
    /// Writes what is better than the best known over it.
    #[arg(long)]
    update: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let mut known = KnownBest::all()?;
    let mut table = format!("{HEADER}\n");
    println!("{HEADER}");
    for (name, path) in suite::problems() {
        if !name.contains(&arguments.only) {
            continue;
        }
        let mut scenario = suite::scenario(&path)?;
        if let Some(percent) = arguments.accuracy {
            scenario.problem.accuracy = percent / 100.0;
        }
        let seeds = arguments.first..arguments.first + arguments.seeds;
        let runs: Vec<Run> = seeds.map(|seed| Run::of(&mut scenario, seed)).collect();
        let best = known.iter().position(|it| it.problem == name);
        let row = Row::new(
            &name,
            &scenario,
            best.map(|index| &known[index]),
            &runs,
            arguments.shots,
        )?;
        println!("{}", row.line);
        if arguments.runs {
            row.tell_runs(&runs);
        }
        table += &format!("{}\n", row.line);
        if arguments.update
            && let Some(better) = row.better
        {
            match best {
                Some(index) => known[index] = better,
                None => known.push(better),
            }
            KnownBest::write(&known)?;
        }
    }
    std::fs::write(&arguments.table, table)?;
    Ok(())
}
