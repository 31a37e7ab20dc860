//! What each effect of the model does at the answer.

use super::setting::{SETTINGS, Setting};
use crate::record::{EffectRecord, ModelRecord, Record, SettingsRecord};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{fixed, significant};

/// A row for each effect; nothing where none was measured.
pub fn block(record: &Record) -> Option<Block> {
    let model = &record.model;
    if model.effects.is_empty() {
        return None;
    }
    let mut table = Table::new(&[
        ("MODEL, without", Align::Left),
        ("J", Align::Right),
        ("best settings move", Align::Left),
        ("costing", Align::Right),
        ("rays", Align::Right),
        ("would change", Align::Left),
        ("figures", Align::Left),
    ]);
    for effect in &model.effects {
        table.row([
            effect.description.clone(),
            change(effect.change),
            moves(effect),
            if effect.regret > 0.0 {
                change(effect.regret)
            } else {
                "0".into()
            },
            format!("{} %", fixed(effect.relative_rays * 100.0, 0)),
            turns(effect),
            if effect.left_out { "without" } else { "" }.into(),
        ]);
    }
    let mut block = Block::default();
    block.table(table.without_empty_columns());
    block.paragraph(&sentence(model));
    Some(block)
}

/// From here on a change is told as a factor, and from there on not exactly.
const MANY: f64 = 10.0;
const MOST: f64 = 1e6;

/// A relative change with its sign, in percent, or as a factor.
fn change(change: f64) -> String {
    if change == 0.0 {
        return "0".into();
    }
    let sign = if change < 0.0 { "-" } else { "+" };
    let size = change.abs() * 100.0;
    if size < 0.01 {
        return format!("{sign}<0.01 %");
    }
    if change >= MOST {
        return "x >1e6".into();
    }
    if change >= MANY {
        return format!("x {}", significant(1.0 + change, 2));
    }
    format!("{sign}{} %", significant(size, 2))
}

/// The setting that moves most.
fn moves(effect: &EffectRecord) -> String {
    let both = [&effect.settings_with, &effect.settings_without];
    let matters = |setting: &&Setting| !both.iter().any(|it| setting.is_any_at(it));
    let moves = SETTINGS.iter().filter(matters).filter_map(|setting| {
        let [from, to] = both.map(|settings| setting.value(settings));
        let shown = fixed((to - from).abs(), setting.decimals);
        let is_seen = shown.chars().any(|digit| ('1'..='9').contains(&digit));
        let sign = if to < from { '-' } else { '+' };
        let share = (to - from).abs() / measure(setting, &effect.settings_with);
        is_seen.then(|| {
            (
                share,
                format!("{} {sign}{shown} {}", setting.name, setting.unit),
            )
        })
    });
    let most = moves.max_by(|a, b| a.0.total_cmp(&b.0));
    most.map_or_else(|| "-".into(), |(_, text)| text)
}

/// What a move is seen against: a radian, the standoff for what is a length, else the setting itself.
fn measure(setting: &Setting, settings: &SettingsRecord) -> f64 {
    match setting.unit {
        "deg" => 1_f64.to_degrees(),
        "mm" => 1e3 * settings.standoff_m,
        _ => setting.value(settings).abs(),
    }
}

fn turns(effect: &EffectRecord) -> String {
    match effect.turned.as_slice() {
        [] => "-".into(),
        [one] => one.clone(),
        many => format!("{} verdicts", many.len()),
    }
}

fn sentence(model: &ModelRecord) -> String {
    let left_out = model.effects.iter().filter(|effect| effect.left_out);
    let left_out: Vec<&str> = left_out.map(|e| e.description.as_str()).collect();
    if left_out.is_empty() {
        return "All figures and verdicts are those of the whole model.".into();
    }
    format!(
        "Left out, as the file asks: {}; the figures are without them.",
        left_out.join(", ")
    )
}
