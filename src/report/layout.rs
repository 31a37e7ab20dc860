//! Plain text in lines of limited length.

mod table;

pub use table::{Align, Table};

/// No line is longer than this.
pub const WIDTH: usize = 92;
/// What stands before every line of a block but its heading.
const INDENT: usize = 2;

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

/// A heading and what stands below it, in this order; as plain text or for others to lay out.
#[derive(Debug, Default)]
pub struct Block {
    title: Option<String>,
    parts: Vec<Part>,
}

/// A part of a block.
#[derive(Debug)]
pub enum Part {
    /// Rows under a heading.
    Table(Table),
    /// A paragraph behind a label, which may be empty.
    Paragraph {
        /// What its first line starts with.
        label: String,
        /// The text, not yet broken into lines.
        text: String,
    },
    /// An empty line.
    Gap,
    /// A line that must not be broken.
    Verbatim(String),
}

impl Block {
    /// A block that starts with a heading.
    pub fn titled(title: &str) -> Self {
        Self {
            title: Some(title.into()),
            parts: Vec::new(),
        }
    }

    /// Adds a table; the heading of its first column is the block's.
    pub fn table(&mut self, table: Table) {
        self.parts.push(Part::Table(table));
    }

    /// Adds a paragraph, indented.
    pub fn paragraph(&mut self, text: &str) {
        self.hanging("", text);
    }

    /// Adds a paragraph where a condition holds.
    pub fn paragraph_if(&mut self, condition: bool, text: &str) {
        if condition {
            self.paragraph(text);
        }
    }

    /// Adds a paragraph whose first line starts with `label`, and the others below what follows it.
    pub fn hanging(&mut self, label: &str, text: &str) {
        self.parts.push(Part::Paragraph {
            label: label.into(),
            text: text.into(),
        });
    }

    /// Adds an empty line.
    pub fn gap(&mut self) {
        self.parts.push(Part::Gap);
    }

    /// Adds a line as it is, indented; for what must not be broken.
    pub fn verbatim(&mut self, line: &str) {
        self.parts.push(Part::Verbatim(line.into()));
    }

    /// What stands below the heading.
    pub fn into_parts(self) -> Vec<Part> {
        self.parts
    }

    /// The text of the block.
    pub fn into_text(self) -> String {
        let title = self.title.map(|title| title + "\n");
        let parts = self.parts.iter().map(Part::text);
        title.into_iter().chain(parts).collect()
    }
}

impl Part {
    fn text(&self) -> String {
        match self {
            Self::Table(table) => table.render(),
            Self::Paragraph { label, text } => hanging(label, text),
            Self::Gap => "\n".into(),
            Self::Verbatim(line) => format!("{:INDENT$}{line}\n", ""),
        }
    }
}

fn hanging(label: &str, text: &str) -> String {
    let start = INDENT + length(label);
    let lines = wrap(text, WIDTH.saturating_sub(start));
    let numbered = lines.iter().enumerate().map(|(index, line)| {
        let label = if index == 0 { label } else { "" };
        let before = format!("{:INDENT$}{label}", "");
        format!("{before:start$}{line}\n")
    });
    numbered.collect()
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
}
