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
        let mut found = Found::default();
        found.collect(&schema, &schema["$defs"], "");
        for (group, below) in std::mem::take(&mut found.repeating) {
            let mut inside = Found::default();
            inside.collect(&below, &schema["$defs"], &group);
            for (name, groups) in inside.homes {
                found.homes.entry(name).or_insert(groups);
            }
        }
        found.homes
    });
    HOMES.get(name).map_or(&[], Vec::as_slice)
}

/// Groups most of whose keys are those of other groups, where they are meant when they stand in the wrong place.
const REPEATING: [&str; 3] = ["stroke", "measured_at", "regions"];

/// What a schema knows.
#[derive(Default)]
struct Found {
    /// The groups of each key.
    homes: HashMap<String, Vec<String>>,
    /// Groups of [`REPEATING`] with their schemas.
    repeating: Vec<(String, Value)>,
}

impl Found {
    /// Collects the keys that a schema knows, from the schema of a group downwards.
    fn collect(&mut self, schema: &Value, definitions: &Value, group: &str) {
        if let Some(reference) = schema["$ref"].as_str() {
            let definition = reference.trim_start_matches("#/$defs/");
            self.collect(&definitions[definition], definitions, group);
        }
        for ways in ["anyOf", "oneOf"] {
            for way in schema[ways].as_array().into_iter().flatten() {
                self.collect(way, definitions, group);
            }
        }
        if schema["items"].is_object() {
            let item = format!("{group}[]");
            self.collect(&schema["items"], definitions, &item);
        }
        if schema["additionalProperties"].is_object() {
            // Names of the user's own; what stands there under fixed names is no key.
            let named = child_key(group, "<name>");
            self.collect(&schema["additionalProperties"], definitions, &named);
            return;
        }
        for (name, below) in schema["properties"].as_object().into_iter().flatten() {
            let known = self.homes.entry(name.clone()).or_default();
            if !known.iter().any(|home| home == group) {
                known.push(group.to_owned());
            }
            let key = child_key(group, name);
            match REPEATING.contains(&name.as_str()) {
                true => self.repeating.push((key, below.clone())),
                false => self.collect(below, definitions, &key),
            }
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
        assert_eq!(
            homes_of("via"),
            [
                "scene.<name>.extrude.profile[]",
                "scene.<name>.revolve.profile[]"
            ]
        );
        // Of a stroke only what is its own.
        assert_eq!(homes_of("run_out"), ["stroke"]);
        assert!(!homes_of("speed").iter().any(|home| home.contains("stroke")));
        assert!(homes_of("radus").is_empty());
    }
}
