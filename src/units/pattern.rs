//! What may be written, as a pattern for other programs.

use super::Dimension;
use super::dimension::Unit;
use super::tidy::{MINUSES, NO_WIDTH, POINTS, SLASHES};

impl Dimension {
    /// A regular expression (ECMA-262, and Rust's) of what [`super::parse`] takes for it. The one thing it
    /// cannot tell is a number that is too large to compute with.
    pub fn pattern(self) -> String {
        let names = self.units().iter().map(spellings);
        let signs = self.signs().iter().map(|(sign, _)| (*sign).to_owned());
        let units: Vec<String> = names.chain(signs).collect();
        let blank = blank();
        format!(
            "^{blank}*{}{blank}*({}){blank}*$",
            number(),
            units.join("|")
        )
    }
}

/// A decimal number.
fn number() -> String {
    // The hyphen comes first in its class, where it stands for itself.
    let sign = format!("[{MINUSES}+]?");
    format!(r"{sign}([0-9]+\.?[0-9]*|\.[0-9]+)([eE]{sign}[0-9]+)?")
}

fn blank() -> String {
    let no_width: String = NO_WIDTH.iter().collect();
    format!(r"[\s{no_width}]")
}

/// Every way to write a unit: the way back from [`super::dimension::plain_spelling`].
fn spellings((name, _): &Unit) -> String {
    let blank = blank();
    let (name, newton_second) = match name.strip_suffix("N.s") {
        Some(prefix) => (prefix, format!("N({blank}*[{POINTS}]{blank}*|{blank}+)?s")),
        None => (*name, String::new()),
    };
    let pattern: String = name
        .chars()
        .map(|letter| match letter {
            'u' => "[uµμ]".to_owned(),
            '3' => r"(\^?3|³)".to_owned(),
            '/' => format!("{blank}*[{SLASHES}]{blank}*"),
            plain => plain.to_string(),
        })
        .collect();
    pattern + &newton_second
}
