//! The jump between slip and stick.

use nalgebra::Vector3;
use peenpose::evaluate::evaluate;
use peenpose::impact::{Contact, Law, Rebound, Regime, rebound};
use peenpose::jet::Replicates;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;

use crate::common::held::held;
use crate::stability::{PLATE, best_objective, edited, scenario, search, terms};

/// A flat impact without spin.
fn flat(contact: &Contact, slip: f64, approach: f64) -> Rebound {
    let velocity = Vector3::new(slip, 0.0, -approach);
    rebound(contact, &velocity, &Vector3::zeros(), &Vector3::z()).unwrap()
}

fn contact(law: Law, static_friction: f64, dynamic_friction: f64, restitution: f64) -> Contact {
    Contact {
        law,
        ..Contact::new(static_friction, dynamic_friction, restitution).unwrap()
    }
}

/// With E = 0, v_n = -1 and mu = 2/7 the threshold is exactly at a slip of 1: Eq. 22 says stick.
#[test]
fn at_the_threshold_itself_a_contact_sticks() {
    let friction = 2.0 / 7.0;
    let jumping = contact(Law::StickSlip, friction, friction / 2.0, 0.0);
    let continuous = contact(Law::Kinetic, friction, friction, 0.0);
    for contact in [jumping, continuous] {
        let regime = |slip| flat(&contact, slip, 1.0).regime;
        assert_eq!(regime(1.0_f64.next_down()), Regime::Stick);
        assert_eq!(regime(1.0), Regime::Stick);
        assert_eq!(regime(1.0_f64.next_up()), Regime::Slip);
    }
    // One step of the last digit halves the impulse under the one law and keeps it under the other.
    let jump = |contact| {
        flat(contact, 1.0_f64.next_up(), 1.0).tangential / flat(contact, 1.0, 1.0).tangential
    };
    assert!((jump(&jumping) - 0.5).abs() < 1e-15);
    assert!((jump(&continuous) - 1.0).abs() < 1e-15);
}

/// The largest slip that sticks, by halving down to neighbouring numbers.
fn last_that_sticks(contact: &Contact, approach: f64) -> f64 {
    let (mut sticks, mut slips) = (0.0, 1e3 * approach);
    loop {
        let middle = 0.5 * (sticks + slips);
        if middle == sticks || middle == slips {
            return sticks;
        }
        match flat(contact, middle, approach).regime {
            Regime::Stick => sticks = middle,
            Regime::Slip => slips = middle,
        }
    }
}

#[test]
fn between_neighbouring_numbers_the_regime_changes_once() {
    for law in [Law::StickSlip, Law::Kinetic] {
        for (static_friction, dynamic_friction) in [(0.3, 0.27), (0.15, 0.01), (1.0, 1.0)] {
            for (restitution, approach) in [(0.25, 8.7), (0.0, 1e-3), (1.0, 333.3)] {
                let contact = contact(law, static_friction, dynamic_friction, restitution);
                let last = last_that_sticks(&contact, approach);
                let holds = match law {
                    Law::Kinetic => dynamic_friction,
                    _ => static_friction,
                };
                let expected = 3.5 * holds * (1.0 + restitution) * approach;
                assert!((last / expected - 1.0).abs() < 1e-14);
                // No flicker: rounding makes no island on either side.
                let mut slip = last;
                for _ in 0..500 {
                    assert_eq!(flat(&contact, slip, approach).regime, Regime::Stick);
                    slip = slip.next_down();
                }
                slip = last.next_up();
                for _ in 0..500 {
                    assert_eq!(flat(&contact, slip, approach).regime, Regime::Slip);
                    slip = slip.next_up();
                }
                let jump = flat(&contact, last, approach).tangential
                    / flat(&contact, last.next_up(), approach).tangential;
                assert!((jump - holds / dynamic_friction).abs() < 1e-13, "{jump}");
            }
        }
    }
}

/// What a naive derivative makes of the jump: a number that grows without bound as its step falls.
#[test]
fn finite_differences_diverge_at_the_jump_and_not_under_the_kinetic_law() {
    let slope = |contact: &Contact, step: f64| {
        let last = last_that_sticks(contact, 5.0);
        let at = |slip| flat(contact, slip, 5.0).tangential;
        (at(last + step) - at(last - step)) / (2.0 * step)
    };
    let jumping = contact(Law::StickSlip, 0.2, 0.1, 0.5);
    let continuous = contact(Law::Kinetic, 0.2, 0.1, 0.5);
    // (mu_s - mu_d) (1 + E) |v_n|.
    let jump = 0.1 * 1.5 * 5.0;
    for step in [1e-4, 1e-6, 1e-8] {
        let naive = slope(&jumping, step);
        assert!((naive * 2.0 * step / -jump - 1.0).abs() < 1e-3, "{naive}");
        // From 2/7 in the stick to 0 in the slip.
        let bounded = slope(&continuous, step);
        assert!((bounded - 1.0 / 7.0).abs() < 1e-6, "{bounded}");
    }
}

/// The plate with a limit on tangential impulse that is always exceeded.
fn plate(law: &str, divergence: &str) -> Scenario {
    scenario(&edited(
        PLATE,
        &[
            (
                "restitution: 0.25 }",
                &format!("restitution: 0.25, law: {law} }}"),
            ),
            ("divergence: 0 deg", &format!("divergence: {divergence}")),
            (
                "40 uN.s }",
                "40 uN.s }\n  tangential_impulse: { limit: 0.1 uN.s }",
            ),
        ],
    ))
}

/// The settings at an angle from that at which the axis of the jet begins to stick.
fn beside_threshold(scenario: &Scenario, angle: f64) -> Settings {
    let threshold = scenario.problem.contacts[0]
        .contact
        .stick_tangent(1.0)
        .atan();
    Settings {
        incidence: threshold + angle,
        ..held(scenario)
    }
}

#[test]
fn a_narrow_jet_jumps_under_the_paper_s_law_and_not_under_the_kinetic_one() {
    let change = |scenario: &Scenario, angle: f64| {
        let at = |angle| terms(scenario, &beside_threshold(scenario, angle), 64).tangential_impulse;
        (at(angle) / at(-angle) - 1.0).abs()
    };
    let (jumping, continuous) = (plate("stick_slip", "0 deg"), plate("kinetic", "0 deg"));
    for angle in [1e-4, 1e-7, 1e-10] {
        // mu_d = mu_s / 2, and the term is nearly quadratic in f*: about four times as much.
        assert!(change(&jumping, angle) > 2.5);
        assert!(change(&continuous, angle) < 10.0 * angle + 1e-14);
    }
}

/// The directions of a wide jet spread the jump over the cone: of n shots each adds a jump of 1/n.
#[test]
fn a_wide_jet_crosses_the_threshold_shot_by_shot() {
    const SHOTS: usize = 2048;
    let wide = plate("stick_slip", "4 deg");
    let half_angle = wide.problem.jet.divergence;
    let fresh = Replicates::without_boundary(&wide.problem, 5, SHOTS);
    let sticking = |angle: f64| {
        let target = evaluate(&wide, &beside_threshold(&wide, angle), &fresh).target;
        assert_eq!(target.hits, SHOTS);
        target.sticking
    };
    // Nothing sticks before the cone reaches the threshold, everything when it is past it.
    assert_eq!(sticking(-1.001 * half_angle), 0);
    assert_eq!(sticking(1.001 * half_angle), SHOTS);
    let steps = 200;
    let counts: Vec<usize> = (0..=steps)
        .map(|k| sticking(half_angle * (2.0 * f64::from(k) / f64::from(steps) - 1.0)))
        .collect();
    assert!(counts.is_sorted());
    let largest = counts.windows(2).map(|pair| pair[1] - pair[0]).max();
    assert!(largest.unwrap() < SHOTS / 50, "{largest:?}");

    // So J has no cliff wider than a few shots; but its naive derivative is worthless all the same:
    // either no shot changes side within the step, or one does, and the step divides its jump.
    let value = |angle: f64| terms(&wide, &beside_threshold(&wide, angle), 256).tangential_impulse;
    let slope = |angle: f64, step: f64| (value(angle + step) - value(angle - step)) / (2.0 * step);
    let true_slope = slope(0.0, 0.2 * half_angle);
    let angles = (0..100).map(|k| half_angle * (f64::from(k) / 100.0 - 0.5));
    let naive: Vec<f64> = angles.map(|angle| slope(angle, 1e-6)).collect();
    let typical = naive.iter().filter(|slope| **slope * true_slope < 0.0);
    assert!(typical.count() > 50, "{naive:?}");
    assert!(
        naive
            .iter()
            .any(|slope| slope.abs() > 20.0 * true_slope.abs())
    );
}

/// A normal impulse that is reached only at steep angles, and a tangential limit that sticking
/// exceeds: the optimum is the last angle that slips.
#[test]
fn a_search_ends_at_the_foot_of_the_cliff() {
    for divergence in ["0 deg", "0.01 deg"] {
        let cliff = scenario(&edited(
            PLATE,
            &[
                ("divergence: 0 deg", &format!("divergence: {divergence}")),
                ("incidence: 60 deg", "incidence: [40 deg, 70 deg]"),
                // m (1 + E) v at perpendicular incidence.
                (
                    "{ target: 40 uN.s }",
                    "{ target: 45.8 uN.s }\n  tangential_impulse: { limit: 3 uN.s, weight: 10 }",
                ),
            ],
        ));
        let threshold = beside_threshold(&cliff, 0.0).incidence;
        // The naive derivative at the cliff has the wrong sign and a size that says nothing.
        let at = |angle: f64| terms(&cliff, &beside_threshold(&cliff, angle), 64).total();
        let below = (at(-2e-3) - at(-3e-3)) / 1e-3;
        let across = (at(5e-4) - at(-5e-4)) / 1e-3;
        assert!(below < 0.0 && across > -100.0 * below, "{below} {across}");

        let solution = search(&cliff);
        let found = solution.answers[0].settings.incidence;
        let short = threshold - found;
        assert!(
            (0.0..0.3_f64.to_radians()).contains(&short),
            "{} deg short",
            short.to_degrees()
        );
        let least = at(-cliff.problem.jet.divergence - 1e-9);
        let excess = best_objective(&solution) / least - 1.0;
        assert!(excess < 0.03, "{excess}");
    }
}
