//! Why a text is no record, and which key says so.

use std::fmt;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::json::{key_at, printable};

/// Why a text is no record.
#[derive(Debug)]
pub enum RecordFault {
    /// It has not the form of one.
    Form {
        /// The key at which that shows; empty outside all of them.
        key: String,
        /// What is wrong, and where.
        error: serde_json::Error,
    },
    /// A newer version of the program wrote it, whose keys may mean something else.
    Newer {
        /// That version.
        version: String,
    },
    /// What it concludes is not what its numbers say, or a number cannot be.
    Contradiction {
        /// The key of that.
        key: String,
        /// What is wrong.
        message: String,
    },
}

impl fmt::Display for RecordFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form { key, error } if key.is_empty() => {
                write!(f, "is not a result: {error}")
            }
            Self::Form { key, error } => write!(f, "is not a result: `{key}`: {error}"),
            Self::Newer { version } => write!(
                f,
                "was written by peenpose {version}, which is newer than this one, {OWN}: \
                 update the program to read it"
            ),
            Self::Contradiction { key, message } => {
                write!(f, "contradicts itself: `{key}` {message}")
            }
        }
    }
}

impl std::error::Error for RecordFault {}

const OWN: &str = env!("CARGO_PKG_VERSION");

/// The version behind a text, whatever else is in it.
#[derive(Deserialize)]
struct Head {
    version: Option<String>,
}

/// Reads what this version or an older one wrote; texts in it are made safe to show.
pub(crate) fn read_json<T: DeserializeOwned>(text: &str) -> Result<T, RecordFault> {
    let text = &*printable(text);
    // Nothing else of a newer version can be relied on, not even its form.
    if let Ok(Head {
        version: Some(version),
    }) = serde_json::from_str(text)
        && is_newer(&version)
    {
        return Err(RecordFault::Newer { version });
    }
    serde_json::from_str(text).map_err(|error| RecordFault::Form {
        key: key_at(text, error.line(), error.column()),
        error,
    })
}

/// Whether a version comes after this one; what is no version is none of ours.
fn is_newer(version: &str) -> bool {
    match (numbers(version), numbers(OWN)) {
        (Some(theirs), Some(own)) => theirs > own,
        _ => true,
    }
}

/// The three numbers of a version, without what may follow them.
fn numbers(version: &str) -> Option<[u64; 3]> {
    let core = version.split(['-', '+']).next()?;
    let mut parts = core.split('.').map(|part| part.parse().ok());
    let numbers = [parts.next()??, parts.next()??, parts.next()??];
    parts.next().is_none().then_some(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_compared_by_their_numbers() {
        for newer in ["0.1.1", "0.2.0", "1.0.0", "0.10.0", "9.9.9-beta", "two", ""] {
            assert!(is_newer(newer), "{newer}");
        }
        for readable in ["0.1.0", "0.0.9", "0.0.99", "0.1.0-rc1"] {
            assert!(!is_newer(readable), "{readable}");
        }
    }
}
