//! Why a text is not a quantity.

use std::fmt;

use super::dimension::plain_spelling;
use super::tidy::tidy;
use super::{Dimension, parse};

/// Why a text is not the quantity that was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnitFault {
    /// It does not start with a number.
    NotANumber {
        /// What was written.
        text: String,
        /// What was asked for.
        dimension: Dimension,
    },
    /// A bare number.
    MissingUnit {
        /// What was written.
        number: String,
        /// What was asked for.
        dimension: Dimension,
    },
    /// No such unit.
    UnknownUnit {
        /// What stood in the place of the unit.
        unit: String,
        /// What was asked for.
        dimension: Dimension,
    },
    /// The unit of another kind of quantity.
    WrongDimension {
        /// What was written.
        text: String,
        /// What it is.
        found: Dimension,
        /// What was asked for.
        dimension: Dimension,
    },
    /// Too large to compute with.
    TooLarge {
        /// What was written.
        text: String,
        /// What was asked for.
        dimension: Dimension,
    },
}

impl UnitFault {
    /// What is wrong.
    pub fn message(&self) -> String {
        match self {
            Self::NotANumber { text, .. } if text.is_empty() => "has no value".to_owned(),
            Self::NotANumber { text, .. } => format!("`{text}` is not a number with a unit"),
            Self::MissingUnit { number, .. } => format!("`{number}` has no unit"),
            Self::UnknownUnit { unit, dimension } => {
                format!("`{unit}` is not a unit of {}", dimension.name())
            }
            Self::WrongDimension { text, found, .. } => {
                format!("`{text}` is {} {}", found.article(), found.name())
            }
            Self::TooLarge { text, .. } => format!("`{text}` is too large a number"),
        }
    }

    /// What should stand there instead.
    pub fn expected(&self) -> String {
        match self {
            Self::UnknownUnit { dimension, .. } => {
                let names: Vec<_> = dimension.unit_names().collect();
                match names.as_slice() {
                    [single] => format!("`{single}`"),
                    several => format!("one of {}", several.join(", ")),
                }
            }
            Self::NotANumber { dimension, .. }
            | Self::MissingUnit { dimension, .. }
            | Self::WrongDimension { dimension, .. }
            | Self::TooLarge { dimension, .. } => dimension.described().to_owned(),
        }
    }

    /// What was probably meant.
    pub fn suggestion(&self) -> Option<String> {
        match self {
            Self::MissingUnit { number, dimension } => Some(dimension.completed(number)),
            Self::NotANumber { text, dimension } => in_plain_digits(text, *dimension),
            Self::UnknownUnit { unit, dimension } => {
                nearest_unit(unit, *dimension).map(str::to_owned)
            }
            _ => None,
        }
    }
}

/// The quantity with a point for its comma and without marks between thousands, if that is one.
///
/// Whether `1,000 mm` is a metre or a millimetre only its writer knows.
fn in_plain_digits(text: &str, dimension: Dimension) -> Option<String> {
    let text = &*tidy(text);
    let (whole, rest) = text.split_once(',').unwrap_or((text, ""));
    let fraction = rest.bytes().take_while(u8::is_ascii_digit).count();
    let plain = match fraction {
        0 => text.to_owned(),
        3 => return None,
        _ => format!("{whole}.{rest}"),
    };
    let plain = plain.replace(['_', '\''], "");
    parse(dimension, &plain).is_ok().then_some(plain)
}

/// The unit that was most likely meant, whatever the case of its letters.
fn nearest_unit(given: &str, dimension: Dimension) -> Option<&'static str> {
    let given = plain_spelling(given).to_lowercase();
    dimension
        .unit_names()
        .map(|name| (strsim::jaro_winkler(&given, &name.to_lowercase()), name))
        // Every word that begins with m is a little like m.
        .filter(|(likeness, name)| *likeness > if name.len() > 1 { 0.7 } else { 0.99 })
        // The first of equals.
        .reduce(|best, next| if next.0 > best.0 { next } else { best })
        .map(|(_, name)| name)
}

impl fmt::Display for UnitFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; expected {}", self.message(), self.expected())?;
        if let Some(suggestion) = self.suggestion() {
            write!(f, "; did you mean `{suggestion}`?")?;
        }
        Ok(())
    }
}

impl std::error::Error for UnitFault {}
