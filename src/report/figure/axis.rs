//! Axes, linear or logarithmic: their ends, ticks and labels.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::coord::types::RangedCoordf64;

use crate::elementary::{ln, log10, whole_power};
use crate::report::number::{count, plain};

/// An axis of a panel.
pub struct Axis<'a> {
    /// Where its values lie.
    pub scale: Scale,
    /// What it shows, with its unit; without a name the axis has no labels either.
    pub name: &'a str,
    /// How its ticks are labelled.
    pub label: fn(f64) -> String,
    /// What lies towards its lower end; nothing for most.
    pub towards_low: &'a str,
}

impl<'a> Axis<'a> {
    /// A linear axis, without anything towards its lower end.
    pub fn linear(ends: Range<f64>, name: &'a str) -> Self {
        Self {
            scale: Scale::Linear(ends),
            name,
            label: plain,
            towards_low: "",
        }
    }
}

/// Where the values of an axis lie between its ends.
#[derive(Clone, Debug)]
pub enum Scale {
    /// Evenly.
    Linear(Range<f64>),
    /// By their logarithms.
    Log(LogAxis),
}

impl Ranged for Scale {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    /// Values beyond the ends lie at the ends.
    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let share = match self {
            Self::Linear(ends) => (value - ends.start) / (ends.end - ends.start),
            Self::Log(axis) => axis.fraction(*value),
        };
        from + (share.clamp(0.0, 1.0) * f64::from(to - from)).round() as i32
    }

    /// Bold points are labelled, light points get a fainter line.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match (self, hint.weight().allow_light_points()) {
            (Self::Linear(_), true) => Vec::new(),
            (Self::Linear(ends), false) => RangedCoordf64::from(ends.clone()).key_points(hint),
            (Self::Log(axis), true) => axis.ticks(&[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]),
            (Self::Log(axis), false) => axis.labelled(MOST_LABELS),
        }
    }

    fn range(&self) -> Range<f64> {
        match self {
            Self::Linear(ends) => ends.clone(),
            Self::Log(axis) => axis.from..axis.to,
        }
    }
}

/// The ends and ticks of a logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogAxis {
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
}

/// Room between the outermost values and the ends, as a factor.
const MARGIN: f64 = 1.6;
/// Most ticks with labels along a whole plot.
const MOST_LABELS: usize = 9;
/// Least ratio of the ends.
const LEAST_SPAN: f64 = 12.0;

impl LogAxis {
    /// An axis that holds all positive values; `None` when there is none.
    pub fn over(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let positive = values
            .into_iter()
            .filter(|value| *value > 0.0 && value.is_finite());
        let (low, high) = positive.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        if low > high {
            return None;
        }
        let widen = (LEAST_SPAN * low / high).max(1.0).sqrt();
        Some(Self {
            from: low / MARGIN / widen,
            to: high * MARGIN * widen,
        })
    }

    /// Where a value stands between the ends: 0 to 1.
    pub fn fraction(self, value: f64) -> f64 {
        let value = value.clamp(self.from, self.to);
        ln(value / self.from) / ln(self.to / self.from)
    }

    /// The ticks that are labelled: powers of ten, fewer or more where they are too many or too few.
    pub fn labelled(self, most: usize) -> Vec<f64> {
        let decades = self.ticks(&[1.0]);
        if decades.len() < 3 {
            return self.ticks(&[1.0, 2.0, 5.0]);
        }
        let step = decades.len().div_ceil(most.max(1));
        decades.into_iter().step_by(step).collect()
    }

    /// Multiples of the powers of ten on the axis.
    fn ticks(self, multiples: &[f64]) -> Vec<f64> {
        let decades = log10(self.from).floor() as i32..=log10(self.to).ceil() as i32;
        decades
            .flat_map(|decade| {
                multiples
                    .iter()
                    .map(move |multiple| multiple * whole_power(10.0, decade))
            })
            .filter(|tick| (self.from..=self.to).contains(tick))
            .collect()
    }
}

/// A share in percent: `0.1 %`.
pub fn percent(share: f64) -> String {
    let percent = share * 100.0;
    if percent > 9999.0 {
        return format!("{} %", count(percent.round() as usize));
    }
    format!("{} %", plain(percent))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_holds_its_values_and_a_decade_at_least() {
        let axis = LogAxis::over([0.0, 2e-3, 0.5, f64::NAN]).unwrap();
        assert!(axis.from < 2e-3 && axis.to > 0.5);
        assert_eq!(
            axis.labelled(9).len(),
            8,
            "1, 2 and 5 where decades are few"
        );
        let long = LogAxis {
            from: 0.5e-3,
            to: 20.0,
        };
        assert_eq!(long.labelled(9), [1e-3, 1e-2, 1e-1, 1.0, 10.0]);
        assert_eq!(long.labelled(3), [1e-3, 1e-1, 10.0]);
        assert_eq!((axis.fraction(0.0), axis.fraction(9.0)), (0.0, 1.0));
        let single = LogAxis::over([3.0]).unwrap();
        assert!(!single.labelled(9).is_empty());
        assert_eq!(LogAxis::over([0.0, -1.0]), None);
    }

    #[test]
    fn shares_are_in_percent() {
        assert_eq!(percent(1e-3), "0.1 %");
        assert_eq!(percent(1.0), "100 %");
    }
}
