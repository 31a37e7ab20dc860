//! The JSON Schema of problem files, made from the types that read them.
//!
//! A schema sees the structure of a file: unknown keys, missing ones, values of the wrong kind,
//! units. What numbers may be and what names refer to only the check can tell. One thing the schema
//! is stricter about: a key that is there but has no value.

mod library;

use std::borrow::Cow;

use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

pub(super) use library::{ContactName, Contacts, MediumName, ModelName};

use super::field::{Field, Needed};
use super::file::{Named, ProblemFile};
use super::name::NAME_PATTERN;
use crate::units::Dimension;

/// The JSON Schema (draft 2020-12) of problem files, for editors and other programs.
///
/// ```
/// let schema = peenpose::problem::schema();
/// assert_eq!(schema["properties"]["format"]["const"], 1);
/// assert!(schema["required"].as_array().unwrap().contains(&"goals".into()));
/// ```
pub fn schema() -> Value {
    let schema = SchemaSettings::draft2020_12()
        .with_transform(RecursiveTransform(finish))
        .into_generator()
        .into_root_schema_for::<ProblemFile>();
    // What it is comes first, for those who read it.
    let mut ordered = Map::new();
    for key in ["$schema", "title", "description"] {
        ordered.extend(schema.get(key).map(|value| (key.to_owned(), value.clone())));
    }
    ordered.extend(
        schema
            .as_object()
            .into_iter()
            .flatten()
            .map(|(key, value)| (key.clone(), value.clone())),
    );
    Value::Object(ordered)
}

/// Marks the schema of a key that must be there, until [`finish`] has seen it.
const NEEDED: &str = "x-needed";

/// What the derived schemas do not know: which keys must be there, that no others may, and that
/// lines of comments are one paragraph.
fn finish(schema: &mut Schema) {
    schema.remove(NEEDED);
    // How a number is held here is nobody else's concern.
    schema.remove("format");
    if let Some(Value::String(description)) = schema.get_mut("description") {
        *description = joined_lines(description);
    }
    let Some(Value::Object(properties)) = schema.get("properties") else {
        return;
    };
    let needed: Vec<&String> = properties
        .iter()
        .filter(|(_, property)| property.get(NEEDED).is_some())
        .map(|(name, _)| name)
        .collect();
    if !needed.is_empty() {
        let needed = json!(needed);
        schema.insert("required".into(), needed);
    }
    if schema.get("additionalProperties").is_none() {
        schema.insert("additionalProperties".into(), false.into());
    }
}

/// The text with one line per paragraph; fenced examples stay as they are.
fn joined_lines(text: &str) -> String {
    let mut joined = String::new();
    let mut fenced = false;
    let mut goes_on = false;
    for line in text.lines() {
        let is_fence = line.starts_with("```");
        let is_plain = !fenced && !is_fence && !line.is_empty();
        if !joined.is_empty() {
            joined.push(if goes_on && is_plain { ' ' } else { '\n' });
        }
        joined.push_str(line);
        fenced ^= is_fence;
        goes_on = is_plain;
    }
    joined
}

/// The schema of a number with a unit.
pub(super) fn quantity(dimension: Dimension) -> Schema {
    let units: Vec<&str> = dimension.unit_names().collect();
    let described = dimension.described();
    let mut letters = described.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    json_schema!({
        "description": format!(
            "{}; in {}.",
            first.chain(letters).collect::<String>(),
            units.join(", ")
        ),
        "type": "string",
        "pattern": dimension.pattern(),
        "patternErrorMessage": format!("expected {described}; units: {}", units.join(", ")),
    })
}

/// What parts, contacts and regions may be called.
pub(super) fn names() -> Value {
    json!({ "pattern": NAME_PATTERN })
}

/// Exactly one of `keys` must be there.
pub(super) fn exactly_one_of(keys: &[&str]) -> Value {
    keys.iter()
        .map(|key| json!({ "required": [key] }))
        .collect()
}

impl<T: JsonSchema> JsonSchema for Field<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        generator.subschema_for::<T>()
    }
}

impl<T: JsonSchema> JsonSchema for Needed<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = generator.subschema_for::<T>();
        schema.insert(NEEDED.into(), true.into());
        schema
    }
}

impl<T: JsonSchema> JsonSchema for Named<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Named_{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "object",
            "additionalProperties": generator.subschema_for::<T>(),
        })
    }
}
