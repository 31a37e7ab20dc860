//! The trade-off between target error, tangential risk and rebound.

use peenpose::control::Control;
use peenpose::feasibility::infeasibility;
use peenpose::problem::Problem;
use peenpose::problem::goal::TangentialImpulse;
use peenpose::record::FrontRecord;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::{Front, Objectives, front, objectives, solve};

use crate::common::shipped;

fn control() -> Control {
    Control {
        most_shots: 1024,
        validation_shots: 1 << 14,
        ..Control::default()
    }
}

fn front_of(scenario: &Scenario) -> Front {
    let solution = solve(scenario, &control());
    front(scenario, &solution.answers, &control())
}

fn all_risks(front: &Front) -> Vec<(Objectives, Objectives)> {
    let evaluations = front
        .answers
        .iter()
        .map(|it| it.evaluation.as_ref().unwrap());
    evaluations
        .map(|it| {
            let errors = &it.term_errors;
            let target = errors.normal_impulse.hypot(errors.miss);
            let of_risks = [target, errors.tangential_impulse, errors.rebound];
            (objectives(&it.terms), of_risks)
        })
        .collect()
}

/// One shot on a plate at 60 deg, sliding: only the speed is free.
fn plate(limit_share: f64) -> Scenario {
    let scenario = shipped::scenario("plate.yaml");
    let mut problem: Problem = scenario.problem;
    problem.ranges.contact = vec![4];
    problem.ranges.speed.min = 1.0;
    problem.ranges.speed.max = 40.0;
    let normal = problem.goals.normal_impulse.target;
    let friction = problem.contacts[4].contact.dynamic_friction;
    problem.goals.tangential_impulse = Some(TangentialImpulse {
        limit: limit_share * friction * normal,
        share: 0.05,
        weight: 1.0,
    });
    Scenario::new(problem, Walls::Exact).unwrap()
}

#[test]
fn on_a_plate_the_front_is_a_formula() {
    // With s = v / v0, v0 giving the target: target error (s - 1)^2, and since f* = mu_d N*, f* over
    // its limit is r s: tangential risk (r s - 1)^2 while r s > 1. Between s = 1/r and s = 1:
    // sqrt(tangential) = r (1 - sqrt(target)) - 1.
    let ratio: f64 = 1.6;
    let front = front_of(&plate(1.0 / ratio));
    let points = all_risks(&front);
    assert!(points.len() >= 5, "{points:?}");
    for ([target, tangential, rebound], _) in &points {
        assert_eq!(*rebound, 0.0);
        let expected = ratio * (1.0 - target.sqrt()) - 1.0;
        assert!(
            (tangential.sqrt() - expected).abs() < 1e-6,
            "{target} {tangential}"
        );
    }
    let (first, last) = (points[0].0, points[points.len() - 1].0);
    assert!(first[0] < 1e-10 && (first[1] - (ratio - 1.0).powi(2)).abs() < 1e-5);
    assert!(last[1] < 1e-10 && (last[0] - (1.0 - 1.0 / ratio).powi(2)).abs() < 1e-5);
    assert!(front.recommended.is_some());
}

#[test]
fn without_a_conflict_there_is_one_answer() {
    let front = front_of(&plate(1.25));
    assert_eq!(front.answers.len(), 1);
    assert_eq!(front.recommended, Some(0));
}

fn keyway() -> Scenario {
    let mut problem = crate::common::keyway(40e-3);
    problem.ranges.contact = vec![0, 2];
    Scenario::new(problem, Walls::Exact).unwrap()
}

#[test]
fn a_front_is_feasible_not_dominated_and_has_the_best_ends() {
    let scenario = keyway();
    let front = front_of(&scenario);
    let points = all_risks(&front);
    assert!(points.len() >= 4);
    assert!(points.is_sorted_by(|a, b| a.0[0] <= b.0[0]));
    for answer in &front.answers {
        assert!(infeasibility(&scenario, &answer.settings).is_none());
    }
    for (index, (objectives, errors)) in points.iter().enumerate() {
        for (other_index, (other, other_errors)) in points.iter().enumerate() {
            let beyond = |risk: usize| {
                let error = errors[risk].hypot(other_errors[risk]);
                other[risk] < objectives[risk] - 2.0 * error - 1e-9
            };
            let nowhere_worse = (0..3).all(|risk| other[risk] <= objectives[risk]);
            let is_dominated = nowhere_worse && (0..3).any(beyond);
            assert!(!is_dominated, "{index} by {other_index}: {points:?}");
        }
    }
    // A search for one risk alone finds nothing that is better than the end of the front.
    for alone in 0..3 {
        let mut single = scenario.clone();
        let goals = &mut single.problem.goals;
        let keep = |risk: usize| if risk == alone { 1.0 } else { 1e-6 };
        goals.normal_impulse.weight *= keep(0);
        goals.miss.weight *= keep(0);
        if let Some(goal) = &mut goals.tangential_impulse {
            goal.weight *= keep(1);
        }
        for limits in &mut single.surfaces {
            limits.weight *= keep(2);
        }
        let solution = solve(&single, &control());
        let best = solution.answers[0].evaluation.as_ref().unwrap();
        let found = objectives(&best.terms)[alone];
        let ends = points
            .iter()
            .map(|(objectives, errors)| (objectives[alone], errors[alone]));
        let (end, error) = ends.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        let allowed = 0.02 * found + 4.0 * error.max(best.standard_error);
        assert!(end <= found + allowed, "{alone}: {end} {found} {allowed}");
    }
}

#[test]
fn a_front_does_not_depend_on_the_threads() {
    let scenario = keyway();
    let records = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let front = pool.unwrap().install(|| front_of(&scenario));
        FrontRecord::all(&scenario, &front)
    });
    assert!(!records[0].is_empty());
    assert_eq!(records[0], records[1]);
}
