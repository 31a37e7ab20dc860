//! The text of a problem file, and where in it every key stands.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::change::Change;
use super::fault::Span;
use super::yaml::{Node, Value};

/// A problem file as it was read.
#[derive(Clone, Debug)]
pub struct Source {
    /// Where it was read from.
    pub path: PathBuf,
    /// Its text, without a byte order mark.
    pub text: String,
    /// SHA-256 of its bytes, in hexadecimal digits; of the changed text where something was changed.
    pub sha256: String,
    /// What was changed in the text that stands on the disk, to get this one.
    pub changes: Vec<Change>,
    places: HashMap<String, Place>,
}

/// Where a key and its value stand.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// `None` for the items of a list.
    name: Option<Span>,
    value: Span,
    /// Whether the value is worth pointing at: present, on one line, and not lines of keys.
    compact: bool,
}

impl Source {
    /// A text without known keys.
    pub(crate) fn new(path: &Path, bytes: &[u8], text: String) -> Self {
        Self {
            path: path.to_owned(),
            text,
            sha256: sha256(bytes),
            changes: Vec::new(),
            places: HashMap::new(),
        }
    }

    /// Learns where the keys of the parsed text stand.
    pub(super) fn index(&mut self, root: &Node) {
        self.add_contents("", root);
    }

    fn add_contents(&mut self, key: &str, node: &Node) {
        match &node.value {
            Value::Map(entries) => {
                for entry in entries {
                    self.add(
                        child_key(key, &entry.key),
                        Some(entry.key_span),
                        &entry.node,
                    );
                }
            }
            Value::List(items) => {
                for (index, item) in items.iter().enumerate() {
                    self.add(item_key(key, index), None, item);
                }
            }
            Value::Null | Value::Number(_) | Value::Text(_) => {}
        }
    }

    fn add(&mut self, key: String, name: Option<Span>, node: &Node) {
        self.add_contents(&key, node);
        let written = self.text.get(node.span.start..node.span.end);
        let is_group = matches!(node.value, Value::List(_) | Value::Map(_));
        let compact = written.is_some_and(|text| {
            let block = is_group && !text.starts_with(['[', '{']);
            !text.is_empty() && !text.contains('\n') && !block
        });
        let value = node.span;
        self.places.insert(
            key,
            Place {
                name,
                value,
                compact,
            },
        );
    }

    /// Where the value of `key` stands, such as `shot.radius` or `settings.speed[1]`.
    ///
    /// A value of several lines, or of keys on lines of their own, is found by its key, and an absent key by the nearest group that
    /// it belongs to; the beginning of the text stands for the file as a whole. `None` only when
    /// the text could not be parsed at all.
    pub fn locate(&self, key: &str) -> Option<Span> {
        if let Some(place) = self.places.get(key) {
            return Some(match place.name {
                Some(name) if !place.compact => name,
                _ => place.value,
            });
        }
        let mut group = key;
        while let Some(cut) = group.rfind(['.', '[']) {
            group = &group[..cut];
            if let Some(place) = self.places.get(group) {
                return Some(place.name.unwrap_or(place.value));
            }
        }
        (!self.places.is_empty()).then_some(Span {
            line: 1,
            column: 1,
            start: 0,
            end: 0,
        })
    }

    /// Whether `key` stands in the text, with a value or without.
    pub(super) fn has(&self, key: &str) -> bool {
        self.places.contains_key(key)
    }

    /// Where the last name of `key` itself stands, not its value.
    pub fn locate_name(&self, key: &str) -> Option<Span> {
        match self.places.get(key) {
            Some(place) => place.name.or(Some(place.value)),
            None => self.locate(key),
        }
    }

    /// The value of `key` as it was written, when it fits on a line.
    pub(super) fn written(&self, key: &str) -> Option<&str> {
        let place = self.places.get(key).filter(|place| place.compact)?;
        self.text.get(place.value.start..place.value.end)
    }
}

/// Key path of `name` within the group `key`.
pub(super) fn child_key(key: &str, name: &str) -> String {
    if key.is_empty() {
        name.to_owned()
    } else {
        format!("{key}.{name}")
    }
}

/// Key path of one item of the list `key`.
pub(super) fn item_key(key: &str, index: usize) -> String {
    format!("{key}[{index}]")
}

/// SHA-256 of a file's bytes, in hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes
        .iter()
        .fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
            let _ = write!(text, "{byte:02x}");
            text
        })
}
