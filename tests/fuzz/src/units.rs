//! Numbers with units.

use peenpose::units::{self, Dimension};

/// Longest complaint about a value, however long that is.
const LONGEST_COMPLAINT: usize = 300;

pub fn run(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    for dimension in Dimension::ALL {
        match units::parse(dimension, &text) {
            Ok(value) => {
                assert!(value.is_finite(), "{text:?} is {value}");
                let spaced = format!("\t {text} ");
                assert_eq!(units::parse(dimension, &spaced), Ok(value), "{text:?}");
            }
            Err(fault) => {
                let complaint = fault.to_string();
                assert!(
                    complaint.chars().count() <= LONGEST_COMPLAINT,
                    "{complaint}"
                );
                assert!(!complaint.contains(char::is_control), "{complaint:?}");
            }
        }
    }
    if let Some(value) = units::parse_number(&text) {
        assert!(!value.is_nan(), "{text:?}");
        agrees_with_metres(&text, value);
    }
}

/// A bare number is the same as so many metres.
fn agrees_with_metres(text: &str, value: f64) {
    let metres = units::parse(Dimension::Length, &format!("{} m", text.trim()));
    if value.is_finite() {
        assert_eq!(metres, Ok(value), "{text:?}");
        // What is written shortest comes back to the last bit, and so does a shifted point.
        assert_eq!(units::parse_number(&format!("{value:e}")), Some(value));
        let micrometres = units::parse(Dimension::Length, &format!("{value:e} um"));
        let shifted: f64 = format!("{}e-6", text_without_exponent(value))
            .parse()
            .unwrap();
        assert_eq!(micrometres, Ok(shifted), "{text:?}");
    } else {
        assert!(metres.is_err(), "{text:?}");
    }
}

fn text_without_exponent(value: f64) -> String {
    format!("{value}")
}
