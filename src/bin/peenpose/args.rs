//! What can be typed.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Parser, Subcommand};
use peenpose::record::MapTerm;

use crate::impact::ImpactArgs;

/// Finds nozzle settings for precision shot peening deep inside keyways, bores and slots.
#[derive(Parser)]
#[command(version, after_help = EXIT_CODES)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "\
Exit status:
  0  the answer passes every verdict
  1  the best answer fails one, or the nozzle fits nowhere (still reported in full)
  2  bad input or failure

Results go to stdout, progress and warnings to stderr.";

/// The commands.
#[derive(Subcommand)]
pub enum Command {
    /// Find the best settings for a problem file
    Solve(SolveArgs),
    /// Say what given settings do
    Evaluate(EvaluateArgs),
    /// Draw the objective, or a term of it, over two settings
    Map(MapArgs),
    /// Measure speed against accuracy on a problem file, as figures and tables
    Chart(ChartArgs),
    /// Show all faults of problem files at once, and what can hardly be meant
    Check(CheckArgs),
    /// Compute one impact, or print the paper's tables
    Impact(ImpactArgs),
}

/// Arguments of `solve`.
#[derive(clap::Args)]
pub struct SolveArgs {
    /// The problem file
    pub file: PathBuf,
    /// Write result.json and sheet.txt into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print result.json instead of the technique sheet
    #[arg(long)]
    pub json: bool,
    /// Accuracy of J, such as `1 %`; the file's by default
    #[arg(long, value_name = "PERCENT")]
    pub accuracy: Option<String>,
    /// Seed of all samples; the file's by default
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Threads; all cores by default. The answer does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// No progress bar, no warnings
    #[arg(long)]
    pub quiet: bool,
}

/// Arguments of `evaluate`.
#[derive(clap::Args)]
pub struct EvaluateArgs {
    /// The problem file
    pub file: PathBuf,
    /// A setting, such as `incidence=60deg` or `contact=dry`; may be given several times
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Take the settings of this result.json; --set goes on top
    #[arg(long, value_name = "result.json")]
    pub from: Option<PathBuf>,
    /// Number of shots
    #[arg(long, value_name = "N", default_value_t = 65_536, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub shots: u32,
    /// Seed of all samples; the file's by default
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Threads; all cores by default. The answer does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Print JSON instead of the sheet
    #[arg(long)]
    pub json: bool,
    /// No warnings
    #[arg(long)]
    pub quiet: bool,
    /// Write result.json and sheet.txt into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Arguments of `map`.
#[derive(clap::Args)]
pub struct MapArgs {
    /// The problem file
    pub file: PathBuf,
    /// The setting of the lower axis, such as `incidence` or `incidence=40deg:80deg`
    #[arg(long, value_name = "NAME[=FROM:TO]")]
    pub x: String,
    /// The setting of the left axis
    #[arg(long, value_name = "NAME[=FROM:TO]")]
    pub y: String,
    /// What is drawn
    #[arg(long, default_value = "total", value_parser = terms())]
    pub term: String,
    /// Hold a setting, such as `standoff=8mm`; may be given several times
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Hold the settings of this result.json; --set goes on top
    #[arg(long, value_name = "result.json")]
    pub from: Option<PathBuf>,
    /// The contact; the best one by default
    #[arg(long, value_name = "NAME")]
    pub contact: Option<String>,
    /// Values along each axis
    #[arg(long, value_name = "N", default_value_t = 41, value_parser = clap::value_parser!(u16).range(2..=401))]
    pub steps: u16,
    /// Shots at each place
    #[arg(long, value_name = "N", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub shots: u32,
    /// Seed of all samples; the file's by default
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Threads; all cores by default. The map does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// No progress bar, no warnings
    #[arg(long)]
    pub quiet: bool,
    /// Write the map as SVG, PNG and CSV into this folder
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

fn terms() -> PossibleValuesParser {
    MapTerm::ALL.map(MapTerm::name).into()
}

/// Arguments of `chart`.
#[derive(clap::Args)]
pub struct ChartArgs {
    /// The problem file
    pub file: PathBuf,
    /// Write chart.txt, chart.json, tables and figures into this folder
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Show other methods too: a table `method,speed,seconds,excess`; may be given several times
    #[arg(long, value_name = "FILE.csv")]
    pub beside: Vec<PathBuf>,
    /// Most shots at a pose
    #[arg(long, value_name = "N", default_value_t = 1 << 18, value_parser = clap::value_parser!(u32).range(64..=1 << 20))]
    pub most_shots: u32,
    /// Searches with seeds of their own at each speed
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=100))]
    pub seeds: u16,
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

/// Arguments of `check`.
#[derive(clap::Args)]
pub struct CheckArgs {
    /// Problem files
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Let warnings count as faults
    #[arg(long)]
    pub deny_warnings: bool,
}
