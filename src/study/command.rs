//! Commands that give the same figures again.

use super::{Extras, Study};
use crate::problem::setting::{Setting, Settings};
use crate::units;

/// A word of a command that a shell reads as one.
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,+:".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// The problem file, and what is changed in it.
fn file(study: &Study) -> String {
    let mut words = quoted(&study.source.path.display().to_string());
    for change in &study.source.changes {
        words += &format!(" --set {}", quoted(&change.to_string()));
    }
    words
}

fn rays(study: &Study) -> &'static str {
    if study.has_parry_rays() {
        " --rays parry"
    } else {
        ""
    }
}

/// The search of a study.
pub(super) fn solve(study: &Study, extras: Extras) -> String {
    let pareto = if extras.pareto { " --pareto" } else { "" };
    let rays = rays(study);
    format!(
        "peenpose solve {} --accuracy '{} %' --seed {}{pareto}{rays}",
        file(study),
        study.problem().accuracy * 100.0,
        study.problem().seed
    )
}

/// The evaluation of given settings.
pub(super) fn evaluate(study: &Study, settings: &Settings, shots: usize) -> String {
    let contact = &study.problem().contacts[settings.contact];
    let mut command = format!(
        "peenpose evaluate {} --set incidence={}deg --set azimuth={}deg --set standoff={}m --set speed={}m/s",
        file(study),
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
    if !contact.static_friction.is_held() {
        command += &format!(" --set mu_s={}", settings.static_friction);
    }
    command
        + &format!(
            " --set {} --shots {shots} --seed {}{}",
            quoted(&format!("contact={}", contact.name)),
            study.problem().seed,
            rays(study)
        )
}
