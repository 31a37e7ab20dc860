//! Plain text in columns.

mod widths;

use super::{INDENT, WIDTH, length, wrap};
use widths::Widths;

/// Spaces between columns.
const GAP: usize = 2;

/// How a column stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Texts.
    Left,
    /// Numbers.
    Right,
}

/// Rows under a heading. The first column holds names; the others hold numbers, or texts that are
/// wrapped where a line has no room for them.
#[derive(Debug)]
pub struct Table {
    head: Vec<String>,
    align: Vec<Align>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these columns; the heading of the first is that of the block.
    pub fn new(columns: &[(&str, Align)]) -> Self {
        Self {
            head: columns.iter().map(|(name, _)| (*name).into()).collect(),
            align: columns.iter().map(|(_, align)| *align).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row with a cell for every column.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        let mut cells: Vec<String> = cells.into_iter().collect();
        cells.resize(self.head.len(), String::new());
        self.rows.push(cells);
    }

    /// Leaves out the columns in which no row says anything.
    pub fn without_empty_columns(mut self) -> Self {
        for column in (1..self.head.len()).rev() {
            if self.rows.iter().all(|row| row[column].is_empty()) {
                self.head.remove(column);
                self.align.remove(column);
                for row in &mut self.rows {
                    row.remove(column);
                }
            }
        }
        self
    }

    /// The headings of its columns.
    pub fn head(&self) -> &[String] {
        &self.head
    }

    /// How its columns stand.
    pub fn align(&self) -> &[Align] {
        &self.align
    }

    /// Its rows, each with a cell for every column.
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    pub(super) fn render(&self) -> String {
        self.render_in(WIDTH)
    }

    /// The table in lines of at most `width` characters.
    fn render_in(&self, width: usize) -> String {
        let widths = Widths::of(self, width);
        let rows = self.rows.iter();
        let lines = rows.flat_map(|row| self.row_lines(&widths, row, width));
        let lines = self.head_lines(&widths, width).into_iter().chain(lines);
        lines.map(|line| line + "\n").collect()
    }

    /// The heading of the block with those of the columns: beside it where there is room, else below.
    fn head_lines(&self, widths: &Widths, width: usize) -> Vec<String> {
        let mut cells = self.head.clone();
        cells[0].clear();
        let title = &self.head[0];
        let start = INDENT + widths.columns[0];
        if length(title) <= start {
            let mut lines = self.grid(widths, &cells, Side::Bottom);
            lines[0] = beside(title, &lines[0]);
            return lines;
        }
        let mut lines = wrap(title, width);
        let below = self.grid(widths, &cells, Side::Bottom);
        lines.extend(below.into_iter().filter(|line| !line.is_empty()));
        lines
    }

    fn row_lines(&self, widths: &Widths, row: &[String], width: usize) -> Vec<String> {
        let mut cells = row.to_vec();
        let mut lines: Vec<String> = Vec::new();
        if length(&row[0]) > widths.columns[0] {
            let name = wrap(&row[0], width.saturating_sub(INDENT));
            lines.extend(name.iter().map(|line| format!("{:INDENT$}{line}", "")));
            cells[0].clear();
        }
        let grid = self.grid(widths, &cells, Side::Top);
        lines.extend(grid.into_iter().filter(|line| !line.is_empty()));
        for &column in &widths.below {
            lines.extend(self.below(column, &row[column], width));
        }
        lines
    }

    /// The cells that stand side by side, each wrapped to the width of its column.
    fn grid(&self, widths: &Widths, cells: &[String], side: Side) -> Vec<String> {
        let columns: Vec<usize> = (0..cells.len())
            .filter(|column| !widths.below.contains(column))
            .collect();
        let wrapped: Vec<Vec<String>> = columns
            .iter()
            .map(|&column| wrap(&cells[column], widths.columns[column]))
            .collect();
        let height = wrapped.iter().map(Vec::len).max().unwrap_or(0).max(1);
        let line = |index: usize| {
            let mut line = " ".repeat(INDENT);
            for (&column, texts) in columns.iter().zip(&wrapped) {
                if column > 0 {
                    line += &" ".repeat(GAP);
                }
                let above = match side {
                    Side::Top => 0,
                    Side::Bottom => height - texts.len(),
                };
                let text = index.checked_sub(above).and_then(|at| texts.get(at));
                let text = text.map_or("", String::as_str);
                line += &pad(text, widths.columns[column], self.align[column]);
            }
            line.trim_end().to_owned()
        };
        (0..height).map(line).collect()
    }

    /// A cell for which no line has room beside the others, with its heading.
    fn below(&self, column: usize, cell: &str, width: usize) -> Vec<String> {
        const FURTHER_IN: usize = 2 * INDENT;
        if cell.is_empty() {
            return Vec::new();
        }
        let text = match self.head[column].as_str() {
            "" => cell.to_owned(),
            head => format!("{head}: {cell}"),
        };
        let lines = wrap(&text, width.saturating_sub(FURTHER_IN));
        let indented = |line: &String| format!("{:FURTHER_IN$}{line}", "");
        lines.iter().map(indented).collect()
    }
}

/// Where cells of one line stand in a row of several.
#[derive(Clone, Copy)]
enum Side {
    Top,
    Bottom,
}

/// A heading with what stands to the right of it in its line.
fn beside(title: &str, line: &str) -> String {
    let rest: String = line.chars().skip(length(title)).collect();
    format!("{title}{rest}")
}

fn pad(text: &str, width: usize, align: Align) -> String {
    match align {
        Align::Left => format!("{text:<width$}"),
        Align::Right => format!("{text:>width$}"),
    }
}

#[cfg(test)]
mod tests;
