//! Where methods of this field are known to fail: each failure is provoked, shown on a naive method
//! where that is cheap, and ours must not have it.
//!
//! | file | failures |
//! |---|---|
//! | `threshold` | the jump between stick and slip: single impacts, jets, and a search up to the jump |
//! | `limits` | perpendicular and grazing impacts, no or full restitution, no friction, shots that come back |
//! | `edges` | rays at edges, vertices, T-junctions, slivers, duplicate and flipped triangles |
//! | `corners` | starts on surfaces, wedges and corners, nearly closed rooms |
//! | `far_away` | scenes far from the origin, and in other units of length |
//! | `landscapes` | flat objectives, bounds, azimuths round the turn, two basins, needles, infeasible by a hair |
//! | `odd_questions` | one setting or none, equal contacts, one hit among 1e5 shots, weights of 0 and 1e9 |
//! | `orders` | orders of convergence that theory gives |

mod corners;
mod edges;
mod far_away;
mod landscapes;
mod limits;
mod odd_questions;
mod orders;
mod threshold;

use std::path::Path;

use nalgebra::{Point3, Vector3};
use peenpose::control::Control;
use peenpose::jet::{Samples, ShotSample, Stream};
use peenpose::objective::{Tally, Terms};
use peenpose::problem;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::{Solution, solve};
use peenpose::trace::{End, PathImpact, Tracer};

use crate::common::held::held;

/// A plate under a parallel jet from a point; every setting is held.
const PLATE: &str = "
format: 1
title: Plate
lengths_in: mm
scene:
  plate: { box: { min: [-50, -50, -10], max: [50, 50, 0] } }
target: { surface: plate.z_max, aim: [0, 0, 0], along: [1, 0, 0] }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 0 mm, divergence: 0 deg }
contacts:
  only: { mu_s: 0.15, mu_d: 0.075, restitution: 0.25 }
settings:
  incidence: 60 deg
  azimuth: 0 deg
  standoff: 10 mm
  speed: 10 m/s
goals:
  normal_impulse: { target: 40 uN.s }
";

/// A text with some of its lines replaced; each of them must be there.
fn edited(text: &str, edits: &[(&str, &str)]) -> String {
    edits.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "`{from}` is not in\n{text}");
        text.replace(from, to)
    })
}

/// The setup of a problem text. Every text of this suite goes through here.
fn scenario(text: &str) -> Scenario {
    setup_beside(Path::new("."), text, Walls::Exact)
}

/// The same with mesh files in a folder, or with facets.
fn setup_beside(folder: &Path, text: &str, walls: Walls) -> Scenario {
    let reading = problem::read_text(text, &folder.join("text.yaml")).unwrap();
    let Some(problem) = reading.problem else {
        panic!(
            "{}",
            problem::render(&reading.source, &reading.faults, false)
        );
    };
    Scenario::new(problem, walls).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// The terms of a choice at its own speed, on the first shots of the search.
fn terms(scenario: &Scenario, settings: &Settings, shots: usize) -> Terms {
    let samples = Samples::new(&scenario.problem, Stream::Search, shots);
    let tally = Tally::trace(scenario, settings, settings.speed, &samples.shots);
    tally.terms(&scenario.problem.goals, settings.speed)
}

/// The path of a shot that starts anywhere, and how it ends.
fn path(
    scenario: &Scenario,
    origin: Point3<f64>,
    direction: Vector3<f64>,
) -> (Vec<PathImpact>, End) {
    let settings = held(scenario);
    let ray = peenpose::scene::ray::Ray {
        origin,
        direction: direction.normalize(),
    };
    let mut impacts = Vec::new();
    let tracer = Tracer::new(scenario, &settings, settings.speed);
    let (end, _) = tracer.follow_from(ray, &ShotSample::NONE, |impact| impacts.push(*impact));
    (impacts, end)
}

/// A search small enough for a test.
fn search(scenario: &Scenario) -> Solution {
    let control = Control {
        most_shots: 1024,
        validation_shots: 4096,
        ..Control::default()
    };
    solve(scenario, &control)
}

/// J of the best answer on fresh shots.
fn best_objective(solution: &Solution) -> f64 {
    let evaluation = solution.answers[0].evaluation.as_ref();
    evaluation.unwrap().terms.total()
}

/// SplitMix64.
struct Random(u64);

impl Random {
    /// Uniform in 0 to 1.
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform within +- 1.
    fn signed(&mut self) -> f64 {
        2.0 * self.uniform() - 1.0
    }

    /// A vector in the cube of +- 1.
    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.signed(), self.signed(), self.signed())
    }
}
