//! Settings on the command line: `--set`, `--from`, and names of settings.

use std::path::Path;

use peenpose::printable;
use peenpose::problem::change::Change;
use peenpose::problem::given::{contact_named, unknown};
use peenpose::problem::setting::{Setting, Settings};
use peenpose::problem::{Problem, Source, given, schema};
use peenpose::record::{Record, mesh_sha256};
use peenpose::scenario::Scenario;
use peenpose::study::Study;

use crate::output::{self, Failure};
use crate::result;

/// The settings asked for: from a result, from `--set`, or held in the file.
pub fn settings(
    set: &[String],
    from: Option<&Earlier>,
    problem: &Problem,
) -> Result<Settings, String> {
    Known::of(set, from, problem)?.complete(problem)
}

/// The same where two settings vary: these need not be known. Also tells whether they are.
pub fn choice_round(
    varied: [Setting; 2],
    set: &[String],
    from: Option<&Earlier>,
    problem: &Problem,
) -> Result<(Settings, bool), String> {
    let mut known = Known::of(set, from, problem)?;
    let middle = problem.ranges.middle();
    let mut all_known = true;
    for (value, setting) in known.values.iter_mut().zip(SETTINGS) {
        if varied.contains(&setting) && value.is_none() {
            *value = Some(setting.of(&middle));
            all_known = false;
        }
    }
    Ok((known.complete(problem)?, all_known))
}

/// Changes of the problem file that `--set` asks for.
pub fn changes(set: &[String]) -> Result<Vec<Change>, String> {
    let changes = set.iter().map(|text| Change::parse(text));
    let changes: Result<_, _> = changes.collect();
    changes.map_err(|fault| format!("--set {fault}"))
}

/// What `--set` says of settings, and what of other keys of the problem file: these have a dot, or are one of its groups.
pub fn split(set: &[String]) -> Result<(Vec<String>, Vec<Change>), String> {
    let schema = schema();
    let is_change = |text: &&String| {
        let key = text.split('=').next().unwrap_or_default().trim();
        key.contains(['.', '[']) || schema["properties"].get(key).is_some()
    };
    let (keys, settings): (Vec<&String>, Vec<&String>) = set.iter().partition(is_change);
    let keys: Vec<String> = keys.into_iter().cloned().collect();
    Ok((settings.into_iter().cloned().collect(), changes(&keys)?))
}

fn names() -> impl Iterator<Item = &'static str> {
    SETTINGS.iter().map(|setting| setting.name())
}

/// The result that `--from` names.
pub struct Earlier<'a> {
    path: &'a Path,
    record: Record,
}

impl<'a> Earlier<'a> {
    /// Reads it. Unless `quiet`, warns when it answers another problem, or the same before its files were
    /// changed: settings that fit there may be nonsense here.
    pub fn read(path: &'a Path, study: &Study, quiet: bool) -> Result<Self, Failure> {
        let record = result::read(path)?;
        if !quiet {
            let shown = path.display();
            for difference in differences(&record, study.scenario(), study.source()) {
                output::warn(&format!(
                    "{shown} {difference}: its settings are taken all the same"
                ));
            }
        }
        Ok(Self { path, record })
    }

    /// Its best settings.
    fn settings(&self, problem: &Problem) -> Result<Settings, String> {
        let best = &self.record.best;
        let contact = contact_named(&best.contact, problem)
            .map_err(|fault| format!("--from {}: {fault}", self.path.display()))?;
        Ok(Settings {
            contact,
            static_friction: best.contact_values.mu_s,
            ..best.settings.settings()
        })
    }
}

/// What a result was made from that is not what is here.
fn differences(record: &Record, scenario: &Scenario, source: &Source) -> Vec<String> {
    let answered = &record.problem.title;
    if *printable::line(&scenario.problem.title) != **answered {
        return vec![format!("answers another problem, `{answered}`")];
    }
    let mut changed = Vec::new();
    if record.problem_sha256 != source.sha256 {
        let file = source.path.display();
        changed.push(format!(
            "was made before the problem file {file} was changed"
        ));
    }
    for (file, sha256) in mesh_sha256(scenario, source) {
        match record.mesh_sha256.get(&file) {
            Some(earlier) if *earlier != sha256 => {
                changed.push(format!("was made before the mesh {file} was changed"));
            }
            // Results of older versions tell nothing about meshes.
            None if !record.mesh_sha256.is_empty() => {
                changed.push(format!("was made without the mesh {file}"));
            }
            _ => {}
        }
    }
    changed
}

/// The settings that are known so far.
struct Known {
    values: [Option<f64>; SETTINGS.len()],
    contact: Option<usize>,
    /// Whether `--set` says what the friction is.
    friction_asked: bool,
}

const SETTINGS: [Setting; Setting::ALL.len()] = Setting::ALL;

impl Known {
    /// What the file holds, a result says, and `--set` says, the later ones on top.
    fn of(set: &[String], from: Option<&Earlier>, problem: &Problem) -> Result<Self, String> {
        let mut known = Self::held(problem);
        if let Some(earlier) = from {
            known.take(&earlier.settings(problem)?);
        }
        for text in set {
            known.set(text, problem)?;
        }
        Ok(known)
    }

    /// What the file holds at one value.
    fn held(problem: &Problem) -> Self {
        let held = |setting| {
            let range = problem.ranges.range(setting)?;
            range.is_held().then_some(range.min)
        };
        let contact = match problem.ranges.contact[..] {
            [only] => Some(only),
            _ => None,
        };
        Self {
            values: SETTINGS.map(held),
            contact,
            friction_asked: false,
        }
    }

    fn take(&mut self, settings: &Settings) {
        self.values = SETTINGS.map(|setting| Some(setting.of(settings)));
        self.contact = Some(settings.contact);
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
            let names: Vec<&str> = names().chain(["contact"]).collect();
            return Err(format!(
                "--set {text}: {}",
                unknown("setting", name, &names)
            ));
        };
        let parsed = given::setting(SETTINGS[index], value)
            .map_err(|fault| format!("--set {text}: {fault}"))?;
        self.values[index] = Some(parsed);
        self.friction_asked |= SETTINGS[index] == Setting::StaticFriction;
        Ok(())
    }

    fn complete(&self, problem: &Problem) -> Result<Settings, String> {
        let mut missing: Vec<&str> = Vec::new();
        let mut settings = Settings::ZERO;
        for (setting, value) in SETTINGS.into_iter().zip(self.values) {
            settings = setting.with(&settings, value.unwrap_or_default());
            if value.is_none() && setting != Setting::StaticFriction {
                missing.push(setting.name());
            }
        }
        match self.contact {
            Some(contact) => settings.contact = contact,
            None => missing.push("contact"),
        }
        let contact = &problem.contacts[settings.contact];
        let friction = contact.static_friction;
        if self.friction_asked && self.contact.is_some() && friction.is_held() {
            return Err(format!(
                "--set mu_s: the friction of contact `{}` is fixed in the file, not a range",
                contact.name
            ));
        }
        let [.., asked] = self.values;
        settings.static_friction = asked.unwrap_or(friction.min);
        if asked.is_none() && !friction.is_held() {
            missing.push("mu_s");
        }
        if self.values[0] == Some(0.0) && settings.aim_above <= 0.0 {
            let message = "the incidence must be above 0 deg where aim_above is not above 0 mm";
            return Err(message.into());
        }
        if missing.is_empty() {
            return given::check(&settings).map(|()| settings);
        }
        Err(format!(
            "the file leaves {} open; say what to evaluate with --set {}=... or --from result.json",
            missing.join(", "),
            missing[0]
        ))
    }
}
