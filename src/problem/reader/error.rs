//! The error that passes through serde while a file is read.

use std::fmt;

use serde::de::{self, Expected, Unexpected};

/// Why a value could not be read.
#[derive(Debug)]
pub(in crate::problem) enum ReadError {
    /// The fault is on record already.
    Recorded,
    /// Raised by serde's own code; the reader that sees it first records it.
    Fresh {
        message: String,
        expected: Option<String>,
    },
}

impl de::Error for ReadError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::Fresh {
            message: message.to_string(),
            expected: None,
        }
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::Fresh {
            message: format!("is {found}"),
            expected: Some(expected.to_string()),
        }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Recorded => f.write_str("a fault that is on record"),
            Self::Fresh { message, .. } => f.write_str(message),
        }
    }
}

impl std::error::Error for ReadError {}
