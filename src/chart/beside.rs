//! Points of other methods, measured elsewhere, to be shown beside the searches.
//!
//! A table that starts with the columns `method,speed,seconds,excess`, in this order and with this
//! heading: the name of the method; what it was told to do, such as `1000 poses`; the wall time, s;
//! and by how much J of its answer is above the best known, relative to it (0.01 is 1 %). These
//! fields hold no commas and no quotes. Further columns, empty lines and lines that start with `#`
//! are passed over. One run is one line; runs with the same method and speed count as repeats.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Bytes of the largest table that is read.
pub const LARGEST_TABLE: u64 = 10_000_000;

/// One run of another method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BesidePoint {
    /// Its name.
    pub method: String,
    /// What it was told to do.
    pub speed: String,
    /// Wall time, s.
    pub seconds: f64,
    /// By how much J of its answer is above the best known, relative to it.
    pub excess: f64,
}

/// What is wrong with such a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BesideFault {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong there.
    pub message: String,
}

impl fmt::Display for BesideFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.line, self.message)
    }
}

impl std::error::Error for BesideFault {}

const COLUMNS: [&str; 4] = ["method", "speed", "seconds", "excess"];

impl BesidePoint {
    /// Reads a table.
    ///
    /// # Errors
    /// The first line that is not as it should be.
    pub fn read_all(text: &str) -> Result<Vec<Self>, BesideFault> {
        let text = text.trim_start_matches('\u{feff}');
        let mut lines = text
            .lines()
            .enumerate()
            .map(|(index, line)| (index + 1, line.trim()))
            .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let (line, head) = lines.next().unwrap_or((1, ""));
        if !fields(head).starts_with(&COLUMNS) {
            return Err(BesideFault {
                line,
                message: format!("expected the heading `{}`", COLUMNS.join(",")),
            });
        }
        lines
            .map(|(line, row)| Self::read(row).map_err(|message| BesideFault { line, message }))
            .collect()
    }

    fn read(row: &str) -> Result<Self, String> {
        let cells = fields(row);
        let [method, speed, seconds, excess, ..] = cells[..] else {
            return Err(format!(
                "{} fields, but there are {} columns: {}",
                cells.len(),
                COLUMNS.len(),
                COLUMNS.join(",")
            ));
        };
        if method.is_empty() {
            return Err("method: a name is missing".into());
        }
        let seconds = number("seconds", seconds)?;
        if seconds <= 0.0 {
            return Err(format!("seconds: `{seconds}` must be above 0"));
        }
        Ok(Self {
            method: method.into(),
            speed: speed.into(),
            seconds,
            excess: number("excess", excess)?,
        })
    }
}

fn fields(line: &str) -> Vec<&str> {
    line.split(',').map(str::trim).collect()
}

fn number(column: &str, text: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| format!("{column}: `{text}` is not a number such as `0.05`"))
}
