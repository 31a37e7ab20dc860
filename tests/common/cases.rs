//! How many cases a property is tried on, and which.

use std::env;

use proptest::test_runner::{Config, RngSeed};

/// So many cases, the same in every run, unless the environment asks for others with
/// `PROPTEST_CASES` and `PROPTEST_RNG_SEED`.
pub fn cases(count: u32) -> Config {
    let asked = Config::default();
    Config {
        cases: match env::var_os("PROPTEST_CASES") {
            Some(_) => asked.cases,
            None => count,
        },
        rng_seed: match asked.rng_seed {
            RngSeed::Random => RngSeed::Fixed(1),
            fixed => fixed,
        },
        failure_persistence: None,
        ..asked
    }
}
