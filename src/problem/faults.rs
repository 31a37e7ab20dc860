//! Where faults are collected, each with its place in the text.

use std::cell::RefCell;
use std::collections::HashSet;

use super::fault::{Fault, Span, any_of, one_of};
use super::fault_code::FaultCode;
use super::key_index::homes_of;
use super::source::{Source, child_key};

/// A key that more groups have than this is at home in none of them.
const MOST_HOMES: usize = 3;

/// All faults found so far in one file.
pub(super) struct Faults<'a> {
    /// The file.
    pub source: &'a Source,
    found: RefCell<Vec<Fault>>,
    /// The keys that unknown keys were probably meant to be.
    meant: RefCell<HashSet<String>>,
}

impl<'a> Faults<'a> {
    pub fn new(source: &'a Source) -> Self {
        Self {
            source,
            found: RefCell::default(),
            meant: RefCell::default(),
        }
    }

    /// Records a fault, where the value of its key stands unless it knows better.
    pub fn push(&self, mut fault: Fault) {
        fault.at = fault.at.or_else(|| self.source.locate(&fault.key));
        self.found.borrow_mut().push(fault);
    }

    /// Records a fault of the name at the end of its key.
    pub fn push_at_name(&self, mut fault: Fault) {
        fault.at = self.source.locate_name(&fault.key);
        self.found.borrow_mut().push(fault);
    }

    /// Records a key that is not one of the `known` keys of its group.
    pub fn push_unknown_key(&self, group: &str, name: &str, at: Span, known: &[&str]) {
        let key = child_key(group, name);
        let homes = homes_of(name);
        let before = self.source.text[..at.start].trim_end();
        let is_fraction = before.ends_with(',') && name.starts_with(|c: char| c.is_ascii_digit());
        let mut fault = if is_fraction {
            let message = "a comma before digits begins a new key";
            Fault::at_key(FaultCode::DecimalComma, key, message)
                .expecting("a decimal point in numbers")
        } else if homes.is_empty() || homes.len() > MOST_HOMES {
            Fault::at_key(FaultCode::UnknownKey, key, "unknown key")
                .expecting(one_of(known))
                .nearest(name, known.iter().copied())
        } else {
            Fault::at_key(FaultCode::MisplacedKey, key, belongs_to(homes)).expecting(one_of(known))
        };
        fault.at = Some(at);
        let mut meant = self.meant.borrow_mut();
        match &fault.suggestion {
            Some(suggestion) => drop(meant.insert(child_key(group, suggestion))),
            None if fault.rule == FaultCode::MisplacedKey => {
                meant.extend(homes.iter().map(|home| child_key(home, name)));
            }
            None => {}
        }
        drop(meant);
        self.push(fault);
    }

    /// Whether an unknown key of `group` was probably meant to be `name`.
    pub fn misspelt(&self, group: &str, name: &str) -> bool {
        self.meant.borrow().contains(&child_key(group, name))
    }

    /// The faults in the order of the text.
    pub fn into_sorted(self) -> Vec<Fault> {
        let mut found = self.found.into_inner();
        found.sort_by_key(|fault| fault.at.map_or((0, 0), |at| (at.start, at.end)));
        found
    }
}

/// Says which groups a key belongs to.
fn belongs_to(homes: &[String]) -> String {
    let shown = homes.iter().map(|home| match home.as_str() {
        "" => "the file as a whole",
        home => home,
    });
    let shown: Vec<&str> = shown.collect();
    format!("belongs to {}", any_of(&shown))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// A key in the wrong group is not missed in its own as well, unless it could be of very many.
    #[test]
    fn misplaced_keys_were_meant_for_where_they_belong() {
        let reading = crate::problem::read_text("format: 2", Path::new("any.yaml"));
        let source = reading.expect("it is short enough").source;
        let faults = Faults::new(&source);
        let at = Span {
            line: 1,
            column: 1,
            start: 0,
            end: 6,
        };
        let misplace = |name: &str| faults.push_unknown_key("nozzle", name, at, &["body"]);
        assert!(!faults.misspelt("jet", "divergence"));
        misplace("divergence");
        assert!(faults.misspelt("jet", "divergence"));
        let homes = homes_of("share");
        assert!(homes.len() > MOST_HOMES);
        misplace("share");
        for home in homes {
            assert!(!faults.misspelt(home, "share"), "{home}");
        }
    }
}
