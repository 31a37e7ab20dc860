//! The two precisions that paths can be traced in: f64 for figures, and f32 for searches where it is
//! enough.

use std::ops::{Add, Div, Mul, Neg, Sub};

use serde::{Deserialize, Serialize};

/// In which precision rays and impacts are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// 64 bits, 16 digits.
    #[default]
    F64,
    /// 32 bits, 7 digits.
    F32,
}

impl Precision {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::F64, Self::F32];

    /// What single precision may change of J as a part of the accuracy asked for, to be enough for a
    /// search.
    pub const LITTLE: f64 = 0.1;
}

/// A floating-point number.
pub trait Real:
    Copy
    + Send
    + Sync
    + 'static
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// Infinity.
    const INFINITY: Self;
    /// How much coarser than in f64 points have to be told apart.
    const COARSENESS: f64;

    /// The nearest number of this precision.
    fn of(value: f64) -> Self;
    /// The same number as f64.
    fn wide(self) -> f64;
    /// The whole number that it is, from 0 to less than 2^23; anything of other numbers.
    fn index(self) -> u32;
    /// Square root; NaN for negative numbers.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The absolute value with the sign of another number.
    fn copysign(self, sign: Self) -> Self;
}

macro_rules! real {
    ($type:ty, $coarseness:expr) => {
        impl Real for $type {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const INFINITY: Self = Self::INFINITY;
            const COARSENESS: f64 = $coarseness;

            #[inline(always)]
            fn of(value: f64) -> Self {
                value as Self
            }
            #[inline(always)]
            fn wide(self) -> f64 {
                f64::from(self)
            }
            // Compilers do not convert several at once with `as`, which has to mind all other numbers.
            #[inline(always)]
            fn index(self) -> u32 {
                const NO_FRACTIONS: $type = (1_u64 << (<$type>::MANTISSA_DIGITS - 1)) as $type;
                (self + NO_FRACTIONS).to_bits() as u32 & ((1 << 23) - 1)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                self.copysign(sign)
            }
        }
    };
}

real!(f64, 1.0);
real!(f32, 1e7);

// Arrays are written out component by component: `map` and the like are not always inlined, and
// then compilers cannot work on several at once.

/// A vector by its components.
pub(crate) type Triple<R> = [R; 3];

#[inline(always)]
pub(crate) fn dot<R: Real>(a: Triple<R>, b: Triple<R>) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn cross<R: Real>(a: Triple<R>, b: Triple<R>) -> Triple<R> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// a + b s.
#[inline(always)]
pub(crate) fn along<R: Real>(a: Triple<R>, b: Triple<R>, s: R) -> Triple<R> {
    [a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s]
}

/// The unit vector along another.
#[inline(always)]
pub(crate) fn unit<R: Real>(vector: Triple<R>) -> Triple<R> {
    scaled(vector, R::ONE / dot(vector, vector).sqrt())
}

/// a s.
#[inline(always)]
pub(crate) fn scaled<R: Real>(a: Triple<R>, s: R) -> Triple<R> {
    [a[0] * s, a[1] * s, a[2] * s]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_indices() {
        for index in [0, 1, 2, 3, 1000, 65_537, (1 << 23) - 1] {
            assert_eq!(f32::of(f64::from(index)).index(), index);
            assert_eq!(f64::from(index).index(), index);
        }
    }
}
