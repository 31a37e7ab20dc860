//! What limits the answer, and which setting drives that.

use super::scatter::{self, Deviation};
use super::setting::{Edge, SETTINGS};
use super::{objective, subject};
use crate::record::{Record, VerdictRecord};
use crate::report::layout::Block;
use crate::report::number::{fixed, impulse, impulse_asked, share, significant};

/// A verdict that passes limits the answer from this part of what is allowed on.
const LOADED: f64 = 0.1;
/// Below this J is nothing but rounding.
const NOTHING: f64 = 1e-9;
/// A term dominates J from this share on.
const DOMINATES: f64 = 0.8;

/// What limits an answer.
enum Cause<'a> {
    /// The nozzle does not fit.
    Clearance,
    /// This verdict: it fails, or is nearest to failing.
    Verdict(&'a VerdictRecord),
    /// No verdict is loaded; this end of a window is the nearest.
    Window(Edge<'a>),
    /// Nothing within the ranges.
    Nothing,
}

impl<'a> Cause<'a> {
    fn of(record: &'a Record) -> Self {
        if !record.best.feasible {
            return Self::Clearance;
        }
        let verdicts = record.best.verdicts.iter();
        let worst = verdicts
            .filter(|verdict| !verdict.passes || subject::utilisation(verdict) >= LOADED)
            .max_by(|a, b| subject::by_urgency(a, b));
        match (worst, nearest_edge(record, |_| true)) {
            (Some(verdict), _) => Self::Verdict(verdict),
            (None, Some(edge)) => Self::Window(edge),
            (None, None) => Self::Nothing,
        }
    }
}

/// The end of a window that is nearest relative to the range of its setting.
fn nearest_edge<'a>(record: &'a Record, counts: impl Fn(&Edge) -> bool) -> Option<Edge<'a>> {
    SETTINGS
        .iter()
        .flat_map(|setting| setting.edges(record))
        .filter(counts)
        .min_by(|a, b| a.of_range.total_cmp(&b.of_range))
}

/// One line for the head of the sheet.
pub fn headline(record: &Record) -> String {
    match Cause::of(record) {
        Cause::Clearance => super::blocked::limit(&record.best),
        Cause::Verdict(verdict)
            if !verdict.passes && subject::missed_target(&record.best).is_some() =>
        {
            format!("{}: no shot hits the target first", verdict.subject)
        }
        Cause::Verdict(verdict) => {
            let driver = nearest_edge(record, |edge| edge.turns == verdict.subject).map_or_else(
                || reason(record, verdict),
                |edge| format!("; {} drives it: fails {}", edge.setting, edge.side()),
            );
            let place = record.stroke.as_ref().zip(verdict.at_m);
            let place = place.map_or(String::new(), |(stroke, at)| {
                format!(" at {}", stroke.place(at))
            });
            format!("{}{place} ({}){driver}", verdict.subject, used(verdict))
        }
        Cause::Window(edge) => format!("{}: fails with {}", edge.turns, edge.at),
        Cause::Nothing => "no verdict comes near".into(),
    }
}

/// Why N* is off, where no setting turns it.
fn reason(record: &Record, verdict: &VerdictRecord) -> String {
    let target = record.best.target.as_ref();
    match target.and_then(|target| Deviation::new(record, target)) {
        Some(deviation) if verdict.subject == "normal_impulse" => {
            if deviation.is_scatter() {
                "; its mean is right, it scatters from shot to shot".into()
            } else {
                format!("; its mean is {}", aside(&deviation))
            }
        }
        _ => String::new(),
    }
}

/// `35 % above what is wanted`.
fn aside(deviation: &Deviation) -> String {
    format!(
        "{} % {} what is wanted",
        significant(deviation.bias.abs() * 100.0, 2),
        if deviation.bias < 0.0 {
            "below"
        } else {
            "above"
        },
    )
}

/// How much of what is allowed is used up.
fn used(verdict: &VerdictRecord) -> String {
    let utilisation = subject::utilisation(verdict);
    if verdict.counted == 0 {
        "nothing was counted".into()
    } else if !utilisation.is_finite() {
        format!("{} where none is allowed", share(verdict.share))
    } else if utilisation >= 2.0 {
        format!("{} times its allowance", significant(utilisation, 2))
    } else {
        format!("{} % of its allowance used", fixed(utilisation * 100.0, 0))
    }
}

/// The same in sentences, with the reasons that the record gives.
pub fn block(record: &Record) -> Option<Block> {
    let mut sentences: Vec<String> = Vec::new();
    match Cause::of(record) {
        // The cure is said elsewhere; before that nothing else counts.
        Cause::Clearance => return None,
        Cause::Verdict(verdict) => {
            sentences.push(format!(
                "{} {}: {}.",
                verdict.subject,
                if verdict.passes {
                    "is the nearest to failing"
                } else {
                    "is the furthest from passing"
                },
                subject::share_against_allowed(verdict)
            ));
            sentences.extend(bounce(record, &verdict.subject));
            sentences.extend(edges(record, &verdict.subject));
        }
        Cause::Window(edge) => {
            sentences.push(format!(
                "No verdict uses {} % of its allowance. The nearest edge: {} ({} away) fails {}.",
                fixed(LOADED * 100.0, 0),
                edge.at,
                edge.distance,
                edge.turns
            ));
        }
        Cause::Nothing => sentences.push(format!(
            "No verdict uses {} % of its allowance{}.",
            fixed(LOADED * 100.0, 0),
            if record.windows.is_empty() {
                ""
            } else {
                ", and none changes within the ranges of the settings"
            }
        )),
    }
    sentences.extend(mean(record));
    sentences.extend(dominant(record));
    let mut block = Block::titled("WHAT LIMITS IT");
    for sentence in sentences {
        block.hanging("- ", &sentence);
    }
    Some(block)
}

/// The edge at which the binding verdict turns, and the nearest at which another one does.
fn edges(record: &Record, binding: &str) -> Vec<String> {
    let mut sentences = Vec::new();
    if let Some(edge) = nearest_edge(record, |edge| edge.turns == binding) {
        sentences.push(format!(
            "{} drives it: it fails {}, {} away ({} % of the range searched).",
            edge.setting,
            edge.side(),
            edge.distance,
            significant(edge.of_range * 100.0, 2)
        ));
    }
    if let Some(edge) = nearest_edge(record, |edge| edge.turns != binding) {
        sentences.push(format!(
            "Next: {} fails with {}, {} away ({} % of the range searched).",
            edge.turns,
            edge.at,
            edge.distance,
            significant(edge.of_range * 100.0, 2)
        ));
    }
    sentences
}

/// The impact of the path that exceeds a surface's limit most.
fn bounce(record: &Record, surface: &str) -> Option<String> {
    let counts = &record.best.surfaces.get(surface)?.over_per_shot_by_number;
    let total: f64 = counts.iter().sum();
    let (index, most) = counts
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1))?;
    (total > 0.0).then(|| {
        let part = if *most >= total { "All" } else { "Most" };
        match index {
            0 => format!("{part} of it comes from direct hits: it is a matter of aim."),
            1 => format!(
                "{part} of it comes from the first bounce: it is a matter of where rebounds go."
            ),
            _ => format!("{part} of it comes from bounce {index}."),
        }
    })
}

/// Mean N* against the wanted one: a wrong mean is a matter of speed, a right one leaves scatter.
fn mean(record: &Record) -> Vec<String> {
    let best = &record.best;
    let binds = |name: &str| {
        let fails = best.verdicts.iter().any(|v| v.subject == name && !v.passes);
        fails || matches!(Cause::of(record), Cause::Verdict(v) if v.subject == name)
    };
    let deviation = best
        .target
        .as_ref()
        .and_then(|target| Some((target, Deviation::new(record, target)?)));
    let (true, true, Some((target, deviation))) =
        (best.feasible, binds("normal_impulse"), deviation)
    else {
        return Vec::new();
    };
    let wanted = record.problem.goals.normal_impulse;
    let bias = format!(
        "Mean N* is {} uN.s, {} ({})",
        impulse(target.normal_impulse.mean),
        aside(&deviation),
        impulse_asked(wanted)
    );
    if deviation.is_scatter() {
        let mut sentences = vec![format!(
            "{bias}: what violates normal_impulse is the scatter from shot to shot."
        )];
        sentences.extend(scatter::sentence(record));
        return sentences;
    }
    // N* goes with the speed where restitution does not depend on it.
    let speed = best.settings.speed_m_s / (1.0 + deviation.bias);
    let mends = best.contact_values.restitution_at_m_s.is_none();
    let cure = if mends {
        let range = record
            .problem
            .ranges
            .iter()
            .find(|r| r.setting == "speed_m_s");
        let outside = range.is_some_and(|r| r.min < r.max && !(r.min..=r.max).contains(&speed));
        format!(
            "; about {} m/s{} would mend it at this pose",
            significant(speed, 3),
            if outside { ", outside its range," } else { "" }
        )
    } else {
        String::new()
    };
    vec![format!("{bias}{cure}.")]
}

/// The term that J mostly consists of.
fn dominant(record: &Record) -> Option<String> {
    let best = &record.best;
    let objective = best.objective.as_ref()?;
    let (name, share) = objective::dominant(objective)?;
    let is_rounding = objective.total < NOTHING;
    (share >= DOMINATES && !is_rounding).then(|| {
        format!(
            "J is {} % {name}.",
            if share >= 1.0 {
                "100".into()
            } else {
                fixed((share * 100.0).min(99.9), 1)
            }
        )
    })
}
