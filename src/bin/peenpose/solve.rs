//! `peenpose solve`: the main job.

use std::process::ExitCode;
use std::sync::Arc;

use peenpose::control::Control;
use peenpose::problem::given;
use peenpose::study::Extras;

use crate::args::SolveArgs;
use crate::checkpoint;
use crate::output::{self, Failure};
use crate::progress::Watcher;
use crate::result::{self, Form};
use crate::settings;
use crate::start;

/// Solves a problem file and reports the answer.
pub fn run(args: &SolveArgs) -> Result<ExitCode, Failure> {
    let clock = start::clock();
    let changes = settings::changes(&args.set)?;
    let mut study = start::open(&args.start, &args.file, &changes, args.out.as_deref())?;
    if let Some(accuracy) = &args.accuracy {
        let accuracy = given::accuracy(accuracy).map_err(|fault| format!("--accuracy: {fault}"))?;
        study = study.with_accuracy(accuracy);
    }
    let checkpoint = checkpoint::open(args.checkpoint.as_deref(), study.scenario())?.map(Arc::new);
    let watcher = Watcher::new(args.start.quiet);
    let control = Control {
        checkpoint: checkpoint.clone(),
        clock,
        ..watcher.control()
    };
    let extras = Extras {
        pareto: args.pareto,
        evidence: args.out.is_some(),
    };
    let record = study.solve(extras, &control);
    watcher.finish();
    checkpoint::close(checkpoint.as_deref(), args.start.quiet);
    if control.is_stopped() {
        output::note("stopped: this is the best answer so far");
    }
    let record = record.ok_or("there is no contact to choose".to_owned())?;
    let form = Form::new(args.json, args.full);
    result::report(&record, form, args.out.as_deref(), &args.exposure)
}
