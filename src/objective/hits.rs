//! First hits on target, and sums over them at a launch speed.

use multiversion::multiversion;

use crate::problem::goal::Goals;

/// Impulses of one hit per unit of launch speed, N s per m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulses {
    /// Normal.
    pub normal: f64,
    /// The same where the shot has the mean speed and its path does not depend on it.
    pub normal_at_mean: f64,
    /// Tangential.
    pub tangential: f64,
    /// Importance weight.
    pub weight: f64,
    /// 1 for a nominal sample, 0 for a boundary sample.
    pub of_jet: f64,
}

/// Impulses of many hits, each quantity in a row of its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hits {
    /// Normal, N s per m/s.
    pub normal: Vec<f64>,
    /// The same where the shots have the mean speed and their paths do not depend on it.
    pub normal_at_mean: Vec<f64>,
    /// Tangential, N s per m/s.
    pub tangential: Vec<f64>,
    /// Importance weights.
    pub weight: Vec<f64>,
    /// 1 for a nominal sample, 0 for a boundary sample.
    pub of_jet: Vec<f64>,
}

impl Hits {
    /// None yet, with space for `count`.
    pub fn with_capacity(count: usize) -> Self {
        Self {
            normal: Vec::with_capacity(count),
            normal_at_mean: Vec::with_capacity(count),
            tangential: Vec::with_capacity(count),
            weight: Vec::with_capacity(count),
            of_jet: Vec::with_capacity(count),
        }
    }

    /// Adds other hits behind these.
    pub fn append(&mut self, mut others: Self) {
        self.normal.append(&mut others.normal);
        self.normal_at_mean.append(&mut others.normal_at_mean);
        self.tangential.append(&mut others.tangential);
        self.weight.append(&mut others.weight);
        self.of_jet.append(&mut others.of_jet);
    }

    /// Hit by hit.
    pub fn iter(&self) -> impl Iterator<Item = Impulses> + '_ {
        (0..self.len()).map(|index| Impulses {
            normal: self.normal[index],
            normal_at_mean: self.normal_at_mean[index],
            tangential: self.tangential[index],
            weight: self.weight[index],
            of_jet: self.of_jet[index],
        })
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.normal.len()
    }

    /// Number of hits of nominal samples.
    pub fn of_jet(&self) -> f64 {
        self.of_jet.iter().sum()
    }

    /// The largest tangential impulse, N s per m/s; 0 without hits.
    pub fn most_tangential(&self) -> f64 {
        self.tangential.iter().copied().fold(0.0, f64::max)
    }

    /// The weights of those that are off the wanted normal impulse by more than the tolerance at a launch speed, m/s.
    pub fn off_target(&self, goals: &Goals, speed: f64) -> impl Iterator<Item = f64> {
        let goal = goals.normal_impulse;
        self.weights_where(&self.normal, move |gain| goal.is_off(gain * speed))
    }

    /// The weights of those over the tangential limit at a launch speed, m/s; none where there is no limit.
    pub fn over_limit(&self, goals: &Goals, speed: f64) -> impl Iterator<Item = f64> {
        let goal = goals.tangential_impulse;
        let is_over = move |gain| goal.is_some_and(|goal| gain * speed > goal.limit);
        self.weights_where(&self.tangential, is_over)
    }

    fn weights_where(
        &self,
        gains: &[f64],
        breaks: impl Fn(f64) -> bool,
    ) -> impl Iterator<Item = f64> {
        let pairs = gains.iter().zip(&self.weight);
        pairs.filter_map(move |(&gain, &weight)| breaks(gain).then_some(weight))
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
            all.normal_at_mean.push(hit.normal_at_mean);
            all.tangential.push(hit.tangential);
            all.weight.push(hit.weight);
            all.of_jet.push(hit.of_jet);
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

impl Moments {
    /// The same averaged over speeds that scatter about the launch speed, m/s, with this relative
    /// variance, where they are those at the mean speed.
    pub fn scattered(self, variance: f64, speed: f64) -> Self {
        let more = variance * self.curvature;
        Self {
            square: self.square + more * speed * speed,
            slope: self.slope + more * speed,
            curvature: self.curvature + more,
        }
    }
}

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
    let mut sums = PartialSums::default();
    let per_unit = 1.0 / unit;
    let (whole, rest) = impulses.as_chunks::<PARTS>();
    let (whole_weights, rest_weights) = weights.as_chunks::<PARTS>();
    for (impulses, weights) in whole.iter().zip(whole_weights) {
        sums.add(impulses, weights, per_unit, speed, only_excess);
    }
    let (mut impulses, mut weights) = ([0.0; PARTS], [0.0; PARTS]);
    impulses[..rest.len()].copy_from_slice(rest);
    weights[..rest_weights.len()].copy_from_slice(rest_weights);
    sums.add(&impulses, &weights, per_unit, speed, only_excess);
    Moments {
        square: sums.square.iter().sum(),
        slope: sums.slope.iter().sum(),
        curvature: sums.curvature.iter().sum(),
    }
}

/// Sums that are kept side by side, so that the result does not depend on the machine.
#[derive(Default)]
struct PartialSums {
    square: [f64; PARTS],
    slope: [f64; PARTS],
    curvature: [f64; PARTS],
}

const PARTS: usize = 16;

impl PartialSums {
    #[inline(always)]
    fn add(
        &mut self,
        impulses: &[f64; PARTS],
        weights: &[f64; PARTS],
        per_unit: f64,
        speed: f64,
        only_excess: bool,
    ) {
        for part in 0..PARTS {
            let gain = impulses[part] * per_unit;
            let excess = gain * speed - 1.0;
            let counts = !only_excess | (excess > 0.0);
            let weight = if counts { weights[part] } else { 0.0 };
            self.square[part] += weight * excess * excess;
            self.slope[part] += weight * excess * gain;
            self.curvature[part] += weight * gain * gain;
        }
    }
}
