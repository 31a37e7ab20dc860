//! `peenpose evaluate`: what given settings do.

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use peenpose::jet::Replicates;
use peenpose::problem::Problem;
use peenpose::problem::fault::nearest_name;
use peenpose::problem::setting::{Choice, Setting};
use peenpose::record::{Circumstances, Record, StatusRecord, WorkRecord};
use peenpose::setup::Setup;
use peenpose::solve::{ANSWERS, Answer, Ladder, clearance_violation};
use peenpose::units::{self, Dimension};
use peenpose::unknowns::Unknowns;
use peenpose::validity;
use peenpose::verdict::Verdict;

use crate::args::EvaluateArgs;
use crate::output::{self, Failure, quoted};
use crate::solve::use_threads;

/// Evaluates settings and reports what they do.
pub fn run(args: &EvaluateArgs) -> Result<ExitCode, Failure> {
    let started = Instant::now();
    use_threads(args.threads)?;
    output::prepare(args.out.as_deref())?;
    let (mut setup, source) = Setup::load(&args.file)?;
    if let Some(seed) = args.seed {
        setup.problem.seed = seed;
    }
    let setup = setup.as_asked();
    let choice = choice(args, &setup.problem)?;
    let fresh = Replicates::new(&setup.problem, ANSWERS, args.shots as usize);
    let evaluation = peenpose::evaluate::evaluate(&setup, &choice, &fresh);
    let rays = evaluation.rays;
    let answer = Answer {
        verdicts: Verdict::all(&setup, &evaluation),
        evaluation: Some(evaluation),
        violation: clearance_violation(&setup, &choice).unwrap_or(0.0),
        choice,
    };
    let circumstances = Circumstances {
        source: &source,
        status: StatusRecord::Evaluated,
        command: command(args, &setup, &choice),
        ladder: &Ladder::of(&setup),
        work: WorkRecord {
            poses: 1,
            shots_per_pose: fresh.shots(),
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
    output::record(&record, args.json, args.out.as_deref())
}

/// The settings asked for: from a result, from `--set`, or held in the file.
fn choice(args: &EvaluateArgs, problem: &Problem) -> Result<Choice, Failure> {
    let mut known = Known::held(problem);
    if let Some(path) = &args.from {
        known.take(&from_result(path, problem)?);
    }
    for text in &args.set {
        known.set(text, problem)?;
    }
    Ok(known.complete(problem)?)
}

/// The best settings of a result.
fn from_result(path: &Path, problem: &Problem) -> Result<Choice, Failure> {
    let record = output::read_record(path)?;
    let best = record.best;
    Ok(Choice {
        incidence: best.settings.incidence_deg.to_radians(),
        azimuth: best.settings.azimuth_deg.to_radians(),
        standoff: best.settings.standoff_m,
        speed: best.settings.speed_m_s,
        aim_along: best.settings.aim_along_m,
        aim_across: best.settings.aim_across_m,
        aim_above: best.settings.aim_above_m,
        contact: contact_named(&best.contact, problem)?,
        static_friction: best.contact_values.mu_s,
    })
}

fn contact_named(name: &str, problem: &Problem) -> Result<usize, String> {
    let contacts = &problem.contacts;
    contacts
        .iter()
        .position(|contact| contact.name == name)
        .ok_or_else(|| {
            let names: Vec<&str> = contacts
                .iter()
                .map(|contact| contact.name.as_str())
                .collect();
            let nearest = nearest_name(name, names.iter().copied())
                .map_or_else(String::new, |nearest| {
                    format!("; did you mean `{nearest}`?")
                });
            format!(
                "there is no contact `{name}`; expected one of {}{nearest}",
                names.join(", ")
            )
        })
}

/// The settings that are known so far.
struct Known {
    values: [Option<f64>; SETTINGS.len()],
    contact: Option<usize>,
    /// Whether `--set` says what the friction is.
    friction_asked: bool,
}

const SETTINGS: [Setting; 8] = [
    Setting::Incidence,
    Setting::Azimuth,
    Setting::Standoff,
    Setting::Speed,
    Setting::AimAlong,
    Setting::AimAcross,
    Setting::AimAbove,
    Setting::StaticFriction,
];

impl Known {
    /// What the file holds at one value.
    fn held(problem: &Problem) -> Self {
        let held = |setting| {
            let range = problem.settings.range(setting)?;
            range.is_held().then_some(range.min)
        };
        let contact = match problem.settings.contact[..] {
            [only] => Some(only),
            _ => None,
        };
        Self {
            values: SETTINGS.map(held),
            contact,
            friction_asked: false,
        }
    }

    fn take(&mut self, choice: &Choice) {
        self.values = SETTINGS.map(|setting| Some(setting.of(choice)));
        self.contact = Some(choice.contact);
    }

    /// Takes `name=value` from the command line.
    fn set(&mut self, text: &str, problem: &Problem) -> Result<(), String> {
        let (name, value) = text.split_once('=').ok_or_else(|| {
            format!("--set {text}: expected NAME=VALUE, such as `incidence=60deg`")
        })?;
        let (name, value) = (name.trim(), value.trim());
        if name == "contact" {
            self.contact = Some(contact_named(value, problem)?);
            return Ok(());
        }
        let Some(index) = SETTINGS.iter().position(|setting| setting.name() == name) else {
            let names = || {
                SETTINGS
                    .iter()
                    .map(|setting| setting.name())
                    .chain(["contact"])
            };
            let nearest = nearest_name(name, names()).map_or_else(String::new, |nearest| {
                format!("; did you mean `{nearest}`?")
            });
            let list: Vec<&str> = names().collect();
            return Err(format!(
                "--set {text}: there is no setting `{name}`; expected one of {}{nearest}",
                list.join(", ")
            ));
        };
        let parsed =
            parse(SETTINGS[index], value).map_err(|fault| format!("--set {text}: {fault}"))?;
        self.values[index] = Some(parsed);
        self.friction_asked |= SETTINGS[index] == Setting::StaticFriction;
        Ok(())
    }

    fn complete(&self, problem: &Problem) -> Result<Choice, String> {
        let mut missing: Vec<&str> = Vec::new();
        let mut value = |index: usize| {
            self.values[index].unwrap_or_else(|| {
                missing.push(SETTINGS[index].name());
                0.0
            })
        };
        let mut choice = Choice {
            incidence: value(0),
            azimuth: value(1),
            standoff: value(2),
            speed: value(3),
            aim_along: value(4),
            aim_across: value(5),
            aim_above: value(6),
            contact: 0,
            static_friction: 0.0,
        };
        match self.contact {
            Some(contact) => choice.contact = contact,
            None => missing.push("contact"),
        }
        let contact = &problem.contacts[choice.contact];
        let friction = contact.static_friction;
        if self.friction_asked && self.contact.is_some() && friction.is_held() {
            return Err(format!(
                "--set mu_s: the friction of contact `{}` is fixed in the file, not a range",
                contact.name
            ));
        }
        choice.static_friction = self.values[7].unwrap_or(friction.min);
        if self.values[7].is_none() && !friction.is_held() {
            missing.push("mu_s");
        }
        if self.values[0] == Some(0.0) && choice.aim_above <= 0.0 {
            let message = "the incidence must be above 0 deg where aim_above is not above 0 mm";
            return Err(message.into());
        }
        if missing.is_empty() {
            return Ok(choice);
        }
        Err(format!(
            "the file leaves {} open; say what to evaluate with --set {}=... or --from result.json",
            missing.join(", "),
            missing[0]
        ))
    }
}

/// Lengths, m, and speeds, m/s, beyond any workshop; problem files end there too.
const FARTHEST: f64 = 1e3;
const FASTEST: f64 = 1e4;

/// A value of a setting, SI, in the range where it means something.
fn parse(setting: Setting, text: &str) -> Result<f64, String> {
    let (dimension, fits): (_, fn(f64) -> bool) = match setting {
        Setting::Incidence => (Dimension::Angle, |x| {
            (0.0..=std::f64::consts::FRAC_PI_2 + 1e-12).contains(&x)
        }),
        Setting::Azimuth => (Dimension::Angle, |_| true),
        Setting::Standoff => (Dimension::Length, |x| x > 0.0 && x <= FARTHEST),
        Setting::Speed => (Dimension::Speed, |x| x > 0.0 && x <= FASTEST),
        Setting::AimAlong | Setting::AimAcross | Setting::AimAbove => {
            (Dimension::Length, |x| x.abs() <= FARTHEST)
        }
        Setting::StaticFriction => {
            return text
                .parse()
                .ok()
                .filter(|value: &f64| value.is_finite() && *value >= 0.0)
                .ok_or_else(|| format!("`{text}` is not a friction coefficient such as `0.2`"));
        }
    };
    let value = units::parse(dimension, text).map_err(|fault| fault.to_string())?;
    if fits(value) {
        Ok(value)
    } else {
        Err(match setting {
            Setting::Incidence => format!("`{text}` must be at least 0 deg and at most 90 deg"),
            Setting::Standoff => format!("`{text}` must be above 0 mm and at most 1 km"),
            Setting::Speed => format!("`{text}` must be above 0 m/s and at most 10000 m/s"),
            _ => format!("`{text}` must be at most 1 km"),
        })
    }
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
