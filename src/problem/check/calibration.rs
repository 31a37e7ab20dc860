//! `jet.pressure`: which pressure gives which speed.

use super::scope::Scope;
use crate::problem::equipment::Calibration;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::equipment::CalibrationEntry;

const EXPECTED_ROW: &str = "`{ pressure: .., speed: .. }`";

/// Checks the rows; the outer `None` stands for a fault.
#[expect(clippy::option_option, reason = "absent and faulty differ")]
pub(super) fn check(
    scope: &Scope<'_>,
    field: &Field<Vec<Field<CalibrationEntry>>>,
) -> Option<Option<Calibration>> {
    let entries = match field {
        Field::Missing => return Some(None),
        Field::Faulty => return None,
        Field::Present(entries) => entries,
    };
    let mut sound = entries.len() >= 2;
    if !sound {
        let fault = scope.own_fault(FaultCode::WrongLength, "has fewer than two rows");
        scope.report(fault.expecting("at least two rows `{ pressure: .., speed: .. }`"));
    }
    let read: Vec<Option<(f64, f64)>> = entries
        .iter()
        .enumerate()
        .map(|(index, entry)| row(&scope.item(index), entry))
        .collect();
    for (index, pair) in (1..).zip(read.windows(2)) {
        if let [Some(before), Some(after)] = pair {
            sound &= rises_from(&scope.item(index), before, after);
        }
    }
    let rows = read.into_iter().collect::<Option<Vec<_>>>()?;
    sound.then_some(Some(Calibration { rows }))
}

fn row(scope: &Scope<'_>, field: &Field<CalibrationEntry>) -> Option<(f64, f64)> {
    if !field.is_given() {
        scope.report(
            scope
                .own_fault(FaultCode::Missing, "is missing")
                .expecting(EXPECTED_ROW),
        );
    }
    let entry = field.value()?;
    let pressure = scope.needed("pressure", &entry.pressure);
    let speed = scope.needed("speed", &entry.speed);
    Some((pressure?, speed?))
}

fn rises_from(scope: &Scope<'_>, before: &(f64, f64), after: &(f64, f64)) -> bool {
    let mut sound = true;
    for (name, low, high) in [
        ("pressure", before.0, after.0),
        ("speed", before.1, after.1),
    ] {
        if high <= low {
            let fault = scope.fault(
                FaultCode::NotRising,
                name,
                "is not above that of the row before",
            );
            scope.report(fault.expecting("rows in which pressure and speed rise"));
            sound = false;
        }
    }
    sound
}
