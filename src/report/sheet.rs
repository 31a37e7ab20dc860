//! The technique sheet.

use crate::record::Record;

/// The technique sheet as text.
pub fn sheet(record: &Record) -> String {
    format!("{:?}\n", record.best.settings)
}
