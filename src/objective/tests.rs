//! Terms worked out by hand.

use super::*;
use crate::problem::goal::{Miss, NormalImpulse, TangentialImpulse};

/// Whose rebounds have no goal of their own: their weight is in their sum.
const GOALS: Goals = Goals {
    normal_impulse: NormalImpulse {
        target: 1.0,
        tolerance: 0.1,
        share: 0.1,
        weight: 2.0,
    },
    tangential_impulse: Some(TangentialImpulse {
        limit: 1.0,
        share: 0.1,
        weight: 3.0,
    }),
    rebound: None,
    miss: Miss {
        share: 0.1,
        weight: 5.0,
    },
};

const ONE: Sums = Sums {
    weight: 8.0,
    missed: 3.0,
    normal: 10.0,
    tangential: 20.0,
    rebound: 40.0,
    worst_miss: 1.0,
    worst_rebound: 16.0,
};

const OTHER: Sums = Sums {
    weight: 24.0,
    missed: 4.0,
    normal: 15.0,
    tangential: 30.0,
    rebound: 56.0,
    worst_miss: 2.0,
    worst_rebound: 12.0,
};

#[test]
fn sums_of_two_sets_of_shots_add_up_and_the_worst_stays() {
    let both = Sums {
        weight: 32.0,
        missed: 7.0,
        normal: 25.0,
        tangential: 50.0,
        rebound: 96.0,
        worst_miss: 2.0,
        worst_rebound: 16.0,
    };
    assert_eq!(ONE.plus(&OTHER), both);
    assert_eq!(OTHER.plus(&ONE), both);
}

#[test]
fn terms_of_the_target_are_means_over_hits_and_the_others_over_all_shots() {
    let terms = ONE.terms(&GOALS);
    let by_hand = Terms {
        normal_impulse: 2.0 * 10.0 / 5.0,
        tangential_impulse: 3.0 * 20.0 / 5.0,
        rebound: 40.0 / 8.0,
        miss: 5.0 * 3.0 / 8.0,
    };
    assert_eq!(terms, by_hand);
    assert_eq!(terms.total(), 4.0 + 12.0 + 5.0 + 1.875);
    let never = Sums { missed: 8.0, ..ONE };
    assert_eq!(never.terms(&GOALS).normal_impulse, 0.0);
    assert_eq!(never.terms(&GOALS).tangential_impulse, 0.0);
}

#[test]
fn one_more_of_the_worst_adds_its_part_over_all_shots() {
    let by_hand = Terms {
        rebound: 16.0 / 8.0,
        miss: 5.0 * 1.0 / 8.0,
        ..Terms::default()
    };
    assert_eq!(ONE.one_more_of_the_worst(&GOALS), by_hand);
    let other = Terms {
        rebound: 12.0 / 24.0,
        miss: 5.0 * 2.0 / 24.0,
        ..Terms::default()
    };
    assert_eq!(OTHER.one_more_of_the_worst(&GOALS), other);
}
