//! Changes of a problem text by dotted keys, such as `contacts.dry.restitution=0.3`; what is not changed keeps its
//! lines and comments.

mod splice;

use std::fmt;

use super::yaml::{self, Entry, Node, Value};
use crate::units::shortened;
use splice::{Missing, Splice, joined, put, steps};

/// A new value of one key of a problem file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Change {
    /// Key path, such as `contacts.dry.restitution` or `scene.hub.extrude.profile[2]`.
    pub key: String,
    /// The value as it stands in a file, on one line.
    pub value: String,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key, self.value)
    }
}

impl Change {
    /// Reads `KEY=VALUE`.
    ///
    /// # Errors
    /// It has no `=`, no key, or its value is no YAML on one line.
    pub fn parse(text: &str) -> Result<Self, String> {
        let expected = "expected KEY=VALUE, such as `contacts.dry.restitution=0.3`";
        let (key, value) = text
            .split_once('=')
            .ok_or_else(|| format!("{}: {expected}", shortened(text)))?;
        Self::new(key.trim(), value.trim())
    }

    /// A change of a key to a value.
    ///
    /// # Errors
    /// There is no key, or the value is no YAML on one line.
    pub fn new(key: &str, value: &str) -> Result<Self, String> {
        let change = Self {
            key: key.to_owned(),
            value: value.to_owned(),
        };
        if steps(key).is_none() {
            return Err(format!(
                "{change}: `{key}` is no key path such as `contacts.dry.restitution`"
            ));
        }
        change.node().map(|_| change)
    }

    /// The value as a tree.
    fn node(&self) -> Result<Node, String> {
        let text = format!("{{ value: {} }}", self.value);
        let root = yaml::parse(&text)
            .ok()
            .filter(|_| !self.value.contains(['\n', '\r']));
        match root.map(|root| root.value) {
            Some(Value::Map(mut entries)) if entries.len() == 1 => {
                let node = entries.remove(0).node;
                // A comment would hide what stands behind it.
                match text.len() >= node.span.end
                    && !self.value.is_empty()
                    && node.value != Value::Null
                {
                    true => Ok(node),
                    false => Err(format!("{}: there is no value", self.key)),
                }
            }
            _ => Err(format!(
                "{}: `{}` is no value on one line; put it into quotes where it is text",
                self.key,
                shortened(&self.value)
            )),
        }
    }
}

/// A problem text in which values can be changed.
#[derive(Clone, Debug)]
pub struct Template {
    text: String,
    root: Node,
}

impl Template {
    /// A text that is YAML; whether it is a problem is found when it is read.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn new(text: &str) -> Result<Self, String> {
        Ok(Self {
            root: yaml::parse(text).map_err(|fault| fault.to_string())?,
            text: text.to_owned(),
        })
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text with changed values, one after the other. A key that is not there is added to its group.
    ///
    /// # Errors
    /// A key that leads through what is no group or beyond the end of a list, or a value that cannot be exchanged where it
    /// stands.
    pub fn with(&self, changes: &[Change]) -> Result<Self, String> {
        if let Some(changed) = self.exchanged(changes) {
            return Ok(changed);
        }
        let mut changed = self.clone();
        for change in changes {
            changed = changed.changed(change)?;
        }
        Ok(changed)
    }

    /// The same in one go, where every key has a value and none is within another's.
    fn exchanged(&self, changes: &[Change]) -> Option<Self> {
        let mut wanted = self.root.clone();
        let mut splices = Vec::with_capacity(changes.len());
        for change in changes {
            let steps = joined(steps(&change.key)?);
            let splice = put(&mut wanted, &steps, change.node().ok()?).ok()?;
            if !matches!(splice.missing, Missing::Nothing { .. }) {
                return None;
            }
            splices.extend(self.exchanges(&splice, &change.value).into_iter().next());
        }
        splices.sort_unstable();
        let (mut text, mut done) = (String::with_capacity(self.text.len()), 0);
        for ([start, end], value) in splices {
            text += self.text.get(done..start)?;
            text += &value;
            done = end;
        }
        text += self.text.get(done..)?;
        let root = yaml::parse(&text).ok()?;
        root.value
            .means(&wanted.value)
            .then_some(Self { text, root })
    }

    fn changed(&self, change: &Change) -> Result<Self, String> {
        let Change { key, value } = change;
        let refuse = |reason: &str| format!("{key}: {reason}");
        let steps = steps(key).ok_or_else(|| refuse("is no key path"))?;
        let mut wanted = self.root.clone();
        let splice =
            put(&mut wanted, &joined(steps), change.node()?).map_err(|reason| refuse(&reason))?;
        // What is written there must mean what was meant, and nothing else may have changed.
        let exchanges = self.exchanges(&splice, value);
        let meant = exchanges.into_iter().find_map(|([start, end], new)| {
            let text = format!("{}{new}{}", &self.text[..start], &self.text[end..]);
            let root = yaml::parse(&text).ok()?;
            let is_meant = root.value.means(&wanted.value);
            is_meant.then_some(Self { text, root })
        });
        meant.ok_or_else(|| {
            refuse(
                "cannot be changed as it stands in the file; write its group on lines of its own, without anchors",
            )
        })
    }

    /// What a value may replace, and with what; the first that means what it should counts.
    fn exchanges(&self, splice: &Splice, value: &str) -> Vec<([usize; 2], String)> {
        let [start, end] = splice.at;
        // Texts of several lines end in the next one.
        let old = self.text.get(start..end);
        let end = old.map_or(end, |it| start + it.trim_end().len());
        let new = match &splice.missing {
            Missing::Nothing { behind } => {
                let here = ([start, end], value.to_owned());
                let colon = behind.and_then(|it| Some(it + self.text[it..].find(':')? + 1));
                let Some(colon) = colon else {
                    return vec![here];
                };
                // Where a list begins in the column of its key, no other value may stand. Its place is that of its
                // first item; other lists are where their first dash is. Comments on the key stay there.
                let lines = self.text.get(colon..start);
                return match lines.and_then(|it| it.rsplit_once('\n')) {
                    Some((comments, dash)) if !dash.trim_start().is_empty() => {
                        vec![([colon, end], format!(" {value}{}", comments.trim_end()))]
                    }
                    _ => vec![here, ([colon; 2], format!(" {value}"))],
                };
            }
            Missing::InBraces { names, is_empty } => {
                let comma = if *is_empty { "" } else { "," };
                format!(" {}{comma}", nested(names, value))
            }
            Missing::OnLines { names, indent } => {
                format!("{}\n{}", nested(names, value), " ".repeat(*indent))
            }
        };
        vec![([start, end], new)]
    }
}

/// `a: { b: value }` of the names a and b.
fn nested(names: &[String], value: &str) -> String {
    let Some((first, rest)) = names.split_first() else {
        return value.to_owned();
    };
    match rest {
        [] => format!("{first}: {value}"),
        _ => format!("{first}: {{ {} }}", nested(rest, value)),
    }
}

impl Value {
    /// Whether two trees say the same, wherever it stands.
    fn means(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::List(a), Self::List(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.value.means(&b.value))
            }
            (Self::Map(a), Self::Map(b)) => {
                let is_same =
                    |(a, b): (&Entry, &Entry)| a.key == b.key && a.node.value.means(&b.node.value);
                a.len() == b.len() && a.iter().zip(b).all(is_same)
            }
            (a, b) => a == b,
        }
    }
}

#[cfg(test)]
mod tests;
