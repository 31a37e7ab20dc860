//! Numbers as tables: comma-separated values with a heading, units in it.

mod chart;
mod evidence;
mod front;
mod map;
mod record;

use std::fmt::Display;
use std::io;

use crate::chart::Chart;
use crate::printable;
use crate::record::{MapRecord, Record};

/// A table as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Name of its file, without ending.
    pub name: &'static str,
    /// Its text.
    pub csv: String,
}

impl Table {
    /// The tables of a chart, each if there is something in it; they have the names of the figures
    /// that they belong to.
    ///
    /// # Errors
    /// None is expected: tables are written to memory.
    pub fn of_chart(chart: &Chart) -> io::Result<Vec<Self>> {
        let mut tables = chart::all(chart)?;
        tables.retain(|table| table.csv.lines().count() > 1);
        Ok(tables)
    }

    /// The tables of a record. Where it has no evidence there are none of hits, rebounds and places.
    ///
    /// # Errors
    /// None is expected: tables are written to memory.
    pub fn of_record(record: &Record) -> io::Result<Vec<Self>> {
        record::all(record)
    }

    /// The table of a map: a row for each place.
    ///
    /// # Errors
    /// None is expected: tables are written to memory.
    pub fn of_map(map: &MapRecord) -> io::Result<Self> {
        map::table("map", map)
    }
}

/// A table that is being written.
pub(super) struct Rows {
    name: &'static str,
    writer: csv::Writer<Vec<u8>>,
}

impl Rows {
    pub fn headed(name: &'static str, columns: &[&str]) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(columns)?;
        Ok(Self { name, writer })
    }

    pub fn row(&mut self, cells: &[&dyn Display]) -> io::Result<()> {
        self.texts(cells.iter().map(ToString::to_string))
    }

    fn texts(&mut self, cells: impl IntoIterator<Item = String>) -> io::Result<()> {
        let cells = cells.into_iter().map(as_text);
        Ok(self.writer.write_record(cells.map(String::into_bytes))?)
    }

    pub fn finish(self) -> io::Result<Table> {
        let bytes = self
            .writer
            .into_inner()
            .map_err(|error| error.into_error())?;
        Ok(Table {
            name: self.name,
            csv: String::from_utf8(bytes).map_err(io::Error::other)?,
        })
    }
}

/// What a programme for spreadsheets takes for a formula gets an apostrophe before it, as OWASP has it; numbers
/// stay, and nothing acts on a terminal.
fn as_text(cell: String) -> String {
    let is_formula = cell.starts_with(FORMULA) && cell.parse::<f64>().is_err();
    let shown = printable::line(&cell);
    if is_formula {
        format!("{QUOTE}{shown}")
    } else {
        shown.into_owned()
    }
}

/// With these a formula begins; the last ones look like the first in wide letters.
const FORMULA: [char; 10] = [
    '=', '+', '-', '@', '\t', '\r', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}',
];
const QUOTE: char = '\'';

/// A cell that is empty where there is no value.
fn or_empty(value: Option<impl Display>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}
