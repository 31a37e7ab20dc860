//! The 95 % intervals of rare shares, tried from seed to seed on a share that is known.

use std::f64::consts::PI;
use std::path::Path;

use peenpose::evaluate::evaluate;
use peenpose::jet::{Replicates, purpose};
use peenpose::problem;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::verdict::{Subject, Verdict};

const SEEDS: u64 = 200;

/// A parallel jet of 4 mm straight down, aimed within 2 mm along x; the target ends this far from where it is
/// aimed at, m. Misses come from a corner of what exit and tolerance allow.
fn cut_off_at(distance: f64) -> Scenario {
    let text = format!(
        "
format: 1
lengths_in: mm
scene: {{ plate: {{ box: {{ min: [-20, -20, -5], max: [20, 20, 0] }} }} }}
target: {{ surface: plate.z_max, within: {{ min: [-20, -20, -1], max: [{}, 20, 1] }}, aim: [0, 0, 0] }}
shot: {{ radius: 0.5 mm, density: 7000 kg/m3 }}
jet: {{ exit_diameter: 4 mm, divergence: 0 deg }}
contacts: {{ dry: {{ mu_s: 0.3, mu_d: 0.27, restitution: 0.25 }} }}
settings: {{ incidence: 90 deg, azimuth: 0 deg, standoff: 20 mm, speed: 10 m/s }}
tolerance: {{ aim_along: 2 mm }}
goals: {{ normal_impulse: {{ target: 40 uN.s }} }}
paths: {{ impacts: 1 }}
",
        distance * 1e3
    );
    let reading = problem::read_text(&text, Path::new("plate.yaml")).unwrap();
    let faults = problem::render(&reading.source, &reading.faults, false);
    let problem = reading.problem.unwrap_or_else(|| panic!("{faults}"));
    Scenario::new(problem, Walls::Exact).unwrap()
}

/// The share of shots beyond a distance, in units of the disc's radius, which is the tolerance, too: the mean over
/// places x on the disc, of density 2/pi sqrt(1 - x^2), of the share of errors that take them there.
fn share_beyond(distance: f64) -> f64 {
    const STEPS: usize = 100_000;
    let step = 2.0 / STEPS as f64;
    let part = |index: usize| {
        let x = -1.0 + (index as f64 + 0.5) * step;
        let beyond = ((1.0 - (distance - x)) / 2.0).clamp(0.0, 1.0);
        2.0 / PI * (1.0 - x * x).sqrt() * beyond * step
    };
    (0..STEPS).map(part).sum()
}

/// Where a share of the shots is beyond, m.
fn where_beyond(share: f64) -> f64 {
    let (mut low, mut high) = (0.0, 2.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if share_beyond(middle) > share {
            low = middle;
        } else {
            high = middle;
        }
    }
    2e-3 * low
}

#[test]
fn intervals_hold_rare_shares_as_often_as_they_say() {
    for share in [1e-4, 1e-3] {
        let mut scenario = cut_off_at(where_beyond(share));
        let settings = scenario.problem.ranges.middle();
        for shots in [2000, 16_384] {
            let mut held = 0;
            let mut missed = 0;
            let mut fired = 0;
            for seed in 1..=SEEDS {
                scenario.problem.seed = seed;
                let fresh =
                    Replicates::without_boundary(&scenario.problem, purpose::ANSWERS, shots);
                let evaluation = evaluate(&scenario, &settings, &fresh);
                let verdicts = Verdict::all(&scenario, &evaluation);
                let miss = verdicts.iter().find(|it| it.subject == Subject::Miss);
                let miss = miss.expect("misses are judged");
                let [low, high] = miss.interval();
                held += u64::from(low <= share && share <= high);
                missed += miss.broken;
                fired += miss.counted;
            }
            // The share is what it is said to be: all seeds together are off by three standard errors at most.
            let expected = share * fired as f64;
            assert!(
                (missed as f64 - expected).abs() < 3.0 * expected.sqrt(),
                "{missed} of {fired}"
            );
            let coverage = held as f64 / SEEDS as f64;
            assert!(
                (0.93..=0.99).contains(&coverage),
                "{share}, {shots}: {coverage}"
            );
        }
    }
}
