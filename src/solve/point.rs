//! Points of the search space, as argmin computes with them. Its own arithmetic on vectors comes with a
//! random number generator, which has no seed in a browser.

use argmin_math::{ArgminAdd, ArgminMul, ArgminSub};

/// A point by its coordinates.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point(pub Vec<f64>);

impl Point {
    fn with(&self, other: &Self, combined: fn(f64, f64) -> f64) -> Self {
        let pairs = self.0.iter().zip(&other.0);
        Self(pairs.map(|(&a, &b)| combined(a, b)).collect())
    }
}

impl ArgminAdd<Self, Self> for Point {
    fn add(&self, other: &Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl ArgminSub<Self, Self> for Point {
    fn sub(&self, other: &Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl ArgminMul<f64, Self> for Point {
    fn mul(&self, factor: &f64) -> Self {
        Self(self.0.iter().map(|x| x * factor).collect())
    }
}
