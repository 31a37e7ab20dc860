//! Text as editors and word processors leave it, with the signs and blanks that were meant.

/// Signs that stand for a minus: hyphens, the minus of typesetters, the short dash.
pub(super) const MINUSES: &str = "-−‐‑–﹣－";
/// Signs between factors.
pub(super) const POINTS: &str = ".·⋅∙•×*";
/// Signs of a division.
pub(super) const SLASHES: &str = "/⁄∕";
/// Blanks without a width, which Unicode does not count as white space.
pub(super) const NO_WIDTH: [char; 3] = ['\u{200b}', '\u{2060}', '\u{feff}'];

/// With ASCII's minus and blank for all others.
pub(super) fn tidy(text: &str) -> String {
    let plain = text.chars().map(|letter| {
        if MINUSES.contains(letter) {
            '-'
        } else if letter.is_whitespace() || NO_WIDTH.contains(&letter) {
            ' '
        } else {
            letter
        }
    });
    plain.collect::<String>().trim().to_owned()
}
