//! Means with their errors, from the scatter between independent sets of shots, and medians.

/// A mean over independent sets.
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    pub value: f64,
    pub standard_error: f64,
}

impl Mean {
    /// The mean of some values; it has no error when there is only one.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        let count = values.len() as f64;
        let value = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|x| (x - value).powi(2)).sum();
        let variance = squares / (count - 1.0).max(1.0);
        Self {
            value,
            standard_error: (variance / count).sqrt(),
        }
    }

    /// The mean of one choice over all sets.
    pub fn of_choice(objectives: &[Vec<f64>], settings: usize) -> Self {
        Self::of(objectives.iter().map(|set| set[settings]))
    }
}

/// The middle value, or the mean of the two in the middle.
pub fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        count => 0.5 * (values[(count - 1) / 2] + values[count / 2]),
    }
}
