//! What to set: each setting with its window, the medium, and the pose for a robot.

use super::origins::origins;
use super::setting::{SETTINGS, Setting};
use crate::record::{
    AnswerRecord, CalibrationRecord, ContactRecord, Record, StatusRecord, StrokeRecord,
};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{coordinate, fixed, plain, share_asked, significant};

/// Settings with their windows, then what is loaded.
pub fn settings(record: &Record) -> Block {
    let best = &record.best;
    let title = match record.status {
        StatusRecord::Evaluated => "SETTINGS GIVEN",
        StatusRecord::NoFeasiblePose => "NEAREST MISS",
        _ if best.passes => "SET THIS",
        _ => "BEST FOUND",
    };
    let mut block = Block::default();
    let mut table = Table::new(&[
        (title, Align::Left),
        ("", Align::Right),
        ("", Align::Left),
        ("set within", Align::Left),
        ("tolerance window", Align::Left),
        ("until this fails", Align::Left),
    ]);
    for setting in SETTINGS.iter().filter(|setting| setting.is_used(record)) {
        table.row(row(record, setting));
    }
    block.table(table.without_empty_columns());
    if let Some(pressure) = pressure(record) {
        block.hanging("pressure   ", &pressure);
    }
    for (label, text) in equipment(record) {
        block.hanging(&format!("{label:<10} "), &text);
    }
    for remark in remarks(record) {
        block.paragraph(&remark);
    }
    block
}

fn row(record: &Record, setting: &Setting) -> [String; 6] {
    let shown = setting.shown(record);
    let (window, until) = match setting.window(record) {
        _ if setting.is_any(record) => (String::new(), "(makes no difference at 90 deg)".into()),
        Some(window) => {
            let until = match (&window.down.turns, &window.up.turns) {
                (None, None) => "(whole range)".into(),
                (Some(down), Some(up)) if down == up => down.clone(),
                (Some(down), Some(up)) => format!("{down} below, {up} above"),
                (Some(down), None) => format!("{down} below"),
                (None, Some(up)) => format!("{up} above"),
            };
            (shown.window(setting.unit), until)
        }
        None if setting
            .range(record)
            .is_some_and(|range| range.min == range.max) =>
        {
            ("held".into(), String::new())
        }
        None => (String::new(), String::new()),
    };
    let tolerance = setting.tolerance(record).unwrap_or_default();
    [
        setting.name.into(),
        shown.value,
        setting.unit_of(record).into(),
        tolerance,
        window,
        until,
    ]
}

/// The pressure that gives the speed; absent without a calibration.
fn pressure(record: &Record) -> Option<String> {
    let rows = &record.problem.calibration;
    let (first, last) = (rows.first()?, rows.last()?);
    let bar = |pascals: f64| format!("{} bar", plain(pascals * 1e-5));
    let speed = |row: &CalibrationRecord| format!("{} m/s", plain(row.speed_m_s));
    let set = record.best.settings.speed_m_s;
    let beside = rows
        .windows(2)
        .find(|pair| pair[0].speed_m_s <= set && set <= pair[1].speed_m_s);
    let text = match (record.best.pressure, beside) {
        (Some(pressure), Some([low, high])) => format!(
            "{} bar for that speed: linear from {} at {} to {} at {}",
            significant(pressure * 1e-5, 3),
            speed(low),
            bar(low.pressure),
            speed(high),
            bar(high.pressure),
        ),
        _ => format!(
            "not known: the calibration goes from {} at {} to {} at {}",
            speed(first),
            bar(first.pressure),
            speed(last),
            bar(last.pressure),
        ),
    };
    Some(text)
}

/// What is loaded into the machine.
fn equipment(record: &Record) -> Vec<(&'static str, String)> {
    let (best, problem) = (&record.best, &record.problem);
    let size = if problem.size_spread > 0.0 {
        format!(", size scatter {}", share_asked(problem.size_spread))
    } else {
        String::new()
    };
    let medium = problem
        .medium
        .as_ref()
        .map_or_else(String::new, |medium| format!("{}, ", medium.name));
    let shot = format!(
        "{medium}{} mm diameter, {} kg/m3, {} mg{size}",
        plain(problem.shot_radius_m * 2e3),
        plain(problem.shot_density_kg_m3),
        significant(problem.shot_mass_kg * 1e6, 3),
    );
    let jet = format!(
        "exit {} mm, half-angle {} deg ({}), speed scatter {}",
        plain(problem.exit_diameter_m * 1e3),
        plain(problem.divergence_deg),
        problem.spread,
        share_asked(problem.speed_spread),
    );
    let mut lines = vec![
        (
            "contact",
            format!("{}: {}", best.contact, coefficients(&best.contact_values)),
        ),
        ("shot", shot),
        ("jet", jet),
    ];
    lines.extend(origins(record));
    lines
}

/// The coefficients of a contact.
pub fn coefficients(contact: &ContactRecord) -> String {
    let mut text = format!(
        "mu_s {}, mu_d {}, restitution {}",
        friction(contact.mu_s),
        friction(contact.mu_d),
        plain(contact.restitution)
    );
    if let (Some(speed), Some(exponent)) =
        (contact.restitution_at_m_s, contact.restitution_exponent)
    {
        text += &format!(
            " at {} m/s, falling with exponent {}",
            plain(speed),
            plain(exponent)
        );
    }
    if contact.tangential_restitution != 0.0 {
        text += &format!(
            ", tangential restitution {}",
            plain(contact.tangential_restitution)
        );
    }
    if contact.law != "stick_slip" {
        text += &format!(" (law: {})", contact.law);
    }
    text
}

fn friction(value: f64) -> String {
    plain((value * 1e4).round() / 1e4)
}

fn remarks(record: &Record) -> Vec<String> {
    let best = &record.best;
    let mut remarks = vec!["Incidence: impingement angle, 90 deg is perpendicular.".to_owned()];
    if best.shots > 0
        && SETTINGS
            .iter()
            .any(|setting| setting.tolerance(record).is_some())
    {
        remarks[0] += " Figures allow for `set within`.";
    }
    if record.windows.is_empty() {
        if record.status == StatusRecord::Evaluated && best.feasible {
            remarks.push("Tolerance windows are not computed for given settings.".into());
        }
    } else if !best.passes {
        remarks.push(
            "A tolerance window counts only the verdicts that pass here: it is no way out of FAIL."
                .into(),
        );
    }
    remarks
}

/// The pose for a robot, and the clearance.
pub fn pose(record: &Record) -> Option<Block> {
    let (best, unit) = (&record.best, record.problem.lengths_in);
    let mut block = Block::titled("POSE IN THE COORDINATES OF THE FILE");
    let vector = |values: &[f64], text: &dyn Fn(f64) -> String| {
        let texts: Vec<String> = values
            .iter()
            .map(|value| format!("{:>9}", text(*value)))
            .collect();
        texts.join(" ")
    };
    let pure = |value: f64| coordinate(value, 5);
    let pose = &best.pose;
    block.verbatim(&format!(
        "exit point   {} {}",
        vector(&pose.exit_m, &|length| unit.text(length)),
        unit.name()
    ));
    block.verbatim(&format!("jet axis     {}", vector(&pose.direction, &pure)));
    block.verbatim(&format!(
        "quaternion   {}   (x y z w; takes z to the jet axis)",
        vector(&pose.quaternion_xyzw, &pure)
    ));
    let stroke = record.stroke.as_ref();
    let is_turning = stroke.is_some_and(StrokeRecord::turns_on_the_way);
    block.hanging("clearance    ", &clearance(best, is_turning));
    Some(block)
}

/// How near the nozzle comes to anything. Where it turns on its way, only what is wanted is known to be kept between
/// the stations.
fn clearance(best: &AnswerRecord, is_turning: bool) -> String {
    let least = plain(best.clearance_wanted_m * 1e3);
    let wanted = match is_turning && !best.is_too_near() && best.feasible {
        true => format!(
            "at the stations of the stroke; between them no less than the {least} mm wanted"
        ),
        false => format!("at least {least} mm wanted"),
    };
    let gap = |gap: f64, surface: &str| {
        if gap >= 0.0 {
            format!("{} mm to {surface}", fixed(gap * 1e3, 2))
        } else {
            format!(
                "NONE: it reaches {} mm into {surface}",
                fixed(-gap * 1e3, 2)
            )
        }
    };
    let set = best.clearance_m.zip(best.clearance_surface.as_deref());
    let worst = best
        .clearance_within_tolerance_m
        .zip(best.clearance_within_tolerance_surface.as_deref());
    match (set, worst) {
        (Some((set, surface)), Some((worst, nearest))) if set >= 0.0 => format!(
            "{} as set, {} with the worst errors, {wanted}",
            gap(set, surface),
            gap(worst, nearest)
        ),
        (Some((set, surface)), _) => format!("{}, {wanted}", gap(set, surface)),
        _ => "unlimited: nothing is near".into(),
    }
}
