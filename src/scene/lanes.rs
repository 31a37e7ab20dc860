//! Numbers side by side: each quantity of many rays in a row, so that the compiler works on several
//! at once.

/// Most rays side by side.
pub const LANES: usize = 128;

/// Most numbers that processors work on at once.
pub const WIDEST: usize = 16;

/// One quantity of all rays.
pub type Lane<R> = [R; LANES];

/// The number of lanes to work on so that no vector is left half full.
#[inline(always)]
pub fn padded(count: usize) -> usize {
    count.next_multiple_of(WIDEST).min(LANES)
}

/// The components of one vector.
#[inline(always)]
pub fn components<R: Copy>(lanes: &[Lane<R>; 3], index: usize) -> [R; 3] {
    [lanes[0][index], lanes[1][index], lanes[2][index]]
}

/// Sets the components of one vector.
#[inline(always)]
pub fn put<R: Copy>(lanes: &mut [Lane<R>; 3], index: usize, value: [R; 3]) {
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
pub fn any<R: Copy>(numbers: &[R], holds: impl Fn(R) -> bool) -> bool {
    let holding = numbers.iter().map(|&number| u32::from(holds(number)));
    holding.sum::<u32>() > 0
}
