//! Orders of convergence that theory gives.

use nalgebra::{Point3, Vector3};
use peenpose::jet::{Samples, ShotSample, Stream};
use peenpose::objective::Tally;
use peenpose::scenario::Scenario;
use peenpose::scene::ray::Ray;
use peenpose::scene::{Scene, Walls};

use crate::common::held::held;
use crate::stability::{PLATE, edited, scenario};

const SCRAMBLINGS: u32 = 64;

/// Root mean square error of J over scramblings, for doubled and doubled numbers of shots.
fn errors(
    scenario: &Scenario,
    draw: impl Fn(Stream, usize) -> Samples,
    reference: f64,
) -> Vec<(usize, f64)> {
    let settings = held(scenario);
    let value = |shots: &[ShotSample]| {
        let tally = Tally::trace(scenario, &settings, settings.speed, shots);
        tally.terms(&scenario.problem.goals, settings.speed).total()
    };
    let most = 4096;
    let sets: Vec<Samples> = (0..SCRAMBLINGS)
        .map(|number| draw(Stream::Validation(1000 + number), most))
        .collect();
    (6..=12)
        .map(|power| {
            let shots = 1 << power;
            let squares: f64 = sets
                .iter()
                .map(|set| (value(&set.shots[..shots]) - reference).powi(2))
                .sum();
            (shots, (squares / f64::from(SCRAMBLINGS)).sqrt())
        })
        .collect()
}

/// The power of n with which errors fall: least squares through their logarithms.
fn rate(errors: &[(usize, f64)]) -> f64 {
    let points: Vec<(f64, f64)> = errors
        .iter()
        .map(|&(shots, error)| ((shots as f64).ln(), error.ln()))
        .collect();
    let count = points.len() as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0 / count, y + p.1 / count));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    covariance / variance
}

/// J on very many shots.
fn converged(scenario: &Scenario) -> f64 {
    let settings = held(scenario);
    let samples = Samples::new(&scenario.problem, Stream::Validation(999), 1 << 17);
    let tally = Tally::trace(scenario, &settings, settings.speed, &samples.shots);
    tally.terms(&scenario.problem.goals, settings.speed).total()
}

/// A wide jet on the plate. Near the threshold of sticking at 56.7 deg a part of the cone sticks.
fn plate(incidence: &str) -> Scenario {
    scenario(&edited(
        PLATE,
        &[
            ("divergence: 0 deg", "divergence: 8 deg, speed_spread: 5 %"),
            ("exit_diameter: 0 mm", "exit_diameter: 2 mm"),
            ("incidence: 60 deg", &format!("incidence: {incidence}")),
            (
                "{ target: 40 uN.s }",
                "{ target: 40 uN.s }\n  tangential_impulse: { limit: 0.5 uN.s }",
            ),
        ],
    ))
}

#[test]
fn away_from_cliffs_scrambled_points_beat_random_ones_by_their_order() {
    let smooth = plate("40 deg");
    let reference = converged(&smooth);
    let problem = &smooth.problem;
    let random = errors(
        &smooth,
        |stream, count| Samples::random(problem, stream, count),
        reference,
    );
    let sobol = errors(
        &smooth,
        |stream, count| Samples::new(problem, stream, count),
        reference,
    );
    let rim = errors(
        &smooth,
        |stream, count| Samples::with_boundary(problem, stream, count),
        reference,
    );
    let rates = [rate(&random), rate(&sobol), rate(&rim)];
    assert!((-0.6..-0.4).contains(&rates[0]), "{rates:?}");
    assert!(rates[1] < -0.9, "{rates:?}");
    assert!(rates[2] < -0.8, "{rates:?}");

    // With a jump through the cone the order is lower, and still not that of random points.
    let jumping = plate("56.7 deg");
    let reference = converged(&jumping);
    let problem = &jumping.problem;
    let sobol = errors(
        &jumping,
        |stream, count| Samples::new(problem, stream, count),
        reference,
    );
    let at_jump = rate(&sobol);
    assert!((-0.95..-0.55).contains(&at_jump), "{at_jump}");
    assert!(at_jump > rates[1]);
}

/// Chords lie inside their arc by its sagitta R (1 - cos(a/2)), second order in their angle a, and
/// their normals are off by a/2 at their ends, first order.
#[test]
fn facets_approach_their_arc_by_the_sagitta() {
    let bore = edited(
        PLATE,
        &[
            (
                "plate: { box: { min: [-50, -50, -10], max: [50, 50, 0] } }",
                "plate: { bore: { diameter: 24 mm, length: 40 mm } }",
            ),
            (
                "plate.z_max, aim: [0, 0, 0], along: [1, 0, 0]",
                "plate.wall, aim: [12, 0, 20]",
            ),
        ],
    );
    let parts = scenario(&bore).problem.parts;
    let (radius, turns) = (12e-3, 7919);
    let mut found = Vec::new();
    for chords in [12, 24, 48, 96, 192] {
        let chord_angle = std::f64::consts::TAU / f64::from(chords);
        let scene = Scene::build(&parts, Walls::TriangleMesh { chord_angle }).unwrap();
        let (mut depth, mut turned): (f64, f64) = (0.0, 0.0);
        let mut mean = 0.0;
        for k in 0..turns {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(turns)).sin_cos();
            let direction = Vector3::new(cos, sin, 0.0);
            let origin = Point3::new(0.0, 0.0, 0.0171);
            let hit = scene.first_hit(&Ray { origin, direction }, None).unwrap();
            depth = depth.max(radius - hit.distance);
            mean += (radius - hit.distance) / f64::from(turns);
            turned = turned.max((hit.normal + direction).norm());
        }
        let sagitta = radius * (1.0 - (chord_angle / 2.0).cos());
        // 7919 rays come near the middle and the end of some chord.
        assert!(
            (0.99..=1.0 + 1e-9).contains(&(depth / sagitta)),
            "{depth} {sagitta}"
        );
        assert!((turned / (2.0 * (chord_angle / 4.0).sin()) - 1.0).abs() < 0.1);
        // Of a chord's parabola two thirds.
        assert!((mean / sagitta - 2.0 / 3.0).abs() < 0.02, "{mean}");
        found.push((depth, mean, turned));
    }
    for pair in found.windows(2) {
        let order = |one: f64, other: f64| (one / other).log2();
        assert!((order(pair[0].0, pair[1].0) - 2.0).abs() < 0.05);
        assert!((order(pair[0].1, pair[1].1) - 2.0).abs() < 0.05);
        assert!((order(pair[0].2, pair[1].2) - 1.0).abs() < 0.15);
    }
}
