//! How reliably the search finds the best settings known, and how well it knows its errors.
//!
//! Every problem is solved with many seeds. Each answer is compared with the best settings known on
//! common fresh shots, so that even small excesses are exact. Then the reported standard error is
//! put to the test: how often J +- 1.96 standard errors covers the true J of fixed settings.
//!
//! ```text
//! cargo run --release --example reliability -- target/reliability.csv target/coverage.csv
//! cargo run --release --example reliability -- part.csv covered.csv --seeds 10 --only long
//! ```

#[path = "../common/mod.rs"]
mod common;
mod coverage;
mod runs;

use std::error::Error;
use std::path::PathBuf;

use clap::Parser;

use common::known::Known;
use common::variant::variants;

/// How reliably the search finds the best settings known, and how well it knows its errors.
#[derive(Parser)]
struct Arguments {
    /// Where the table of runs goes.
    runs: PathBuf,
    /// Where the table of coverage goes.
    coverage: PathBuf,
    /// Seeds that every problem is solved with.
    #[arg(long, default_value_t = 100)]
    seeds: u64,
    /// Common fresh shots that answers are compared on.
    #[arg(long, default_value_t = 1 << 18)]
    shots: usize,
    /// Seeds of fresh shots whose intervals are counted.
    #[arg(long, default_value_t = 200)]
    intervals: u64,
    /// Shots behind what counts as the true J.
    #[arg(long, default_value_t = 1 << 28)]
    reference_shots: usize,
    /// Only variants whose name contains this.
    #[arg(long, default_value = "")]
    only: String,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let known = Known::read()?;
    let mut run_lines = vec![runs::HEADER.to_string()];
    let mut coverage_lines = vec![coverage::HEADER.to_string()];
    println!("{}", runs::HEADER);
    for variant in variants() {
        if variant.name().contains(&arguments.only) {
            let lines = runs::of_variant(&variant, &known, arguments.seeds, arguments.shots)?;
            run_lines.extend(lines);
        }
    }
    println!("\n{}", coverage::HEADER);
    for case in coverage::CASES {
        if case.variant.name().contains(&arguments.only) {
            let lines = case.lines(&known, arguments.intervals, arguments.reference_shots)?;
            coverage_lines.extend(lines);
        }
    }
    std::fs::write(&arguments.runs, run_lines.join("\n") + "\n")?;
    std::fs::write(&arguments.coverage, coverage_lines.join("\n") + "\n")?;
    Ok(())
}
