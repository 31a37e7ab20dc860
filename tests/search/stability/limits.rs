//! Impacts at the ends of what the model allows.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Point3, Vector3};
use peenpose::evaluate::{Evaluation, evaluate};
use peenpose::impact::{Contact, Oblique, Regime, Sphere};
use peenpose::jet::{Replicates, Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::trace::End;

use crate::common::held::held;
use crate::stability::{PLATE, Random, edited, path, scenario};

/// A room of 20 mm, seen from inside, in which every wall has one contact.
fn room(contact: &str, impacts: usize) -> Scenario {
    scenario(&edited(
        PLATE,
        &[
            (
                "plate: { box: { min: [-50, -50, -10], max: [50, 50, 0] } }",
                "plate: { box: { min: [-10, -10, -10], max: [10, 10, 10] } }",
            ),
            ("aim: [0, 0, 0]", "aim: [0, 0, 10], facing: [0, 0, -1]"),
            ("mu_s: 0.15, mu_d: 0.075, restitution: 0.25", contact),
            (
                "goals:",
                &format!("paths: {{ impacts: {impacts}, least_energy: 0 % }}\ngoals:"),
            ),
        ],
    ))
}

fn evaluated(scenario: &Scenario, settings: &Settings) -> Evaluation {
    evaluate(
        scenario,
        settings,
        &Replicates::new(&scenario.problem, 5, 1024),
    )
}

#[test]
fn perpendicular_shots_come_straight_back_whatever_the_azimuth() {
    // The direction of slip is 0/0 to who divides by it unasked.
    let naive = Vector3::new(0.0, 0.0, 0.0) / Vector3::<f64>::zeros().norm();
    assert!(naive.x.is_nan());

    let plate = scenario(PLATE);
    let mass = plate.problem.shot.mass();
    // Zeros of either sign: 1/-0 is the other infinity.
    for (x, y) in [(0.0, 0.0), (-0.0, 0.0), (0.0, -0.0), (-0.0, -0.0)] {
        let start = Point3::new(0.001, 0.002, 0.01);
        let (impacts, end) = path(&plate, start, Vector3::new(x, y, -1.0));
        assert_eq!((impacts.len(), end), (1, End::Left), "{x} {y}");
        assert_eq!(impacts[0].tangential_impulse, 0.0);
        assert_eq!(impacts[0].regime, Regime::Stick);
        assert_eq!(impacts[0].velocity, Vector3::new(0.0, 0.0, 2.5));
    }

    for azimuth in (-12..=12).map(|k| f64::from(k) * PI / 12.0) {
        let settings = Settings {
            incidence: FRAC_PI_2,
            azimuth,
            ..held(&plate)
        };
        let target = evaluated(&plate, &settings).target;
        assert_eq!(target.off_target, target.hits);
        assert!((target.normal_impulse.mean / (mass * 12.5) - 1.0).abs() < 1e-13);
        assert!(target.tangential_impulse.largest <= 1e-15 * target.normal_impulse.mean);
    }
}

#[test]
fn half_of_a_cone_along_the_plate_misses_it_and_the_rest_grazes() {
    // So large that every shot below the horizon lands on it, seen from 4 mm above.
    let plate = scenario(&edited(
        PLATE,
        &[
            (
                "min: [-50, -50, -10], max: [50, 50, 0]",
                "min: [-1e6, -1e6, -10], max: [1e6, 1e6, 0]",
            ),
            ("divergence: 0 deg", "divergence: 10 deg"),
            ("incidence: 60 deg", "incidence: 5 deg"),
            ("standoff: 10 mm", "standoff: 45 mm"),
        ],
    ));
    let settings = held(&plate);
    let samples = Samples::new(&plate.problem, Stream::Search, 4096);
    let tally = Tally::trace(&plate, &settings, settings.speed, &samples.shots);
    // Components towards the plate, from the definition of the jet.
    let (sin, cos) = settings.incidence.sin_cos();
    let sinking = samples.shots.iter().map(|sample| {
        let [_, upward, forward] = sample.cone;
        forward * sin - upward * cos
    });
    let sinking: Vec<f64> = sinking.filter(|&sinking| sinking > 0.0).collect();
    assert!((0.2..0.9).contains(&(sinking.len() as f64 / 4096.0)));
    assert_eq!(tally.hits.len(), sinking.len());
    assert_eq!(tally.missed, 4096.0 - sinking.len() as f64);
    let per_speed = plate.problem.shot.mass() * 1.25;
    for (hit, sinking) in tally.hits.iter().zip(&sinking) {
        assert!((hit.normal / (per_speed * sinking) - 1.0).abs() < 1e-12);
        // All of them slip: f* = mu_d N*.
        assert!((hit.tangential / hit.normal - 0.075).abs() < 1e-12);
    }
}

#[test]
fn shots_in_the_plane_of_a_surface_get_no_negative_impulse() {
    let plate = scenario(PLATE);
    for height in [0.0, 1e-300, 1e-18, 1e-15, 1e-12, -1e-15, 1e-9] {
        for slope in [0.0, 1e-300, 1e-15, 1e-9, -1e-300, -1e-15, -1e-9] {
            for start in [-0.06, 0.0] {
                let origin = Point3::new(start, 0.001, height);
                let (impacts, _) = path(&plate, origin, Vector3::new(1.0, 0.0, slope));
                let what = format!("{height} {slope} {start}: {impacts:?}");
                for impact in &impacts {
                    assert!(impact.normal_impulse >= 0.0, "{what}");
                    assert!(impact.tangential_impulse >= 0.0, "{what}");
                    assert!(impact.velocity.norm() <= 10.0 * (1.0 + 1e-14), "{what}");
                }
            }
        }
    }
}

#[test]
fn without_restitution_every_path_ends_at_its_first_impact() {
    let plate = scenario(&edited(PLATE, &[("restitution: 0.25", "restitution: 0")]));
    for incidence in [5.0_f64, 60.0, 90.0] {
        let settings = Settings {
            incidence: incidence.to_radians(),
            standoff: 40e-3,
            ..held(&plate)
        };
        let evaluation = evaluated(&plate, &settings);
        assert_eq!(evaluation.ends.len(), 1);
        assert!((evaluation.ends[&End::Stays] - 1.0).abs() < 1e-12);
        assert_eq!(
            evaluation.rays,
            evaluation.shots + evaluation.boundary_shots
        );
        let expected = plate.problem.shot.mass() * 10.0 * settings.incidence.sin();
        let mean = evaluation.target.normal_impulse.mean;
        assert!((mean / expected - 1.0).abs() < 1e-12);
    }
    // In a corner it stays on the first wall and never meets the second.
    let room = room("mu_s: 0.1, mu_d: 0.1, restitution: 0", 1000);
    let (impacts, end) = path(&room, Point3::origin(), Vector3::new(1.0, 1.0, 0.9));
    assert_eq!((impacts.len(), end), (1, End::Stays));
}

#[test]
fn elastic_frictionless_shots_keep_speed_and_place_for_a_thousand_impacts() {
    let room = room("mu_s: 0, mu_d: 0, restitution: 1", 1000);
    let mut random = Random(11);
    for _ in 0..50 {
        let (impacts, end) = path(&room, Point3::from(random.vector() * 5e-3), random.vector());
        assert_eq!((impacts.len(), end), (1000, End::Limit));
        for impact in &impacts {
            // Each impact may cost a few digits' last step.
            let steps = 4.0 * impact.number as f64;
            assert!((impact.velocity.norm() / 10.0 - 1.0).abs() <= steps * f64::EPSILON);
            assert_eq!(impact.rolling, Vector3::zeros());
            assert!(impact.point.coords.amax() <= 10e-3 * (1.0 + 1e-12));
        }
    }
}

#[test]
fn with_friction_energy_never_rises_in_a_thousand_impacts() {
    let mut random = Random(12);
    for contact in [
        "mu_s: 0.3, mu_d: 0.27, restitution: 1",
        "mu_s: 0.3, mu_d: 0.27, restitution: 1, law: kinetic",
        "mu_s: 10, mu_d: 10, restitution: 1, tangential_restitution: 1",
        "mu_s: 0.2, mu_d: 0.1, restitution: 0.999",
    ] {
        let room = room(contact, 1000);
        for _ in 0..20 {
            let (impacts, end) = path(&room, Point3::from(random.vector() * 5e-3), random.vector());
            assert_eq!(end, End::Limit);
            let mut before: f64 = 50.0;
            for impact in &impacts {
                let energy =
                    0.5 * impact.velocity.norm_squared() + 0.2 * impact.rolling.norm_squared();
                assert!(energy <= before * (1.0 + 8.0 * f64::EPSILON), "{contact}");
                before = energy;
            }
        }
    }
}

/// Backspin at the equator of 5/2 of the tangential speed is what a sticking contact turns into a
/// perpendicular rebound; with more the shot comes back.
#[test]
fn enough_backspin_brings_a_shot_back() {
    let sphere = Sphere {
        radius: 0.5e-3,
        density: 7000.0,
    };
    let shot = |backspin: f64| Oblique {
        sphere,
        contact: Contact::new(10.0, 10.0, 0.5).unwrap(),
        speed: 10.0,
        angle: 60_f64.to_radians(),
        spin: backspin * 5.0 / sphere.radius,
    };
    for (backspin, side) in [(2.5 - 1e-9, 1.0), (2.5 + 1e-9, -1.0), (10.0, -1.0)] {
        let outcome = shot(backspin).outcome().unwrap();
        assert_eq!(outcome.regime, Regime::Stick);
        // (5/7) v_t - (2/7) R w.
        let expected = 5.0 * (5.0 - 2.0 * backspin) / 7.0;
        assert!((outcome.tangential_velocity - expected).abs() < 1e-12);
        assert_eq!(outcome.tangential_velocity.signum(), side);
        assert_eq!(outcome.angle > FRAC_PI_2, side < 0.0);
        assert!(outcome.energy_ratio() <= 1.0 + 1e-14);
        // Who leaves out the spin lets every shot fly on.
        let naive = 5.0 * (1.0 - 2.0 / 7.0);
        assert!(naive > 0.0);
    }
    // Where friction is too weak to stop the slip, it comes back by as much as friction gives.
    let weak = Oblique {
        contact: Contact::new(0.7, 0.6, 0.5).unwrap(),
        ..shot(10.0)
    };
    let outcome = weak.outcome().unwrap();
    assert_eq!(outcome.regime, Regime::Slip);
    let expected = 5.0 - 0.6 * 1.5 * 75_f64.sqrt();
    assert!(expected < 0.0 && (outcome.tangential_velocity - expected).abs() < 1e-12);
}

/// A ball that is elastic in both directions, thrown under a table, returns: after floor, table and
/// floor its speed along the floor is -333/343 of that at the start (R. L. Garwin, "Kinematics of an
/// ultraelastic rough ball", American Journal of Physics 37, 1969).
#[test]
fn a_superball_thrown_under_a_table_returns() {
    let table = scenario(&edited(
        PLATE,
        &[
            (
                "scene:",
                "scene:\n  table: { box: { min: [-50, -50, 10], max: [50, 50, 20] } }",
            ),
            (
                "mu_s: 0.15, mu_d: 0.075, restitution: 0.25",
                "mu_s: 10, mu_d: 10, restitution: 1, tangential_restitution: 1",
            ),
        ],
    ));
    let start = Point3::new(-0.04, 0.0, 0.005);
    let (impacts, _) = path(&table, start, Vector3::new(1.0, 0.0, -1.0));
    let along: Vec<f64> = impacts.iter().map(|impact| impact.velocity.x).collect();
    let launched = 50_f64.sqrt();
    for (found, share) in along.iter().zip([3.0 / 7.0, -31.0 / 49.0, -333.0 / 343.0]) {
        assert!((found / launched - share).abs() < 1e-14, "{along:?}");
    }
    assert!(impacts[2].point.x < impacts[1].point.x);
}
