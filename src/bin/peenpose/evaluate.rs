//! `peenpose evaluate`: what given settings do.

use std::process::ExitCode;
use std::time::Instant;

use peenpose::evaluate::evaluate_streamed;
use peenpose::jet::{Draw, purpose};
use peenpose::problem::setting::{Setting, Settings};
use peenpose::record::{Record, RunInfo, StatusRecord, WorkRecord};
use peenpose::scenario::Scenario;
use peenpose::solve::Answer;
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
    let (scenario, source) = start::load(&args.start, &args.file, args.out.as_deref())?;
    let from = args
        .from
        .as_deref()
        .map(|path| Earlier::read(path, &scenario, &source, args.start.quiet))
        .transpose()?;
    let scenario = scenario.as_asked();
    let settings = settings::settings(&args.set, from.as_ref(), &scenario.problem)?;
    let fresh = Draw::new(&scenario.problem, purpose::ANSWERS, args.shots as usize);
    let evaluation = evaluate_streamed(&scenario, &settings, &fresh);
    let (shots, rays) = (evaluation.shots, evaluation.rays);
    let answer = Answer::evaluated(&scenario, &settings, Some(evaluation));
    let run = RunInfo {
        source: &source,
        status: StatusRecord::Evaluated,
        command: command(args, &scenario, &settings),
        ablations: &[],
        work: WorkRecord {
            poses: 1,
            shots_per_pose: shots,
            rays,
            seconds: started.elapsed().as_secs_f64(),
        },
    };
    let notes = validity::notes(&scenario, &settings, answer.evaluation.as_ref());
    let unknowns = Unknowns::of(&scenario, &settings);
    let answers = [answer];
    let mut record = Record::new(&scenario, &answers, &[], notes, unknowns, run)
        .ok_or("there is nothing to report".to_owned())?;
    if args.out.is_some() {
        record = record.with_evidence(&scenario, &answers[0]);
    }
    result::report(&record, args.json, args.out.as_deref())
}

/// The command that gives the same figures again.
fn command(args: &EvaluateArgs, scenario: &Scenario, settings: &Settings) -> String {
    let contact = &scenario.problem.contacts[settings.contact].name;
    let mut command = format!(
        "peenpose evaluate {} --set incidence={}deg --set azimuth={}deg --set standoff={}m --set speed={}m/s",
        quoted(&args.file.display().to_string()),
        units::degrees(settings.incidence),
        units::degrees(settings.azimuth),
        settings.standoff,
        settings.speed,
    );
    for setting in [Setting::AimAlong, Setting::AimAcross, Setting::AimAbove] {
        if setting.of(settings) != 0.0 {
            command += &format!(" --set {}={}m", setting.name(), setting.of(settings));
        }
    }
    if !scenario.problem.contacts[settings.contact]
        .static_friction
        .is_held()
    {
        command += &format!(" --set mu_s={}", settings.static_friction);
    }
    command
        + &format!(
            " --set {} --shots {} --seed {}",
            quoted(&format!("contact={contact}")),
            args.shots,
            scenario.problem.seed
        )
}
