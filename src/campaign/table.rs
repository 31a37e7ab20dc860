//! Tables of a campaign: the cases that are planned, and what has come of them.

use std::io;

use super::folder::{CaseStatus, ID};
use super::plan::Plan;
use crate::record::{AnswerRecord, Record};
use crate::report::sheet::setting::SETTINGS;
use crate::report::table::Table;

/// The names of the cases and the values of their keys.
pub(super) fn cases(plan: &Plan) -> io::Result<Table> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(heading(plan))?;
    for case in &plan.cases {
        writer.write_record([&case.id].into_iter().chain(&case.values))?;
    }
    finish("cases", writer)
}

fn heading(plan: &Plan) -> Vec<&str> {
    let keys = plan.keys.iter().map(String::as_str);
    [ID].into_iter().chain(keys).collect()
}

/// What there is to say of each case besides its verdicts.
const COLUMNS: [&str; 5] = [
    "status",
    "search",
    "contact",
    "objective",
    "objective_standard_error",
];

/// A row for each case: its keys; 0 where every verdict passes, 1 where one fails, 2 where the problem has faults, nothing where there
/// is no result yet; the settings; J; and the share and the margin of each verdict of any case.
pub(super) fn gathered(
    plan: &Plan,
    records: &[Option<Record>],
    statuses: &[CaseStatus],
) -> io::Result<Table> {
    let mut subjects: Vec<&str> = Vec::new();
    for verdict in records
        .iter()
        .flatten()
        .flat_map(|record| &record.best.verdicts)
    {
        if !subjects.contains(&verdict.subject.as_str()) {
            subjects.push(&verdict.subject);
        }
    }
    let of_verdicts = subjects
        .iter()
        .flat_map(|it| [format!("share.{it}"), format!("margin.{it}")]);
    let of_settings = SETTINGS.iter().map(|setting| setting.key.to_owned());
    let fixed = heading(plan).into_iter().chain(COLUMNS).map(str::to_owned);
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(fixed.chain(of_settings).chain(of_verdicts))?;
    for ((case, record), status) in plan.cases.iter().zip(records).zip(statuses) {
        let best = record.as_ref().map(|record| &record.best);
        let status = match (status, best) {
            (CaseStatus::Done, Some(best)) => {
                if best.passes {
                    "0"
                } else {
                    "1"
                }
            }
            (CaseStatus::Faulty, _) => "2",
            _ => "",
        };
        let search = record
            .as_ref()
            .and_then(|record| serde_json::to_value(record.status).ok());
        let search = search
            .as_ref()
            .and_then(|it| it.as_str())
            .unwrap_or_default()
            .to_owned();
        let number = |value: Option<f64>| value.map_or_else(String::new, |it| it.to_string());
        let objective = best.and_then(|best| best.objective.as_ref());
        let mut cells = vec![case.id.clone()];
        cells.extend(case.values.iter().cloned());
        cells.extend([
            status.to_owned(),
            search,
            best.map_or_else(String::new, |best| best.contact.clone()),
            number(objective.map(|it| it.total)),
            number(objective.map(|it| it.standard_error)),
        ]);
        cells.extend(
            SETTINGS
                .iter()
                .map(|it| number(best.map(|best| it.in_record(&best.settings)))),
        );
        for subject in &subjects {
            cells.extend(verdict(best, subject).map(number));
        }
        writer.write_record(cells)?;
    }
    finish("table", writer)
}

/// Share and margin of a verdict.
fn verdict(best: Option<&AnswerRecord>, subject: &str) -> [Option<f64>; 2] {
    let mut verdicts = best.iter().flat_map(|best| &best.verdicts);
    let verdict = verdicts.find(|verdict| verdict.subject == subject);
    [
        verdict.map(|it| it.share),
        verdict.map(|it| it.allowed - it.share),
    ]
}

fn finish(name: &'static str, writer: csv::Writer<Vec<u8>>) -> io::Result<Table> {
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(Table {
        name,
        csv: String::from_utf8(bytes).map_err(io::Error::other)?,
    })
}
