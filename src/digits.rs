//! Numbers for people: no more digits than a figure deserves, and five at most.
//!
//! Files for programs (`result.json`, tables) keep every digit; texts use these.

use crate::elementary::whole_power;

/// Significant digits of a number in a text, at most.
pub const MOST: i32 = 5;
/// What is shown instead of a number that is not finite.
pub(crate) const NO_NUMBER: &str = "-";
/// Numbers from ten to this power on, and those below ten to that, are shown with a power of ten.
const LARGE: i32 = 6;
const SMALL: i32 = -5;

/// `value` with this many decimals, or fewer where that would be more than five significant
/// digits; never `-0`.
pub fn fixed(value: f64, decimals: usize) -> String {
    with_decimals(value, decimals.min(decimals_for(value, MOST)))
}

/// `value` with this many decimals, whatever its size: for coordinates, which a machine is given.
pub fn coordinate(value: f64, decimals: usize) -> String {
    if exponent(value, MOST) >= LARGE {
        return fixed(value, decimals);
    }
    unsigned_zero(format!("{value:.decimals$}"))
}

/// `value` with this many significant digits, zeros at the end kept.
pub fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if value.is_finite() && exponent(value, digits) < SMALL {
        return power(value, digits);
    }
    with_decimals(value, decimals_for(value, digits))
}

/// `value` with at most this many significant digits, without zeros at the end.
pub fn rounded(value: f64, digits: i32) -> String {
    without_end_zeros(&significant(value, digits))
}

/// A number that somebody gave: five significant digits, whole numbers below a million with all of
/// theirs; without zeros at the end.
pub fn plain(value: f64) -> String {
    const ROUNDING: f64 = 1e-9;
    let whole = value.round();
    let is_whole = (value - whole).abs() <= ROUNDING * value.abs();
    if is_whole && whole != 0.0 && exponent(whole, MOST) < LARGE {
        return format!("{whole:.0}");
    }
    rounded(value, MOST)
}

/// Decimals that show this many significant digits of `value`.
pub fn decimals_for(value: f64, digits: i32) -> usize {
    if value == 0.0 || !value.is_finite() {
        return 0;
    }
    (digits - 1 - exponent(value, digits)).clamp(0, 12) as usize
}

/// The power of ten of the first digit, once rounded to this many digits.
fn exponent(value: f64, digits: i32) -> i32 {
    if value == 0.0 || !value.is_finite() {
        return 0;
    }
    let rounded = format!("{:.*e}", (digits - 1).max(0) as usize, value.abs());
    let exponent = rounded.split_once('e').map(|(_, exponent)| exponent);
    exponent.and_then(|text| text.parse().ok()).unwrap_or(0)
}

fn with_decimals(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return NO_NUMBER.into();
    }
    let exponent = exponent(value, MOST);
    if exponent >= LARGE {
        return without_end_zeros(&power(value, MOST));
    }
    let last_digit = whole_power(10.0, (exponent + 1 - MOST).max(0));
    let value = if decimals == 0 {
        (value / last_digit).round() * last_digit
    } else {
        value
    };
    unsigned_zero(format!("{value:.decimals$}"))
}

/// With a power of ten: `1.25e-7`.
fn power(value: f64, digits: i32) -> String {
    format!("{value:.*e}", (digits - 1).max(0) as usize)
}

fn unsigned_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.into(),
        _ => text,
    }
}

fn without_end_zeros(text: &str) -> String {
    let (digits, power) = match text.find('e') {
        Some(at) => text.split_at(at),
        None => (text, ""),
    };
    let digits = if digits.contains('.') {
        digits.trim_end_matches('0').trim_end_matches('.')
    } else {
        digits
    };
    format!("{digits}{power}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_they_deserve() {
        assert_eq!(significant(1.606_918_391_474_963_2, 3), "1.61");
        assert_eq!(significant(0.000_999_6, 3), "0.00100");
        assert_eq!(significant(12_345.6, 3), "12346");
        assert_eq!(fixed(-0.000_1, 2), "0.00");
        assert_eq!(fixed(-1.25, 1), "-1.2");
        assert_eq!(plain(29.999_999_999_999_996), "30");
        assert_eq!(plain(0.0015 * 1e3), "1.5");
        assert_eq!(fixed(f64::NAN, 2), "-");
        assert_eq!(plain(f64::INFINITY), "-");
        assert_eq!(plain(0.0), "0");
    }

    #[test]
    fn no_number_has_more_than_five_significant_digits() {
        assert_eq!(plain(44.287_44), "44.287");
        assert_eq!(fixed(123.456_7, 4), "123.46");
        assert_eq!(fixed(123_456.7, 1), "123460");
        assert_eq!(significant(99_999.6, 5), "100000");
        assert_eq!(plain(1e39), "1e39");
        assert_eq!(plain(1.234_567e39), "1.2346e39");
        assert_eq!(fixed(-1e300, 3), "-1e300");
        assert_eq!(significant(1.234e7, 3), "1.234e7");
        assert_eq!(plain(123_456.0), "123456");
        let digits = |text: &str| {
            let digits = text.split('e').next().unwrap_or_default();
            let digits: String = digits.chars().filter(char::is_ascii_digit).collect();
            digits.trim_matches('0').len()
        };
        for power in -30..=300 {
            for mantissa in [1.0, 1.234_567_89, 7.777_777_777, 9.999_996] {
                let value = mantissa * 10_f64.powi(power);
                for decimals in 0..=12 {
                    assert!(digits(&fixed(value, decimals)) <= 5, "{value:e}");
                }
                for text in [significant(value, 5), rounded(value, 5), plain(value)] {
                    assert!(digits(&text) <= 6 && text.len() <= 12, "{value:e}: {text}");
                    let back: f64 = text.parse().unwrap();
                    assert!((back / value - 1.0).abs() < 0.6e-4, "{value:e}: {text}");
                }
            }
        }
    }

    #[test]
    fn small_numbers_are_not_zero() {
        assert_eq!(plain(1e-20), "1e-20");
        assert_eq!(significant(1.25e-7, 3), "1.25e-7");
        assert_eq!(plain(1e-5), "0.00001");
        assert_eq!(rounded(-3.0e-9, 2), "-3e-9");
    }

    #[test]
    fn coordinates_keep_their_decimals() {
        assert_eq!(coordinate(1234.5678, 3), "1234.568");
        assert_eq!(coordinate(-0.0001, 3), "0.000");
        assert_eq!(coordinate(1.0, 5), "1.00000");
        assert_eq!(coordinate(1e40, 3), "1e40");
    }
}
