//! Elementary functions that give the same bits on every machine.
//!
//! Those of [`f64`] are the system's: their last bit depends on its C library, and within one such
//! library on the processor. Here they come from the `libm` crate, which is Rust throughout: additions,
//! multiplications, divisions and square roots in a fixed order, each of which IEEE 754 rounds in one way.
//! So all that is computed takes them from here, and nowhere from [`f64`].
//!
//! Absolute values, square roots, remainders and roundings to whole numbers are exact or correctly
//! rounded everywhere, and stay those of [`f64`].

/// Sine of an angle, rad.
#[inline]
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}

/// Cosine of an angle, rad.
#[inline]
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// Sine and cosine of an angle, rad.
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// Tangent of an angle, rad.
#[inline]
pub fn tan(angle: f64) -> f64 {
    libm::tan(angle)
}

/// The angle within +-pi/2 of a sine, rad.
#[inline]
pub fn asin(sine: f64) -> f64 {
    libm::asin(sine)
}

/// The angle within +-pi/2 of a tangent, rad.
#[inline]
pub fn atan(tangent: f64) -> f64 {
    libm::atan(tangent)
}

/// The angle within +-pi from the x axis to a point, rad.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// e to the power of a number.
#[inline]
pub fn exp(exponent: f64) -> f64 {
    libm::exp(exponent)
}

/// e to the power of a number, minus 1, without the rounding of the difference.
#[inline]
pub fn exp_m1(exponent: f64) -> f64 {
    libm::expm1(exponent)
}

/// Natural logarithm.
#[inline]
pub fn ln(number: f64) -> f64 {
    libm::log(number)
}

/// Natural logarithm of 1 plus a number, without the rounding of the sum.
#[inline]
pub fn ln_1p(number: f64) -> f64 {
    libm::log1p(number)
}

/// Logarithm to the base 10.
#[inline]
pub fn log10(number: f64) -> f64 {
    libm::log10(number)
}

/// A number to any power.
#[inline]
pub fn power(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// The smallest and the largest of some numbers; inf and -inf where there are none. NaN is left out. Of zeros with
/// different signs the first one counts, where [`f64::min`] leaves the choice to the machine.
pub(crate) fn extremes(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    numbers.fold(none, |(low, high), number| {
        let low = if number < low { number } else { low };
        (low, if number > high { number } else { high })
    })
}

/// A number times itself.
#[inline(always)]
pub fn square(number: f64) -> f64 {
    number * number
}

/// The third power of a number.
#[inline(always)]
pub fn cube(number: f64) -> f64 {
    number * number * number
}

/// A number to a whole power. The standard library's own leaves open in which order it multiplies.
#[inline]
pub fn whole_power(base: f64, exponent: i32) -> f64 {
    let (mut square, mut left) = (base, exponent.unsigned_abs());
    let mut power = 1.0;
    while left != 0 {
        if left & 1 == 1 {
            power *= square;
        }
        square *= square;
        left >>= 1;
    }
    if exponent < 0 { 1.0 / power } else { power }
}

/// Length of the hypotenuse, without overflow on the way.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}
