//! Every shipped problem is solved, within the accuracy it asks for and in the right valley.

use std::ops::RangeInclusive;
use std::path::Path;

use nalgebra::Vector2;
use peenpose::control::Control;
use peenpose::problem::curve::Curve;
use peenpose::problem::part::Shape;
use peenpose::scenario::Scenario;
use peenpose::scene::profile::Profile;
use peenpose::solve::{Answer, Solution, Status, solve};

/// Where the best answer for one contact must lie.
struct Expectation {
    contact: &'static str,
    incidence_deg: RangeInclusive<f64>,
    objective: RangeInclusive<f64>,
    passes: bool,
}

/// What is expected of a file; the contact of the first expectation must be the best one, or as
/// good as the best within the errors.
fn expectations(file: &str) -> Vec<Expectation> {
    let expect = |contact, incidence_deg, objective, passes| Expectation {
        contact,
        incidence_deg,
        objective,
        passes,
    };
    match file {
        // Rebounds leave by the open ends; friction hardly matters. By brute force: 67.5 deg and
        // 0.004636 oiled, 66.5 deg and 0.004664 with more friction.
        "keyway.yaml" => vec![
            expect("oiled", 66.0..=69.0, 0.00463..=0.00470, true),
            expect("damp", 65.0..=68.0, 0.00465..=0.00473, true),
            expect("dry", 65.0..=68.0, 0.00465..=0.00473, true),
        ],
        // A valley at 45 deg for little friction; a far worse one at 33 deg is all that is left dry.
        "keyway-long.yaml" => vec![
            expect("oiled", 44.0..=46.0, 0.0031..=0.0033, true),
            expect("damp", 41.5..=43.5, 0.0031..=0.0036, true),
            expect("dry", 32.0..=34.0, 0.0515..=0.0537, false),
        ],
        "keyway-blind.yaml" => vec![
            expect("oiled", 61.0..=65.0, 0.0028..=0.0033, true),
            expect("damp", 60.0..=65.0, 0.0028..=0.0034, true),
            expect("dry", 60.0..=65.0, 0.0028..=0.0034, true),
        ],
        // A flat jet sends its rebounds along the slot and out of it, which takes little friction; dry,
        // only a steep one keeps within the tangential limit, and its rebounds cross the slot.
        "firtree.yaml" => vec![
            expect("oiled", 29.5..=34.5, 0.0057..=0.0060, true),
            expect("dry", 58.0..=64.5, 0.0314..=0.0327, false),
        ],
        // As steep as the tip of the other tooth lets the jet be; shots stick, dry or oiled.
        "gear-root.yaml" => vec![
            expect("oiled", 72.5..=74.5, 0.0113..=0.0119, true),
            expect("dry", 72.5..=74.5, 0.0113..=0.0119, true),
        ],
        // The pin turns the jet nearly square to the wall, and J is mostly what then crosses the bore.
        "deflector.yaml" => vec![
            expect("oiled", 0.0..=0.0, 0.0275..=0.0287, true),
            expect("dry", 0.0..=0.0, 0.0461..=0.0480, true),
        ],
        // Nothing to search, and the target is what the paper gives.
        "plate.yaml" => ["mu_030", "mu_024", "mu_018", "mu_012", "mu_006"]
            .map(|contact| expect(contact, 59.999_999..=60.000_001, 0.0..=1e-9, true))
            .into(),
        _ => panic!("{file} has no expectation: say here what its answer is"),
    }
}

fn load(file: &str) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("problems")
        .join(file);
    let loaded = Scenario::load(&path);
    loaded
        .unwrap_or_else(|fault| panic!("{}", fault.render(false)))
        .0
}

fn solved(file: &str) -> (Scenario, Solution) {
    let scenario = load(file);
    let solution = solve(&scenario, &Control::default());
    (scenario, solution)
}

fn objective(answer: &Answer) -> f64 {
    answer
        .evaluation
        .as_ref()
        .expect("the nozzle fits")
        .terms
        .total()
}

fn standard_error(answer: &Answer) -> f64 {
    answer
        .evaluation
        .as_ref()
        .expect("the nozzle fits")
        .standard_error
}

#[test]
fn every_file_is_solved_in_the_right_valley() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    let mut files: Vec<String> = folder
        .read_dir()
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".yaml") || name.ends_with(".yml"))
        .collect();
    files.sort();
    assert!(files.len() >= 7, "{files:?}");
    for file in &files {
        // Strokes have tests of their own, in `tests/search/strokes.rs`.
        if load(file).problem.stroke.is_some() {
            continue;
        }
        let expected = expectations(file);
        let (scenario, solution) = solved(file);
        assert_eq!(solution.status, Status::Converged, "{file}");
        assert_eq!(solution.answers.len(), expected.len(), "{file}");
        let totals: Vec<f64> = solution.answers.iter().map(objective).collect();
        // Contacts that tie within the accuracy asked for come in the order of the file.
        assert!(
            totals.is_sorted_by(|a, b| *a <= b * 1.02),
            "{file}: {totals:?}"
        );
        for (rank, expected) in expected.iter().enumerate() {
            let name = |answer: &&Answer| {
                scenario.problem.contacts[answer.settings.contact].name == expected.contact
            };
            let answer = solution.answers.iter().find(name).expect("every contact");
            let (j, incidence) = (objective(answer), answer.settings.incidence.to_degrees());
            let what = format!("{file}, {}: J {j} at {incidence} deg", expected.contact);
            assert!(expected.objective.contains(&j), "{what}");
            assert!(expected.incidence_deg.contains(&incidence), "{what}");
            assert_eq!(answer.passes(), expected.passes, "{what}");
            // What cannot win need not be known as well.
            let wanted = if rank == 0 { 1.0 } else { 4.0 } * scenario.problem.accuracy * j;
            assert!(standard_error(answer) <= wanted, "{what}");
            if rank == 0 {
                let slack =
                    3.0 * standard_error(&solution.answers[0]).hypot(standard_error(answer));
                assert!(
                    j <= totals[0] + slack,
                    "{what}, but the best is {}",
                    totals[0]
                );
            }
        }
    }
}

/// Unit vectors along a curve where it starts and where it ends.
fn directions(curve: &Curve) -> [Vector2<f64>; 2] {
    match *curve {
        Curve::Line { from, to } => [(to - from).normalize(); 2],
        Curve::Arc { start, sweep, .. } => [start, start + sweep].map(|angle| {
            let (sin, cos) = angle.sin_cos();
            Vector2::new(-sin, cos) * sweep.signum()
        }),
    }
}

#[test]
fn arcs_of_extrusions_are_tangent_to_what_they_join() {
    // Only the tips of the gear's teeth have edges.
    for (file, sharp) in [("firtree.yaml", 0), ("gear-root.yaml", 2)] {
        let scenario = load(file);
        let Shape::Extrude { profile, .. } = &scenario.problem.parts[0].shape else {
            panic!("{file} is an extrusion");
        };
        let pieces = Profile::outline(profile).pieces;
        let kinks = pieces.windows(2).map(|pair| {
            let [_, before] = directions(&pair[0].curve);
            let [after, _] = directions(&pair[1].curve);
            before.angle(&after).to_degrees()
        });
        let edges: Vec<f64> = kinks.filter(|&kink| kink > 0.03).collect();
        assert_eq!(edges.len(), sharp, "{file}: {edges:?}");
    }
}

#[test]
#[should_panic(expected = "has no expectation")]
fn a_new_file_needs_an_expectation() {
    expectations("new.yaml");
}

#[test]
fn the_plate_receives_what_the_paper_says() {
    let (_, solution) = solved("plate.yaml");
    for answer in &solution.answers {
        let target = &answer.evaluation.as_ref().unwrap().target;
        // N* = (1 + E) m v sin(60 deg), whatever the friction.
        for impulse in [target.normal_impulse.mean, target.normal_impulse.largest] {
            assert!((impulse / 39.6769e-6 - 1.0).abs() < 1e-4, "{impulse}");
        }
        assert_eq!(target.hits, answer.evaluation.as_ref().unwrap().shots);
    }
}

#[test]
fn the_long_keyway_has_friction_to_choose() {
    let (scenario, solution) = solved("keyway-long.yaml");
    let names: Vec<&str> = solution
        .answers
        .iter()
        .map(|answer| {
            scenario.problem.contacts[answer.settings.contact]
                .name
                .as_str()
        })
        .collect();
    assert_eq!(names, ["oiled", "damp", "dry"]);
    assert!(objective(&solution.answers[2]) > 10.0 * objective(&solution.answers[1]));
}
