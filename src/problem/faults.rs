//! Where faults are collected, each with its place in the text.

use std::cell::RefCell;
use std::collections::HashSet;

use super::fault::{Fault, Span, one_of};
use super::source::{Source, child_key};

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
        let mut fault = Fault::at_key(child_key(group, name), "unknown key")
            .expecting(one_of(known))
            .nearest(name, known.iter().copied());
        fault.at = Some(at);
        if let Some(meant) = &fault.suggestion {
            self.meant.borrow_mut().insert(child_key(group, meant));
        }
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
