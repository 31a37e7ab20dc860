//! Every key of a problem file as Markdown: a section for each group, a table row for each key.

use std::fmt::Write as _;

use peenpose::problem;
use peenpose::problem::model::Effect;
use peenpose::units::Dimension;
use serde_json::{Map, Value};

/// What stands above is written by hand, what stands below is not.
const MARK: &str = "<!-- From here on made by `cargo run --example problem_file_docs`. -->\n";

/// The document with everything below the mark made anew.
pub fn renewed(document: &str) -> Result<String, String> {
    let above = document.find(MARK).ok_or("the mark is missing")?;
    let schema = problem::schema();
    let definitions = schema["$defs"].as_object().ok_or("no definitions")?;
    let mut sections = Sections {
        definitions,
        places: Vec::new(),
        headings: Vec::new(),
        text: String::new(),
    };
    // The first pass learns where each group has its section, for the links of the second.
    sections.top(&schema)?;
    let mut sections = Sections {
        definitions,
        places: sections.headings,
        headings: Vec::new(),
        text: String::new(),
    };
    sections.units();
    sections.top(&schema)?;
    sections.effects();
    Ok(format!("{}{MARK}{}", &document[..above], sections.text))
}

struct Sections<'a> {
    definitions: &'a Map<String, Value>,
    /// Where each group has its section.
    places: Vec<(&'a str, String)>,
    /// The groups that have a section so far, each with its heading.
    headings: Vec<(&'a str, String)>,
    text: String,
}

impl<'a> Sections<'a> {
    fn units(&mut self) {
        self.text += "\n## Units\n\n| quantity | units |\n|---|---|\n";
        for dimension in Dimension::ALL {
            let units: Vec<String> = dimension.unit_names().map(code).collect();
            let _ = writeln!(self.text, "| {} | {} |", dimension.name(), units.join(" "));
        }
    }

    fn effects(&mut self) {
        self.text += "\n## `model`\n\nThe effects that a list may name.\n\n";
        self.text += "| effect | what it is | without it |\n|---|---|---|\n";
        for effect in Effect::ALL {
            let (name, what) = (effect.name(), effect.description());
            let _ = writeln!(self.text, "| `{name}` | {what} | {} |", effect.without());
        }
        self.text += "\nPoints alone, for example, are `model: [rebounds, later_rebounds, spin, \
                      exit_width, divergence, speed_scatter]`.\n";
    }

    fn top(&mut self, schema: &'a Value) -> Result<(), String> {
        self.text += "\n## Top level\n\n";
        self.keys(schema)?;
        self.groups(schema, 2)
    }

    /// The sections of the groups among the keys of a group.
    fn groups(&mut self, group: &'a Value, level: usize) -> Result<(), String> {
        for (key, property) in properties(group) {
            let Some(name) = group_in(property) else {
                continue;
            };
            if self.headings.iter().any(|(known, _)| *known == name) {
                continue;
            }
            if self.headings.iter().any(|(_, heading)| heading == key) {
                return Err(format!("two sections are called {key}"));
            }
            self.headings.push((name, key.clone()));
            let definition = &self.definitions[name];
            let _ = writeln!(self.text, "\n{} `{key}`\n", "#".repeat(level));
            let _ = writeln!(self.text, "{}\n", text(definition, "description")?);
            self.keys(definition)?;
            self.groups(definition, level + 1)?;
        }
        Ok(())
    }

    fn keys(&mut self, group: &Value) -> Result<(), String> {
        self.text += "| key | value | default | meaning | example |\n|---|---|---|---|---|\n";
        for (key, property) in properties(group) {
            let described = text(property, "description")?;
            let (meaning, absent) = parted(described);
            let default = if is_listed(&group["required"], key) {
                "**needed**".to_owned()
            } else if is_alternative(group, key) {
                "one of these".to_owned()
            } else if let Some(default) = property.get("default") {
                code(&yaml(default))
            } else {
                absent.ok_or(format!("nothing says what holds without {key}"))?
            };
            let example = property["examples"]
                .get(0)
                .map_or_else(String::new, |example| {
                    code(&format!("{key}: {}", yaml(example)))
                });
            let _ = writeln!(
                self.text,
                "| `{key}` | {} | {default} | {meaning} | {example} |",
                self.value(key, property)?
            );
        }
        Ok(())
    }

    /// What may stand behind a key.
    fn value(&self, key: &str, property: &Value) -> Result<String, String> {
        if key == "use" {
            return Ok("a name".into());
        }
        if let Some(value) = property.get("const") {
            return Ok(code(&yaml(value)));
        }
        if let Some(names) = property["enum"].as_array() {
            return Ok(names
                .iter()
                .map(|name| code(&yaml(name)))
                .collect::<Vec<_>>()
                .join(" or "));
        }
        if let Some(forms) = property.get("anyOf").or(property.get("oneOf")) {
            let mut forms: Vec<String> = forms
                .as_array()
                .into_iter()
                .flatten()
                .map(|form| self.value(key, form))
                .collect::<Result<_, _>>()?;
            forms.dedup();
            return Ok(forms.join(" or "));
        }
        if let Some(name) = referred(property) {
            let definition = &self.definitions[name];
            return match definition.get("pattern") {
                Some(_) => Ok(range(text(definition, "description")?)),
                None => Ok(self.link(name)),
            };
        }
        if let Some(named) = group_in(property) {
            let link = self.link(named);
            return Ok(match property["type"].as_str() {
                Some("array") => format!("list of {link}"),
                _ => format!("names with {link} each"),
            });
        }
        Ok(match property["type"].as_str() {
            Some("array") if property["items"]["type"] == "array" => code("[[x, y, z], ..]"),
            Some("array") => match property["minItems"].as_u64() {
                Some(2) if referred(&property["items"]).is_some() => code("[min, max]"),
                Some(2) if key == "mu_s" => code("[min, max]"),
                Some(2) => code("[x, y]"),
                Some(3) => match referred(&property["items"]) {
                    Some(name) => {
                        let each = range(text(&self.definitions[name], "description")?);
                        format!("{}, each an {each}", code("[x, y, z]"))
                    }
                    None => code("[x, y, z]"),
                },
                _ => "a list of names".into(),
            },
            Some("integer") => format!("whole number{}", ends(property)),
            Some("string") => "text".into(),
            Some(kind) => format!("{kind}{}", ends(property)),
            None => return Err(format!("nothing says what {key} may be")),
        })
    }

    /// A link to the section of a group.
    fn link(&self, name: &str) -> String {
        let mut places = self.places.iter();
        let place = places.find(|(known, _)| *known == name);
        format!("[keys](#{})", place.map_or("", |(_, heading)| heading))
    }
}

fn properties(group: &Value) -> impl Iterator<Item = (&String, &Value)> {
    group["properties"].as_object().into_iter().flatten()
}

fn text<'a>(schema: &'a Value, key: &str) -> Result<&'a str, String> {
    schema[key].as_str().ok_or(format!("no {key} in {schema}"))
}

/// What a quantity may be, by the description of its type: `A length from 0 mm to 1000 m, such as ..`.
fn range(description: &str) -> String {
    let (range, _) = description
        .split_once(", such as ")
        .unwrap_or((description, ""));
    let (_article, range) = range.split_once(' ').unwrap_or(("", range));
    range.into()
}

/// Between what a number must lie.
fn ends(schema: &Value) -> String {
    let most = [("maximum", "to"), ("exclusiveMaximum", "to below")];
    let most = most
        .into_iter()
        .find_map(|(key, word)| Some((schema.get(key)?, word)));
    match (schema.get("minimum"), most) {
        (Some(least), Some((most, word))) => format!(" from {least} {word} {most}"),
        (Some(least), None) => format!(" from {least}"),
        _ => String::new(),
    }
}

/// The definition that a schema refers to.
fn referred(schema: &Value) -> Option<&str> {
    schema["$ref"].as_str()?.strip_prefix("#/$defs/")
}

/// The group of keys that a value is, holds by name, lists, or may be.
fn group_in(schema: &Value) -> Option<&str> {
    let itself = referred(schema).filter(|name| name.ends_with("Entry") || *name == "EachEnd");
    let forms = schema["anyOf"].as_array().into_iter().flatten();
    itself
        .or_else(|| schema.get("additionalProperties").and_then(group_in))
        .or_else(|| schema.get("items").and_then(group_in))
        .or_else(|| forms.filter_map(group_in).next())
}

fn is_listed(names: &Value, key: &str) -> bool {
    names
        .as_array()
        .is_some_and(|names| names.iter().any(|name| name == key))
}

/// Whether exactly one of several keys must be there, and this is one of them.
fn is_alternative(group: &Value, key: &str) -> bool {
    let mut forms = group["oneOf"].as_array().into_iter().flatten();
    forms.any(|form| is_listed(&form["required"], key))
}

/// The meaning of a key, and what holds where it is absent.
fn parted(description: &str) -> (String, Option<String>) {
    let absent = description.strip_suffix(" where absent.");
    match absent.and_then(|text| text.rsplit_once("; ")) {
        Some((meaning, absent)) => (
            format!("{meaning}."),
            Some(absent.trim_end_matches(',').into()),
        ),
        None => (description.into(), None),
    }
}

fn code(text: &str) -> String {
    format!("`{text}`")
}

/// A value as one writes it on a line of a problem file.
fn yaml(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(items) => {
            format!(
                "[{}]",
                items.iter().map(yaml).collect::<Vec<_>>().join(", ")
            )
        }
        Value::Object(entries) => {
            let entries = entries
                .iter()
                .map(|(key, value)| format!("{key}: {}", yaml(value)));
            format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
        }
        plain => plain.to_string(),
    }
}
