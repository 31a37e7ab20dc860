//! Wall-clock measurements on one thread.

use std::hint::black_box;
use std::time::Instant;

/// A measurement takes at least so many repeats, a comparison so many turns, and so long, s.
const LEAST_REPEATS: usize = 5;
const LEAST_TURNS: usize = 99;
const LEAST_SECONDS: f64 = 0.01;

/// Time that some work takes, s: the median of its slices times their number, so that a busy
/// machine, which stretches long work most, does not tell much.
pub fn seconds<S: Copy, T>(slices: &[S], work: impl Fn(S) -> T) -> f64 {
    let mut turns = slices.iter().cycle();
    let slice = repeated(LEAST_REPEATS.max(slices.len()), || {
        timed(&mut || turns.next().map(|slice| work(*slice)))
    });
    slice * slices.len() as f64
}

/// Median of the time that some work takes over that of other work, taken in turns.
pub fn ratio<T>(mut work: impl FnMut() -> T, mut over: impl FnMut() -> T) -> f64 {
    repeated(LEAST_TURNS, || {
        let first = timed(&mut work);
        first / timed(&mut over)
    })
}

fn timed<T>(work: &mut impl FnMut() -> T) -> f64 {
    let started = Instant::now();
    black_box(work());
    started.elapsed().as_secs_f64()
}

fn repeated(least: usize, mut measurement: impl FnMut() -> f64) -> f64 {
    let started = Instant::now();
    let mut values = Vec::new();
    while values.len() < least || started.elapsed().as_secs_f64() < LEAST_SECONDS {
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
