//! `peenpose solve`: the main job.

use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Instant;

use peenpose::problem::given;
use peenpose::record::{Circumstances, FrontRecord, Record, StatusRecord, WorkRecord};
use peenpose::setup::Setup;
use peenpose::solve::{Control, front, passing_windows_until, solve};
use peenpose::unknowns::Unknowns;
use peenpose::validity;

use crate::args::SolveArgs;
use crate::kept;
use crate::output::{self, Failure, quoted};
use crate::progress::Watcher;
use crate::result;
use crate::start;

/// Solves a problem file and reports the answer.
pub fn run(args: &SolveArgs) -> Result<ExitCode, Failure> {
    let started = Instant::now();
    let (mut setup, source) = start::load(&args.start, &args.file, args.out.as_deref())?;
    if let Some(accuracy) = &args.accuracy {
        setup.problem.accuracy =
            given::accuracy(accuracy).map_err(|fault| format!("--accuracy: {fault}"))?;
    }
    let checkpoint = kept::open(args.checkpoint.as_deref(), &setup)?;
    let watcher = Watcher::new(args.start.quiet);
    let control = Control {
        checkpoint: checkpoint.as_ref(),
        stop: &watcher.stop,
        watch: &|progress| watcher.show(progress),
        ..Control::default()
    };
    let solution = solve(&setup, &control);
    let setup = setup.as_asked();
    let front = args
        .pareto
        .then(|| front(&setup, &solution.answers, &control));
    let is_stopped = control.is_stopped();
    watcher.finish();
    kept::close(checkpoint.as_ref(), args.start.quiet);
    let windows = passing_windows_until(&setup, &solution, &watcher.late);
    if is_stopped {
        output::note("stopped: this is the best answer so far");
    }
    let best = solution
        .answers
        .first()
        .ok_or("there is no contact to choose".to_owned())?;
    let notes = validity::notes(&setup, &best.choice, best.evaluation.as_ref());
    let fits = best.evaluation.is_some();
    let has_time = !watcher.late.load(Ordering::Relaxed);
    let unknowns = (fits && has_time)
        .then(|| Unknowns::of(&setup, &best.choice))
        .flatten();
    let circumstances = Circumstances {
        source: &source,
        status: if is_stopped {
            StatusRecord::Interrupted
        } else {
            solution.status.into()
        },
        command: command(args, &setup),
        ladder: &solution.ladder,
        work: WorkRecord {
            poses: solution.poses + front.as_ref().map_or(0, |front| front.poses),
            shots_per_pose: solution.shots_per_pose,
            rays: solution.rays + front.as_ref().map_or(0, |front| front.rays),
            seconds: started.elapsed().as_secs_f64(),
        },
    };
    let mut record = Record::new(
        &setup,
        &solution.answers,
        &windows,
        notes,
        unknowns,
        circumstances,
    )
    .ok_or("there is no contact to choose".to_owned())?;
    if let Some(front) = &front {
        record.front = FrontRecord::all(&setup, front);
    }
    if args.out.is_some() {
        record = record.with_evidence_until(&setup, best, &watcher.late);
    }
    result::report(&record, args.json, args.out.as_deref())
}

/// The command that gives the same answer again.
fn command(args: &SolveArgs, setup: &Setup) -> String {
    let pareto = if args.pareto { " --pareto" } else { "" };
    format!(
        "peenpose solve {} --accuracy '{} %' --seed {}{pareto}",
        quoted(&args.file.display().to_string()),
        setup.problem.accuracy * 100.0,
        setup.problem.seed
    )
}
