//! What can be typed.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand};
use clap_complete::Shell;
use peenpose::record::MapTerm;

use crate::campaign::CampaignArgs;
use crate::impact::ImpactArgs;
use crate::init::Template;
use crate::start::StartArgs;
use crate::surfaces::SurfacesArgs;

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
    #[command(after_help = SOLVE_EXAMPLES)]
    Solve(SolveArgs),
    /// Say what given settings do
    #[command(after_help = EVALUATE_EXAMPLES)]
    Evaluate(EvaluateArgs),
    /// Draw the objective, or a term of it, over two settings
    #[command(after_help = MAP_EXAMPLES)]
    Map(MapArgs),
    /// Make all reports again from the result in a folder
    #[command(after_help = REPORT_EXAMPLES)]
    Report(ReportArgs),
    /// Write scene, nozzle, paths and hits of a result for other programs
    #[command(after_help = EXPORT_EXAMPLES)]
    Export(ExportArgs),
    /// Measure speed against accuracy on a problem file, as figures and tables
    #[command(after_help = CHART_EXAMPLES)]
    Chart(ChartArgs),
    /// Show all faults of problem files at once, and what can hardly be meant
    #[command(after_help = CHECK_EXAMPLES)]
    Check(CheckArgs),
    /// Compute one impact, or print the paper's tables
    #[command(after_help = IMPACT_EXAMPLES)]
    Impact(ImpactArgs),
    /// Write a commented problem file to start from
    #[command(after_help = INIT_EXAMPLES)]
    Init(InitArgs),
    /// Solve many problems made from one, in shards that any queue can start
    #[command(after_help = CAMPAIGN_EXAMPLES)]
    Campaign(CampaignArgs),
    /// List shot and contacts that a problem file may use, with the source of every number
    #[command(after_help = MEDIA_EXAMPLES)]
    Media(MediaArgs),
    /// List the smooth faces of a mesh, each with a point that names it in a problem file
    #[command(after_help = SURFACES_EXAMPLES)]
    Surfaces(SurfacesArgs),
    /// Print the JSON Schema of problem files, for editors
    #[command(after_help = SCHEMA_EXAMPLES)]
    Schema,
    /// Print completions for a shell
    #[command(after_help = COMPLETIONS_EXAMPLES)]
    Completions(CompletionsArgs),
    /// Print the manual page
    #[command(after_help = MAN_EXAMPLES)]
    Man(ManArgs),
}

const SOLVE_EXAMPLES: &str = "\
Examples:
  peenpose solve keyway.yaml                        the technique sheet
  peenpose solve keyway.yaml --out result           sheet, result.json and figures in a folder
  peenpose solve keyway.yaml --pareto               what can be had instead, too
  peenpose solve keyway.yaml --set contacts.dry.restitution=0.3 --set 'settings.speed=[5 m/s, 20 m/s]'
                                                    with other values than the file's
  peenpose solve keyway.yaml --json | jq .best.settings
  peenpose solve keyway.yaml --out result --checkpoint kept
                                                    goes on where it was, if it was ended
Ctrl-C ends the search with the best answer so far.";

const EVALUATE_EXAMPLES: &str = "\
Examples:
  peenpose evaluate keyway.yaml --set incidence=80deg --set azimuth=0deg \\
      --set standoff=8mm --set speed=9.4m/s --set contact=oiled
  peenpose evaluate keyway.yaml --from result/result.json --set speed=9.8m/s";

const MAP_EXAMPLES: &str = "\
Examples:
  peenpose map keyway.yaml --x incidence --y azimuth --out maps
  peenpose map keyway.yaml --x incidence=55deg:75deg --y standoff --term rebound \\
      --from result/result.json --out maps
Without --from and --set the best settings are searched first.
Ctrl-C ends the map with the places that are known; the others stay blank.";

const REPORT_EXAMPLES: &str = "\
Examples:
  peenpose report result
  peenpose report result --exposure 1,2,4,8         a stroke for each exposure of a set-up test";

const EXPORT_EXAMPLES: &str = "\
Examples:
  peenpose export result --out scene.glb
  peenpose export result --out paths.vtk";

const CHART_EXAMPLES: &str = "\
Examples:
  peenpose chart keyway.yaml --out chart
  peenpose chart keyway.yaml --out chart --beside other-method.csv";

const CHECK_EXAMPLES: &str = "\
Examples:
  peenpose check *.yaml
  peenpose check --deny-warnings keyway.yaml";

const IMPACT_EXAMPLES: &str = "\
Examples:
  peenpose impact --speed '10 m/s' --angle '60 deg' --mu-s 0.12
  peenpose impact --table zohdi1";

const INIT_EXAMPLES: &str = "\
Examples:
  peenpose init --out part.yaml                     a keyway, with the schema beside it
  peenpose init mesh --out part.yaml                a part from CAD, with a small mesh to try
  peenpose init stroke --out part.yaml              a keyway that is peened over its whole length
  peenpose init plate | less";

const MEDIA_EXAMPLES: &str = "\
Examples:
  peenpose media
  peenpose media --json | jq .shot";

const SCHEMA_EXAMPLES: &str = "\
Examples:
  peenpose schema > peenpose.schema.json";

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  peenpose completions bash > ~/.local/share/bash-completion/completions/peenpose
  peenpose completions zsh > ~/.zfunc/_peenpose
  peenpose completions fish > ~/.config/fish/completions/peenpose.fish";

const MAN_EXAMPLES: &str = "\
Examples:
  peenpose man | man -l -
  peenpose man solve | man -l -
  peenpose man --out ~/.local/share/man/man1";

const CAMPAIGN_EXAMPLES: &str = "\
Examples:
  peenpose campaign plan campaign.yaml --out study
  peenpose campaign run study                       every case that is missing
  peenpose campaign run study --shard 3/8           the third eighth of them
  peenpose campaign status study
  peenpose campaign gather study                    study/table.csv
A run that was ended goes on where it was. Exit status of `run`: 0 also where verdicts fail, 2 where problems have faults.";

const SURFACES_EXAMPLES: &str = "\
Examples:
  peenpose surfaces housing.stl                     numbers, forms, sizes, and a point of each
  peenpose surfaces housing.stl --angle '20 deg' --out faces.svg
In the problem file: regions: { floor: { at: [x, y, z] } }";

/// Arguments of `completions`.
#[derive(clap::Args)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: Shell,
}

/// Arguments of `man`.
#[derive(clap::Args)]
pub struct ManArgs {
    /// The command that the page is about; the whole program by default
    pub command: Option<String>,
    /// Write the pages of all commands into this folder
    #[arg(long, value_name = "DIR", conflicts_with = "command")]
    pub out: Option<PathBuf>,
}

/// Arguments of `solve`.
#[derive(clap::Args)]
pub struct SolveArgs {
    /// The problem file
    pub file: PathBuf,
    /// Change a key of the problem file, such as `contacts.dry.restitution=0.3`; may be given several times
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Write result.json and all reports on it into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print result.json instead of the technique sheet
    #[arg(long)]
    pub json: bool,
    /// Print the whole sheet on a terminal, too, not just its head
    #[arg(long)]
    pub full: bool,
    /// Accuracy of J, such as `1 %`; the file's by default
    #[arg(long, value_name = "PERCENT")]
    pub accuracy: Option<String>,
    /// Show the trade-off between target error, tangential risk and rebound, too
    #[arg(long)]
    pub pareto: bool,
    /// Keep what was worked out in this folder, and go on from what is there
    #[arg(long, value_name = "DIR")]
    pub checkpoint: Option<PathBuf>,
    #[command(flatten)]
    pub start: StartArgs,
    /// Exposures of a set-up test, such as `1,2,4,8`: the same stroke that many times as slow, in files of their own
    #[arg(long, value_name = "TIMES", value_delimiter = ',', requires = "out", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub exposure: Vec<u32>,
}

/// Arguments of `evaluate`.
#[derive(clap::Args)]
pub struct EvaluateArgs {
    /// The problem file
    pub file: PathBuf,
    /// A setting, such as `incidence=60deg` or `contact=dry`, or a key of the problem file with its groups, such as
    /// `contacts.dry.restitution=0.3`; may be given several times
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Take the settings of this result.json; --set goes on top
    #[arg(long, value_name = "result.json")]
    pub from: Option<PathBuf>,
    /// Number of shots
    #[arg(long, value_name = "N", default_value_t = 65_536, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub shots: u32,
    #[command(flatten)]
    pub start: StartArgs,
    /// Print JSON instead of the sheet
    #[arg(long)]
    pub json: bool,
    /// Print the whole sheet on a terminal, too, not just its head
    #[arg(long)]
    pub full: bool,
    /// Write result.json and all reports on it into this folder
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
    pub term: MapTerm,
    /// Hold a setting, such as `standoff=8mm`, or change a key of the problem file with its groups, such as
    /// `contacts.dry.restitution=0.3`; may be given several times
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
    /// Keep what was worked out in this folder, and go on from what is there
    #[arg(long, value_name = "DIR")]
    pub checkpoint: Option<PathBuf>,
    #[command(flatten)]
    pub start: StartArgs,
    /// Write the map as SVG, PNG and CSV into this folder
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

fn terms() -> impl TypedValueParser<Value = MapTerm> {
    PossibleValuesParser::new(MapTerm::ALL.map(MapTerm::name)).try_map(|name| {
        let mut terms = MapTerm::ALL.into_iter();
        terms.find(|term| term.name() == name).ok_or("no such term")
    })
}

/// Arguments of `report`.
#[derive(clap::Args)]
pub struct ReportArgs {
    /// The folder that `--out` has written into
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Exposures of a set-up test, such as `1,2,4,8`: the same stroke that many times as slow, in files of their own
    #[arg(long, value_name = "TIMES", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub exposure: Vec<u32>,
}

/// Arguments of `export`.
#[derive(clap::Args)]
pub struct ExportArgs {
    /// The folder that `--out` has written into, or its result.json
    #[arg(value_name = "DIR|result.json")]
    pub result: PathBuf,
    /// The file; its ending says the format: .glb (glTF), .vtk (ParaView) or .ply (MeshLab)
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
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
    #[command(flatten)]
    pub start: StartArgs,
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

/// Arguments of `init`.
#[derive(clap::Args)]
pub struct InitArgs {
    /// What the part is like; keyway where absent, but asked for on a terminal
    #[arg(value_enum)]
    pub kind: Option<Template>,
    /// Write it to this file, with what belongs to it beside; it goes to stdout otherwise
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write over files that are there already
    #[arg(long, requires = "out")]
    pub force: bool,
}

/// Arguments of `media`.
#[derive(clap::Args)]
pub struct MediaArgs {
    /// Print JSON instead of tables
    #[arg(long)]
    pub json: bool,
}
