//! Numbers side by side: each quantity of many rays in a row, so that the compiler works on several
//! at once.

use nalgebra::Vector3;
use wide::f64x4;

/// Most rays side by side.
pub const LANES: usize = 128;

/// Most numbers that processors work on at once.
pub const WIDEST: usize = 16;

/// One quantity of all rays.
pub type Lane = [f64; LANES];

/// The number of lanes to work on so that no vector is left half full.
#[inline(always)]
pub fn padded(count: usize) -> usize {
    count.next_multiple_of(WIDEST).min(LANES)
}

/// The components of a vector, each four times.
#[inline(always)]
pub fn splat(vector: Vector3<f64>) -> [f64x4; 3] {
    [
        f64x4::splat(vector.x),
        f64x4::splat(vector.y),
        f64x4::splat(vector.z),
    ]
}

/// The components of one vector.
#[inline(always)]
pub fn components(lanes: &[Lane; 3], index: usize) -> [f64; 3] {
    [lanes[0][index], lanes[1][index], lanes[2][index]]
}

/// Sets the components of one vector.
#[inline(always)]
pub fn put(lanes: &mut [Lane; 3], index: usize, value: [f64; 3]) {
    lanes[0][index] = value[0];
    lanes[1][index] = value[1];
    lanes[2][index] = value[2];
}

/// The larger of two numbers; of what is not a number it is the second.
#[inline(always)]
pub fn larger<R: PartialOrd>(a: R, b: R) -> R {
    if a > b { a } else { b }
}

/// The smaller of two numbers, likewise.
#[inline(always)]
pub fn smaller<R: PartialOrd>(a: R, b: R) -> R {
    if a < b { a } else { b }
}

/// Whether something holds for any of some numbers, which are all looked at.
#[inline(always)]
pub fn any(numbers: &[f64], holds: impl Fn(f64) -> bool) -> bool {
    let holding = numbers.iter().map(|&number| u32::from(holds(number)));
    holding.sum::<u32>() > 0
}

/// The whole number, from 0 to less than 2^23, that a float is; anything for other floats. Compilers do
/// not convert several at once with `as`, which has to mind all floats.
#[inline(always)]
pub fn index(number: f64) -> u32 {
    const NO_FRACTIONS: f64 = (1_u64 << (f64::MANTISSA_DIGITS - 1)) as f64;
    (number + NO_FRACTIONS).to_bits() as u32 & ((1 << 23) - 1)
}

#[cfg(test)]
mod tests {
    use super::index;

    #[test]
    fn whole_numbers_are_indices() {
        for number in [0, 1, 2, 3, 1000, 65_537, (1 << 23) - 1] {
            assert_eq!(index(f64::from(number)), number);
        }
    }
}
