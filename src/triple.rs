//! Vectors by their components, for loops over many rays at once.
//!
//! They are written out component by component: `map` and the like are not always inlined, and then
//! compilers cannot work on several at once.

/// A vector by its components.
pub(crate) type Triple = [f64; 3];

#[inline(always)]
pub(crate) fn dot(a: Triple, b: Triple) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn cross(a: Triple, b: Triple) -> Triple {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// a + b s.
#[inline(always)]
pub(crate) fn along(a: Triple, b: Triple, s: f64) -> Triple {
    [a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s]
}

/// The unit vector along another.
#[inline(always)]
pub(crate) fn unit(vector: Triple) -> Triple {
    scaled(vector, 1.0 / dot(vector, vector).sqrt())
}

/// a s.
#[inline(always)]
pub(crate) fn scaled(a: Triple, s: f64) -> Triple {
    [a[0] * s, a[1] * s, a[2] * s]
}
