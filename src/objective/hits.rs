//! First hits on target, and sums over them at a launch speed.

use multiversion::multiversion;

/// Impulses of one hit per unit of launch speed, N s per m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulses {
    /// Normal.
    pub normal: f64,
    /// Tangential.
    pub tangential: f64,
    /// What the shot stands for.
    pub weight: f64,
}

/// Impulses of many hits, each quantity in a row of its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hits {
    /// Normal, N s per m/s.
    pub normal: Vec<f64>,
    /// Tangential, N s per m/s.
    pub tangential: Vec<f64>,
    /// What the shots stand for.
    pub weight: Vec<f64>,
}

impl Hits {
    /// None yet, with space for so many.
    pub fn with_capacity(count: usize) -> Self {
        Self {
            normal: Vec::with_capacity(count),
            tangential: Vec::with_capacity(count),
            weight: Vec::with_capacity(count),
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.normal.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.normal.is_empty()
    }
}

impl FromIterator<Impulses> for Hits {
    fn from_iter<I: IntoIterator<Item = Impulses>>(hits: I) -> Self {
        let mut all = Self::default();
        for hit in hits {
            all.normal.push(hit.normal);
            all.tangential.push(hit.tangential);
            all.weight.push(hit.weight);
        }
        all
    }
}

/// Sums of weight times something over hits whose impulses are measured in what is wanted or
/// allowed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Moments {
    /// Of (gain speed - 1)^2.
    pub square: f64,
    /// Of (gain speed - 1) gain: half the derivative of that in the speed.
    pub slope: f64,
    /// Of gain^2: half the second derivative.
    pub curvature: f64,
}

/// Partial sums that are kept side by side; the result does not depend on the machine.
const PARTS: usize = 16;

/// The moments of impulses over `unit` at a launch speed. With `only_excess` those hits count for
/// which gain speed > 1.
#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+fma",
    "x86_64+avx+avx2+bmi1+bmi2+fma"
))]
pub(super) fn moments(
    impulses: &[f64],
    weights: &[f64],
    unit: f64,
    speed: f64,
    only_excess: bool,
) -> Moments {
    let mut square = [0.0; PARTS];
    let mut slope = [0.0; PARTS];
    let mut curvature = [0.0; PARTS];
    let mut add = |impulses: &[f64], weights: &[f64]| {
        for (part, (impulse, weight)) in impulses.iter().zip(weights).enumerate().take(PARTS) {
            let gain = impulse / unit;
            let excess = gain * speed - 1.0;
            let counts = !only_excess | (excess > 0.0);
            let weight = if counts { *weight } else { 0.0 };
            square[part] += weight * excess * excess;
            slope[part] += weight * excess * gain;
            curvature[part] += weight * gain * gain;
        }
    };
    let (whole, rest) = impulses.as_chunks::<PARTS>();
    let (whole_weights, rest_weights) = weights.as_chunks::<PARTS>();
    for (impulses, weights) in whole.iter().zip(whole_weights) {
        add(impulses, weights);
    }
    add(rest, rest_weights);
    Moments {
        square: square.iter().sum(),
        slope: slope.iter().sum(),
        curvature: curvature.iter().sum(),
    }
}
