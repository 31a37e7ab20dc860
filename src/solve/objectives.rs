//! The three parts of J that are traded against each other.

use crate::objective::Terms;

/// Target error, tangential risk and rebound: each a part of J.
pub type Objectives = [f64; 3];

/// Target error (normal impulse and misses), tangential risk and rebound.
pub fn objectives(terms: &Terms) -> Objectives {
    [
        terms.normal_impulse + terms.miss,
        terms.tangential_impulse,
        terms.rebound,
    ]
}
