//! Wall-clock measurements on one thread.

use std::hint::black_box;

use crate::control::Clock;

/// Least repeats of a measurement, least turns of a comparison, and least time of either, s.
const LEAST_REPEATS: usize = 5;
const LEAST_TURNS: usize = 99;
const LEAST_SECONDS: f64 = 0.01;

/// Time that some work takes, s: the median of its slices times their number, so that a busy
/// machine, which stretches long work most, does not tell much.
pub fn seconds<S: Copy, T>(clock: &Clock, slices: &[S], work: impl Fn(S) -> T) -> f64 {
    let mut turns = slices.iter().cycle();
    let slice = repeated(clock, LEAST_REPEATS.max(slices.len()), || {
        timed(clock, &mut || turns.next().map(|slice| work(*slice)))
    });
    slice * slices.len() as f64
}

/// Median of the time that some work takes over that of other work, taken in turns.
pub fn ratio<T>(clock: &Clock, mut work: impl FnMut() -> T, mut over: impl FnMut() -> T) -> f64 {
    repeated(clock, LEAST_TURNS, || {
        let first = timed(clock, &mut work);
        first / timed(clock, &mut over).max(f64::MIN_POSITIVE)
    })
}

fn timed<T>(clock: &Clock, work: &mut impl FnMut() -> T) -> f64 {
    let started = clock.seconds();
    black_box(work());
    clock.seconds() - started
}

fn repeated(clock: &Clock, least: usize, mut measurement: impl FnMut() -> f64) -> f64 {
    let started = clock.seconds();
    let mut values = Vec::new();
    let is_short = || {
        let elapsed = clock.seconds() - started;
        // A clock may stand still.
        0.0 < elapsed && elapsed < LEAST_SECONDS
    };
    while values.len() < least || is_short() {
        values.push(measurement());
    }
    median(values)
}

/// The value in the middle, the lower of two; 0 if there is none.
pub fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = (values.len() - 1) / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
