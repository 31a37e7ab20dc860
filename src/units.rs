//! Quantities as people write them, `0.5 mm`, turned into SI: the only conversions there are.
//!
//! ```
//! use peenpose::units::{Dimension, parse};
//!
//! assert_eq!(parse(Dimension::Length, "0.5 mm"), Ok(0.0005));
//! assert_eq!(
//!     parse(Dimension::Speed, "0.5 mm").unwrap_err().to_string(),
//!     "`0.5 mm` is a length; expected a speed such as `10 m/s`"
//! );
//! ```

mod dimension;
mod fault;
mod pattern;
#[cfg(test)]
mod tests;
mod tidy;

pub use dimension::Dimension;
pub use fault::UnitFault;

use dimension::Scale;
use tidy::tidy;

/// Reads a number with its unit, such as `0.5 mm`, as a value in SI.
///
/// # Errors
/// A [`UnitFault`] when there is no number, no unit, or a unit of something else.
pub fn parse(dimension: Dimension, text: &str) -> Result<f64, UnitFault> {
    let written = text.trim();
    let text = &*tidy(text);
    let Some((number, unit)) = split_number(text) else {
        return Err(UnitFault::NotANumber {
            text: shortened(written),
            dimension,
        });
    };
    if unit.is_empty() {
        return Err(UnitFault::MissingUnit {
            number: shortened(number),
            dimension,
        });
    }
    let Some(scale) = dimension.scale(unit) else {
        let other = Dimension::ALL
            .into_iter()
            .find(|other| other.scale(unit).is_some());
        return Err(match other {
            Some(found) => UnitFault::WrongDimension {
                text: shortened(text),
                found,
                dimension,
            },
            None => UnitFault::UnknownUnit {
                unit: shortened(unit),
                dimension,
            },
        });
    };
    let value = match scale {
        Scale::Shift(places) => shifted(number, places),
        Scale::Factor(factor) => shifted(number, 0) * factor,
    };
    if value.is_finite() {
        Ok(value)
    } else {
        Err(UnitFault::TooLarge {
            text: shortened(text),
            dimension,
        })
    }
}

/// An angle in degrees for people and files, rounded to 1e-10 deg: 60 deg that became radians
/// comes back as 60.
pub fn degrees(radians: f64) -> f64 {
    const DIGITS: f64 = 1e10;
    (radians.to_degrees() * DIGITS).round() / DIGITS
}

/// Reads a bare number in decimal notation; neither `1_000` nor `0x10` nor `inf` is one.
pub fn parse_number(text: &str) -> Option<f64> {
    match split_number(&tidy(text))? {
        (number, "") => Some(shifted(number, 0)),
        _ => None,
    }
}

/// Splits `0.5 mm` into its number and its unit, which may be empty.
fn split_number(text: &str) -> Option<(&str, &str)> {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));

    let mut end = sign(0);
    let whole = digits(end);
    end += whole;
    let mut fraction = 0;
    if bytes.get(end) == Some(&b'.') {
        fraction = digits(end + 1);
        end += 1 + fraction;
    }
    if whole + fraction == 0 {
        return None;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = end + 1 + sign(end + 1);
        let length = digits(exponent.min(bytes.len()));
        if length > 0 {
            end = exponent + length;
        }
    }
    let (number, unit) = text.split_at(end);
    // `1_000`, `0x10`, `1,5`, `1.2.3`, `4-5` and `1 000` are mistakes in the number, not in the unit.
    // An apostrophe alone is a unit.
    let thousands = unit.starts_with('\'') && unit.len() > 1;
    let broken = thousands || unit.starts_with(['_', ',', '.', 'x']);
    let unit = unit.trim_start();
    let goes_on = unit.starts_with(|c: char| c.is_ascii_digit() || "+-±".contains(c));
    (!broken && !goes_on).then_some((number, unit))
}

/// The number times 10^places, as exactly as the decimal text allows.
fn shifted(number: &str, places: i32) -> f64 {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let exponent = exponent.parse::<i32>().unwrap_or_else(|_| {
        // Beyond 32 bits every exponent means zero or infinity.
        if exponent.starts_with('-') {
            -1_000_000
        } else {
            1_000_000
        }
    });
    let exponent = exponent.saturating_add(places);
    format!("{mantissa}e{exponent}").parse().unwrap_or(f64::NAN)
}

/// What was written, short enough for a message.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut short: String = text
        .chars()
        .take(LONGEST)
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push('…');
    }
    short
}
