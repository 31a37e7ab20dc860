//! `peenpose solve`: the main job.

use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Instant;

use peenpose::problem::given;
use peenpose::record::{FrontRecord, Record, RunInfo, StatusRecord, WorkRecord};
use peenpose::scenario::Scenario;
use peenpose::solve::{Control, front, passing_windows_until, solve};
use peenpose::unknowns::Unknowns;
use peenpose::validity;

use crate::args::SolveArgs;
use crate::checkpoint;
use crate::output::{self, Failure, quoted};
use crate::progress::Watcher;
use crate::result;
use crate::start;

/// Solves a problem file and reports the answer.
pub fn run(args: &SolveArgs) -> Result<ExitCode, Failure> {
    let started = Instant::now();
    let (mut scenario, source) = start::load(&args.start, &args.file, args.out.as_deref())?;
    if let Some(accuracy) = &args.accuracy {
        scenario.problem.accuracy =
            given::accuracy(accuracy).map_err(|fault| format!("--accuracy: {fault}"))?;
    }
    let checkpoint = checkpoint::open(args.checkpoint.as_deref(), &scenario)?;
    let watcher = Watcher::new(args.start.quiet);
    let control = Control {
        checkpoint: checkpoint.as_ref(),
        stop: &watcher.stop,
        watch: &|progress| watcher.show(progress),
        ..Control::default()
    };
    let solution = solve(&scenario, &control);
    let scenario = scenario.as_asked();
    let front = args
        .pareto
        .then(|| front(&scenario, &solution.answers, &control));
    let is_stopped = control.is_stopped();
    watcher.finish();
    checkpoint::close(checkpoint.as_ref(), args.start.quiet);
    let windows = passing_windows_until(&scenario, &solution, &watcher.late);
    if is_stopped {
        output::note("stopped: this is the best answer so far");
    }
    let best = solution
        .answers
        .first()
        .ok_or("there is no contact to choose".to_owned())?;
    let notes = validity::notes(&scenario, &best.settings, best.evaluation.as_ref());
    let fits = best.evaluation.is_some();
    let has_time = !watcher.late.load(Ordering::Relaxed);
    let unknowns = (fits && has_time)
        .then(|| Unknowns::of(&scenario, &best.settings))
        .flatten();
    let run = RunInfo {
        source: &source,
        status: if is_stopped {
            StatusRecord::Interrupted
        } else {
            solution.status.into()
        },
        command: command(args, &scenario),
        ablations: &solution.ablations,
        work: WorkRecord {
            poses: solution.poses + front.as_ref().map_or(0, |front| front.poses),
            shots_per_pose: solution.shots_per_pose,
            rays: solution.rays + front.as_ref().map_or(0, |front| front.rays),
            seconds: started.elapsed().as_secs_f64(),
        },
    };
    let mut record = Record::new(&scenario, &solution.answers, &windows, notes, unknowns, run)
        .ok_or("there is no contact to choose".to_owned())?;
    if let Some(front) = &front {
        record.front = FrontRecord::all(&scenario, front);
    }
    if args.out.is_some() {
        record = record.with_evidence_until(&scenario, best, &watcher.late);
    }
    result::report(&record, args.json, args.out.as_deref())
}

/// The command that gives the same answer again.
fn command(args: &SolveArgs, scenario: &Scenario) -> String {
    let pareto = if args.pareto { " --pareto" } else { "" };
    format!(
        "peenpose solve {} --accuracy '{} %' --seed {}{pareto}",
        quoted(&args.file.display().to_string()),
        scenario.problem.accuracy * 100.0,
        scenario.problem.seed
    )
}
