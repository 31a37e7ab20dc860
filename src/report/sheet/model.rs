//! What each effect of the model does here, and what the search did without.

use super::setting::{SETTINGS, Setting};
use crate::precision::Precision;
use crate::record::{ModelRecord, Record, RungRecord, SettingsRecord};
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
        ("turns", Align::Left),
        ("search", Align::Left),
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
            if effect.left_out { "without" } else { "with" }.into(),
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
fn moves(effect: &RungRecord) -> String {
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

fn turns(effect: &RungRecord) -> String {
    match effect.turned.as_slice() {
        [] => "-".into(),
        [one] => one.clone(),
        many => format!("{} verdicts", many.len()),
    }
}

fn sentence(model: &ModelRecord) -> String {
    let left_out = model.effects.iter().filter(|effect| effect.left_out);
    let left_out: Vec<&str> = left_out.map(|e| e.description.as_str()).collect();
    let is_auto = model.asked.iter().any(|asked| asked == "auto");
    let what = if left_out.is_empty() {
        "Every effect matters here: none was left out".to_owned()
    } else {
        format!("Left out: {}", left_out.join(", "))
    };
    let figures = if is_auto {
        "; all figures and verdicts are those of the whole model."
    } else {
        ", as the file asks; the figures are without them."
    };
    let put_back = match model.put_back {
        0 => String::new(),
        1 => " One effect was put back because the whole model disagreed.".into(),
        more => format!(" {more} effects were put back because the whole model disagreed."),
    };
    let precision = match model.precision {
        Precision::F64 => "",
        Precision::F32 => " The search traced in single precision, the figures are in double.",
    };
    format!("{what}{figures}{put_back}{precision}")
}
