//! What a key is varied over.

use crate::units::parse_number;

/// A key of the problem file and its values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    /// Key path, such as `contacts.dry.restitution`.
    pub key: String,
    pub values: Values,
}

/// Values of a key.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Values {
    /// These, as they stand in a problem file.
    Listed(Vec<String>),
    /// Any of a range.
    Between(Range),
}

/// From one number to another, in a unit.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Range {
    from: f64,
    to: f64,
    unit: String,
}

/// Most values of one key.
const MOST_VALUES: f64 = 1e6;
/// A last step that ends within this share of a step beyond the range belongs to it.
const ROUNDING: f64 = 1e-9;

impl Range {
    /// Such as `5 m/s` to `40 m/s`.
    pub fn new(from: &str, to: &str) -> Result<Self, String> {
        let (from, unit) = number_with_unit(from)?;
        let to = in_unit(to, unit)?;
        if from >= to {
            return Err(format!("`from` ({from}) is not below `to` ({to})"));
        }
        let unit = unit.to_owned();
        Ok(Self { from, to, unit })
    }

    /// Its values in steps, both ends included where the last step ends there.
    pub fn in_steps(&self, step: &str) -> Result<Values, String> {
        let step = in_unit(step, &self.unit)?;
        let steps = (self.to - self.from) / step + ROUNDING;
        if step <= 0.0 || steps > MOST_VALUES {
            return Err(format!("`step` ({step}) gives no or too many values"));
        }
        let values = (0..=steps as u64).map(|index| self.written(self.from + index as f64 * step));
        Ok(Values::Listed(values.collect()))
    }

    /// So many of its values, both ends included.
    pub fn counted(&self, count: &str) -> Result<Values, String> {
        let count = count.parse::<u32>().ok();
        let count = count
            .filter(|&count| count >= 2 && f64::from(count) <= MOST_VALUES)
            .ok_or_else(|| format!("`count` is no whole number from 2 to {MOST_VALUES}"))?;
        let width = self.to - self.from;
        let at = |index| self.from + width * f64::from(index) / f64::from(count - 1);
        let values = (0..count).map(|index| self.written(at(index)));
        Ok(Values::Listed(values.collect()))
    }

    /// A number as it stands in a file: without the rounding errors of steps.
    fn written(&self, value: f64) -> String {
        let rounded: f64 = format!("{value:.11e}").parse().unwrap_or(value);
        // No -0.
        let rounded = rounded + 0.0;
        match self.unit.as_str() {
            "" => format!("{rounded}"),
            unit => format!("{rounded} {unit}"),
        }
    }
}

impl Values {
    /// The value at a coordinate from 0 to below 1.
    pub fn at(&self, coordinate: f64) -> String {
        match self {
            Self::Listed(values) => {
                let index = (coordinate * values.len() as f64) as usize;
                values[index.min(values.len() - 1)].clone()
            }
            Self::Between(range) => {
                range.written(range.from + (range.to - range.from) * coordinate)
            }
        }
    }
}

/// `5 m/s` as a number and its unit, which may be empty.
fn number_with_unit(text: &str) -> Result<(f64, &str), String> {
    let text = text.trim();
    let mut ends = text
        .char_indices()
        .rev()
        .map(|(at, letter)| at + letter.len_utf8());
    let number = ends.find_map(|end| Some((parse_number(&text[..end])?, end)));
    let (value, end) = number.ok_or_else(|| format!("`{text}` is no number with a unit"))?;
    Ok((value, text[end..].trim()))
}

fn in_unit(text: &str, unit: &str) -> Result<f64, String> {
    match number_with_unit(text)? {
        (value, same) if same == unit => Ok(value),
        _ => Err(format!("`{text}` is not in the unit of `from`, `{unit}`")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(values: Values) -> Vec<String> {
        match values {
            Values::Listed(values) => values,
            Values::Between(_) => panic!("not listed"),
        }
    }

    #[test]
    fn steps_end_with_the_range_and_have_no_rounding_errors() {
        let range = |from, to| Range::new(from, to).unwrap();
        let tenths = listed(range("0.1", "0.7").in_steps("0.1").unwrap());
        assert_eq!(tenths, ["0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"]);
        let speeds = listed(range("5 m/s", "9m/s").in_steps("1.5 m/s").unwrap());
        assert_eq!(speeds, ["5 m/s", "6.5 m/s", "8 m/s"]);
        let counted = listed(range("-1 deg", "1 deg").counted("3").unwrap());
        assert_eq!(counted, ["-1 deg", "0 deg", "1 deg"]);
        assert_eq!(
            Values::Between(range("1e1 mm", "2e1 mm")).at(0.25),
            "12.5 mm"
        );
        assert_eq!(Values::Listed(vec!["a".into(), "b".into()]).at(0.5), "b");
    }

    #[test]
    fn what_is_no_range_is_refused() {
        assert!(Range::new("a", "b").unwrap_err().contains("no number"));
        assert!(
            Range::new("1 mm", "2 m")
                .unwrap_err()
                .contains("not in the unit")
        );
        assert!(Range::new("2", "2").unwrap_err().contains("not below"));
        let range = || Range::new("1 mm", "2 mm").unwrap();
        for step in ["0 mm", "-1 mm", "1e-9 mm"] {
            assert!(
                range()
                    .in_steps(step)
                    .unwrap_err()
                    .contains("no or too many"),
                "{step}"
            );
        }
        assert!(range().in_steps("1").is_err());
        for count in ["1", "2.5", "x", "1000001"] {
            assert!(range().counted(count).is_err(), "{count}");
        }
    }
}
