//! Numbers as bars: windows of settings, loads of surfaces, terms of the objective.

use crate::record::Record;
use crate::report::number::{Scale, fixed, impulse, plain, share, significant};
use crate::report::sheet::objective;
use crate::report::sheet::received::{mainly, shown_name};
use crate::report::sheet::setting::{SETTINGS, Setting};
use crate::report::typeset::{typeset, unit_behind};

/// A piece of a bar, in percent of its track.
pub struct Span {
    /// Where it starts.
    pub from: String,
    /// How wide it is.
    pub width: String,
}

impl Span {
    /// A piece between two values of a scale from `low` to `high`, cut at its ends.
    fn new(from: f64, to: f64, (low, high): (f64, f64)) -> Self {
        let [from, to] = [from, to].map(|value| percent_of(value, (low, high)));
        Self {
            from: fixed(from, 2),
            width: fixed((to - from).max(0.0), 2),
        }
    }
}

/// Where a value stands on a scale, %.
fn percent_of(value: f64, (low, high): (f64, f64)) -> f64 {
    let share = (value - low) / (high - low);
    if share.is_finite() {
        share.clamp(0.0, 1.0) * 100.0
    } else {
        0.0
    }
}

/// How far a setting may drift, against its range and its tolerance.
pub struct WindowBar {
    /// The setting.
    pub name: &'static str,
    /// The unit behind the recommended value.
    pub unit: String,
    /// The unit behind the ends of its range.
    pub range_unit: String,
    /// The recommended value.
    pub value: String,
    /// How exactly it is set; empty for exactly.
    pub tolerance: String,
    /// Ends of the range searched.
    pub range: [String; 2],
    /// The window within that range.
    pub window_in_range: Span,
    /// The value within it, %.
    pub value_in_range: String,
    /// Ends of the window.
    pub window: [String; 2],
    /// What turns there; empty at the end of the range.
    pub turns: [String; 2],
    /// The window on a scale round the value.
    pub near_window: Span,
    /// The tolerance on it.
    pub near_tolerance: Option<Span>,
    /// The value on it, %.
    pub near_value: String,
    /// Whether the tolerance lies within the window.
    pub is_held: bool,
}

/// Room beside what the near scale has to show, relative to it.
const ROOM: f64 = 0.08;

impl WindowBar {
    /// One for each setting that has a window.
    pub fn of(record: &Record) -> Vec<Self> {
        SETTINGS
            .iter()
            .filter_map(|setting| Self::new(record, setting))
            .collect()
    }

    fn new(record: &Record, setting: &Setting) -> Option<Self> {
        let (window, range) = (setting.window(record)?, setting.range(record)?);
        let scale = setting.scale();
        let value = setting.value(&record.best.settings);
        let [low, high] = [window.down.to, window.up.to].map(|end| end * scale);
        let half = setting.half_width(record);
        let ends = (range.min * scale, range.max * scale);
        let (from, to) = (low.min(value - half), high.max(value + half));
        let room = ROOM * (to - from);
        let near = (from - room, to + room);
        let shown = setting.shown(record);
        let turns = [&window.down.turns, &window.up.turns];
        let is_inside = |end: f64, turns: &Option<String>, drift: f64| {
            turns.is_none() || (end - value).abs() >= drift
        };
        Some(Self {
            name: setting.name,
            unit: unit_behind(setting.unit_of(record)),
            range_unit: unit_behind(setting.unit),
            value: shown.value,
            tolerance: typeset(&setting.tolerance(record).unwrap_or_default()),
            range: [ends.0, ends.1].map(plain),
            window_in_range: Span::new(low, high, ends),
            value_in_range: fixed(percent_of(value, ends), 2),
            window: [shown.low, shown.high],
            near_window: Span::new(low, high, near),
            near_tolerance: (half > 0.0).then(|| Span::new(value - half, value + half, near)),
            near_value: fixed(percent_of(value, near), 2),
            is_held: is_inside(low, turns[0], half) && is_inside(high, turns[1], half),
            turns: turns.map(|turns| turns.clone().unwrap_or_default()),
        })
    }
}

/// What a surface receives against what it may take.
pub struct LoadBar {
    /// The surface and what is counted there.
    pub name: String,
    /// 95 % of the impacts are below; empty where there is none.
    pub high_95: String,
    /// The largest.
    pub largest: String,
    /// What it may take.
    pub allowed: String,
    /// 95 % against what it may take.
    pub utilisation: String,
    /// The shots that exceed it.
    pub over: String,
    /// By which impact of a path it is mainly hit.
    pub by: String,
    /// The bar up to 95 %.
    pub span: Span,
    /// Where the largest stands, %.
    pub largest_at: String,
    /// Where the limit stands, %.
    pub limit_at: String,
    /// Whether 95 % is over the limit.
    pub is_over: bool,
}

/// The scale of loads reaches at least to this multiple of the limit, and at most to that.
const LEAST_SCALE: f64 = 1.25;
const MOST_SCALE: f64 = 4.0;

impl LoadBar {
    /// One for f* on the target and one for each other surface, all on one scale relative to what each
    /// may take.
    pub fn of(record: &Record) -> Vec<Self> {
        let best = &record.best;
        let target = best.target.as_ref().and_then(|target| {
            let allow = record.problem.goals.tangential_impulse?;
            let spread = (target.share_on_target > 0.0).then_some(target.tangential_impulse);
            let over = best
                .verdicts
                .iter()
                .find(|v| v.subject == "tangential_impulse");
            Some((
                format!("{}, f* on target", target.surface),
                spread,
                allow,
                over.map_or_else(String::new, |verdict| share(verdict.share)),
                String::new(),
            ))
        });
        let others = best.surfaces.iter().filter_map(|(name, receipt)| {
            Some((
                shown_name(record, name),
                receipt.normal_impulse,
                receipt.allow?,
                share(receipt.share_over),
                mainly(receipt),
            ))
        });
        let loads: Vec<_> = target.into_iter().chain(others).collect();
        let most = loads
            .iter()
            .filter_map(|(_, spread, allow, ..)| Some(spread.as_ref()?.largest / allow))
            .fold(0.0, f64::max);
        let scale = (0.0, (1.05 * most).clamp(LEAST_SCALE, MOST_SCALE));
        let bars = loads.into_iter().map(|(name, spread, allow, over, by)| {
            let of_allowed = |value: f64| value / allow;
            let high = spread.map_or(0.0, |spread| of_allowed(spread.high_95));
            Self {
                name,
                high_95: spread.map_or_else(String::new, |spread| impulse(spread.high_95)),
                largest: spread.map_or_else(String::new, |spread| impulse(spread.largest)),
                allowed: significant(allow * 1e6, 3),
                utilisation: spread
                    .map_or_else(String::new, |_| format!("{} %", fixed(high * 100.0, 0))),
                over: if spread.is_some() {
                    over
                } else {
                    String::new()
                },
                by: if spread.is_some() { by } else { String::new() },
                span: Span::new(0.0, high, scale),
                largest_at: spread.map_or_else(String::new, |spread| {
                    fixed(percent_of(of_allowed(spread.largest), scale), 2)
                }),
                limit_at: fixed(percent_of(1.0, scale), 2),
                is_over: high > 1.0,
            }
        });
        bars.collect()
    }
}

/// The terms of the objective of a contact's best settings.
pub struct ChoiceBar {
    /// Name of the contact.
    pub contact: String,
    /// J with its standard error.
    pub total: String,
    /// The terms, in the order of the objective.
    pub terms: Vec<TermBar>,
}

/// A term of the objective.
pub struct TermBar {
    /// Its value.
    pub value: String,
    /// Its piece of the bar, %.
    pub width: String,
}

impl ChoiceBar {
    /// One for each choice at which the nozzle fits, all on one scale.
    pub fn of(record: &Record) -> Vec<Self> {
        let fitting = || {
            let choices = record.choices.iter();
            choices.filter_map(|answer| Some((&answer.contact, answer.objective.as_ref()?)))
        };
        let totals = fitting().map(|(_, objective)| objective.total);
        let most = totals.fold(0.0, f64::max);
        let scale = fitting()
            .next()
            .map(|(_, objective)| Scale::for_error(objective.total, objective.standard_error));
        let bars = fitting().zip(scale.iter().cycle());
        bars.map(|((contact, objective), scale)| Self {
            contact: contact.clone(),
            total: typeset(&scale.with_error(objective.total, objective.standard_error)),
            terms: objective::terms(objective)
                .map(|(_, value, _)| TermBar {
                    value: scale.text(value),
                    width: fixed(percent_of(value, (0.0, most)), 2),
                })
                .into(),
        })
        .collect()
    }
}
