//! Why a file is no valid scenario.

use std::fmt;

use crate::printable;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::{self, Source};

/// Why a file is no valid scenario: all its faults, each with its place.
#[derive(Clone, Debug)]
pub struct Rejection {
    /// The file; absent when it cannot be read at all.
    pub source: Option<Source>,
    /// What is wrong, in the order of the text.
    pub faults: Vec<Fault>,
}

impl Rejection {
    pub(crate) fn unread(fault: Fault) -> Box<Self> {
        Box::new(Self {
            source: None,
            faults: vec![fault],
        })
    }

    pub(crate) fn new(source: Source, mut faults: Vec<Fault>) -> Box<Self> {
        for fault in &mut faults {
            // Under `surfaces` the name itself is wrong, not what stands behind it.
            let of_name =
                fault.rule == FaultCode::UnknownSurface && fault.key.starts_with("surfaces.");
            let place = || match of_name {
                true => source.locate_name(&fault.key),
                false => source.locate(&fault.key),
            };
            fault.at = fault.at.or_else(place);
        }
        faults.sort_by_key(|fault| fault.at);
        Box::new(Self {
            source: Some(source),
            faults,
        })
    }

    /// The faults for people: with the lines of the file, or a line each.
    pub fn render(&self, color: bool) -> String {
        match &self.source {
            Some(source) => problem::render(source, &self.faults, color),
            None => self
                .faults
                .iter()
                .map(|fault| format!("error: {}\n", printable::line(&fault.to_string())))
                .collect(),
        }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.render(false).trim_end())
    }
}

impl std::error::Error for Rejection {}
