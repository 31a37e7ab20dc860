//! Numbers of reports: convenient units, and no more digits than a figure deserves.

use crate::digits::{MOST, NO_NUMBER};
pub use crate::digits::{coordinate, decimals_for, fixed, plain, rounded, significant};
use crate::elementary::whole_power;

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
    format!("{} %", percent(share, decimals))
}

/// A share in percent with this many decimals; neither nothing nor the whole unless it is.
fn percent(share: f64, decimals: usize) -> String {
    if share == 1.0 {
        return "100".into();
    }
    let text = fixed(share * 100.0, decimals);
    match text.parse() {
        Ok(0.0) if share > 0.0 => {
            format!("<{}", fixed(whole_power(0.1, decimals as i32), decimals))
        }
        Ok(100.0) if share < 1.0 => ">99.99".into(),
        _ => text,
    }
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
    let [share, low_text, high_text] = [share, low, high].map(|it| percent(it, decimals));
    let interval = match low_text.strip_prefix('>') {
        Some(least) => format!("above {least}"),
        None => format!("{low_text} to {high_text}"),
    };
    (share, interval)
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
        let most = match value {
            0.0 => decimals,
            _ => decimals_for(value, MOST),
        };
        Self::Decimals(decimals.min(most).min(8))
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
        assert_eq!(share(0.999_95), "99.995 %");
        assert_eq!(share(0.999_999_9), ">99.99 %");
        assert_eq!(share(2e-9), "<0.00001 %");
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
        assert_eq!(
            share_with_interval(0.999_999, [0.999_99, 0.999_999_9]),
            (">99.99".into(), "99.999 to >99.99".into())
        );
        assert_eq!(
            share_with_interval(1.0, [0.999_77, 1.0]),
            ("100".into(), "99.977 to 100".into())
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
        let sharp = Scale::for_error(1.234_567_8, 0.000_001_1);
        assert_eq!(
            sharp.with_error(1.234_567_8, 0.000_001_1),
            "1.2346 +- <0.0001"
        );
    }

    #[test]
    fn counts_are_grouped_and_agree_with_their_noun() {
        assert_eq!(count(1_912_854), "1 912 854");
        assert_eq!(count(1408), "1408");
        assert_eq!(plural(1, "verdict"), "1 verdict");
        assert_eq!(plural(7, "verdict"), "7 verdicts");
    }
}
