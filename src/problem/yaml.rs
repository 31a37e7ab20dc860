//! YAML text to a tree of nodes that know where they stand; the one door to the YAML crate.

mod explain;

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_saphyr::options::{DuplicateKeyPolicy, MergeKeyPolicy, NonFiniteFloatPolicy};
use serde_saphyr::{Location, Options, Spanned};

use explain::explain;

use super::fault::{Fault, Span};
use super::size::{MOST_ALIASES, MOST_LEVELS};
use crate::units::parse_number;

/// A value of the file and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    /// What it is.
    pub value: Value,
    /// Where it is used; an alias stands where it is written, not where it leads.
    pub span: Span,
}

/// What stands at a place in the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    /// Nothing, or `~`.
    Null,
    /// A plain number, as it was written.
    Number(String),
    /// Any other scalar.
    Text(String),
    /// `[a, b]` or lines with dashes.
    List(Vec<Node>),
    /// `{ a: 1 }` or lines with keys.
    Map(Vec<Entry>),
}

/// One key with its value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub key: String,
    pub key_span: Span,
    pub node: Node,
}

/// Parses a whole file. The text must not start with a byte order mark.
pub(crate) fn parse(text: &str) -> Result<Node, Box<Fault>> {
    let raw: Spanned<Raw> = serde_saphyr::from_str_with_options(text, options())
        .map_err(|error| Box::new(explain(text, &error)))?;
    Ok(node(text, raw))
}

/// No honest problem file is deeper or larger than this.
fn options() -> Options {
    serde_saphyr::options! {
        budget: serde_saphyr::budget! {
            max_depth: MOST_LEVELS,
            flow_nesting_limit: MOST_LEVELS,
            max_documents: 1,
            max_events: 500_000,
            max_nodes: 250_000,
            max_aliases: MOST_ALIASES,
            max_anchors: MOST_ALIASES,
            max_recorded_anchor_events: 50_000,
            max_total_scalar_bytes: 2_000_000,
        },
        alias_limits: serde_saphyr::alias_limits! {
            max_total_replayed_events: 20_000,
            max_replay_stack_depth: 8,
        },
        merge_keys: MergeKeyPolicy::Error,
        // Every entry is handed over; what stands twice is reported with all other faults.
        duplicate_keys: DuplicateKeyPolicy::LastWins,
        reject_unsupported_tags: true,
        strict_booleans: true,
        non_finite_float_policy: NonFiniteFloatPolicy::PassThrough,
        with_snippet: false,
    }
}

/// A value as the YAML crate hands it over.
enum Raw {
    Null,
    Number,
    Flag,
    Text(String),
    List(Vec<Spanned<Raw>>),
    Map(Vec<(Spanned<String>, Spanned<Raw>)>),
}

impl<'de> Deserialize<'de> for Raw {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RawVisitor)
    }
}

struct RawVisitor;

impl<'de> Visitor<'de> for RawVisitor {
    type Value = Raw;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_unit<E>(self) -> Result<Raw, E> {
        Ok(Raw::Null)
    }

    fn visit_none<E>(self) -> Result<Raw, E> {
        Ok(Raw::Null)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Raw, E> {
        Ok(Raw::Flag)
    }

    fn visit_i64<E>(self, _: i64) -> Result<Raw, E> {
        Ok(Raw::Number)
    }

    fn visit_u64<E>(self, _: u64) -> Result<Raw, E> {
        Ok(Raw::Number)
    }

    fn visit_i128<E>(self, _: i128) -> Result<Raw, E> {
        Ok(Raw::Number)
    }

    fn visit_u128<E>(self, _: u128) -> Result<Raw, E> {
        Ok(Raw::Number)
    }

    fn visit_f64<E>(self, _: f64) -> Result<Raw, E> {
        Ok(Raw::Number)
    }

    fn visit_str<E>(self, text: &str) -> Result<Raw, E> {
        Ok(Raw::Text(text.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Raw, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element()? {
            list.push(item);
        }
        Ok(Raw::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Raw, A::Error> {
        let mut map = Vec::new();
        while let Some(entry) = entries.next_entry()? {
            map.push(entry);
        }
        Ok(Raw::Map(map))
    }
}

/// The node of `raw`, with the extent of lists and maps, which the YAML crate does not tell.
fn node(text: &str, raw: Spanned<Raw>) -> Node {
    let mut span = span(text, raw.referenced);
    let written = || {
        let place = self::span(text, raw.defined);
        text.get(place.start..place.end)
            .unwrap_or_default()
            .trim()
            .to_owned()
    };
    let value = match raw.value {
        Raw::Null => Value::Null,
        Raw::Number => Value::Number(written()),
        Raw::Flag => Value::Text(written()),
        // YAML knows no other minus and no other blank than ASCII's.
        Raw::Text(content) if is_typeset(&content) && !is_quoted(&written()) => {
            Value::Number(content)
        }
        Raw::Text(content) => Value::Text(content),
        Raw::List(items) => {
            let items: Vec<Node> = items.into_iter().map(|item| node(text, item)).collect();
            let last = items.last().map(|item| item.span.end);
            span.end = end_of_group(text, span, last, ']');
            Value::List(items)
        }
        Raw::Map(entries) => {
            let entries: Vec<Entry> = entries
                .into_iter()
                .map(|(key, value)| Entry {
                    key_span: self::span(text, key.referenced),
                    key: key.value,
                    node: node(text, value),
                })
                .collect();
            let last = entries
                .last()
                .map(|entry| entry.node.span.end.max(entry.key_span.end));
            span.end = end_of_group(text, span, last, '}');
            Value::Map(entries)
        }
    };
    Node { value, span }
}

/// Whether a text is a number with a sign or a blank of typesetters. What else YAML takes for text,
/// such as `1_000`, is none.
fn is_typeset(content: &str) -> bool {
    !content.is_ascii() && parse_number(content).is_some()
}

/// Whether a scalar was written so that it is text whatever it holds.
fn is_quoted(written: &str) -> bool {
    written.starts_with(['"', '\'', '|', '>', '!', '&'])
}

/// Where a list or map ends: at its bracket, or with its last entry.
fn end_of_group(text: &str, span: Span, last: Option<usize>, bracket: char) -> usize {
    let inside = last.unwrap_or(span.end).max(span.end);
    let rest = text.get(inside..).unwrap_or_default();
    let flow = text
        .get(span.start..)
        .is_some_and(|t| t.starts_with(['[', '{']));
    match rest.find(|c: char| !c.is_whitespace() && c != ',') {
        Some(gap) if flow && rest[gap..].starts_with(bracket) => inside + gap + 1,
        _ => inside,
    }
}

/// The place that the YAML crate means; tokens carry bytes, syntax errors only characters.
fn span(text: &str, location: Location) -> Span {
    let place = location.span();
    let (start, end) = match (place.byte_offset(), place.byte_len()) {
        (Some(start), Some(length)) => (start, start.saturating_add(length)),
        _ => {
            let skip = usize::try_from(place.offset()).unwrap_or(usize::MAX);
            let mut rest = text.char_indices().map(|(at, _)| at as u64).skip(skip);
            let start = rest.next().unwrap_or(text.len() as u64);
            (start, rest.next().unwrap_or(text.len() as u64))
        }
    };
    let within = |at: u64| text.floor_char_boundary(usize::try_from(at).unwrap_or(usize::MAX));
    Span {
        line: usize::try_from(location.line()).unwrap_or(1).max(1),
        column: usize::try_from(location.column()).unwrap_or(1).max(1),
        start: within(start),
        end: within(end),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the value of the only key of `text` covers.
    fn extent(text: &str) -> &str {
        let root = parse(text).unwrap();
        let Value::Map(entries) = root.value else {
            panic!("{text} is a map");
        };
        let span = entries[0].node.span;
        &text[span.start..span.end]
    }

    #[test]
    fn groups_end_with_their_bracket_or_their_last_entry() {
        for (text, written) in [
            ("a: [1, 2]", "[1, 2]"),
            ("a: [1, 2 ,\n  ]\n", "[1, 2 ,\n  ]"),
            ("a: []", "[]"),
            ("a: {b: 1, c: [2] } # x", "{b: 1, c: [2] }"),
            ("a:\n  - 1\n  - 2 # x\n", "- 1\n  - 2"),
            ("a:\n  b: 1\n  c: [2]\n", "b: 1\n  c: [2]"),
            // Behind a comment the bracket is not looked for.
            ("a: [1, 2 # x\n  ]", "[1, 2"),
        ] {
            assert_eq!(extent(text), written, "{text}");
        }
    }
}
