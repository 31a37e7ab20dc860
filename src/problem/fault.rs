//! A fault in a problem file: where it is, what is wrong, what was expected.

use std::fmt;

use super::fault_code::FaultCode;

/// One thing wrong with a problem file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Why it is one.
    pub rule: FaultCode,
    /// Key path, such as `scene.hub.keyway.width`; empty for the file as a whole.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// What should stand there instead.
    pub expected: Option<String>,
    /// The nearest valid name or value.
    pub suggestion: Option<String>,
    /// The place in the text, once known.
    pub at: Option<Span>,
}

/// A place in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Byte range in the text.
    pub start: usize,
    /// End of the byte range.
    pub end: usize,
}

impl Fault {
    /// A fault of the value at `key`.
    pub fn at_key(rule: FaultCode, key: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            rule,
            key: key.into(),
            message: message.into(),
            expected: None,
            suggestion: None,
            at: None,
        }
    }

    /// Says what should stand there instead.
    #[must_use]
    pub fn expecting(mut self, expected: impl Into<String>) -> Self {
        self.expected = Some(expected.into());
        self
    }

    /// Proposes the known name nearest to `given`, if one is near.
    #[must_use]
    pub fn nearest<'a>(mut self, given: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        self.suggestion = nearest_name(given, known).map(str::to_owned);
        self
    }
}

/// The name among `known` that `given` was most likely meant to be, whatever the case of its
/// letters.
pub fn nearest_name<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let given = given.to_lowercase();
    known
        .into_iter()
        .map(|name| (strsim::jaro_winkler(&given, &name.to_lowercase()), name))
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// Several names as alternatives: `a, b or c`.
pub(super) fn any_of(names: &[&str]) -> String {
    match names {
        [before @ .., last] if !before.is_empty() => format!("{} or {last}", before.join(", ")),
        names => names.concat(),
    }
}

/// The names that would do, in messages.
pub(crate) fn one_of(names: &[&str]) -> String {
    match names {
        [single] => format!("`{single}`"),
        several => format!("one of {}", several.join(", ")),
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.key.is_empty() {
            write!(f, "{}: ", self.key)?;
        }
        f.write_str(&self.message)?;
        if let Some(expected) = &self.expected {
            write!(f, "; expected {expected}")?;
        }
        if let Some(suggestion) = &self.suggestion {
            write!(f, "; did you mean `{suggestion}`?")?;
        }
        Ok(())
    }
}

impl std::error::Error for Fault {}
