//! Quantiles of the standard normal distribution, to 16 digits: algorithm AS 241 of M. J. Wichura, Applied
//! Statistics 37 (1988) 477-484.

use crate::elementary::ln;

/// Polynomials of one variable, by their coefficients from the constant onwards.
struct Quotient {
    above: [f64; 8],
    below: [f64; 8],
}

/// In the middle, by how much the square of a share falls short of that of `CENTRAL`.
const MIDDLE: Quotient = Quotient {
    above: [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    below: [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
};

/// Farther out, by the root of the logarithm of what is beyond.
const OUTSIDE: Quotient = Quotient {
    above: [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        7.745_450_142_783_414e-4,
    ],
    below: [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
};

/// How far from the median the middle reaches, as a share of all.
const CENTRAL: f64 = 0.425;
/// Of the root of the logarithm, where the approximation outside the middle is centred.
const OUTER: f64 = 1.6;

impl Quotient {
    fn at(&self, x: f64) -> f64 {
        let value = |polynomial: &[f64; 8]| {
            let powers = polynomial.iter().rev();
            powers.fold(0.0, |sum, coefficient| sum * x + coefficient)
        };
        value(&self.above) / value(&self.below)
    }
}

/// The deviation, in standard deviations, with this share of the distribution between it and the mean: negative
/// for a negative share. The share is within +-(0.5 - 1e-11), which is six deviations.
pub(super) fn deviation(share: f64) -> f64 {
    if share.abs() <= CENTRAL {
        return share * MIDDLE.at(CENTRAL * CENTRAL - share * share);
    }
    let beyond = 0.5 - share.abs();
    let root = (-ln(beyond)).sqrt();
    OUTSIDE.at(root - OUTER).copysign(share)
}

#[cfg(test)]
mod tests {
    use statrs::distribution::{ContinuousCDF, Normal};

    use super::deviation;

    #[test]
    fn quantiles_are_those_of_the_distribution() {
        // Wichura's own check values.
        for (share, expected) in [
            (-0.25, -0.674_489_750_196_081_7),
            (0.499, 3.090_232_306_167_813_5),
            (0.477_249_868_051_820_8, 2.0),
        ] {
            let found = deviation(share);
            assert!((found - expected).abs() < 4e-15, "{share}: {found}");
        }
        let normal = Normal::standard();
        for step in -4999..=4999 {
            let share = 1e-4 * f64::from(step);
            let (found, expected) = (deviation(share), normal.inverse_cdf(0.5 + share));
            assert!(
                (found - expected).abs() < 1e-12,
                "{share}: {found} {expected}"
            );
            assert_eq!(deviation(-share), -found);
        }
    }
}
