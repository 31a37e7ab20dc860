//! Rebounds from rough walls, against a direct simulation of the formula.

use std::path::Path;

use nalgebra::Vector3;
use peenpose::impact::{Contact, rebound};
use peenpose::jet::{Samples, Stream};
use peenpose::problem;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::trace::Tracer;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{RngCore, SeedableRng};
use statrs::distribution::{ContinuousCDF, Normal};

/// A rough plate under a jet of equal shots.
fn plate(roughness_deg: f64) -> Scenario {
    let text = format!(
        "
format: 1
lengths_in: mm
scene: {{ plate: {{ box: {{ min: [-50, -50, -1], max: [50, 50, 0] }} }} }}
target: {{ surface: plate.z_max, along: [1, 0, 0] }}
shot: {{ radius: 0.5 mm, density: 7000 kg/m3 }}
jet: {{ exit_diameter: 0 mm, divergence: 0 deg }}
contacts: {{ dry: {{ mu_s: 0.1, mu_d: 0.09, restitution: 0.5 }} }}
settings: {{ incidence: [5 deg, 80 deg], azimuth: 0 deg, standoff: 10 mm, speed: 10 m/s }}
goals: {{ normal_impulse: {{ target: 1 uN.s }} }}
surfaces: {{ plate.z_max: {{ roughness: {roughness_deg} deg }} }}
"
    );
    let reading = problem::read_text(&text, Path::new("plate.yaml")).unwrap();
    let problem = reading
        .problem
        .unwrap_or_else(|| panic!("{:?}", reading.faults));
    Scenario::new(problem, Walls::Exact).unwrap()
}

/// Elevation over the plate, and azimuth from the jet's own, rad.
fn angles(velocity: &Vector3<f64>) -> [f64; 2] {
    let flat = velocity.xy().norm();
    [velocity.z.atan2(flat), velocity.y.atan2(velocity.x)]
}

fn mean_and_deviation(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let variance = values.map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    (mean, variance.sqrt())
}

const SHOTS: usize = 400_000;

fn traced(scenario: &Scenario, incidence: f64) -> Vec<[f64; 2]> {
    let settings = Settings {
        incidence,
        azimuth: 0.0,
        standoff: 10e-3,
        speed: 10.0,
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact: 0,
        static_friction: 0.1,
    };
    let samples = Samples::new(&scenario.problem, Stream::Search, SHOTS);
    let tracer = Tracer::new(scenario, &settings, settings.speed);
    let mut found = Vec::new();
    for sample in &samples.shots {
        tracer.follow(sample, |impact| {
            if impact.number == 1 {
                found.push(angles(&impact.velocity));
            }
        });
    }
    assert_eq!(found.len(), SHOTS);
    found
}

fn simulated(incidence: f64, roughness: f64) -> Vec<[f64; 2]> {
    let contact = Contact::new(0.1, 0.09, 0.5).unwrap();
    let velocity = Vector3::new(incidence.cos(), 0.0, -incidence.sin()) * 10.0;
    let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
    let normal = Normal::standard();
    let mut sample = || {
        // Never 0 or 1.
        let uniform = ((random.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64;
        roughness * normal.inverse_cdf(uniform)
    };
    let one = |tilted: &Vector3<f64>| {
        let after = rebound(&contact, &velocity, &Vector3::zeros(), tilted)?;
        Some(after.velocity).filter(|velocity| velocity.z > 0.0)
    };
    let shot = |_| {
        let tilted = Vector3::new(sample(), sample(), 1.0).normalize();
        let after = one(&tilted).or_else(|| one(&Vector3::z()));
        angles(&after.unwrap())
    };
    (0..SHOTS).map(shot).collect()
}

#[test]
fn rebound_angles_scatter_as_the_formula_says() {
    // The flat jet often could not meet the tilted surface, or would leave into the plate.
    for (incidence_deg, roughness_deg) in [(60.0, 4.0), (30.0, 2.0), (8.0, 6.0)] {
        let (incidence, roughness) = (
            f64::to_radians(incidence_deg),
            f64::to_radians(roughness_deg),
        );
        let found = traced(&plate(roughness_deg), incidence);
        let expected = simulated(incidence, roughness);
        for angle in 0..2 {
            let (mean, deviation) = mean_and_deviation(found.iter().map(|each| each[angle]));
            let (right_mean, right) = mean_and_deviation(expected.iter().map(|each| each[angle]));
            let error = right * (2.0 / SHOTS as f64).sqrt();
            let what = format!(
                "{incidence_deg} deg, angle {angle}: {mean} +- {deviation}, not {right_mean} +- {right}"
            );
            assert!((mean - right_mean).abs() < 4.0 * error, "{what}");
            assert!((deviation / right - 1.0).abs() < 0.03, "{what}");
            assert!(right > 0.2 * roughness, "{what}");
        }
    }
}

#[test]
fn a_smooth_plate_does_not_scatter() {
    let found = traced(&plate(0.0), 1.0);
    assert!(found.iter().all(|angles| *angles == found[0]));
}

#[test]
fn the_same_shot_meets_the_same_tilt_in_every_pose() {
    // At nearly the same incidence a shot rebounds nearly as it did, but for the few that stick there
    // and slide here.
    let scenario = plate(5.0);
    let (one, other) = (traced(&scenario, 1.0), traced(&scenario, 1.0 + 1e-7));
    let pairs = one.iter().zip(&other);
    let strays = pairs.filter(|(one, other)| (one[0] - other[0]).abs() > 1e-5);
    assert!(strays.count() < SHOTS / 10_000);
}
