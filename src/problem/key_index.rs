//! Which groups have a key: for keys that stand in another one.

use std::collections::HashMap;
use std::sync::LazyLock;

use serde_json::Value;

use super::schema::schema;
use super::source::child_key;

/// The key paths of the groups that have a key of this name; empty for the file as a whole, and
/// with `<name>` where the user chooses a name.
pub(super) fn homes_of(name: &str) -> &'static [String] {
    static HOMES: LazyLock<HashMap<String, Vec<String>>> = LazyLock::new(|| {
        let schema = schema();
        let mut homes = HashMap::new();
        collect(&schema, &schema["$defs"], "", &mut homes);
        homes
    });
    HOMES.get(name).map_or(&[], Vec::as_slice)
}

/// Collects the keys that a schema knows, from the schema of a group downwards.
fn collect(
    schema: &Value,
    definitions: &Value,
    group: &str,
    homes: &mut HashMap<String, Vec<String>>,
) {
    if let Some(reference) = schema["$ref"].as_str() {
        let definition = reference.trim_start_matches("#/$defs/");
        collect(&definitions[definition], definitions, group, homes);
    }
    for ways in ["anyOf", "oneOf"] {
        for way in schema[ways].as_array().into_iter().flatten() {
            collect(way, definitions, group, homes);
        }
    }
    if schema["items"].is_object() {
        let item = format!("{group}[]");
        collect(&schema["items"], definitions, &item, homes);
    }
    if schema["additionalProperties"].is_object() {
        // Names of the user's own; what stands there under fixed names is no key.
        let named = child_key(group, "<name>");
        collect(&schema["additionalProperties"], definitions, &named, homes);
        return;
    }
    for (name, below) in schema["properties"].as_object().into_iter().flatten() {
        let known = homes.entry(name.clone()).or_default();
        if !known.iter().any(|home| home == group) {
            known.push(group.to_owned());
        }
        // Most keys of a stroke are those of other groups, where they are meant.
        if !(group.is_empty() && name == "stroke") {
            collect(below, definitions, &child_key(group, name), homes);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::homes_of;

    #[test]
    fn keys_are_at_home_where_the_schema_has_them() {
        assert_eq!(homes_of("divergence"), ["jet"]);
        assert_eq!(homes_of("lengths_in"), ["", "scene.<name>"]);
        assert_eq!(
            homes_of("mu_s"),
            ["contacts.<name>", "surfaces.<name>.contact"]
        );
        assert_eq!(
            homes_of("radius"),
            ["shot", "nozzle.body[].ball", "nozzle.body[].capsule"]
        );
        assert_eq!(homes_of("via"), ["scene.<name>.extrude.profile[]"]);
        assert!(homes_of("radus").is_empty());
    }
}
