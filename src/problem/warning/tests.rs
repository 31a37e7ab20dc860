use super::*;
use crate::problem::equipment::SurfaceRule;
use crate::problem::example::{keyway, rule};

#[test]
fn any_weight_is_enough() {
    let weighing = |one: usize, other: usize| {
        let weight = |index: usize| f64::from(u8::from(index == one || index == other));
        let mut problem = keyway();
        let goals = &mut problem.goals;
        goals.normal_impulse.weight = weight(0);
        goals.tangential_impulse.as_mut().expect("given").weight = weight(1);
        goals.rebound.as_mut().expect("given").weight = weight(2);
        goals.miss.weight = weight(3);
        problem
    };
    for one in 0..4 {
        for other in 0..4 {
            assert_eq!(weights(&weighing(one, other)), None, "{one}, {other}");
        }
    }
    let none = weights(&weighing(9, 9)).expect("nothing weighs");
    assert_eq!(none.doubt, WarningCode::NothingWeighs);
}

#[test]
fn a_surface_weighs_where_something_limits_its_impacts() {
    let weighs_beside = |miss: f64, allow: Option<f64>, weight: Option<f64>| {
        let mut problem = keyway();
        problem.goals.normal_impulse.weight = 0.0;
        problem.goals.miss.weight = miss;
        problem.goals.tangential_impulse = None;
        problem.goals.rebound = None;
        problem.surfaces = vec![SurfaceRule {
            allow,
            weight,
            ..rule("hub.bore")
        }];
        weights(&problem).is_none()
    };
    let weighs = |allow, weight| weighs_beside(0.0, allow, weight);
    assert!(weighs_beside(0.5, Some(1e-6), Some(0.5)));
    assert!(weighs(Some(1e-6), Some(0.5)));
    assert!(weighs(Some(1e-6), None));
    assert!(!weighs(Some(1e-6), Some(0.0)));
    assert!(!weighs(None, Some(0.5)));
}

#[test]
fn the_target_may_have_a_contact_of_its_own() {
    // Without any bounce the fastest shot gives 161.3e-6 N.s, with a full one twice as much.
    let doubt = |surface: &str, target: f64| {
        let mut problem = keyway();
        problem.surfaces = vec![SurfaceRule {
            contact: Contact::new(0.1, 0.1, 1.0).ok(),
            ..rule(surface)
        }];
        problem.goals.normal_impulse.target = target;
        reachable_impulse(&problem).map(|warning| warning.doubt)
    };
    assert_eq!(doubt("hub.floor", 370e-6), None);
    assert_eq!(
        doubt("hub.floor", 372e-6),
        Some(WarningCode::ImpulseTooLarge)
    );
    assert_eq!(
        doubt("hub.bore", 232e-6),
        Some(WarningCode::ImpulseTooLarge)
    );
}

#[test]
fn a_target_is_compared_with_what_the_fastest_and_the_slowest_shot_give() {
    let doubt = |target: f64| {
        let mut problem = keyway();
        problem.goals.normal_impulse.target = target;
        reachable_impulse(&problem).map(|warning| warning.doubt)
    };
    // 3.6652e-6 kg at 40 m/s 1.1 give 201.6e-6 N.s with restitution, and 15 % more are allowed.
    assert_eq!(doubt(231.7e-6), None);
    assert_eq!(doubt(231.9e-6), Some(WarningCode::ImpulseTooLarge));
    // At 5 m/s and 30 deg they give 11.45e-6 N.s; a quarter of it is still believed.
    assert_eq!(doubt(2.87e-6), None);
    assert_eq!(doubt(2.86e-6), Some(WarningCode::ImpulseTooSmall));
}

#[test]
fn friction_may_be_as_high_as_its_tolerance_says() {
    let doubt = |limit: f64| {
        let mut problem = keyway();
        problem.tolerance.friction = 0.1;
        let goal = problem.goals.tangential_impulse.as_mut();
        goal.expect("given").limit = limit;
        friction_limit(&problem).map(|warning| warning.doubt)
    };
    // 0.30 1.1 times 40e-6 N.s 1.15
    assert_eq!(doubt(15.17e-6), None);
    assert_eq!(doubt(15.19e-6), Some(WarningCode::LimitBeyondFriction));
}

#[test]
fn a_shot_may_be_as_wide_as_the_exit() {
    let doubt = |exit_diameter: f64| {
        let mut problem = keyway();
        problem.jet.exit_diameter = exit_diameter;
        exit(&problem).map(|warning| warning.doubt)
    };
    assert_eq!(doubt(1e-3), None);
    assert_eq!(doubt(0.99e-3), Some(WarningCode::ExitTooSmall));
    // A point, which stands for no nozzle at all.
    assert_eq!(doubt(0.0), None);
}

#[test]
fn a_surface_may_take_what_the_target_takes() {
    let mut problem = keyway();
    problem.goals.normal_impulse.tolerance = 0.0;
    let target = problem.goals.normal_impulse.target;
    let mut doubts = |allow: f64| {
        problem.goals.rebound.as_mut().expect("given").allow = allow;
        allowances(&problem).len()
    };
    assert_eq!(doubts(target), 0);
    assert_eq!(doubts(target.next_up()), 1);
}
