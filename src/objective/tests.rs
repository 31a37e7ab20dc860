//! Terms worked out by hand.

use super::accumulator::largest;
use super::*;
use crate::problem::goal::{Miss, NormalImpulse, TangentialImpulse};
use crate::problem::setting::Range;
use crate::scene::lanes::LANES;

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
    hits_of_jet: 4.0,
    normal: 10.0,
    tangential: 20.0,
    rebound: 40.0,
    worst_miss: 1.0,
    worst_rebound: 16.0,
};

const OTHER: Sums = Sums {
    weight: 24.0,
    missed: 4.0,
    hits_of_jet: 16.0,
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
        hits_of_jet: 20.0,
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
        normal_impulse: 2.0 * 10.0 / 4.0,
        tangential_impulse: 3.0 * 20.0 / 5.0,
        rebound: 40.0 / 8.0,
        miss: 5.0 * 3.0 / 8.0,
    };
    assert_eq!(terms, by_hand);
    assert_eq!(terms.total(), 5.0 + 12.0 + 5.0 + 1.875);
    let never = Sums {
        missed: 8.0,
        hits_of_jet: 0.0,
        ..ONE
    };
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

/// Three hits; the second one stands for half a shot and is drawn towards the boundary.
fn hits() -> Hits {
    Hits {
        normal: vec![0.5, 0.25, 0.375],
        normal_at_mean: vec![0.5, 0.25, 0.375],
        tangential: vec![0.125, 0.5, 0.25],
        weight: vec![1.0, 0.5, 1.0],
        of_jet: vec![1.0, 0.0, 1.0],
    }
}

#[test]
fn hits_off_the_wanted_impulse_and_over_the_limit_are_counted() {
    // At 2 m/s normal impulses are 1, 0.5 and 0.75 where 1 is wanted, and tangential ones 0.25, 1 and 0.5.
    assert_eq!(hits().off_target(&GOALS, 2.0).count(), 2);
    assert_eq!(hits().over_limit(&GOALS, 2.0).count(), 0);
    assert_eq!(hits().over_limit(&GOALS, 2.5).count(), 1);
    assert_eq!(hits().over_limit(&GOALS, 5.0).count(), 2);
    let only = |tolerance| Goals {
        normal_impulse: NormalImpulse {
            tolerance,
            ..GOALS.normal_impulse
        },
        tangential_impulse: None,
        ..GOALS
    };
    assert_eq!(hits().off_target(&only(0.25), 2.0).count(), 1);
    assert_eq!(hits().off_target(&only(0.5), 2.0).count(), 0);
    assert_eq!(hits().over_limit(&only(0.25), 100.0).count(), 0);
    assert_eq!(hits().most_tangential(), 0.5);
    assert_eq!(Hits::default().most_tangential(), 0.0);
}

#[test]
fn tallies_add_up_and_sums_go_with_the_square_of_the_speed() {
    let tally = Tally {
        shots: 4,
        weight: 3.5,
        missed: 1.0,
        hits: hits(),
        rebound: 6.0,
        worst_miss: 1.0,
        worst_rebound: 5.0,
        speed_variance: 0.0,
        rays: 9,
    };
    let other = Tally {
        shots: 3,
        rays: 4,
        worst_rebound: 7.0,
        ..tally.clone()
    };
    let sums = tally.sums(&GOALS, 4.0);
    let by_hand = Sums {
        weight: 3.5,
        missed: 1.0,
        // Of the jet, impulses of 2 and 1.5 where 1 is wanted; of all, 0.5, 2 and 1 where 1 is allowed.
        hits_of_jet: 2.0,
        normal: 1.0 + 0.25,
        tangential: 0.5 * 1.0,
        rebound: 96.0,
        worst_miss: 1.0,
        worst_rebound: 80.0,
    };
    assert_eq!(sums, by_hand);
    let both = Tally::join(vec![tally.clone(), other]);
    assert_eq!((both.shots, both.rays, both.hits.len()), (7, 13, 6));
    assert_eq!(both.worst_rebound, 7.0);
    let twice = Sums {
        worst_rebound: 7.0 * 16.0,
        ..sums.plus(&sums)
    };
    assert_eq!(both.sums(&GOALS, 4.0), twice);
}

#[test]
fn the_normal_impulse_is_averaged_over_speeds_that_scatter() {
    let exact = Tally {
        shots: 3,
        weight: 2.5,
        hits: Hits {
            // As they were drawn; they have no part in J.
            normal: vec![0.6, 0.2, 0.5],
            ..hits()
        },
        ..Tally::default()
    };
    let scattered = Tally {
        speed_variance: 0.0625,
        ..exact.clone()
    };
    // Speeds of 3 and 5 m/s have a mean of 4 and a relative variance of 1/16.
    let square = |speed: f64| exact.sums(&GOALS, speed).normal;
    assert_eq!(square(4.0), 1.0 + 0.25);
    assert_eq!(
        scattered.sums(&GOALS, 4.0).normal,
        0.5 * (square(3.0) + square(5.0))
    );
    let both = Tally::join(vec![scattered.clone(), scattered.clone()]);
    assert_eq!(both.terms(&GOALS, 4.0), scattered.terms(&GOALS, 4.0));
    // Scatter costs less where impulses are smaller.
    let range = Range {
        min: 0.5,
        max: 20.0,
    };
    let best = scattered.best_speed(&GOALS, range);
    assert!(best < exact.best_speed(&GOALS, range));
    let objective = |speed: f64| scattered.terms(&GOALS, speed).total();
    assert!(objective(best) < objective(best * 1.001).min(objective(best / 1.001)));
}

#[test]
fn the_best_speed_is_where_j_is_least() {
    let tally = Tally {
        shots: 4,
        weight: 3.5,
        missed: 1.0,
        hits: hits(),
        rebound: 0.25,
        ..Tally::default()
    };
    let objective = |speed: f64| tally.terms(&GOALS, speed).total();
    for (min, max) in [(0.5, 20.0), (0.5, 1.0), (4.0, 20.0), (2.0, 2.0)] {
        let best = tally.best_speed(&GOALS, Range { min, max });
        let steps = (0..=4000).map(|step| min + (max - min) * f64::from(step) / 4000.0);
        let least = steps.map(objective).fold(f64::INFINITY, f64::min);
        assert!((min..=max).contains(&best), "{best}");
        assert!(objective(best) <= least * (1.0 + 1e-12), "{best}");
    }
}

#[test]
fn the_largest_of_a_row_is_sought_as_far_as_it_is_filled() {
    let mut row = [0.0; LANES];
    row[..4].copy_from_slice(&[0.5, 3.0, 2.0, 7.0]);
    assert_eq!(largest(&row, 3), 3.0);
    assert_eq!(largest(&row, 4), 7.0);
    assert_eq!(largest(&row, 0), 0.0);
}
