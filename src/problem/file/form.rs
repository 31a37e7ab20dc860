//! Schemas of values that the derived ones do not describe: quantities, and names out of lists.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

use crate::problem::Limit;
use crate::problem::media;
use crate::problem::model::Effect;
use crate::problem::name::NAME_PATTERN;
use crate::units::Dimension;

/// The schema of a number with a unit.
pub(super) fn quantity(dimension: Dimension, range: &str) -> Schema {
    let units: Vec<&str> = dimension.unit_names().collect();
    let described = dimension.described();
    let (_, example) = described.split_once(" such as ").unwrap_or_default();
    let mut letters = range.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    json_schema!({
        "description": format!(
            "{}, such as {example}; in {}.",
            first.chain(letters).collect::<String>(),
            units.join(", ")
        ),
        "type": "string",
        "pattern": dimension.pattern(),
        "patternErrorMessage": format!("expected {described}; units: {}", units.join(", ")),
    })
}

/// The schema of a number without a unit.
pub(super) fn number(mut schema: Schema, limit: &Limit) -> Schema {
    let (min, max, is_closed) = limit.ends();
    let most = if is_closed {
        "maximum"
    } else {
        "exclusiveMaximum"
    };
    for (key, end) in [("minimum", min), (most, max)] {
        let whole = end as i64;
        let end = if whole as f64 == end {
            json!(whole)
        } else {
            json!(end)
        };
        schema.insert(key.into(), end);
    }
    schema
}

/// What parts, contacts and regions may be called.
pub(in crate::problem) fn names() -> Value {
    json!({ "pattern": NAME_PATTERN })
}

/// Exactly one of `keys` must be there.
pub(in crate::problem) fn exactly_one_of(keys: &[&str]) -> Value {
    keys.iter()
        .map(|key| json!({ "required": [key] }))
        .collect()
}

/// A medium of the library.
pub(in crate::problem) struct MediumName;

/// A contact of the library.
pub(in crate::problem) struct ContactName;

/// `auto`, a speed or turns.
pub(in crate::problem) struct FeedText;

/// `auto` or a whole number.
pub(in crate::problem) struct PassesText;

/// `auto` or a length.
pub(in crate::problem) struct RunOutText;

/// `auto`, `full`, or effects.
pub(in crate::problem) struct ModelName;

fn medium_names() -> Vec<&'static str> {
    media::media().iter().map(|known| known.name).collect()
}

/// The names of all contacts of the library.
pub(super) fn contact_names() -> Vec<&'static str> {
    media::contacts().iter().map(|known| known.name).collect()
}

macro_rules! inline_schemas {
    ($($name:ident: $schema:expr;)*) => {$(
        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                $schema
            }
        }
    )*};
}

inline_schemas! {
    MediumName: json_schema!({ "enum": medium_names() });
    ContactName: json_schema!({ "enum": contact_names() });
    FeedText: json_schema!({
        "anyOf": [
            { "const": "auto" },
            { "type": "string", "pattern": Dimension::Speed.pattern() },
            { "type": "string", "pattern": "^[ ]*[0-9.]+([eE][-+]?[0-9]+)?[ ]*rpm[ ]*$" },
        ],
    });
    PassesText: json_schema!({
        "anyOf": [{ "const": "auto" }, { "type": "integer", "minimum": 1, "maximum": 10_000 }],
    });
    RunOutText: json_schema!({
        "anyOf": [{ "const": "auto" }, { "type": "string", "pattern": Dimension::Length.pattern() }],
    });
    ModelName: json_schema!({
        "anyOf": [
            { "enum": ["auto", "full"] },
            { "type": "array", "items": { "enum": Effect::ALL.map(Effect::name) } },
        ],
    });
}
