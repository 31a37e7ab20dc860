//! `peenpose campaign`: many problems from one.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};

use peenpose::campaign::{CampaignFolder, CaseStatus, Outcome, Plan, Shard};
use peenpose::control::Control;

use crate::output::{self, BAD_INPUT, Failure};
use crate::progress::{ENDED, Watcher};
use crate::{folder, start};

/// Arguments of `campaign`.
#[derive(clap::Args)]
pub struct CampaignArgs {
    /// What to do
    #[command(subcommand)]
    pub command: CampaignCommand,
}

/// Commands of a campaign.
#[derive(clap::Subcommand)]
pub enum CampaignCommand {
    /// Write what there is to solve into a folder
    Plan(PlanArgs),
    /// Solve the cases that are missing
    Run(RunArgs),
    /// Count the cases that are done, missing and faulty
    Status(StatusArgs),
    /// Write the table of all cases
    Gather(GatherArgs),
}

/// Arguments of `campaign plan`.
#[derive(clap::Args)]
pub struct PlanArgs {
    /// The campaign file
    pub file: PathBuf,
    /// The folder of the campaign
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Arguments of `campaign run`.
#[derive(clap::Args)]
pub struct RunArgs {
    /// The folder of the campaign
    pub folder: PathBuf,
    /// Every so many-th case only: `3/8` is the third of eight shards
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub shard: Shard,
    /// Threads; all cores by default. Only times depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// No progress bar
    #[arg(long)]
    pub quiet: bool,
}

/// Arguments of `campaign status`.
#[derive(clap::Args)]
pub struct StatusArgs {
    /// The folder of the campaign
    pub folder: PathBuf,
}

/// Arguments of `campaign gather`.
#[derive(clap::Args)]
pub struct GatherArgs {
    /// The folder of the campaign
    pub folder: PathBuf,
    /// Where the table goes; table.csv in the folder by default
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Runs one of its commands.
pub fn run(command: &CampaignCommand) -> Result<ExitCode, Failure> {
    match command {
        CampaignCommand::Plan(args) => plan(args),
        CampaignCommand::Run(args) => solve(args),
        CampaignCommand::Status(args) => status(args),
        CampaignCommand::Gather(args) => gather(args),
    }
}

fn plan(args: &PlanArgs) -> Result<ExitCode, Failure> {
    start::use_threads(None)?;
    let plan = Plan::read(&args.file)?;
    if let Some(faults) = &plan.faults_of_first {
        output::aside(faults);
        output::warn("the first case has these faults, and so may others: they will be faulty");
    }
    let (cases, repeated) = (plan.cases.len(), plan.repeated);
    CampaignFolder::create(&args.out, plan)?;
    let again = match repeated {
        0 => String::new(),
        count => format!(", {count} left out that repeat others"),
    };
    output::text(format!(
        "{cases} cases planned in {}{again}\n",
        args.out.display()
    ))
}

fn solve(args: &RunArgs) -> Result<ExitCode, Failure> {
    start::use_threads(args.threads)?;
    let campaign = CampaignFolder::open(&args.folder)?;
    let watcher = Watcher::new(args.quiet);
    let control = Control {
        clock: start::clock(),
        observer: None,
        ..watcher.control()
    };
    let done = AtomicUsize::new(0);
    let outcome = campaign.run(args.shard, &control, &|case, status| {
        let number = 1 + done.fetch_add(1, Ordering::Relaxed);
        watcher.say(format!("{number} cases solved"));
        if status == CaseStatus::Faulty {
            output::warn(&format!(
                "case {} has faults: see results/{0}.fault.txt",
                case.id
            ));
        }
    });
    watcher.finish();
    let Outcome {
        solved,
        faulty,
        kept,
        left,
    } = outcome?;
    let text = format!("{solved} cases solved, {faulty} faulty, {kept} kept, {left} left\n");
    output::text(text)?;
    Ok(match (left, faulty) {
        (0, 0) => ExitCode::SUCCESS,
        (0, _) => ExitCode::from(BAD_INPUT),
        _ => ExitCode::from(ENDED),
    })
}

fn status(args: &StatusArgs) -> Result<ExitCode, Failure> {
    let campaign = CampaignFolder::open(&args.folder)?;
    let [done, missing, faulty] = [CaseStatus::Done, CaseStatus::Missing, CaseStatus::Faulty]
        .map(|status| campaign.count(status));
    output::text(format!("{done} done, {missing} missing, {faulty} faulty\n"))
}

fn gather(args: &GatherArgs) -> Result<ExitCode, Failure> {
    start::use_threads(None)?;
    let campaign = CampaignFolder::open(&args.folder)?;
    let table = campaign.gather()?;
    let path = args.out.clone();
    let path = path.unwrap_or_else(|| args.folder.join("table.csv"));
    let name = path
        .file_name()
        .ok_or("--out: expected a file".to_owned())?;
    let name = name.to_string_lossy();
    folder::write(folder::folder_of(&path), &name, table.csv.as_bytes())?;
    output::text(format!("{}\n", path.display()))
}
