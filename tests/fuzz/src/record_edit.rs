//! Changes of single values of a record.

use serde_json::{Map, Number, Value};

use super::bytes::Bytes;

/// Changes some values anywhere in a record.
pub fn edit(record: &mut Value, bytes: &mut Bytes<'_>) {
    const MOST_EDITS: usize = 12;
    for _ in 0..MOST_EDITS {
        if bytes.is_empty() {
            return;
        }
        let place = descend(record, bytes);
        change(place, bytes);
    }
}

/// Walks inwards; the bytes say where to, and when to stop.
fn descend<'v>(value: &'v mut Value, bytes: &mut Bytes<'_>) -> &'v mut Value {
    let is_deep_enough = bytes.byte() < 20;
    let index = usize::from(bytes.byte());
    let count = match value {
        Value::Object(map) => map.len(),
        Value::Array(list) => list.len(),
        _ => 0,
    };
    if is_deep_enough || count == 0 {
        return value;
    }
    let inner = match value {
        Value::Object(map) => map.values_mut().nth(index % count),
        Value::Array(list) => list.get_mut(index % count),
        _ => None,
    };
    descend(inner.expect("there are so many"), bytes)
}

fn change(value: &mut Value, bytes: &mut Bytes<'_>) {
    let index = usize::from(bytes.byte());
    match value {
        Value::Array(list) => match bytes.byte() % 4 {
            0 => list.clear(),
            1 => list.truncate(index),
            2 => list.extend(list.get(index).cloned()),
            _ => list.iter_mut().for_each(|item| change_leaf(item, index)),
        },
        Value::Object(map) => match bytes.byte() % 3 {
            0 => *value = Value::Null,
            1 => take_key(map, index),
            _ => map.values_mut().for_each(|item| change_leaf(item, index)),
        },
        leaf => change_leaf(leaf, index),
    }
}

fn take_key(map: &mut Map<String, Value>, index: usize) {
    let key = map.keys().nth(index % map.len().max(1)).cloned();
    key.and_then(|key| map.remove(&key));
}

fn change_leaf(value: &mut Value, index: usize) {
    const NUMBERS: [f64; 16] = [
        0.0, -0.0, 1.0, -1.0, 2.0, 0.5, 1e-3, 1e3, 1e9, 1e-9, 1e15, 1e-300, 1e300, -1e300,
        1.797e308, 5e-324,
    ];
    const TEXTS: [&str; 8] = [
        "",
        " ",
        "</script>",
        "\u{0}",
        "é\u{301}\u{202e}",
        "a,b\"c\n",
        "incidence",
        "\u{1f600}",
    ];
    const WHOLE: [u64; 6] = [0, 1, 2, 1000, 4_294_967_295, u64::MAX];
    match value {
        Value::Number(number) if number.is_f64() => {
            *value =
                Number::from_f64(NUMBERS[index % NUMBERS.len()]).map_or(Value::Null, Value::Number);
        }
        Value::Number(_) => *value = WHOLE[index % WHOLE.len()].into(),
        Value::String(text) => {
            *text = match index {
                0..8 => TEXTS[index].to_owned(),
                _ => text.chars().cycle().take(20 * index).collect(),
            }
        }
        Value::Bool(is_so) => *is_so = !*is_so,
        Value::Null => *value = Value::from(NUMBERS[index % NUMBERS.len()]),
        Value::Array(_) | Value::Object(_) => {}
    }
}
