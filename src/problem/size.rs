//! How large a problem file and what stands in it may be: no honest file is larger, and the time
//! and memory that some checks take grow with the square of these numbers.

use super::fault::Fault;
use super::fault_code::FaultCode;
use super::source::{child_key, item_key};
use super::yaml::{Node, Value};

/// Bytes of the largest problem file; meshes have files of their own.
pub const LARGEST_FILE: u64 = 1_000_000;
/// Most lists and groups of keys within each other.
pub const MOST_LEVELS: usize = 24;
/// Most aliases, and most anchors.
pub const MOST_ALIASES: usize = 1000;
/// Most items of a list, and most keys of a group.
pub const MOST_ITEMS: usize = 1000;
/// Characters of the longest key.
pub const LONGEST_KEY: usize = 100;
/// Characters of the longest text.
pub const LONGEST_TEXT: usize = 1000;

/// The first thing in a file that is larger than any honest file has.
pub(super) fn fault_of(root: &Node) -> Option<Fault> {
    of_value(root, "")
}

fn of_value(node: &Node, key: &str) -> Option<Fault> {
    let fault = |rule: FaultCode, message: String, expected: String| {
        let mut fault = Fault::at_key(rule, key, message).expecting(expected);
        fault.at = Some(node.span);
        Some(fault)
    };
    match &node.value {
        Value::Number(text) | Value::Text(text) if text.chars().count() > LONGEST_TEXT => fault(
            FaultCode::TextTooLong,
            format!("is {} characters long", text.chars().count()),
            format!("at most {LONGEST_TEXT} characters"),
        ),
        Value::Null | Value::Number(_) | Value::Text(_) => None,
        Value::List(items) if items.len() > MOST_ITEMS => fault(
            FaultCode::TooManyItems,
            format!("is a list of {}", items.len()),
            format!("at most {MOST_ITEMS} items"),
        ),
        Value::Map(entries) if entries.len() > MOST_ITEMS => fault(
            FaultCode::TooManyItems,
            format!("has {} keys", entries.len()),
            format!("at most {MOST_ITEMS} keys"),
        ),
        Value::List(items) => {
            let mut items = items.iter().enumerate();
            items.find_map(|(index, item)| of_value(item, &item_key(key, index)))
        }
        Value::Map(entries) => entries.iter().find_map(|entry| {
            let length = entry.key.chars().count();
            if length > LONGEST_KEY {
                let message = format!("has a key of {length} characters");
                let expected = format!("at most {LONGEST_KEY} characters");
                let mut fault =
                    Fault::at_key(FaultCode::KeyTooLong, key, message).expecting(expected);
                fault.at = Some(entry.key_span);
                return Some(fault);
            }
            of_value(&entry.node, &child_key(key, &entry.key))
        }),
    }
}
