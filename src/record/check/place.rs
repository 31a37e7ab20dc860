//! A key of a record under check.

use super::super::RecordFault;

/// Nothing, or the first contradiction.
pub(in crate::record) type Outcome = Result<(), RecordFault>;

/// Rounding errors of figures that are computed in another order.
const ROUNDING: f64 = 1e-9;

/// The path of a key.
#[derive(Clone, Default)]
pub(super) struct Place(String);

impl Place {
    /// A key in this group.
    pub fn of(&self, name: &str) -> Self {
        if self.0.is_empty() {
            Self(name.to_owned())
        } else {
            Self(format!("{}.{name}", self.0))
        }
    }

    /// An item of this list.
    pub fn item(&self, index: usize) -> Self {
        Self(format!("{}[{index}]", self.0))
    }

    /// What is wrong here unless `is_true`.
    pub fn holds(&self, is_true: bool, message: &str) -> Outcome {
        if is_true {
            return Ok(());
        }
        Err(RecordFault::Contradiction {
            key: self.0.clone(),
            message: message.to_owned(),
        })
    }

    /// The same with a message that is only made when needed.
    pub fn holds_or(&self, is_true: bool, message: impl FnOnce() -> String) -> Outcome {
        if is_true {
            Ok(())
        } else {
            self.holds(false, &message())
        }
    }

    /// A number in a range.
    pub fn within(&self, value: f64, min: f64, max: f64) -> Outcome {
        self.holds_or((min..=max).contains(&value), || {
            format!("is {value}; expected a number from {min} to {max}")
        })
    }

    /// A number that is not too small.
    pub fn at_least(&self, value: f64, min: f64) -> Outcome {
        self.holds_or(value >= min && value.is_finite(), || {
            if min > 0.0 {
                format!("is {value}; expected a number above 0")
            } else {
                format!("is {value}; expected a number from {min}")
            }
        })
    }

    /// A share of something.
    pub fn share(&self, value: f64) -> Outcome {
        self.within(value, 0.0, 1.0)
    }

    /// What follows from other numbers, but for rounding.
    pub fn follows(&self, value: f64, expected: f64, from: &str) -> Outcome {
        self.holds_or(is_close(value, expected), || {
            format!("is {value}, but {from} gives {expected}")
        })
    }

    /// A conclusion that follows from other keys.
    pub fn concludes(&self, found: bool, expected: bool, from: &str) -> Outcome {
        self.holds_or(found == expected, || {
            format!("is {found}, but {from} gives {expected}")
        })
    }
}

/// Whether two numbers are the same but for rounding.
pub(super) fn is_close(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * a.abs().max(b.abs()).max(1.0)
}
