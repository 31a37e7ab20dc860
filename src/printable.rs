//! Text as people see it, without characters that act on a terminal or turn the direction of writing.
//!
//! Titles, names of surfaces and paths come from elsewhere. On a terminal their control characters could move the
//! cursor, hide a verdict or rewrite it, so every text that is shown goes through here. A character
//! becomes one character: columns keep their width.

use std::borrow::Cow;

/// A text for one line: line breaks and tabs become visible as well.
///
/// ```
/// use peenpose::printable;
///
/// assert_eq!(printable::line("Keyway\u{1b}[8m"), "Keyway\u{241b}[8m");
/// ```
pub fn line(text: &str) -> Cow<'_, str> {
    replaced(text, acts)
}

/// A text of several lines, whose line breaks stay.
pub fn lines(text: &str) -> Cow<'_, str> {
    replaced(text, |c| c != '\n' && acts(c))
}

fn replaced(text: &str, is_bad: fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(is_bad) {
        return Cow::Borrowed(text);
    }
    let shown = |c: char| if is_bad(c) { symbol(c) } else { c };
    Cow::Owned(text.chars().map(shown).collect())
}

/// Whether a character acts on what shows it: a control character, a separator of lines, or one that
/// turns the direction of writing.
pub const fn acts(c: char) -> bool {
    matches!(
        c,
        '\0'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    )
}

/// What stands for it: its own picture where Unicode has one.
fn symbol(c: char) -> char {
    const PICTURES: u32 = 0x2400;
    match c {
        '\0'..='\u{1f}' => char::from_u32(PICTURES + u32::from(c)),
        '\u{7f}' => Some('\u{2421}'),
        _ => None,
    }
    .unwrap_or(char::REPLACEMENT_CHARACTER)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_becomes_visible_and_keeps_its_width() {
        let text = "a\0b\tc\nd\u{1b}[2J\u{7f}\u{85}\u{9b}31m\u{202e}x\u{2066}\u{2069}\u{2028}";
        let shown = "a␀b␉c␊d␛[2J␡\u{fffd}\u{fffd}31m\u{fffd}x\u{fffd}\u{fffd}\u{fffd}";
        assert_eq!(line(text), shown);
        assert_eq!(lines(text), shown.replace('␊', "\n"));
        assert_eq!(line(text).chars().count(), text.chars().count());
    }

    #[test]
    fn ordinary_text_of_any_language_stays() {
        for text in [
            "Nabe \u{2300}30 µN·s ±1°",
            "中文 עברית\u{200f} \u{1f527}",
            "",
        ] {
            assert!(matches!(line(text), Cow::Borrowed(same) if same == text));
        }
        assert!(!acts('\u{2027}') && !acts('\u{202f}') && !acts('\u{a0}') && !acts(' '));
    }
}
