//! Points of other methods, measured elsewhere, to be shown beside the searches.
//!
//! A table that starts with the columns `method,speed,seconds,excess`, in this order and with this
//! heading: the name of the method; what it was told to do, such as `1000 poses`; the wall time, s;
//! and by how much J of its answer is above the best known, relative to it (0.01 is 1 %). These
//! fields hold no commas, no quotes and no control characters. Further columns, empty lines and lines
//! that start with `#` are passed over. One run is one line; runs with the same method and speed count
//! as repeats.

use std::collections::HashSet;
use std::fmt;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::printable;
use crate::units::shortened;

/// Bytes of the largest table that is read.
pub const LARGEST_TABLE: u64 = 10_000_000;
/// Runs in the longest table: each has a marker in the figure.
pub const MOST_RUNS: usize = 10_000;
/// Methods in a table: each has a line in the legend of the figure.
pub const MOST_METHODS: usize = 100;
/// Characters of a method, or of what it was told to do.
pub const LONGEST_NAME: usize = 100;
/// Further out lies nothing that was measured, and an axis could not hold it.
const SECONDS: RangeInclusive<f64> = 1e-9..=1e9;
/// The same; as J is not negative, nothing is farther below the best known than that itself.
const EXCESS: RangeInclusive<f64> = -1.0..=1e15;

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
        let mut points = Vec::new();
        let mut methods = HashSet::new();
        for (line, row) in lines {
            let fault = |message| BesideFault { line, message };
            let point = Self::read(row).map_err(fault)?;
            if points.len() == MOST_RUNS {
                return Err(fault(format!("has more than {MOST_RUNS} runs")));
            }
            methods.insert(point.method.clone());
            if methods.len() > MOST_METHODS {
                return Err(fault(format!("has more than {MOST_METHODS} methods")));
            }
            points.push(point);
        }
        Ok(points)
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
        Ok(Self {
            method: name("method", method)?,
            speed: name("speed", speed)?,
            seconds: number("seconds", seconds, SECONDS)?,
            excess: number("excess", excess, EXCESS)?,
        })
    }
}

fn fields(line: &str) -> Vec<&str> {
    line.split(',').map(str::trim).collect()
}

fn name(column: &str, text: &str) -> Result<String, String> {
    // Our own tables have it before what would be a formula.
    let unquoted = text.strip_prefix('\'');
    let text = unquoted
        .filter(|rest| rest.starts_with(['=', '+', '-', '@']))
        .unwrap_or(text);
    if text.contains(|c: char| c == '"' || printable::acts(c)) {
        let shown = shortened(text);
        return Err(format!(
            "{column}: `{shown}` has a quote or a control character"
        ));
    }
    if text.chars().nth(LONGEST_NAME).is_some() {
        let shown = shortened(text);
        return Err(format!(
            "{column}: `{shown}` has more than {LONGEST_NAME} characters"
        ));
    }
    Ok(text.into())
}

fn number(column: &str, text: &str, range: RangeInclusive<f64>) -> Result<f64, String> {
    let shown = shortened(text);
    let value = text.parse().ok().filter(|value: &f64| value.is_finite());
    let value =
        value.ok_or_else(|| format!("{column}: `{shown}` is not a number such as `0.05`"))?;
    if range.contains(&value) {
        return Ok(value);
    }
    let (least, most) = range.into_inner();
    Err(format!(
        "{column}: `{shown}` must be from {least:e} to {most:e}"
    ))
}
