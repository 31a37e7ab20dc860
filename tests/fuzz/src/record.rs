//! Results read back: what is a record by its form can be shown, whatever it says.

use std::sync::LazyLock;

use peenpose::control::Control;
use peenpose::record::Record;
use peenpose::report::export::{Format, export};
use peenpose::report::figure::Figure;
use peenpose::report::table::Table;
use peenpose::report::{page, sheet};
use peenpose::solve::solve;
use serde_json::Value;

use super::bytes::Bytes;
use super::record_edit::edit;
use super::solve::{recorded, sound};

/// About how many figures a record has.
const FIGURES: usize = 16;

/// A record of a small search that the edits start from; made anew, so that it is never out of date.
static WHOLE: LazyLock<Value> = LazyLock::new(|| {
    let (scenario, source) = sound(include_str!("../../../problems/keyway.yaml"));
    let control = Control {
        most_shots: 64,
        validation_shots: 128,
        ..Control::default()
    };
    let solution = solve(&scenario, &control);
    let scenario = scenario.as_asked();
    let record = recorded(&scenario, &source, &solution);
    let record = record.with_evidence(
        &scenario,
        &solution.answers[0],
        &peenpose::control::Control::default(),
    );
    let mut whole = serde_json::to_value(record).expect("every number is finite");
    for list in ["/evidence/hits", "/evidence/rebounds"] {
        if let Some(columns) = whole.pointer_mut(list).and_then(Value::as_object_mut) {
            columns.values_mut().for_each(shorten);
        }
    }
    for list in ["/evidence/surfaces", "/evidence/paths", "/evidence/maps"] {
        if let Some(items) = whole.pointer_mut(list).and_then(Value::as_array_mut) {
            items.truncate(3);
        }
    }
    whole
});

/// A record that nothing has been done to.
pub fn whole() -> Value {
    WHOLE.clone()
}

/// Keeps a few items: reports of short lists are made sooner.
fn shorten(list: &mut Value) {
    if let Some(items) = list.as_array_mut() {
        items.truncate(60);
    }
}

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let text = if bytes.byte() < 16 {
        String::from_utf8_lossy(bytes.0).into_owned()
    } else {
        let mut value = whole();
        edit(&mut value, &mut bytes);
        value.to_string()
    };
    let Ok(record) = Record::from_json(&text) else {
        return;
    };
    let written = record
        .to_json()
        .expect("every number that was read is finite");
    let back = Record::from_json(&written).expect("what was written can be read");
    assert!(back == record, "{written}");
    assert!(!sheet(&record).is_empty());
    let tables = Table::of_record(&record).expect("tables are made in memory");
    assert!(tables.iter().all(|table| !table.csv.is_empty()));
    // Whatever cannot be drawn is an error, not a crash.
    if let Ok(figures) = Figure::of_record(&record) {
        assert!(figures.iter().all(|figure| !figure.svg.contains("NaN")));
        // Pixels take most of the time: one figure each time.
        if let Some(figure) = figures.get(data.len() % FIGURES) {
            let _ = figure.png();
        }
    }
    let _ = page(&record);
    for format in Format::ALL {
        if let Some(Ok(exported)) = export(&record, format) {
            assert!(!exported.is_empty());
        }
    }
}
