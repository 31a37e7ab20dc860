//! Against an independent implementation (numpy and numba, its own tracer and random numbers):
//! single paths, and the terms of the objective for settings all over the range.

use nalgebra::{Point3, Vector3};
use peenpose::evaluate::evaluate;
use peenpose::impact::{Contact, Regime};
use peenpose::jet::{Pose, Replicates, ShotSample};
use peenpose::problem::setting::{Settings, Tolerance};
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::scene::ray::Ray;
use peenpose::trace::Tracer;
use serde_json::Value;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_iterator(value.as_array().unwrap().iter().map(number))
}

/// The reference's mesh has 330 chords in the bore.
fn walls(case: &Value) -> Walls {
    match case["geometry"].as_str().unwrap() {
        "exact" => Walls::Exact,
        "mesh" => {
            let lip = (15.0_f64 * 15.0 - 16.0).sqrt();
            let sweep = std::f64::consts::TAU - 2.0 * 4.0_f64.atan2(lip);
            Walls::TriangleMesh {
                chord_angle: sweep / 330.0,
            }
        }
        other => panic!("unknown geometry {other}"),
    }
}

fn contact(values: &Value) -> Contact {
    Contact::new(
        number(&values["mu_s"]),
        number(&values["mu_d"]),
        number(&values["restitution"]),
    )
    .unwrap()
}

#[test]
fn single_paths_agree_impact_by_impact() {
    let text = include_str!("../data/reference_paths.json");
    let file: Value = serde_json::from_str(text).unwrap();
    let mut impacts = 0;
    for path in file["rays"].as_array().unwrap() {
        let mut problem = crate::common::keyway(number(&path["length_mm"]) * 1e-3);
        problem.contacts[0].contact = contact(path);
        let scenario = Scenario::new(problem, walls(path)).unwrap();
        let velocity = vector(&path["velocity_m_s"]);
        let start = Ray {
            origin: Point3::from(vector(&path["start_m"])),
            direction: velocity.normalize(),
        };
        let settings = Settings {
            incidence: 1.0,
            azimuth: 0.0,
            standoff: 0.01,
            speed: velocity.norm(),
            aim_along: 0.0,
            aim_across: 0.0,
            aim_above: 0.0,
            contact: 0,
            static_friction: 0.0,
        };
        let mut found = Vec::new();
        Tracer::new(&scenario, &settings, settings.speed).follow_from(
            start,
            &ShotSample::NONE,
            |impact| found.push(*impact),
        );
        let expected = path["impacts"].as_array().unwrap();
        assert_eq!(found.len(), expected.len(), "{path}");
        for (ours, theirs) in found.iter().zip(expected) {
            impacts += 1;
            let surface = &scenario.scene.surfaces()[ours.surface as usize];
            assert_eq!(surface, theirs["surface"].as_str().unwrap());
            assert_eq!(ours.on_target, theirs["on_target_patch"].as_bool().unwrap());
            assert_eq!(
                ours.regime == Regime::Stick,
                theirs["stick"].as_bool().unwrap()
            );
            let close =
                |a: f64, b: f64, scale: f64| assert!((a - b).abs() <= 1e-9 * scale, "{a} {b}");
            let impulse = number(&theirs["normal_impulse_N_s"]);
            close(ours.normal_impulse, impulse, impulse);
            close(
                ours.tangential_impulse,
                number(&theirs["tangential_impulse_N_s"]),
                impulse,
            );
            close(
                (ours.point.coords - vector(&theirs["point_m"])).norm(),
                0.0,
                0.03,
            );
            let after = vector(&theirs["velocity_after_m_s"]);
            close((ours.velocity - after).norm(), 0.0, velocity.norm());
            let spin = vector(&theirs["angular_velocity_after_rad_s"]) * 0.5e-3;
            close((ours.rolling - spin).norm(), 0.0, velocity.norm());
        }
    }
    assert_eq!(impacts, 822);
}

#[test]
fn terms_agree_all_over_the_range() {
    let cases: Vec<Value> =
        serde_json::from_str(include_str!("../data/reference_cases.json")).unwrap();
    let mut worst: f64 = 0.0;
    for case in &cases {
        let mut problem = crate::common::keyway(number(&case["hub_length_m"]));
        problem.contacts[0].contact = contact(&case["contact"]);
        if !case["tolerance"].is_null() {
            problem.tolerance = Tolerance {
                incidence: 2.0_f64.to_radians(),
                azimuth: 2.0_f64.to_radians(),
                standoff: 1e-3,
                speed: 0.03,
                restitution: 0.1,
                ..Tolerance::default()
            };
        }
        let settings = &case["settings"];
        let settings = Settings {
            incidence: number(&settings["incidence_deg"]).to_radians(),
            azimuth: number(&settings["azimuth_deg"]).to_radians(),
            standoff: number(&settings["standoff_m"]),
            speed: number(&settings["speed_m_s"]),
            aim_along: 0.0,
            aim_across: 0.0,
            aim_above: 0.0,
            contact: 0,
            static_friction: 0.0,
        };
        let scenario = Scenario::new(problem, walls(case)).unwrap();
        let pose = Pose::new(&scenario.target.frame, &settings);
        assert!((pose.direction - vector(&case["direction"])).norm() < 1e-12);
        assert!((pose.exit.coords - vector(&case["exit_m"])).norm() < 1e-12);
        let nozzle = &scenario.problem.nozzle;
        let (clearance, _) = scenario
            .scene
            .clearance(nozzle, &pose.exit, &pose.direction, f64::INFINITY)
            .unwrap();
        assert!((clearance - number(&case["clearance_m"])).abs() < 1e-6);

        let fresh = Replicates::new(&scenario.problem, 0, 1 << 16);
        let found = evaluate(&scenario, &settings, &fresh);
        let (terms, errors) = (&case["terms"], &case["term_errors"]);
        let mut check = |name: &str, ours: f64, our_error: f64, theirs: f64, their_error: f64| {
            let error = our_error.hypot(their_error);
            let difference = (ours - theirs).abs();
            if error > 0.0 {
                worst = worst.max(difference / error);
            }
            assert!(
                difference <= (4.0 * error).max(1e-3 * theirs.abs()).max(1e-9),
                "case {}: {name} {ours} +- {our_error} against {theirs} +- {their_error}",
                case["id"]
            );
        };
        for (name, ours, error) in [
            (
                "normal_impulse",
                found.terms.normal_impulse,
                found.term_errors.normal_impulse,
            ),
            (
                "tangential_impulse",
                found.terms.tangential_impulse,
                found.term_errors.tangential_impulse,
            ),
            ("rebound", found.terms.rebound, found.term_errors.rebound),
            ("miss", found.terms.miss, found.term_errors.miss),
        ] {
            check(
                name,
                ours,
                error,
                number(&terms[name]),
                number(&errors[name]),
            );
        }
        check(
            "total",
            found.terms.total(),
            found.standard_error,
            number(&case["total"]),
            number(&case["total_error"]),
        );
        let hits = found.target.hits.max(1) as f64;
        let binomial = |share: f64, count: f64| (share * (1.0 - share) / count).sqrt();
        let off = found.target.off_target as f64 / hits;
        check(
            "off_target",
            off,
            binomial(off, hits),
            number(&case["off_target"][0]),
            number(&case["off_target"][1]),
        );
        let over = found.target.over_limit as f64 / hits;
        check(
            "over_limit",
            over,
            binomial(over, hits),
            number(&case["over_limit"][0]),
            number(&case["over_limit"][1]),
        );
        for (index, name) in scenario.scene.surfaces().iter().enumerate() {
            let share = found.surfaces[index].over as f64 / found.shots as f64;
            let theirs = &case["surfaces"][name];
            check(
                name,
                share,
                binomial(share, found.shots as f64),
                number(&theirs[0]),
                number(&theirs[1]),
            );
        }
    }
    println!("largest difference: {worst:.2} combined standard errors");
}
