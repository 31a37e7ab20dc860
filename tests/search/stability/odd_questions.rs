//! Questions that leave little to choose, or weigh strangely.

use nalgebra::{Point3, Vector3};
use peenpose::control::Control;
use peenpose::evaluate::evaluate;
use peenpose::jet::{Replicates, Samples, Stream};
use peenpose::objective::Tally;
use peenpose::scenario::Scenario;
use peenpose::solve::{Status, solve};
use peenpose::trace::Tracer;
use peenpose::verdict::{Subject, Verdict};

use crate::common::held::held;
use crate::stability::{PLATE, best_objective, edited, scenario, search};

#[test]
fn with_nothing_to_choose_the_answer_is_the_question() {
    let held_plate = scenario(PLATE);
    let solution = search(&held_plate);
    assert_eq!(solution.status, Status::Converged);
    assert_eq!(solution.answers.len(), 1);
    assert_eq!(solution.answers[0].settings, held(&held_plate));
    // One pose, judged a few times; not a search.
    assert!(solution.poses < 20, "{}", solution.poses);
}

#[test]
fn a_single_free_setting_is_found_whichever_it_is() {
    let mass = scenario(PLATE).problem.shot.mass();
    // m (1 + E) v sin(incidence).
    let impulse = |speed: f64, incidence: f64| mass * 1.25 * speed * incidence.to_radians().sin();
    let cases = [
        (
            "incidence: 60 deg",
            "incidence: [20 deg, 80 deg]",
            impulse(10.0, 47.0),
        ),
        (
            "speed: 10 m/s",
            "speed: [2 m/s, 30 m/s]",
            impulse(17.0, 60.0),
        ),
        (
            "azimuth: 0 deg",
            "azimuth: [-90 deg, 90 deg]",
            impulse(10.0, 60.0),
        ),
        (
            "standoff: 10 mm",
            "standoff: [5 mm, 50 mm]",
            impulse(10.0, 60.0),
        ),
    ];
    for (line, range, wanted) in cases {
        let target = format!("target: {:?} N.s", wanted);
        let free = scenario(&edited(
            PLATE,
            &[(line, range), ("target: 40 uN.s", &target)],
        ));
        let solution = search(&free);
        assert_eq!(solution.status, Status::Converged, "{range}");
        // Where it makes no difference any value does; where it does, the right one is found.
        assert!(
            best_objective(&solution) < 1e-6,
            "{range}: {}",
            best_objective(&solution)
        );
        let best = solution.answers[0].settings;
        let found = impulse(best.speed, best.incidence.to_degrees());
        assert!((found / wanted - 1.0).abs() < 1e-3, "{range}");
    }
    // Friction alone: half of the limit on f* is mu_d N* where it slips.
    let tuned = scenario(&edited(
        PLATE,
        &[
            (
                "mu_s: 0.15, mu_d: 0.075",
                "mu_s: [0.02, 0.1], mu_d_ratio: 0.9",
            ),
            (
                "{ target: 40 uN.s }",
                "{ target: 39.6769 uN.s }\n  tangential_impulse: { limit: 1.5 uN.s }",
            ),
        ],
    ));
    let solution = search(&tuned);
    let found = solution.answers[0].settings.static_friction;
    assert!(
        found >= 0.02 && 0.9 * found * 39.6769 < 1.5 * 1.001,
        "{found}"
    );
}

#[test]
fn equal_contacts_are_equal_and_stay_in_their_order() {
    let line = "  only: { mu_s: 0.15, mu_d: 0.075, restitution: 0.25 }";
    let contacts: Vec<String> = ["zinc", "alum", "mica", "beta"]
        .iter()
        .map(|name| line.replace("only", name))
        .collect();
    let text = edited(
        PLATE,
        &[
            (line, &contacts.join("\n")),
            ("incidence: 60 deg", "incidence: [30 deg, 80 deg]"),
            ("standoff: 10 mm", "standoff: [5 mm, 20 mm]"),
            ("divergence: 0 deg", "divergence: 3 deg"),
            (
                "{ target: 40 uN.s }",
                "{ target: 40 uN.s }\n  tangential_impulse: { limit: 2 uN.s }",
            ),
        ],
    );
    for order in [None, Some("[mica, zinc, beta, alum]")] {
        let text = order.map_or_else(
            || text.clone(),
            |order| {
                edited(
                    &text,
                    &[(
                        "speed: 10 m/s",
                        &format!("speed: 10 m/s\n  contact: {order}"),
                    )],
                )
            },
        );
        let equal = scenario(&text);
        for _ in 0..2 {
            let solution = search(&equal);
            let found: Vec<usize> = solution
                .answers
                .iter()
                .map(|a| a.settings.contact)
                .collect();
            assert_eq!(found, equal.problem.ranges.contact);
            let total = |k: usize| {
                solution.answers[k]
                    .evaluation
                    .as_ref()
                    .unwrap()
                    .terms
                    .total()
            };
            for k in 1..4 {
                assert_eq!(total(k).to_bits(), total(0).to_bits());
            }
        }
    }
}

/// A parallel jet on a plate gives exactly what is wanted at some speed: what is left of J is
/// rounding, and no reason to go on.
#[test]
fn a_goal_that_is_reached_to_rounding_is_reached() {
    for wanted in [31, 37, 41, 43, 47, 53] {
        for seed in 1..=3 {
            let exact = scenario(&edited(
                PLATE,
                &[
                    ("target: 40 uN.s", &format!("target: {wanted} uN.s")),
                    ("incidence: 60 deg", "incidence: [50 deg, 80 deg]"),
                    ("speed: 10 m/s", "speed: [5 m/s, 20 m/s]"),
                    ("goals:", &format!("solve: {{ seed: {seed} }}\ngoals:")),
                ],
            ));
            let control = Control {
                validation_shots: 4096,
                ..Control::default()
            };
            let solution = solve(&exact, &control);
            assert!(best_objective(&solution) < 1e-29);
            assert_eq!(solution.status, Status::Converged, "{wanted} {seed}");
            assert_eq!(solution.shots_per_pose, 1024);
        }
    }
}

/// A target so small that exactly one of 1e5 shots hits it.
#[test]
fn one_shot_on_target_is_enough_to_count() {
    const SHOTS: usize = 100_000;
    let mut wide = scenario(&edited(
        PLATE,
        &[
            ("divergence: 0 deg", "divergence: 30 deg"),
            ("incidence: 60 deg", "incidence: 90 deg"),
            ("standoff: 10 mm", "standoff: 50 mm"),
            ("speed: 10 m/s", "speed: [1 m/s, 100 m/s]"),
            ("goals:", "goals:\n  rebound: { allow: 1e6 N.s }"),
        ],
    ));
    let settings = held(&wide);
    let samples = Samples::new(&wide.problem, Stream::Search, SHOTS);
    // Round the place where one of them lands.
    let mut place = Point3::origin();
    Tracer::new(&wide, &settings, 1.0)
        .follow(&samples.shots[54_321], |impact| place = impact.point);
    let around = Vector3::repeat(1e-8);
    wide.target.within = Some((place - around, place + around));
    let tally = Tally::trace(&wide, &settings, 1.0, &samples.shots);
    assert_eq!((tally.hits.len(), tally.shots), (1, SHOTS));
    assert_eq!(tally.missed, (SHOTS - 1) as f64);
    // Everything rests on it: the best speed gives it what is wanted.
    let goals = &wide.problem.goals;
    let speed = tally.best_speed(goals, wide.problem.ranges.speed);
    assert!((tally.hits.normal[0] * speed / 40e-6 - 1.0).abs() < 1e-12);
    let terms = tally.terms(goals, speed);
    assert!(terms.normal_impulse < 1e-20 && terms.tangential_impulse == 0.0);
    assert!((terms.miss - (1.0 - 1e-5)).abs() < 1e-12);
    // One that hits proves little, and the interval says so; nobody that hits proves nothing.
    let verdict = Verdict {
        subject: Subject::NormalImpulse,
        broken: 0,
        counted: 1,
        allowed: 0.05,
        is_exact: false,
        place: None,
    };
    assert!(verdict.passes() && !verdict.is_certain());
    wide.target.within = Some((place + around * 1e3, place + around * 1e3));
    let fresh = Replicates::new(&wide.problem, 5, 2048);
    let evaluation = evaluate(&wide, &settings, &fresh);
    assert_eq!(evaluation.target.hits, 0);
    assert!(evaluation.terms.total().is_finite() && evaluation.standard_error.is_finite());
    let verdicts = Verdict::all(&wide, &evaluation);
    for subject in [Subject::Miss, Subject::NormalImpulse] {
        let verdict = verdicts.iter().find(|verdict| verdict.subject == subject);
        assert!(!verdict.unwrap().passes(), "{subject:?}");
    }
}

/// The keyway in which limits conflict, with every weight times a factor.
fn weighted(factor: f64) -> Scenario {
    let weight = |share: f64| format!("{:?}", share * factor);
    scenario(&edited(
        include_str!("../../../problems/keyway.yaml"),
        &[
            (
                "share: 5 %, weight: 1 }\n  tang",
                &format!("share: 5 %, weight: {} }}\n  tang", weight(1.0)),
            ),
            (
                "limit: 8 uN.s, share: 5 %, weight: 1",
                &format!("limit: 8 uN.s, share: 5 %, weight: {}", weight(1.0)),
            ),
            ("weight: 0.5", &format!("weight: {}", weight(0.5))),
            (
                "miss: { share: 1 %, weight: 2 }",
                &format!("miss: {{ share: 1 %, weight: {} }}", weight(2.0)),
            ),
            ("contact: [dry, damp, oiled]", "contact: [damp]"),
        ],
    ))
}

/// J times a factor has its least value in the same place, and the search goes the same way there:
/// to the last digit for powers of two, which round nothing.
#[test]
fn a_common_factor_on_all_weights_changes_nothing() {
    let usual = search(&weighted(1.0));
    for power in [-60, -10, 10, 28] {
        let factor = 2.0_f64.powi(power);
        let found = search(&weighted(factor));
        assert_eq!(
            found.answers[0].settings, usual.answers[0].settings,
            "{factor}"
        );
        assert_eq!(found.poses, usual.poses, "{factor}");
        assert_eq!(best_objective(&found), factor * best_objective(&usual));
    }
}

/// Weights of 0 and 1e9 side by side: what has no weight does not count, what has it all rules.
#[test]
fn extreme_weights_rule() {
    let text = |normal: &str, tangential: &str| {
        edited(
            PLATE,
            &[
                ("incidence: 60 deg", "incidence: [30 deg, 85 deg]"),
                ("divergence: 0 deg", "divergence: 2 deg"),
                (
                    "{ target: 40 uN.s }",
                    &format!(
                        "{{ target: 45 uN.s, weight: {normal} }}\n  tangential_impulse: {{ limit: 0.5 uN.s, weight: {tangential} }}\n  miss: {{ weight: 0 }}"
                    ),
                ),
            ],
        )
    };
    let incidence = |normal, tangential| {
        let solution = search(&scenario(&text(normal, tangential)));
        let terms = solution.answers[0].evaluation.as_ref().unwrap().terms;
        assert!(terms.total().is_finite());
        (solution.answers[0].settings.incidence.to_degrees(), terms)
    };
    // Without the other: 45 uN.s needs 45/45.8 of the full speed, 79 deg.
    let (alone, terms) = incidence("1e9", "0");
    assert_eq!(terms.tangential_impulse, 0.0);
    assert!((alone - 79.2).abs() < 1.0, "{alone}");
    let (ruled, _) = incidence("1e9", "1");
    assert!((ruled - alone).abs() < 0.5, "{ruled} {alone}");
    // f* falls with incidence where the shots stick: as steep as may be.
    let (other, terms) = incidence("0", "1e9");
    assert_eq!(terms.normal_impulse, 0.0);
    assert!(other > 84.9, "{other}");
    let (nothing, terms) = incidence("0", "0");
    assert_eq!(terms.total(), 0.0);
    assert!((30.0..=85.0).contains(&nothing));
}
