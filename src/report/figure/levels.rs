//! The levels at which a quantity changes its colour.

use plotters::style::RGBColor;

use crate::elementary::{extremes, ln, log10, power, whole_power};
use crate::report::number::{decimals_for, fixed, plain};

/// Round values, and a colour for each band between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels {
    /// Rising; there is one more band than levels.
    pub values: Vec<f64>,
    /// Whether equal factors lie between them rather than equal differences.
    pub is_logarithmic: bool,
}

/// Values that span more than this factor are shown on a logarithmic scale.
const WIDE: f64 = 30.0;
/// Decades below the largest value that are told apart.
const DECADES: f64 = 6.0;
/// Most levels.
const MOST: usize = 12;

impl Levels {
    /// Levels for some values; `None` when they are all the same.
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Option<Self> {
        let finite = || values.clone().filter(|value| value.is_finite());
        let (lowest, highest) = extremes(finite());
        if lowest >= highest {
            return None;
        }
        let positive = finite().filter(|value| *value > highest * power(0.1, DECADES));
        let least = positive.fold(f64::INFINITY, f64::min);
        let levels = if lowest >= 0.0 && highest > WIDE * least {
            Self {
                values: rounded_powers(least, highest),
                is_logarithmic: true,
            }
        } else {
            Self {
                values: rounded_steps(lowest, highest),
                is_logarithmic: false,
            }
        };
        (!levels.values.is_empty()).then_some(levels)
    }

    /// The value on the scale on which contours are interpolated.
    pub fn scaled(&self, value: f64) -> f64 {
        if self.is_logarithmic {
            // Far below the lowest level it does not matter how far.
            ln(value.max(self.values[0] * 1e-3))
        } else {
            value
        }
    }

    /// The colour of a band: of the values below the first level, then above each. The ramp is
    /// cividis, which looks the same to most colour-blind people; dark is low.
    pub fn colour(&self, band: usize) -> RGBColor {
        let share = band as f64 / self.values.len() as f64;
        let colour = colorous::CIVIDIS.eval_continuous(share);
        RGBColor(colour.r, colour.g, colour.b)
    }

    /// A level as text.
    pub fn text(&self, index: usize) -> String {
        let value = self.values[index];
        if self.is_logarithmic {
            return plain(value);
        }
        let steps = self.values.windows(2).map(|pair| pair[1] - pair[0]);
        // A step is 1, 2 or 5 times a power of ten.
        fixed(value, decimals_for(steps.fold(value.abs(), f64::min), 1))
    }
}

/// One to three levels in each decade, between two values.
fn rounded_powers(from: f64, to: f64) -> Vec<f64> {
    let between = |multiples: &[f64]| -> Vec<f64> {
        let decades = log10(from).floor() as i32..=log10(to).ceil() as i32;
        decades
            .flat_map(|decade| multiples.iter().map(move |m| m * whole_power(10.0, decade)))
            .filter(|level| from < *level && *level < to)
            .collect()
    };
    let choices: [&[f64]; 2] = [&[1.0, 2.0, 5.0], &[1.0, 3.0]];
    choices
        .into_iter()
        .map(between)
        .find(|levels| levels.len() <= MOST)
        .unwrap_or_else(|| between(&[1.0]))
}

/// Multiples of 1, 2 or 5 times a power of ten, between two values.
fn rounded_steps(from: f64, to: f64) -> Vec<f64> {
    let step = round_step((to - from) / (MOST - 1) as f64);
    let first = (from / step).floor() as i64 + 1;
    (first..)
        .map(|multiple| multiple as f64 * step)
        .take_while(|level| *level < to)
        .take(MOST)
        .collect()
}

/// The smallest of 1, 2 or 5 times a power of ten that is not below a positive value.
pub fn round_step(least: f64) -> f64 {
    let power = power(10.0, log10(least).floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|multiple| multiple * power);
    let step = steps.into_iter().find(|step| *step >= least);
    step.unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(values: &[f64]) -> Levels {
        Levels::of(values.iter().copied()).unwrap()
    }

    #[test]
    fn wide_spans_have_equal_factors() {
        let wide = levels(&[0.003, 0.2, 4.0]);
        assert!(wide.is_logarithmic);
        assert_eq!(
            wide.values,
            [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0]
        );
        assert_eq!(wide.text(0), "0.005");
        // Zeros are below every level.
        let with_zero = levels(&[0.0, 1e-12, 1e-3, 50.0]);
        assert_eq!(with_zero.values.first(), Some(&3e-3));
        assert!(with_zero.scaled(0.0) < with_zero.scaled(2e-3));
        assert!(levels(&[1e-6, 1e-2, 1e5]).values.len() <= MOST);
    }

    #[test]
    fn narrow_spans_have_equal_steps() {
        let narrow = levels(&[0.98, 1.02]);
        assert!(!narrow.is_logarithmic);
        assert_eq!(narrow.values.len(), 7);
        assert_eq!(narrow.text(0), "0.985");
        assert_eq!(Levels::of([2.0, 2.0].into_iter()), None);
        assert_eq!(Levels::of(std::iter::empty()), None);
    }

    #[test]
    fn bands_go_from_dark_to_light() {
        let levels = levels(&[0.003, 0.2, 4.0]);
        let light = |band| {
            let RGBColor(red, green, blue) = levels.colour(band);
            u32::from(red) + u32::from(green) + u32::from(blue)
        };
        let bands: Vec<u32> = (0..=levels.values.len()).map(light).collect();
        assert!(bands.is_sorted(), "{bands:?}");
    }
}
