//! How wide the columns of a table are.

use super::{Align, GAP, INDENT, Table, length};
use crate::report::layout::words;

/// The first column gives way to this when a table is too wide; longer names get a line of their own.
const NARROW_FIRST: usize = 24;

/// The widths of the columns of a table.
pub(super) struct Widths {
    /// Of each column.
    pub columns: Vec<usize>,
    /// Columns that no line has room for beside the others, from left to right: their cells stand
    /// below the row.
    pub below: Vec<usize>,
}

impl Widths {
    /// Widths with which lines are at most `width` long. No column is narrower than its longest word:
    /// texts are wrapped first, and where that is not enough the widest column moves below its row.
    pub fn of(table: &Table, width: usize) -> Self {
        let count = table.head.len();
        let mut widths = Self {
            columns: (0..count).map(|column| natural(table, column)).collect(),
            below: Vec::new(),
        };
        let least: Vec<usize> = (0..count)
            .map(|column| least(table, column, widths.columns[column]))
            .collect();
        let first = NARROW_FIRST.max(length(&table.head[0]).saturating_sub(INDENT));
        let shortest = first.min(width / 2).min(widths.columns[0]);
        widths.narrow(0, shortest, width);
        loop {
            // The widest gives way, the last of several: that is where long texts stand.
            while widths.total() > width {
                let wraps = |&column: &usize| widths.columns[column] > least[column];
                let beside = (1..count).filter(|column| !widths.below.contains(column));
                let widest = beside.filter(wraps).max_by_key(|&c| widths.columns[c]);
                let Some(widest) = widest else { break };
                widths.columns[widest] -= 1;
            }
            let beside = (1..count).filter(|column| !widths.below.contains(column));
            let widest = beside.max_by_key(|&column| widths.columns[column]);
            match widest {
                Some(widest) if widths.total() > width => {
                    widths.below.push(widest);
                    for column in 1..count {
                        widths.columns[column] = natural(table, column);
                    }
                }
                _ => break,
            }
        }
        let room = width.saturating_sub(INDENT).max(1);
        widths.columns[0] = widths.columns[0].min(room);
        widths.below.sort_unstable();
        widths
    }

    /// Takes from a column what lines are too long by, down to `least`.
    fn narrow(&mut self, column: usize, least: usize, width: usize) {
        let excess = self.total().saturating_sub(width);
        self.columns[column] = self.columns[column].saturating_sub(excess).max(least);
    }

    /// The length of the lines.
    fn total(&self) -> usize {
        let beside = self.columns.iter().enumerate();
        let beside = beside.filter(|(column, _)| !self.below.contains(column));
        INDENT + beside.map(|(_, width)| width + GAP).sum::<usize>() - GAP
    }
}

/// The width with which nothing in a column is wrapped.
fn natural(table: &Table, column: usize) -> usize {
    let head = length(&table.head[column]);
    let head = if column == 0 {
        head.saturating_sub(INDENT)
    } else {
        head
    };
    let cells = table.rows.iter().map(|row| length(&row[column]));
    cells.fold(head, usize::max)
}

/// The width of the longest word in a column; columns of numbers are not wrapped but for their
/// headings.
fn least(table: &Table, column: usize, natural: usize) -> usize {
    let longest = |text: &String| words(text).iter().map(|word| length(word)).max();
    let head = longest(&table.head[column]).unwrap_or(0);
    let cells = table.rows.iter().map(|row| &row[column]);
    let cells = cells.filter_map(|cell| match table.align[column] {
        Align::Left => longest(cell),
        Align::Right => Some(length(cell)),
    });
    cells.fold(head, usize::max).min(natural)
}
