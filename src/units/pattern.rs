//! What may be written, as a pattern for other programs.

use super::{Dimension, Unit};

/// A decimal number, as [`super::parse`] reads it.
const NUMBER: &str = r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";

impl Dimension {
    /// A regular expression (ECMA-262, and Rust's) of what [`super::parse`] takes for it. The one thing it
    /// cannot tell is a number that is too large to compute with.
    pub fn pattern(self) -> String {
        let units: Vec<String> = self.units().iter().map(spellings).collect();
        format!(r"^\s*{NUMBER}\s*({})\s*$", units.join("|"))
    }
}

/// Every way to write a unit: the way back from [`super::plain_spelling`].
fn spellings((name, _): &Unit) -> String {
    let (name, newton_second) = match name.strip_suffix("N.s") {
        Some(prefix) => (prefix, "N[.·⋅* ]?s"),
        None => (*name, ""),
    };
    let mut pattern: String = name
        .chars()
        .map(|letter| match letter {
            'u' => "[u\u{b5}\u{3bc}]".to_owned(),
            '3' => r"(\^?3|³)".to_owned(),
            plain => plain.to_string(),
        })
        .collect();
    if name == "deg" {
        pattern.push_str("|°");
    }
    pattern + newton_second
}
