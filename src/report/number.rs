//! Numbers for people: convenient units, and no more digits than a figure deserves.

use crate::elementary::whole_power;

/// What is shown instead of a number that is not finite.
const NO_NUMBER: &str = "-";

/// `value` with this many decimals; never `-0`.
pub fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return NO_NUMBER.into();
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.into(),
        _ => text,
    }
}

/// `value` with this many significant digits, zeros at the end kept.
pub fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".into();
    }
    fixed(value, decimals_for(value, digits))
}

/// A number that somebody asked for: up to six significant digits, without zeros at the end.
pub fn plain(value: f64) -> String {
    rounded(value, 6)
}

/// `value` with at most this many significant digits, without zeros at the end.
pub fn rounded(value: f64, digits: i32) -> String {
    without_end_zeros(&significant(value, digits)).into()
}

fn without_end_zeros(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// Decimals that show this many significant digits of `value`.
pub fn decimals_for(value: f64, digits: i32) -> usize {
    if value == 0.0 || !value.is_finite() {
        return 0;
    }
    let rounded = format!("{:.*e}", (digits - 1).max(0) as usize, value.abs());
    let exponent = rounded
        .split_once('e')
        .and_then(|(_, exponent)| exponent.parse::<i32>().ok())
        .unwrap_or(0);
    (digits - 1 - exponent).clamp(0, 12) as usize
}

/// An impulse in uN.s without its unit, three significant digits.
pub fn impulse(newton_seconds: f64) -> String {
    significant(newton_seconds * 1e6, 3)
}

/// An impulse that was asked for, with its unit.
pub fn impulse_asked(newton_seconds: f64) -> String {
    format!("{} uN.s", plain(newton_seconds * 1e6))
}

/// A share that was asked for.
pub fn share_asked(share: f64) -> String {
    format!("{} %", plain(share * 100.0))
}

/// A share that was counted: two significant digits of what it is or of what is missing to the whole.
pub fn share(share: f64) -> String {
    let least = share.min(1.0 - share) * 100.0;
    let decimals = if least > 0.0 {
        decimals_for(least, 2).clamp(1, 5)
    } else {
        0
    };
    format!("{} %", fixed(share * 100.0, decimals))
}

/// A share with its 95 % interval as two texts, in percent: `2.01` and `1.90 to 2.12`. A share of
/// which nothing was seen is `0`, and all that is known is what it lies below. An interval of no
/// width is `exact`.
pub fn share_with_interval(share: f64, [low, high]: [f64; 2]) -> (String, String) {
    if low == high {
        return (plain(share * 100.0), "exact".into());
    }
    if share <= 0.0 {
        return (
            "0".into(),
            format!("below {}", significant(high * 100.0, 2)),
        );
    }
    let decimals = decimals_for((high - low) * 50.0, 2);
    let percent = |value: f64| fixed(value * 100.0, decimals);
    (
        percent(share),
        format!("{} to {}", percent(low), percent(high)),
    )
}

/// A count with thin groups: `1 912 854`.
pub fn count(value: usize) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) && digits.len() > 4 {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// A time with its unit: `100 µs`.
pub fn time(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 0.99e-6 => (s * 1e9, "ns"),
        s if s < 0.99e-3 => (s * 1e6, "µs"),
        s if s < 0.99 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    format!("{} {unit}", plain(value))
}

/// `verdict`, or `verdicts` for any number but one.
pub fn plural(number: usize, noun: &str) -> String {
    if number == 1 {
        format!("{number} {noun}")
    } else {
        format!("{} {noun}s", count(number))
    }
}

/// Values that are added up or compared, with their standard errors, all to the same decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Plain decimals.
    Decimals(usize),
    /// A power of ten, for values too small for that.
    Power,
}

impl Scale {
    /// The scale on which an error has two significant digits; an exact value gets four.
    pub fn for_error(value: f64, error: f64) -> Self {
        if value != 0.0 && value.abs() < 1e-6 {
            return Self::Power;
        }
        let decimals = if error > value.abs() * 1e-7 {
            decimals_for(error, 2)
        } else {
            decimals_for(value, 4)
        };
        Self::Decimals(decimals.min(8))
    }

    /// A value on this scale.
    pub fn text(self, value: f64) -> String {
        match self {
            _ if value == 0.0 => "0".into(),
            Self::Decimals(decimals) => {
                let least = whole_power(0.1, decimals as i32);
                if value.abs() < 0.5 * least {
                    format!("<{}", fixed(least, decimals))
                } else {
                    fixed(value, decimals)
                }
            }
            Self::Power if value.is_finite() => format!("{value:.1e}"),
            Self::Power => NO_NUMBER.into(),
        }
    }

    /// The standard error of a value on this scale; 0 where it is nothing but rounding.
    pub fn error_text(self, value: f64, error: f64) -> String {
        const ROUNDING: f64 = 1e-12;
        self.text(if error < ROUNDING * value.abs() {
            0.0
        } else {
            error
        })
    }

    /// A value with its standard error.
    pub fn with_error(self, value: f64, error: f64) -> String {
        format!("{} +- {}", self.text(value), self.error_text(value, error))
    }
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
    }

    #[test]
    fn impulses_are_in_micronewton_seconds() {
        assert_eq!(impulse(3.981_214_874_978_531e-5), "39.8");
        assert_eq!(impulse_asked(4e-5), "40 uN.s");
    }

    #[test]
    fn times_carry_their_unit() {
        assert_eq!(time(1e-4), "100 µs");
        assert_eq!(time(1e-3), "1 ms");
        assert_eq!(time(10.0), "10 s");
    }

    #[test]
    fn shares_show_what_was_counted() {
        assert_eq!(share(0.0), "0 %");
        assert_eq!(share(1.0), "100 %");
        assert_eq!(share(0.999_95), "99.9950 %");
        assert_eq!(share(0.020_065_3), "2.0 %");
        assert_eq!(share(0.701_34), "70.1 %");
        assert_eq!(
            share_with_interval(0.020_065_3, [0.019_019_5, 0.021_167_3]),
            ("2.01".into(), "1.90 to 2.12".into())
        );
        assert_eq!(
            share_with_interval(0.0, [0.0, 3.0 / 65_536.0]),
            ("0".into(), "below 0.0046".into())
        );
    }

    #[test]
    fn errors_decide_how_many_digits_a_sum_shows() {
        let scale = Scale::for_error(0.004_638_56, 0.000_016_8);
        assert_eq!(
            scale.with_error(0.004_638_56, 0.000_016_8),
            "0.004639 +- 0.000017"
        );
        assert_eq!(
            Scale::for_error(9.6e-13, 1e-27).with_error(9.6e-13, 0.0),
            "9.6e-13 +- 0"
        );
        assert_eq!(Scale::for_error(0.0, 0.0).with_error(0.0, 0.0), "0 +- 0");
        assert_eq!(scale.text(6.8e-8), "<0.000001");
        assert_eq!(Scale::for_error(11.312, 0.013_98).text(11.312), "11.312");
    }

    #[test]
    fn counts_are_grouped_and_agree_with_their_noun() {
        assert_eq!(count(1_912_854), "1 912 854");
        assert_eq!(count(1408), "1408");
        assert_eq!(plural(1, "verdict"), "1 verdict");
        assert_eq!(plural(7, "verdict"), "7 verdicts");
    }
}
