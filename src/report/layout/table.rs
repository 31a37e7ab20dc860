//! Plain text in columns.

use super::{INDENT, WIDTH, length, wrap};

/// Spaces between columns.
const GAP: usize = 2;
/// The first column gives way to this when a table is too wide; longer names get a line of their own.
const NARROW_FIRST: usize = 24;

/// How a column stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Texts.
    Left,
    /// Numbers.
    Right,
}

/// Rows under a heading. The first column holds names; the last may hold texts that are wrapped.
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
        let widths = self.widths();
        let mut text = String::new();
        // The heading may begin where names do not.
        let mut head = self.head.clone();
        let first = head[0].clone();
        head[0] = String::new();
        let line = self.lines(&widths, &head).concat();
        let rest: String = line.chars().skip(length(&first)).collect();
        text += &format!("{first}{rest}");
        if !text.ends_with('\n') {
            text.push('\n');
        }
        for row in &self.rows {
            text += &self.lines(&widths, row).concat();
        }
        text
    }

    fn widths(&self) -> Vec<usize> {
        let last = self.head.len() - 1;
        let mut widths: Vec<usize> = (0..=last)
            .map(|column| {
                let cells = self.rows.iter().map(|row| length(&row[column]));
                let head = length(&self.head[column]);
                let head = if column == 0 {
                    head.saturating_sub(INDENT)
                } else {
                    head
                };
                cells.fold(head, usize::max)
            })
            .collect();
        let total = |widths: &[usize]| INDENT + widths.iter().sum::<usize>() + GAP * last;
        if total(&widths) > WIDTH {
            let excess = total(&widths) - WIDTH;
            let least = NARROW_FIRST.max(length(&self.head[0]).saturating_sub(INDENT));
            widths[0] = widths[0].saturating_sub(excess).max(least).min(widths[0]);
        }
        if total(&widths) > WIDTH && last > 0 {
            let excess = total(&widths) - WIDTH;
            widths[last] = widths[last].saturating_sub(excess).max(1);
        }
        widths
    }

    fn lines(&self, widths: &[usize], row: &[String]) -> Vec<String> {
        let last = widths.len() - 1;
        let mut lines: Vec<String> = Vec::new();
        let mut name = row[0].as_str();
        if length(name) > widths[0] {
            lines.extend(
                wrap(name, WIDTH - INDENT)
                    .iter()
                    .map(|line| format!("{:INDENT$}{line}\n", "")),
            );
            name = "";
        }
        let mut line = format!("{:INDENT$}{}", "", pad(name, widths[0], self.align[0]));
        for column in 1..last {
            line += &" ".repeat(GAP);
            line += &pad(&row[column], widths[column], self.align[column]);
        }
        let start = length(&line) + GAP;
        let end = if last == 0 {
            Vec::new()
        } else {
            wrap(&row[last], widths[last])
        };
        let first = end.first().map_or_else(String::new, |end| {
            " ".repeat(GAP) + &pad(end, widths[last], self.align[last])
        });
        lines.push(format!("{}\n", (line + &first).trim_end()));
        for more in end.iter().skip(1) {
            lines.push(format!("{:start$}{more}\n", ""));
        }
        lines
    }
}

fn pad(text: &str, width: usize, align: Align) -> String {
    match align {
        Align::Left => format!("{text:<width$}"),
        Align::Right => format!("{text:>width$}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_get_a_line_of_their_own() {
        let mut table = Table::new(&[("NAMES", Align::Left), ("value", Align::Right)]);
        let long = "part.".repeat(25);
        table.row([long.clone(), "1".into()]);
        table.row(["short".into(), "12".into()]);
        let text = table.render();
        assert!(text.lines().all(|line| length(line) <= WIDTH), "{text}");
        assert!(text.lines().all(|line| line.trim_end() == line));
        assert_eq!(text.matches("part.").count(), 25);
    }

    #[test]
    fn columns_are_aligned_below_their_headings() {
        let mut table = Table::new(&[("NAMES", Align::Left), ("value", Align::Right)]);
        table.row(["a".into(), "1.0".into()]);
        table.row(["bcdef".into(), "12.0".into()]);
        assert_eq!(
            table.render(),
            "NAMES    value\n  a        1.0\n  bcdef   12.0\n"
        );
    }
}
