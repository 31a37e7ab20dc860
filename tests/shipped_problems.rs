//! Every shipped problem is solved, within the accuracy it asks for and in the right valley.

use std::ops::RangeInclusive;
use std::path::Path;

use peenpose::setup::Setup;
use peenpose::solve::{Answer, Control, Solution, Status, solve};

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
        // Rebounds leave by the open ends; friction hardly matters.
        "keyway.yaml" => vec![
            expect("oiled", 66.0..=69.5, 0.0045..=0.0049, true),
            expect("damp", 66.0..=69.5, 0.0045..=0.0049, true),
            expect("dry", 66.0..=69.5, 0.0045..=0.0049, true),
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
        // Nothing to search, and the target is what the paper gives.
        "plate.yaml" => ["mu_030", "mu_024", "mu_018", "mu_012", "mu_006"]
            .map(|contact| expect(contact, 59.999_999..=60.000_001, 0.0..=1e-9, true))
            .into(),
        _ => panic!("{file} has no expectation: say here what its answer is"),
    }
}

fn solved(file: &str) -> (Setup, Solution) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("problems")
        .join(file);
    let (setup, _) = Setup::load(&path).unwrap_or_else(|fault| panic!("{}", fault.render(false)));
    let solution = solve(&setup, &Control::default());
    (setup, solution)
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
    assert!(files.len() >= 4, "{files:?}");
    for file in &files {
        let expected = expectations(file);
        let (setup, solution) = solved(file);
        assert_eq!(solution.status, Status::Converged, "{file}");
        assert_eq!(solution.answers.len(), expected.len(), "{file}");
        let totals: Vec<f64> = solution.answers.iter().map(objective).collect();
        assert!(totals.is_sorted(), "{file}: {totals:?}");
        for (rank, expected) in expected.iter().enumerate() {
            let name = |answer: &&Answer| {
                setup.problem.contacts[answer.choice.contact].name == expected.contact
            };
            let answer = solution.answers.iter().find(name).expect("every contact");
            let (j, incidence) = (objective(answer), answer.choice.incidence.to_degrees());
            let what = format!("{file}, {}: J {j} at {incidence} deg", expected.contact);
            assert!(expected.objective.contains(&j), "{what}");
            assert!(expected.incidence_deg.contains(&incidence), "{what}");
            assert_eq!(answer.passes(), expected.passes, "{what}");
            assert!(
                standard_error(answer) <= setup.problem.accuracy * j,
                "{what}"
            );
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
    let (setup, solution) = solved("keyway-long.yaml");
    let names: Vec<&str> = solution
        .answers
        .iter()
        .map(|answer| setup.problem.contacts[answer.choice.contact].name.as_str())
        .collect();
    assert_eq!(names, ["oiled", "damp", "dry"]);
    assert!(objective(&solution.answers[2]) > 10.0 * objective(&solution.answers[1]));
}
