//! The JSON Schema of problem files, made from the types that read them.
//!
//! A schema sees the structure of a file: unknown keys, missing ones, values of the wrong kind,
//! units. What numbers may be and what names refer to only the check can tell. One thing the schema
//! is stricter about: a key that is there but has no value.

use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde_json::{Map, Value, json};

use super::field::NEEDED;
use super::file::ProblemFile;

/// The JSON Schema (draft 2020-12) of problem files, for editors and other programs.
///
/// ```
/// let schema = peenpose::problem::schema();
/// assert_eq!(schema["properties"]["format"]["const"], 1);
/// assert!(schema["required"].as_array().unwrap().contains(&"goals".into()));
/// ```
pub fn schema() -> Value {
    let mut schema = SchemaSettings::draft2020_12()
        .with_transform(RecursiveTransform(finish))
        .into_generator()
        .into_root_schema_for::<ProblemFile>();
    schema.insert("$id".into(), ID.into());
    let all = schema.ensure_object().clone();
    // What it is comes first, for those who read it.
    let mut ordered = Map::new();
    for key in ["$schema", "$id", "title", "description"] {
        ordered.extend(
            all.get_key_value(key)
                .map(|(key, value)| (key.clone(), value.clone())),
        );
    }
    ordered.extend(all);
    Value::Object(ordered)
}

/// The name of the schema: with the version of the format.
const ID: &str = "urn:peenpose:problem:1";

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
