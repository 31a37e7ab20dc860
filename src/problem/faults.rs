//! Where faults are collected, each with its place in the text.

use std::cell::RefCell;

use super::fault::{Fault, Span};
use super::source::Source;

/// All faults found so far in one file.
pub(super) struct Faults<'a> {
    /// The file.
    pub source: &'a Source,
    found: RefCell<Vec<Fault>>,
}

impl<'a> Faults<'a> {
    pub fn new(source: &'a Source) -> Self {
        Self {
            source,
            found: RefCell::default(),
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

    /// Whether an unknown key of the group `key` was probably meant to be `name`.
    pub fn misspelt(&self, key: &str, name: &str) -> bool {
        self.found.borrow().iter().any(|fault| {
            fault.suggestion.as_deref() == Some(name)
                && fault.message == super::reader::UNKNOWN_KEY
                && match fault.key.strip_prefix(key) {
                    Some(rest) => !rest.trim_start_matches('.').contains('.'),
                    None => false,
                }
        })
    }

    /// The faults in the order of the text.
    pub fn into_sorted(self) -> Vec<Fault> {
        let mut found = self.found.into_inner();
        found.sort_by_key(|fault| {
            fault
                .at
                .map_or((0, 0), |Span { start, end, .. }| (start, end))
        });
        found
    }
}
