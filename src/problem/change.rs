//! Changes of a problem text by dotted keys, such as `contacts.dry.restitution=0.3`; what is not changed keeps its
//! lines and comments.

use std::fmt;

use super::fault::Span;
use super::yaml::{self, Entry, Node, Value};
use crate::units::shortened;

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
            match put(&mut wanted, &steps, change.node().ok()?).ok()? {
                Splice {
                    at,
                    missing: Missing::Nothing,
                } => splices.push((at, &change.value)),
                _ => return None,
            }
        }
        splices.sort_unstable();
        let (mut text, mut done) = (String::with_capacity(self.text.len()), 0);
        for ([start, end], value) in splices {
            text += self.text.get(done..start)?;
            text += value;
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
        let Splice {
            at: [start, end],
            missing,
        } = splice;
        let (before, after) = (&self.text[..start], &self.text[end..]);
        let text = match missing {
            Missing::Nothing => format!("{before}{value}{after}"),
            // Where nothing stands there is no place but behind the colon.
            Missing::Value { behind } if !["~", "null"].contains(&&self.text[start..end]) => {
                let colon = self.text[behind..].find(':').map(|at| behind + at + 1);
                let (before, after) = self.text.split_at(colon.unwrap_or(behind));
                format!("{before} {value}{after}")
            }
            Missing::Value { .. } => format!("{before}{value}{after}"),
            Missing::InBraces { names, is_empty } => {
                let comma = if is_empty { "" } else { "," };
                format!("{before} {}{comma}{after}", nested(&names, value))
            }
            Missing::OnLines { names, indent } => {
                format!(
                    "{before}{}\n{}{after}",
                    nested(&names, value),
                    " ".repeat(indent)
                )
            }
        };
        // What is written there must mean what was meant, and nothing else may have changed.
        match yaml::parse(&text) {
            Ok(root) if root.value.means(&wanted.value) => Ok(Self { text, root }),
            _ => Err(refuse(
                "cannot be changed as it stands in the file; write its group on lines of its own, without anchors",
            )),
        }
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

/// One step of a key path.
enum Step {
    Name(String),
    Item(usize),
}

/// The steps of a key path, names cut at every dot; `None` where it is none.
fn steps(key: &str) -> Option<Vec<Step>> {
    let mut steps = Vec::new();
    for part in key.split('.') {
        let (name, items) = part.split_at(part.find('[').unwrap_or(part.len()));
        if name.is_empty()
            || name.contains(char::is_whitespace)
            || name.contains([':', '#', '{', '}', ',', ']'])
        {
            return None;
        }
        steps.push(Step::Name(name.to_owned()));
        let items = items.strip_suffix(']').map(|it| it.strip_prefix('['));
        if let Some(items) = items {
            for item in items?.split("][") {
                steps.push(Step::Item(item.parse().ok()?));
            }
        } else if part.contains('[') {
            return None;
        }
    }
    Some(steps)
}

/// The same with the names of surfaces, `part.surface`, as the one name that they are in `surfaces`.
fn joined(mut steps: Vec<Step>) -> Vec<Step> {
    if let [Step::Name(group), Step::Name(part), Step::Name(surface), ..] = &steps[..]
        && group == "surfaces"
    {
        let name = Step::Name(format!("{part}.{surface}"));
        steps.splice(1..3, [name]);
    }
    steps
}

/// What of the text is replaced.
struct Splice {
    at: [usize; 2],
    missing: Missing,
}

/// What has to be written besides the value.
enum Missing {
    Nothing,
    /// Perhaps the place of the value itself, which is the one behind this key then.
    Value {
        behind: usize,
    },
    /// Keys behind an opening brace.
    InBraces {
        names: Vec<String>,
        is_empty: bool,
    },
    /// Keys on a line of their own before others, which begin in this column, from 0.
    OnLines {
        names: Vec<String>,
        indent: usize,
    },
}

/// Puts a value into a tree, and tells where in its text it belongs.
fn put(node: &mut Node, steps: &[Step], value: Node) -> Result<Splice, String> {
    let Some((first, rest)) = steps.split_first() else {
        let at = [node.span.start, node.span.end];
        node.value = value.value;
        return Ok(Splice {
            at,
            missing: Missing::Nothing,
        });
    };
    match (&mut node.value, first) {
        (Value::Map(entries), Step::Name(name)) => {
            // A name may have dots of its own.
            let mut names = vec![name.clone()];
            let mut ways = vec![(name.clone(), rest)];
            let mut left = rest;
            while let Some((Step::Name(next), beyond)) = left.split_first() {
                names.push(next.clone());
                ways.push((names.join("."), beyond));
                left = beyond;
            }
            let way = ways.into_iter().rev().find_map(|(name, rest)| {
                let index = entries.iter().position(|entry| entry.key == name)?;
                Some((index, rest))
            });
            if let Some((index, rest)) = way {
                let entry = &mut entries[index];
                if rest.is_empty() && entry.node.value == Value::Null {
                    let Span { start, end, .. } = entry.node.span;
                    entry.node.value = value.value;
                    return Ok(Splice {
                        at: [start, end],
                        missing: Missing::Value {
                            behind: entry.key_span.end,
                        },
                    });
                }
                return put(&mut entry.node, rest, value);
            }
            if !left.is_empty() {
                return Err(format!(
                    "there is no list `{}` in the file",
                    names.join(".")
                ));
            }
            add(node, names, value)
        }
        (Value::List(items), &Step::Item(index)) => {
            let count = items.len();
            let item = items
                .get_mut(index)
                .ok_or_else(|| format!("the list has {count} items, numbered from 0"))?;
            put(item, rest, value)
        }
        (Value::Null, Step::Name(_)) => Err("its group is empty in the file".to_owned()),
        (_, Step::Name(name)) => Err(format!("`{name}` would be in what is no group")),
        (_, Step::Item(index)) => Err(format!("[{index}] would be in what is no list")),
    }
}

/// Adds a key, with the groups that it is in, to a group that has none of them.
fn add(group: &mut Node, names: Vec<String>, value: Node) -> Result<Splice, String> {
    let span = group.span;
    let Value::Map(entries) = &mut group.value else {
        return Err("is in what is no group".to_owned());
    };
    let mut node = value;
    for name in names[1..].iter().rev() {
        let entry = Entry {
            key: name.clone(),
            key_span: span,
            node,
        };
        node = Node {
            value: Value::Map(vec![entry]),
            span,
        };
    }
    let entry = Entry {
        key: names[0].clone(),
        key_span: span,
        node,
    };
    let splice = match entries.last() {
        // Before the last key of the group: what follows that may be a comment on anything.
        Some(last) if !is_in_braces(entries, span) => Splice {
            at: [last.key_span.start; 2],
            missing: Missing::OnLines {
                names,
                indent: last.key_span.column - 1,
            },
        },
        _ => Splice {
            at: [span.start + 1; 2],
            missing: Missing::InBraces {
                names,
                is_empty: entries.is_empty(),
            },
        },
    };
    let place = match splice.missing {
        Missing::OnLines { .. } => entries.len() - 1,
        _ => 0,
    };
    entries.insert(place, entry);
    Ok(splice)
}

/// Whether a group begins before its first key: with a brace.
fn is_in_braces(entries: &[Entry], span: Span) -> bool {
    entries
        .first()
        .is_none_or(|first| span.start < first.key_span.start)
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
mod tests {
    use super::*;

    const TEXT: &str = "\
format: 1
contacts:            # pairs
  dry: { mu_s: 0.3, restitution: 0.25 }   # as measured
  wet:
    mu_s: 0.1
    restitution: 0.2 # guessed
settings: { speed: [5 m/s, 40 m/s] }
surfaces:
  hub.bore: { allow: 5 uN.s }
empty:
nil: ~ # none
list:
  - a: 1
  - b: 2
";

    fn changed(changes: &[&str]) -> Result<String, String> {
        let changes: Result<Vec<Change>, String> =
            changes.iter().map(|it| Change::parse(it)).collect();
        Ok(Template::new(TEXT)?.with(&changes?)?.text)
    }

    #[test]
    fn one_value_changes_and_all_else_stays() {
        for (change, old, new) in [
            (
                "contacts.dry.restitution=0.3",
                "restitution: 0.25",
                "restitution: 0.3",
            ),
            (
                "contacts.wet.restitution=0.3",
                "0.2 # guessed",
                "0.3 # guessed",
            ),
            (
                "contacts.wet={ mu_s: 0.4 }",
                "\n    mu_s: 0.1\n    restitution: 0.2 #",
                "\n    { mu_s: 0.4 } #",
            ),
            (
                "settings.speed=[6 m/s, 7 m/s]",
                "[5 m/s, 40 m/s]",
                "[6 m/s, 7 m/s]",
            ),
            ("settings.speed[1]=7 m/s", "40 m/s", "7 m/s"),
            ("list[1].b=3", "b: 2", "b: 3"),
            ("surfaces.hub.bore.allow=6 uN.s", "5 uN.s", "6 uN.s"),
            ("empty=1", "empty:", "empty: 1"),
            ("nil=1", "nil: ~ #", "nil: 1 #"),
            // What is not there is added to its group.
            (
                "contacts.dry.mu_d=0.2",
                "{ mu_s: 0.3,",
                "{ mu_d: 0.2, mu_s: 0.3,",
            ),
            (
                "contacts.wet.mu_d=0.2",
                "    restitution: 0.2",
                "    mu_d: 0.2\n    restitution: 0.2",
            ),
            (
                "contacts.oil={ mu_s: 0.1 }",
                "  wet:\n",
                "  oil: { mu_s: 0.1 }\n  wet:\n",
            ),
            (
                "contacts.oil.mu_s=0.1",
                "  wet:\n",
                "  oil: { mu_s: 0.1 }\n  wet:\n",
            ),
            (
                "surfaces.hub.floor.allow=6 uN.s",
                "  hub.bore",
                "  hub.floor: { allow: 6 uN.s }\n  hub.bore",
            ),
            ("solve.seed=2", "list:", "solve: { seed: 2 }\nlist:"),
            ("list[0].c=2", "- a: 1", "- c: 2\n    a: 1"),
        ] {
            assert_eq!(
                changed(&[change]).unwrap(),
                TEXT.replacen(old, new, 1),
                "{change}"
            );
        }
        let both = changed(&["solve.seed=2", "solve.accuracy=2 %", "solve.seed=3"]).unwrap();
        assert!(
            both.contains("solve: { accuracy: 2 %, seed: 3 }\n"),
            "{both}"
        );
    }

    #[test]
    fn what_cannot_be_changed_is_refused_with_its_key() {
        for (change, reason) in [
            ("contacts.dry.restitution", "expected KEY=VALUE"),
            ("=1", "no key path"),
            ("a b=1", "no key path"),
            ("list[x]=1", "no key path"),
            ("format=", "there is no value"),
            ("format=~", "there is no value"),
            ("format=1 # one", "no value on one line"),
            ("format=a: b: c", "no value on one line"),
            ("format=1 }, { x: 2", "no value on one line"),
            ("format=1, x: 2", "no value on one line"),
            ("format=[1", "no value on one line"),
            ("format.a=1", "`a` would be in what is no group"),
            ("contacts[0]=1", "[0] would be in what is no list"),
            ("list[2].a=1", "the list has 2 items"),
            ("new[0]=1", "there is no list `new`"),
        ] {
            let fault = changed(&[change]).unwrap_err();
            assert!(fault.contains(reason), "{change}: {fault}");
        }
    }

    /// An anchor is used elsewhere: what repeats it would change as well.
    #[test]
    fn an_anchored_value_is_left_alone() {
        let text = "a: &x { b: 1 }\nc: *x\n";
        let with = |change: &str| {
            Template::new(text)
                .unwrap()
                .with(&[Change::parse(change).unwrap()])
        };
        assert!(with("a.b=2").unwrap_err().contains("without anchors"));
        assert_eq!(with("c=2").unwrap().text(), "a: &x { b: 1 }\nc: 2\n");
    }
}
