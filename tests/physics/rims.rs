//! Shots that touch the rim of a part where the target's box ends with it.

use std::path::Path;

use peenpose::evaluate::{ViolationCounts, evaluate};
use peenpose::jet::{Replicates, purpose};
use peenpose::problem;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::trace::Tracer;

/// A jet of large shot at the mouth of a keyway: a fifth of the hits on its floor touch the rim of that.
fn mouth(low: f64) -> Scenario {
    let text = format!(
        "
format: 1
lengths_in: mm
scene: {{ hub: {{ keyway: {{ bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm }} }} }}
target: {{ surface: hub.floor, within: {{ min: [-3, 18, {low}], max: [3, 19, 4] }}, aim: [0, 18.3, 0.4], along: [0, 0, 1] }}
shot: {{ radius: 0.9 mm, density: 7000 kg/m3 }}
jet: {{ exit_diameter: 1.5 mm, divergence: 8 deg, speed_spread: 5 % }}
contacts: {{ bouncy: {{ mu_s: 0.1, mu_d: 0.09, restitution: 0.9 }} }}
settings: {{ incidence: 70 deg, azimuth: 0 deg, standoff: 10 mm, speed: 10 m/s }}
goals: {{ normal_impulse: {{ target: 400 uN.s }} }}
paths: {{ impacts: 1 }}
"
    );
    let reading = problem::read_text(&text, Path::new("mouth.yaml")).unwrap();
    let faults = problem::render(&reading.source, &reading.faults, false);
    let problem = reading.problem.unwrap_or_else(|| panic!("{faults}"));
    Scenario::new(problem, Walls::Exact).unwrap()
}

#[test]
fn hits_on_a_rim_in_a_face_of_the_box_are_on_target() {
    let (exact, wider) = (mouth(0.0), mouth(-0.1));
    let settings = exact.problem.ranges.middle();
    let shots = Replicates::without_boundary(&exact.problem, purpose::ANSWERS, 16_384);
    let counts = |scenario: &Scenario| ViolationCounts::of(&evaluate(scenario, &settings, &shots));
    let found = counts(&exact);
    // There is no floor beyond its end, so a box that goes on holds no more of it.
    assert_eq!(found, counts(&wider));
    let share = found.hits as f64 / found.shots as f64;
    assert!((share - 0.948).abs() < 0.005, "{share}");

    // Shot by shot as many at once.
    let tracer = Tracer::new(&exact, &settings, settings.speed);
    let (mut hits, mut rims) = (0, 0);
    for sample in shots.sets.iter().flat_map(|set| &set.jet.shots) {
        tracer.follow(sample, |first| {
            hits += usize::from(first.on_target);
            rims += usize::from(first.on_target && first.point.z.abs() < 1e-9);
        });
    }
    assert_eq!(hits, found.hits);
    assert!(rims > found.shots / 10, "{rims}");
}
