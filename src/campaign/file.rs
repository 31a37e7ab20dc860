//! A campaign file: what is varied of which problem.

use std::path::{Path, PathBuf};

use super::axis::{Axis, Range, Values};
use crate::problem::Source;
use crate::problem::change::Change;
use crate::problem::fault::{Fault, Span, nearest_name, one_of};
use crate::problem::fault_code::FaultCode;
use crate::problem::yaml::{self, Entry, Node, Value};
use crate::scenario::Rejection;

/// A campaign file as it was read.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CampaignFile {
    /// The problem file that all cases are made from.
    pub base: PathBuf,
    pub cases: Cases,
}

/// Which cases there are.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cases {
    /// Every value of each key with every one of all others.
    Grid(Vec<Axis>),
    /// So many points of a scrambled Sobol sequence.
    Sobol {
        axes: Vec<Axis>,
        count: u32,
        seed: u32,
    },
    /// The rows of a table, with a column for each key.
    Table(PathBuf),
}

/// Keys of a campaign file.
const KEYS: [&str; 5] = ["campaign", "base", "vary", "sample", "cases"];
/// Points before the sequence repeats itself.
const MOST_POINTS: u32 = 1 << 16;
/// Keys that a sequence can vary.
const MOST_KEYS: usize = 256;

/// Reads a campaign file.
///
/// # Errors
/// All its faults, with their places.
pub(super) fn read(path: &Path) -> Result<CampaignFile, Box<Rejection>> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        let message = format!("cannot read {}: {error}", path.display());
        Rejection::unread(Fault::at_key(FaultCode::FileUnreadable, "", message))
    })?;
    parse(&text, path.parent().unwrap_or(Path::new("")))
        .map_err(|faults| Rejection::new(Source::new(path, text.as_bytes(), text.clone()), faults))
}

/// What the text says; paths in it are taken from `folder`.
fn parse(text: &str, folder: &Path) -> Result<CampaignFile, Vec<Fault>> {
    let root = yaml::parse(text).map_err(|fault| vec![*fault])?;
    let mut reader = Reader {
        text,
        faults: Vec::new(),
    };
    let Value::Map(entries) = &root.value else {
        return Err(vec![fault_at(
            root.span,
            "",
            FaultCode::WrongKind,
            "is no group of keys",
            "campaign, base and vary",
        )]);
    };
    reader.known(entries, "", &KEYS);
    let find = |name: &str| {
        entries
            .iter()
            .find(|entry| entry.key == name)
            .map(|entry| &entry.node)
    };
    match find("campaign").map(|node| (node.span, reader.scalar(node))) {
        Some((_, Some("1"))) => {}
        Some((span, _)) => reader.push(
            span,
            "campaign",
            FaultCode::UnknownFormat,
            "is no format that this version knows",
            "`1`",
        ),
        None => reader.push(
            root.span,
            "campaign",
            FaultCode::Missing,
            "is missing",
            "`campaign: 1`",
        ),
    }
    let base = reader.path(find("base"), "base", folder);
    if base.is_none() && find("base").is_none() {
        reader.push(
            root.span,
            "base",
            FaultCode::Missing,
            "is missing",
            "a problem file, such as `base: keyway.yaml`",
        );
    }
    let axes = find("vary").map(|node| reader.axes(node));
    let sample = find("sample").map(|node| (node.span, reader.sample(node)));
    let table = find("cases").map(|node| (node.span, reader.path(Some(node), "cases", folder)));
    let cases = match (axes, sample, table) {
        (None, None, Some((_, table))) => table.map(Cases::Table),
        (Some(axes), Some((_, sample)), None) => {
            if axes.len() > MOST_KEYS {
                reader.push(
                    root.span,
                    "vary",
                    FaultCode::TooManyItems,
                    "has more keys than a sequence can vary",
                    "at most 256",
                );
            }
            sample.map(|(count, seed)| Cases::Sobol { axes, count, seed })
        }
        (Some(axes), None, None) => {
            for axis in &axes {
                if let Values::Between(_) = axis.values {
                    let key = format!("vary.{}", axis.key);
                    reader.push(
                        root.span,
                        &key,
                        FaultCode::Missing,
                        "is a range without steps",
                        "`step`, `count`, or `sample` for the campaign",
                    );
                }
            }
            Some(Cases::Grid(axes))
        }
        (_, _, Some((span, _))) => {
            reader.push(
                span,
                "cases",
                FaultCode::EitherOr,
                "stands beside `vary` or `sample`",
                "the table alone",
            );
            None
        }
        (None, Some((span, _)), None) => {
            reader.push(
                span,
                "sample",
                FaultCode::NoEffect,
                "has nothing to sample",
                "`vary` with ranges",
            );
            None
        }
        (None, None, None) => {
            reader.push(
                root.span,
                "vary",
                FaultCode::Missing,
                "is missing",
                "`vary` with keys and their values, or `cases` with a table",
            );
            None
        }
    };
    match (base, cases) {
        (Some(base), Some(cases)) if reader.faults.is_empty() => Ok(CampaignFile { base, cases }),
        _ => Err(reader.faults),
    }
}

struct Reader<'a> {
    text: &'a str,
    faults: Vec<Fault>,
}

fn fault_at(span: Span, key: &str, code: FaultCode, message: &str, expected: &str) -> Fault {
    let mut fault = Fault::at_key(code, key, message).expecting(expected);
    fault.at = Some(span);
    fault
}

impl<'a> Reader<'a> {
    fn push(&mut self, span: Span, key: &str, code: FaultCode, message: &str, expected: &str) {
        self.faults
            .push(fault_at(span, key, code, message, expected));
    }

    /// Refuses keys that a group does not have, and those that it has twice.
    fn known(&mut self, entries: &[Entry], group: &str, names: &[&str]) {
        for (index, entry) in entries.iter().enumerate() {
            let key = match group {
                "" => entry.key.clone(),
                group => format!("{group}.{}", entry.key),
            };
            if entries[..index]
                .iter()
                .any(|earlier| earlier.key == entry.key)
            {
                self.push(
                    entry.key_span,
                    &key,
                    FaultCode::RepeatedKey,
                    "is given already",
                    "every key once",
                );
            } else if !names.is_empty() && !names.contains(&entry.key.as_str()) {
                let mut fault = fault_at(
                    entry.key_span,
                    &key,
                    FaultCode::UnknownKey,
                    "is no key of a campaign",
                    &one_of(names),
                );
                fault.suggestion =
                    nearest_name(&entry.key, names.iter().copied()).map(str::to_owned);
                self.faults.push(fault);
            }
        }
    }

    /// A number or a text as it is written.
    fn scalar<'b>(&self, node: &'b Node) -> Option<&'b str> {
        match &node.value {
            Value::Number(text) | Value::Text(text) if !text.trim().is_empty() => Some(text),
            _ => None,
        }
    }

    fn path(&mut self, node: Option<&Node>, key: &str, folder: &Path) -> Option<PathBuf> {
        let node = node?;
        let path = self.scalar(node).map(|text| folder.join(text));
        if path.is_none() {
            self.push(
                node.span,
                key,
                FaultCode::WrongKind,
                "is no path",
                "the path of a file",
            );
        }
        path
    }

    /// The keys that are varied.
    fn axes(&mut self, node: &Node) -> Vec<Axis> {
        let Value::Map(entries) = &node.value else {
            self.push(
                node.span,
                "vary",
                FaultCode::WrongKind,
                "is no group",
                "keys of the problem file, each with a list or a range",
            );
            return Vec::new();
        };
        self.known(entries, "vary", &[]);
        let axes = entries.iter().filter_map(|entry| {
            let key = format!("vary.{}", entry.key);
            let values = match &entry.node.value {
                Value::List(items) if !items.is_empty() => self.listed(&entry.key, items),
                Value::Map(ends) => self.range(&key, entry.node.span, ends),
                _ => Err((entry.node.span, "is neither a list nor a range".to_owned())),
            };
            match values {
                Ok(values) => Some(Axis { key: entry.key.clone(), values }),
                Err((span, message)) => {
                    let expected = "a list such as `[0.2, 0.3]`, or a range such as `{ from: 5 m/s, to: 40 m/s, step: 5 m/s }`";
                    self.push(span, &key, FaultCode::WrongKind, &message, expected);
                    None
                }
            }
        });
        axes.collect()
    }

    /// Values as they are written.
    fn listed(&self, key: &str, items: &[Node]) -> Result<Values, (Span, String)> {
        let value = |item: &Node| {
            let written = self
                .text
                .get(item.span.start..item.span.end)
                .unwrap_or_default();
            Change::new(key, written)
                .map(|change| change.value)
                .map_err(|message| (item.span, message))
        };
        items
            .iter()
            .map(value)
            .collect::<Result<_, _>>()
            .map(Values::Listed)
    }

    fn range(&mut self, key: &str, span: Span, ends: &[Entry]) -> Result<Values, (Span, String)> {
        self.known(ends, key, &["from", "to", "step", "count"]);
        let find = |name: &str| {
            let entry = ends.iter().find(|entry| entry.key == name)?;
            Some((
                entry.node.span,
                self.scalar(&entry.node).unwrap_or_default(),
            ))
        };
        let (Some((_, from)), Some((_, to))) = (find("from"), find("to")) else {
            return Err((span, "has no `from` or no `to`".to_owned()));
        };
        let range = Range::new(from, to).map_err(|message| (span, message))?;
        match (find("step"), find("count")) {
            (Some(_), Some((span, _))) => Err((span, "has `step` and `count`".to_owned())),
            (Some((span, step)), None) => range.in_steps(step).map_err(|message| (span, message)),
            (None, Some((span, count))) => range.counted(count).map_err(|message| (span, message)),
            (None, None) => Ok(Values::Between(range)),
        }
    }

    /// Number and seed of the points.
    fn sample(&mut self, node: &Node) -> Option<(u32, u32)> {
        let Value::Map(entries) = &node.value else {
            self.push(
                node.span,
                "sample",
                FaultCode::WrongKind,
                "is no group",
                "`{ sobol: 256, seed: 1 }`",
            );
            return None;
        };
        self.known(entries, "sample", &["sobol", "seed"]);
        let mut number = |name: &str, range: [u32; 2]| {
            let entry = entries.iter().find(|entry| entry.key == name)?;
            let number = self.scalar(&entry.node).and_then(|text| text.parse().ok());
            let within = number.filter(|number| (range[0]..=range[1]).contains(number));
            if within.is_none() {
                let expected = format!("a whole number from {} to {}", range[0], range[1]);
                self.push(
                    entry.node.span,
                    &format!("sample.{name}"),
                    FaultCode::WrongKind,
                    "is no such number",
                    &expected,
                );
            }
            within
        };
        let count = number("sobol", [1, MOST_POINTS]);
        let seed = number("seed", [0, u32::MAX]);
        if !entries.iter().any(|entry| entry.key == "sobol") {
            self.push(
                node.span,
                "sample.sobol",
                FaultCode::Missing,
                "is missing",
                "how many points, such as `sobol: 256`",
            );
        }
        Some((count?, seed.unwrap_or(1)))
    }
}
