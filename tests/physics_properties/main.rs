//! What physics asks of whole paths and evaluations, in worlds at random: laws of mechanics from the
//! nozzle to the end of every path, and answers that do not depend on where the world stands, how it is
//! turned, in which units, at which scale, in which order and under which names it is written down.
//!
//! Rounding grows from impact to impact: a flight of length L after a wall of radius R multiplies it by
//! 1 + 2 L/R. Round pins of 0.3 mm and flights of 10 mm make it up to 100 times larger each time.

#[path = "../common/held.rs"]
mod held;
mod laws;
mod views;
mod world;

/// Relative rounding of a path in its impact of this number, the first being 0.
fn rounding(number: usize) -> f64 {
    1e-12 * 100_f64.powi(number as i32)
}
