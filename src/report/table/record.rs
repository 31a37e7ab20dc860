//! The tables of a record; SI units, angles in degrees.

use std::fmt::Display;
use std::io;

use super::{Rows, Table, evidence, front, map, or_empty};
use crate::record::{AnswerRecord, PoseRecord, ReceiptRecord, Record, SpreadRecord, TargetRecord};
use crate::report::map::MAPS;
use crate::report::sheet::setting::{SETTINGS, Setting};

pub(super) fn all(record: &Record) -> io::Result<Vec<Table>> {
    let mut tables = vec![
        surfaces(&record.best)?,
        verdicts(&record.best)?,
        choices(record)?,
        windows(record)?,
        poses(record)?,
    ];
    if let Some(evidence) = &record.evidence {
        tables.extend(evidence::all(evidence)?);
        for (name, map) in MAPS.into_iter().zip(&evidence.maps) {
            tables.push(map::table(name, map)?);
        }
    }
    if !record.front.is_empty() {
        tables.push(front::table(&record.front)?);
    }
    Ok(tables)
}

/// What the target receives by first hits, then what the other surfaces receive by all impacts.
fn surfaces(best: &AnswerRecord) -> io::Result<Table> {
    let mut table = Rows::headed(
        "surfaces",
        &[
            "surface",
            "role",
            "share_of_shots",
            "share_over",
            "allow_N_s",
            "normal_impulse_mean_N_s",
            "normal_impulse_5_percent_N_s",
            "normal_impulse_95_percent_N_s",
            "normal_impulse_largest_N_s",
            "direct_hits_per_shot",
            "rebounds_per_shot",
        ],
    )?;
    if let Some(target) = &best.target {
        let TargetRecord {
            surface,
            share_on_target: share,
            normal_impulse: spread,
            ..
        } = target;
        let [mean, low, high, largest] = spread_cells(Some(spread));
        table.row(&[
            surface, &"target", share, &"", &"", &mean, &low, &high, &largest, share, &0,
        ])?;
    }
    for (surface, receipt) in &best.surfaces {
        let ReceiptRecord {
            share_of_shots,
            share_over,
            allow,
            normal_impulse,
            impacts_per_shot_by_number,
            ..
        } = receipt;
        let [mean, low, high, largest] = spread_cells(normal_impulse.as_ref());
        let numbers = impacts_per_shot_by_number.split_first();
        let (direct, later) = numbers.unwrap_or((&0.0, &[]));
        table.row(&[
            surface,
            &"secondary",
            share_of_shots,
            share_over,
            &or_empty(*allow),
            &mean,
            &low,
            &high,
            &largest,
            direct,
            &later.iter().fold(0.0, |sum, share| sum + share),
        ])?;
    }
    table.finish()
}

fn spread_cells(spread: Option<&SpreadRecord>) -> [String; 4] {
    let parts: [fn(&SpreadRecord) -> f64; 4] = [
        |spread| spread.mean,
        |spread| spread.low_5,
        |spread| spread.high_95,
        |spread| spread.largest,
    ];
    parts.map(|part| or_empty(spread.map(part)))
}

fn verdicts(best: &AnswerRecord) -> io::Result<Table> {
    let mut table = Rows::headed(
        "verdicts",
        &[
            "subject",
            "passes",
            "share",
            "share_95_percent_low",
            "share_95_percent_high",
            "share_allowed",
            "shots_counted",
            "certain",
        ],
    )?;
    for verdict in &best.verdicts {
        let [low, high] = verdict.interval_95;
        table.row(&[
            &verdict.subject,
            &verdict.passes,
            &verdict.share,
            &low,
            &high,
            &verdict.allowed,
            &verdict.counted,
            &verdict.certain,
        ])?;
    }
    table.finish()
}

/// The best settings of each contact, best first.
fn choices(record: &Record) -> io::Result<Table> {
    let (pose, aim) = SETTINGS.split_at(4);
    let keys = |settings: &[Setting]| settings.iter().map(|it| it.key).collect::<Vec<_>>();
    let columns = [
        &["contact", "passes", "feasible"][..],
        &keys(pose),
        &["pressure_Pa"],
        &keys(aim),
        &[
            "mu_s",
            "mu_d",
            "restitution",
            "clearance_m",
            "objective",
            "objective_standard_error",
            "normal_impulse_term",
            "tangential_impulse_term",
            "rebound_term",
            "miss_term",
            "share_on_target",
            "share_sticking",
            "normal_impulse_mean_N_s",
            "tangential_impulse_mean_N_s",
        ],
    ];
    let mut table = Rows::headed("choices", &columns.concat())?;
    for answer in &record.choices {
        let contact = &answer.contact_values;
        let values = |settings: &[Setting]| {
            let values = settings.iter().map(|it| it.in_record(&answer.settings));
            values.map(|value| value.to_string()).collect::<Vec<_>>()
        };
        let objective = |part: fn(&crate::record::ObjectiveRecord) -> f64| {
            or_empty(answer.objective.as_ref().map(part))
        };
        let target = |part: fn(&TargetRecord) -> f64| or_empty(answer.target.as_ref().map(part));
        let texts = |values: &[&dyn Display]| -> Vec<String> {
            values.iter().map(ToString::to_string).collect()
        };
        let cells = [
            texts(&[&answer.contact, &answer.passes, &answer.feasible]),
            values(pose),
            vec![or_empty(answer.pressure)],
            values(aim),
            texts(&[&contact.mu_s, &contact.mu_d, &contact.restitution]),
            vec![
                or_empty(answer.clearance_m),
                objective(|terms| terms.total),
                objective(|terms| terms.standard_error),
                objective(|terms| terms.normal_impulse),
                objective(|terms| terms.tangential_impulse),
                objective(|terms| terms.rebound),
                objective(|terms| terms.miss),
                target(|target| target.share_on_target),
                target(|target| target.share_sticking),
                target(|target| target.normal_impulse.mean),
                target(|target| target.tangential_impulse.mean),
            ],
        ];
        table.texts(cells.concat())?;
    }
    table.finish()
}

/// The names of settings have their units in them.
fn windows(record: &Record) -> io::Result<Table> {
    let mut table = Rows::headed(
        "windows",
        &[
            "setting",
            "down_to",
            "down_turn_within",
            "down_turns",
            "up_to",
            "up_turn_within",
            "up_turns",
        ],
    )?;
    for window in &record.windows {
        table.row(&[
            &window.setting,
            &window.down.to,
            &window.down.within,
            &or_empty(window.down.turns.as_ref()),
            &window.up.to,
            &window.up.within,
            &or_empty(window.up.turns.as_ref()),
        ])?;
    }
    table.finish()
}

/// One row for each contact, for a robot; the matrix takes the nozzle's frame, whose z axis is that
/// of the jet, to the coordinates of the file.
fn poses(record: &Record) -> io::Result<Table> {
    const FIRST: [&str; 11] = [
        "contact",
        "exit_x_m",
        "exit_y_m",
        "exit_z_m",
        "axis_x",
        "axis_y",
        "axis_z",
        "quaternion_x",
        "quaternion_y",
        "quaternion_z",
        "quaternion_w",
    ];
    // Lengths in the last column of the matrix, without unit elsewhere.
    const MATRIX: [&str; 16] = [
        "m11", "m12", "m13", "m14_m", "m21", "m22", "m23", "m24_m", "m31", "m32", "m33", "m34_m",
        "m41", "m42", "m43", "m44",
    ];
    const IN_MM: [&str; 3] = ["exit_x_mm", "exit_y_mm", "exit_z_mm"];
    let mut table = Rows::headed("pose", &[&FIRST[..], &MATRIX[..], &IN_MM[..]].concat())?;
    for answer in &record.choices {
        let PoseRecord {
            exit_m,
            direction,
            quaternion_xyzw,
            matrix_4x4,
        } = &answer.pose;
        let numbers = exit_m.iter().chain(direction).chain(quaternion_xyzw);
        let matrix = matrix_4x4.map(|rows| rows.concat());
        let matrix =
            (0..MATRIX.len()).map(|i| or_empty(matrix.as_ref().map(|m| picometres(&m[i]))));
        let contact = std::iter::once(answer.contact.clone());
        let in_mm = exit_m.map(|length| picometres(&(length * 1e3)));
        table.texts(
            contact
                .chain(numbers.map(picometres))
                .chain(matrix)
                .chain(in_mm),
        )?;
    }
    table.finish()
}

/// A coordinate or a direction without the rounding errors at its end.
fn picometres(value: &f64) -> String {
    ((value * 1e12).round() / 1e12 + 0.0).to_string()
}
