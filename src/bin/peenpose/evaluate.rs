//! `peenpose evaluate`: what given settings do.

use std::process::ExitCode;
use std::time::Instant;

use peenpose::evaluate::evaluate_drawn;
use peenpose::jet::{Draw, purpose};
use peenpose::problem::setting::{Choice, Setting};
use peenpose::record::{Circumstances, Record, StatusRecord, WorkRecord};
use peenpose::setup::Setup;
use peenpose::solve::{Answer, Ladder};
use peenpose::units;
use peenpose::unknowns::Unknowns;
use peenpose::validity;

use crate::args::EvaluateArgs;
use crate::output::{Failure, quoted};
use crate::result;
use crate::settings::{self, Earlier};
use crate::start;

/// Evaluates settings and reports what they do.
pub fn run(args: &EvaluateArgs) -> Result<ExitCode, Failure> {
    let started = Instant::now();
    let (setup, source) = start::load(&args.start, &args.file, args.out.as_deref())?;
    let from = args
        .from
        .as_deref()
        .map(|path| Earlier::read(path, &setup, &source, args.start.quiet))
        .transpose()?;
    let setup = setup.as_asked();
    let choice = settings::choice(&args.set, from.as_ref(), &setup.problem)?;
    let fresh = Draw::new(&setup.problem, purpose::ANSWERS, args.shots as usize);
    let evaluation = evaluate_drawn(&setup, &choice, &fresh);
    let (shots, rays) = (evaluation.shots, evaluation.rays);
    let answer = Answer::judged(&setup, &choice, Some(evaluation));
    let circumstances = Circumstances {
        source: &source,
        status: StatusRecord::Evaluated,
        command: command(args, &setup, &choice),
        ladder: &Ladder::of(&setup),
        work: WorkRecord {
            poses: 1,
            shots_per_pose: shots,
            rays,
            seconds: started.elapsed().as_secs_f64(),
        },
    };
    let notes = validity::notes(&setup, &choice, answer.evaluation.as_ref());
    let unknowns = Unknowns::of(&setup, &choice);
    let answers = [answer];
    let mut record = Record::new(&setup, &answers, &[], notes, unknowns, circumstances)
        .ok_or("there is nothing to report".to_owned())?;
    if args.out.is_some() {
        record = record.with_evidence(&setup, &answers[0]);
    }
    result::report(&record, args.json, args.out.as_deref())
}

/// The command that gives the same figures again.
fn command(args: &EvaluateArgs, setup: &Setup, choice: &Choice) -> String {
    let contact = &setup.problem.contacts[choice.contact].name;
    let mut command = format!(
        "peenpose evaluate {} --set incidence={}deg --set azimuth={}deg --set standoff={}m --set speed={}m/s",
        quoted(&args.file.display().to_string()),
        units::degrees(choice.incidence),
        units::degrees(choice.azimuth),
        choice.standoff,
        choice.speed,
    );
    for setting in [Setting::AimAlong, Setting::AimAcross, Setting::AimAbove] {
        if setting.of(choice) != 0.0 {
            command += &format!(" --set {}={}m", setting.name(), setting.of(choice));
        }
    }
    if !setup.problem.contacts[choice.contact]
        .static_friction
        .is_held()
    {
        command += &format!(" --set mu_s={}", choice.static_friction);
    }
    command
        + &format!(
            " --set {} --shots {} --seed {}",
            quoted(&format!("contact={contact}")),
            args.shots,
            setup.problem.seed
        )
}
