//! Blocks of the sheet as elements of a page.

use crate::report::layout::{Align, Block, Part, Table};
use crate::report::typeset::typeset;

/// An element of a page.
pub enum Element {
    /// A table.
    Table(TableView),
    /// A list of sentences.
    List(Vec<String>),
    /// Names with what belongs to them.
    Terms(Vec<(String, String)>),
    /// A paragraph.
    Paragraph(String),
    /// Lines that must not be broken.
    Verbatim(String),
}

/// A table whose cells know how they stand.
pub struct TableView {
    /// What it holds.
    pub caption: String,
    /// Headings of the columns.
    pub head: Vec<Cell>,
    /// Rows of cells.
    pub rows: Vec<Vec<Cell>>,
}

/// A cell of a table.
pub struct Cell {
    /// Its text.
    pub text: String,
    /// Its class in the style sheet.
    pub class: &'static str,
}

impl Element {
    /// The elements of a block, without its heading.
    pub fn of_block(block: Block) -> Vec<Self> {
        let mut elements: Vec<Self> = Vec::new();
        for part in block.into_parts() {
            match part {
                Part::Table(table) => elements.push(Self::Table(TableView::new(&table))),
                Part::Gap => {}
                Part::Verbatim(line) => match elements.last_mut() {
                    Some(Self::Verbatim(lines)) => *lines += &format!("\n{line}"),
                    _ => elements.push(Self::Verbatim(line)),
                },
                Part::Paragraph { label, text } => {
                    let text = typeset(&text);
                    match (label.trim(), elements.last_mut()) {
                        ("", _) => elements.push(Self::Paragraph(text)),
                        ("-", Some(Self::List(items))) => items.push(text),
                        ("-", _) => elements.push(Self::List(vec![text])),
                        (name, Some(Self::Terms(terms))) => terms.push((name.into(), text)),
                        (name, _) => elements.push(Self::Terms(vec![(name.into(), text)])),
                    }
                }
            }
        }
        elements
    }

    /// The elements of a block that may be missing.
    pub fn of(block: Option<Block>) -> Vec<Self> {
        block.map_or_else(Vec::new, Self::of_block)
    }
}

impl TableView {
    fn new(table: &Table) -> Self {
        let class = |column: usize| match table.align()[column] {
            Align::Left => "",
            Align::Right => "number",
        };
        // The heading of the first column is that of the whole table.
        let head = table.head().iter().enumerate().map(|(column, text)| Cell {
            text: if column == 0 {
                String::new()
            } else {
                typeset(text)
            },
            class: class(column),
        });
        let row = |row: &Vec<String>| {
            let cells = row.iter().enumerate().map(|(column, text)| Cell {
                class: verdict_class(text).unwrap_or(class(column)),
                text: typeset(text),
            });
            cells.collect()
        };
        Self {
            caption: typeset(&sentence_case(
                table.head().first().map_or("", String::as_str),
            )),
            head: head.collect(),
            rows: table.rows().iter().map(row).collect(),
        }
    }
}

/// The class of a cell that holds a verdict.
fn verdict_class(text: &str) -> Option<&'static str> {
    match text.split_whitespace().next() {
        Some("PASS") => Some("pass"),
        Some("FAIL" | "NO") if text == text.to_uppercase() || text.ends_with("near") => {
            Some("fail")
        }
        _ => None,
    }
}

/// `OTHER SURFACES, N* in uN.s` as `Other surfaces, N* in uN.s`.
fn sentence_case(heading: &str) -> String {
    let is_loud = |word: &str| {
        let letters = || word.chars().filter(|c| c.is_alphabetic());
        letters().count() > 1 && letters().all(char::is_uppercase)
    };
    let words = heading.split_whitespace().enumerate().map(|(index, word)| {
        if !is_loud(word) {
            return word.to_owned();
        }
        let quiet = word.to_lowercase();
        match quiet.chars().next() {
            Some(first) if index == 0 => {
                first.to_uppercase().chain(quiet.chars().skip(1)).collect()
            }
            _ => quiet,
        }
    });
    words.collect::<Vec<String>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_of_the_sheet_are_quiet_on_a_page() {
        assert_eq!(
            sentence_case("OTHER SURFACES, N* in uN.s"),
            "Other surfaces, N* in uN.s"
        );
        assert_eq!(sentence_case("MODEL, without"), "Model, without");
        assert_eq!(sentence_case(""), "");
    }

    #[test]
    fn verdicts_stand_out_and_names_that_look_like_them_do_not() {
        assert_eq!(verdict_class("PASS near"), Some("pass"));
        assert_eq!(verdict_class("FAIL near"), Some("fail"));
        assert_eq!(verdict_class("NO ROOM"), Some("fail"));
        assert_eq!(verdict_class("FAIL 2"), Some("fail"));
        assert_eq!(verdict_class("NO feather.edge"), None);
    }

    #[test]
    fn lists_terms_and_lines_are_gathered() {
        let mut block = Block::titled("TITLE");
        block.hanging("- ", "one");
        block.hanging("- ", "two");
        block.hanging("shot    ", "round");
        block.gap();
        block.verbatim("a  b");
        block.verbatim("c  d");
        let elements = Element::of_block(block);
        assert!(matches!(&elements[0], Element::List(items) if items.len() == 2));
        assert!(matches!(&elements[1], Element::Terms(terms) if terms[0].0 == "shot"));
        assert!(matches!(&elements[2], Element::Verbatim(lines) if lines == "a  b\nc  d"));
    }
}
