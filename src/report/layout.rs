//! Plain text in columns.

/// No line is longer than this.
pub const WIDTH: usize = 92;
/// What stands before every line of a block but its heading.
const INDENT: usize = 2;
/// Spaces between columns.
const GAP: usize = 2;
/// The first column gives way to this when a table is too wide; longer names get a line of their own.
const NARROW_FIRST: usize = 24;

/// Breaks a text into lines of at most `width` characters, between words where it can.
pub fn wrap(text: &str, width: usize) -> Vec<String> {
    let width = width.max(1);
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in &words(text) {
        if !line.is_empty() && length(&line) + 1 + length(word) > width {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        for letter in word.chars() {
            if length(&line) == width {
                lines.push(std::mem::take(&mut line));
            }
            line.push(letter);
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// What must not be parted: words, and numbers with their units.
fn words(text: &str) -> Vec<String> {
    const UNITS: [&str; 9] = ["%", "deg", "mm", "um", "m/s", "uN.s", "s", "kg/m3", "bar"];
    let mut words: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let unit = word.trim_end_matches(['.', ',', ';', ':', ')']);
        match words.last_mut() {
            Some(number)
                if UNITS.contains(&unit) && number.ends_with(|c: char| c.is_ascii_digit()) =>
            {
                number.push(' ');
                number.push_str(word);
            }
            _ => words.push(word.into()),
        }
    }
    words
}

fn length(text: &str) -> usize {
    text.chars().count()
}

/// A heading and what stands below it.
#[derive(Debug, Default)]
pub struct Block(String);

impl Block {
    /// A block that starts with a heading.
    pub fn titled(title: &str) -> Self {
        Self(format!("{title}\n"))
    }

    /// Adds a table; the heading of its first column is the block's.
    pub fn table(&mut self, table: &Table) {
        self.0 += &table.render();
    }

    /// Adds a paragraph, indented.
    pub fn paragraph(&mut self, text: &str) {
        self.hanging("", text);
    }

    /// Adds a paragraph whose first line starts with `label`, and the others below what follows it.
    pub fn hanging(&mut self, label: &str, text: &str) {
        let start = INDENT + length(label);
        for (index, line) in wrap(text, WIDTH.saturating_sub(start)).iter().enumerate() {
            let label = if index == 0 { label } else { "" };
            let before = format!("{:INDENT$}{label}", "");
            self.0 += &format!("{before:start$}{line}\n");
        }
    }

    /// Adds an empty line.
    pub fn gap(&mut self) {
        self.0.push('\n');
    }

    /// Adds a line as it is, indented; for what must not be broken.
    pub fn verbatim(&mut self, line: &str) {
        self.0 += &format!("{:INDENT$}{line}\n", "");
    }

    /// The text of the block.
    pub fn into_text(self) -> String {
        self.0
    }
}

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

    fn render(&self) -> String {
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
    fn words_wider_than_a_line_are_cut() {
        assert_eq!(wrap("a bcd efghij k", 4), ["a", "bcd", "efgh", "ij k"]);
        assert!(wrap("", 10).is_empty());
    }

    #[test]
    fn units_stay_with_their_numbers() {
        assert_eq!(
            wrap("above 9.71 m/s, then", 14),
            ["above", "9.71 m/s, then"]
        );
    }

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
