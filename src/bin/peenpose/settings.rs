//! Settings on the command line: `--set`, `--from`, and names of settings.

use std::path::Path;

use peenpose::printable;
use peenpose::problem::change::Change;
use peenpose::problem::given::{Incomplete, PartialSettings, contact_named};
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
    complete(&known(set, from, problem)?)
}

/// The same where two settings vary: these need not be known. Also tells whether they are.
pub fn choice_round(
    varied: [Setting; 2],
    set: &[String],
    from: Option<&Earlier>,
    problem: &Problem,
) -> Result<(Settings, bool), String> {
    let mut known = known(set, from, problem)?;
    let middle = problem.ranges.middle();
    let [one, other] = varied.map(|setting| known.fill(setting, setting.of(&middle)));
    Ok((complete(&known)?, one && other))
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

/// What the file holds, a result says, and `--set` says, the later ones on top.
fn known<'a>(
    set: &[String],
    from: Option<&Earlier>,
    problem: &'a Problem,
) -> Result<PartialSettings<'a>, String> {
    let mut known = PartialSettings::held(problem);
    if let Some(earlier) = from {
        known.take(&earlier.settings(problem)?);
    }
    for text in set {
        let (name, value) = text.split_once('=').ok_or_else(|| {
            format!("--set {text}: expected NAME=VALUE, such as `incidence=60deg`")
        })?;
        let (name, value) = (name.trim(), value.trim());
        let wrong = |fault: String| format!("--set {text}: {fault}");
        let Some(setting) = given::setting_or_contact(name).map_err(wrong)? else {
            known.set_contact(value)?;
            continue;
        };
        let value = given::setting(setting, value).map_err(wrong)?;
        known.set(setting, value);
    }
    Ok(known)
}

/// All settings, or what to do about those that are not known.
fn complete(known: &PartialSettings) -> Result<Settings, String> {
    known.complete().map_err(|incomplete| match &incomplete {
        Incomplete::Missing(names) => format!(
            "{incomplete}; say what to evaluate with --set {}=... or --from result.json",
            names[0]
        ),
        Incomplete::FrictionIsHeld(_) => format!("--set {incomplete}"),
        Incomplete::Wrong(_) => incomplete.to_string(),
    })
}
