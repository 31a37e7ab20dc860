//! `peenpose campaign`: many problems from one.

use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};

use peenpose::campaign::{CampaignFolder, CaseStatus, Outcome, Plan};
use peenpose::control::Control;

use crate::args::{CampaignCommand, GatherArgs, PlanArgs, RunArgs, StatusArgs};
use crate::output::{self, BAD_INPUT, Failure};
use crate::progress::{ENDED, Watcher};
use crate::{folder, start};

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
    let statuses: Vec<CaseStatus> = campaign
        .plan()
        .cases
        .iter()
        .map(|case| campaign.status(case))
        .collect();
    let count = |wanted| statuses.iter().filter(|status| **status == wanted).count();
    let [done, missing, faulty] =
        [CaseStatus::Done, CaseStatus::Missing, CaseStatus::Faulty].map(count);
    output::text(format!("{done} done, {missing} missing, {faulty} faulty\n"))
}

fn gather(args: &GatherArgs) -> Result<ExitCode, Failure> {
    start::use_threads(None)?;
    let campaign = CampaignFolder::open(&args.folder)?;
    let table = campaign.gather()?;
    match &args.out {
        Some(file) => {
            let name = file
                .file_name()
                .ok_or("--out: expected a file".to_owned())?;
            let written = folder::folder_of(file);
            folder::write(written, &name.to_string_lossy(), table.csv.as_bytes())?;
        }
        None => folder::write(&args.folder, "table.csv", table.csv.as_bytes())?,
    }
    let path = args
        .out
        .clone()
        .unwrap_or_else(|| args.folder.join("table.csv"));
    output::text(format!("{}\n", path.display()))
}
