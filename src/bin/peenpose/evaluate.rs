//! `peenpose evaluate`: what given settings do.

use std::process::ExitCode;

use peenpose::control::Control;
use peenpose::study::Extras;

use crate::args::EvaluateArgs;
use crate::output::Failure;
use crate::result::{self, Form};
use crate::settings::{self, Earlier};
use crate::start;

/// Evaluates settings and reports what they do.
pub fn run(args: &EvaluateArgs) -> Result<ExitCode, Failure> {
    let control = Control {
        clock: start::clock(),
        ..Control::default()
    };
    let (set, changes) = settings::split(&args.set)?;
    let study = start::open(&args.start, &args.file, &changes, args.out.as_deref())?;
    let from = args
        .from
        .as_deref()
        .map(|path| Earlier::read(path, &study, args.start.quiet))
        .transpose()?;
    let settings = settings::settings(&set, from.as_ref(), study.problem())?;
    let extras = Extras {
        pareto: false,
        evidence: args.out.is_some(),
    };
    let record = study.evaluate(&settings, args.shots as usize, extras, &control);
    let record = record.ok_or("there is nothing to report".to_owned())?;
    let form = Form::new(args.json, args.full);
    result::report(&record, form, args.out.as_deref(), &[])
}
