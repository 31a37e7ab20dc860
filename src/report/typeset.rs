//! Texts of the sheet with the signs that pages and figures have: `67.9°`, `± 15 %`, `40 µN·s`.
//!
//! The sheet itself stays plain, so that every terminal and every printer shows it.

/// A text of the sheet with the signs of a page.
pub fn typeset(text: &str) -> String {
    let mut typeset = String::with_capacity(text.len());
    for word in text.split_inclusive(' ') {
        let (word, space) = match word.strip_suffix(' ') {
            Some(word) => (word, " "),
            None => (word, ""),
        };
        let end = word.trim_end_matches([',', ';', '.', ':', ')']).len();
        let (word, punctuation) = word.split_at(end);
        let number = typeset.strip_suffix(' ');
        let is_behind_number = number.is_some_and(|it| it.ends_with(|c: char| c.is_ascii_digit()));
        let is_in_heading = number.is_some_and(|it| it.ends_with(['.', ',']));
        match word {
            "deg" if is_behind_number => {
                typeset.pop();
                typeset.push('°');
            }
            "deg" if is_in_heading => typeset.push('°'),
            _ => typeset += &sign(word),
        }
        typeset += punctuation;
        typeset += space;
    }
    typeset
}

/// A word that is a unit, or a tolerance.
fn sign(word: &str) -> String {
    match word {
        "uN.s" => "µN·s".into(),
        "um" => "µm".into(),
        "kg/m3" => "kg/m³".into(),
        "hits/mm2" => "hits/mm²".into(),
        "+-" => "±".into(),
        _ => match word.strip_prefix("+-") {
            Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit() || c == '<') => {
                format!("±{rest}")
            }
            _ => word.into(),
        },
    }
}

/// A unit as it follows a number without anything between.
pub fn unit_behind(unit: &str) -> String {
    match unit {
        "" => String::new(),
        "deg" => "°".into(),
        unit => format!("\u{a0}{}", sign(unit)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_and_tolerances_have_their_signs() {
        for (plain, page) in [
            ("+-2 deg", "±2°"),
            (
                "N* off 40 uN.s +- 15 %, at 67.9 deg.",
                "N* off 40 µN·s ± 15 %, at 67.9°.",
            ),
            ("inc. deg", "inc. °"),
            (
                "angle, deg; 90 is perpendicular",
                "angle, °; 90 is perpendicular",
            ),
            ("N* normal, uN.s", "N* normal, µN·s"),
            ("7000 kg/m3, 3.67 mg", "7000 kg/m³, 3.67 mg"),
            ("0.0046 +- <0.0001", "0.0046 ± <0.0001"),
            ("J +- std. error", "J ± std. error"),
            ("(a fall of 1.37 um)", "(a fall of 1.37 µm)"),
        ] {
            assert_eq!(typeset(plain), page);
        }
    }

    #[test]
    fn other_words_stay_as_they_are() {
        for text in [
            "a degree of 3 degrees",
            "hub.deg",
            "  two  spaces ",
            "+-x",
            "dry deg",
            "",
        ] {
            assert_eq!(typeset(text), text);
        }
        assert_eq!(unit_behind("deg"), "°");
        assert_eq!(unit_behind("mm"), "\u{a0}mm");
    }
}
