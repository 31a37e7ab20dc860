//! Keys that a group holds already. YAML allows no second one, and none is passed over in silence.

use std::collections::HashMap;
use std::collections::hash_map::Entry as Slot;

use super::fault::Fault;
use super::fault_code::FaultCode;
use super::source::{child_key, item_key};
use super::yaml::{Entry, Node, Value};

/// Takes out every key that stands earlier in its group, and says so.
pub(super) fn take_out(root: &mut Node) -> Vec<Fault> {
    let mut faults = Vec::new();
    take_out_below("", root, &mut faults);
    faults
}

fn take_out_below(key: &str, node: &mut Node, faults: &mut Vec<Fault>) {
    match &mut node.value {
        Value::Map(entries) => {
            let mut first_lines = HashMap::new();
            entries.retain(|entry| match first_lines.entry(entry.key.clone()) {
                Slot::Vacant(slot) => {
                    slot.insert(entry.key_span.line);
                    true
                }
                Slot::Occupied(slot) => {
                    faults.push(fault(key, entry, *slot.get()));
                    false
                }
            });
            for entry in entries {
                take_out_below(&child_key(key, &entry.key), &mut entry.node, faults);
            }
        }
        Value::List(items) => {
            for (index, item) in items.iter_mut().enumerate() {
                take_out_below(&item_key(key, index), item, faults);
            }
        }
        Value::Null | Value::Number(_) | Value::Text(_) => {}
    }
}

fn fault(group: &str, entry: &Entry, first_line: usize) -> Fault {
    let message = if entry.key_span.line == first_line {
        "is given twice in this line".to_owned()
    } else {
        format!("is given already in line {first_line}")
    };
    let key = child_key(group, &entry.key);
    let mut fault = Fault::at_key(FaultCode::RepeatedKey, key, message).expecting("every key once");
    fault.at = Some(entry.key_span);
    fault
}
