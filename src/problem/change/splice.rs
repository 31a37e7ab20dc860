//! Where in a text a value belongs: found on the way down its key path, in a tree that gets the value as well.

use crate::problem::fault::Span;
use crate::problem::yaml::{Entry, Node, Value};

/// One step of a key path.
pub(super) enum Step {
    Name(String),
    Item(usize),
}

/// The steps of a key path, names cut at every dot; `None` where it is none.
pub(super) fn steps(key: &str) -> Option<Vec<Step>> {
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
pub(super) fn joined(mut steps: Vec<Step>) -> Vec<Step> {
    if let [Step::Name(group), Step::Name(part), Step::Name(surface), ..] = &steps[..]
        && group == "surfaces"
    {
        let name = Step::Name(format!("{part}.{surface}"));
        steps.splice(1..3, [name]);
    }
    steps
}

/// What of the text is replaced.
pub(super) struct Splice {
    pub at: [usize; 2],
    pub missing: Missing,
}

/// What has to be written besides the value.
pub(super) enum Missing {
    /// Perhaps a place for the value, which is behind this key then: nothing stands there, or lines that begin in the
    /// column of the key.
    Nothing { behind: Option<usize> },
    /// Keys behind an opening brace.
    InBraces { names: Vec<String>, is_empty: bool },
    /// Keys on a line of their own before others, which begin in this column, from 0.
    OnLines { names: Vec<String>, indent: usize },
}

/// Puts a value into a tree, and tells where in its text it belongs.
pub(super) fn put(node: &mut Node, steps: &[Step], value: Node) -> Result<Splice, String> {
    let Some((first, rest)) = steps.split_first() else {
        let at = [node.span.start, node.span.end];
        node.value = value.value;
        return Ok(Splice {
            at,
            missing: Missing::Nothing { behind: None },
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
                let splice = put(&mut entry.node, rest, value)?;
                return Ok(match rest {
                    [] => Splice {
                        missing: Missing::Nothing {
                            behind: Some(entry.key_span.end),
                        },
                        ..splice
                    },
                    _ => splice,
                });
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
