//! Problems on which a search can go wrong: regions apart, windows, a lance that nearly fills its bore, many settings,
//! a least J that fails. How often it does on all of them: `cargo run --release --example suite -- target/suite.csv`.

use std::path::Path;

use peenpose::control::Control;
use peenpose::problem::change::Change;
use peenpose::scenario::Scenario;
use peenpose::solve::{Answer, Status, solve};
use peenpose::study::Study;

use crate::examples::statistics::Mean;
use crate::examples::suite::{KnownBest, problems, scenario};
use crate::examples::validation;

/// J may be above the best known by this share, and violations where nothing passes.
const GOOD: f64 = 0.01;
const NEARLY: f64 = 0.05;
/// Shots that J is compared on, and how well that tells it.
const SHOTS: usize = 1 << 15;
const NOISE: f64 = 0.005;

/// Whether an answer is as good as the best known.
fn is_good(known: &KnownBest, scenario: &Scenario, answer: &Answer) -> bool {
    if !known.passes {
        return answer.largest_violation() <= known.violation * (1.0 + NEARLY);
    }
    let choices = [known.settings, answer.settings];
    let objectives = validation::objectives(scenario, &choices, 1 << 20, SHOTS);
    let [best, found] = [0, 1].map(|index| Mean::of_choice(&objectives, index).value);
    answer.passes() && found <= best * (1.0 + GOOD + NOISE)
}

/// Solves problems with some seeds: how many answers are good, and how many say `converged` and are not.
fn searched(names: &[&str], seeds: std::ops::Range<u64>) -> (usize, usize, usize) {
    let known = KnownBest::all().unwrap();
    let (mut all, mut good, mut untrue) = (0, 0, 0);
    for (name, path) in problems() {
        if !names.contains(&name.as_str()) {
            continue;
        }
        let best = known.iter().find(|it| it.problem == name).unwrap();
        let mut scenario = scenario(&path).unwrap();
        for seed in seeds.clone() {
            scenario.problem.seed = seed;
            let solution = solve(&scenario, &Control::default());
            let is_good = is_good(best, &scenario, &solution.answers[0]);
            all += 1;
            good += usize::from(is_good);
            untrue += usize::from(!is_good && solution.status == Status::Converged);
        }
    }
    (all, good, untrue)
}

/// A shipped problem with some of its keys changed.
fn changed(name: &str, changes: &[[&str; 2]]) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("problems")
        .join(name);
    let changes = changes.iter();
    let changes: Vec<Change> = changes
        .map(|[key, value]| Change::new(key, value).unwrap())
        .collect();
    let study = Study::open_changed(&path, &changes).unwrap_or_else(|it| panic!("{it}"));
    study.scenario().clone()
}

/// The best answer with a seed, its J, and the status.
fn solved(scenario: &mut Scenario, seed: u64) -> (Answer, f64, Status) {
    scenario.problem.seed = seed;
    let mut solution = solve(scenario, &Control::default());
    let best = solution.answers.remove(0);
    let objective = best.evaluation.as_ref().unwrap().terms.total();
    (best, objective, solution.status)
}

#[test]
fn every_problem_of_the_suite_has_best_settings_that_are_known() {
    let known = KnownBest::all().unwrap();
    let problems = problems();
    assert!(problems.len() >= 16);
    for (name, _) in &problems {
        assert!(known.iter().any(|it| it.problem == *name), "{name}");
    }
}

#[test]
fn searches_find_regions_apart_thin_bands_and_what_passes() {
    let names = [
        "bridge",
        "bridge-low",
        "lance-fills-bore",
        "groove-wall-deep",
        "gear-root-unit-weights",
    ];
    let (all, good, untrue) = searched(&names, 101..102);
    assert_eq!(all, names.len());
    assert!(good >= 4 && untrue == 0, "{good} of {all}, {untrue} untrue");
}

/// Where the shares of hits off target and on the floor are used up at once J has a kink along a flat valley. A simplex
/// that shrank there left J 14 % too high, and a near miss stayed one.
#[test]
fn what_passes_is_found_where_two_shares_are_used_up_at_once() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/search/t_slot.yaml");
    let mut scenario = scenario(&path).unwrap();
    for seed in [4, 8] {
        let (best, objective, status) = solved(&mut scenario, seed);
        assert!(best.passes() && objective < 0.85, "{seed}: {objective}");
        // The least J that 18 seeds have found is 0.800.
        let is_best = objective < 0.800 * 1.02;
        assert!(is_best || status != Status::Converged, "{seed}");
    }
}

/// On few shots this seed takes 83 % of an allowed share for all of it, which costs 2 % of J.
#[test]
fn an_allowed_share_is_used_up() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/gear-root-unit-weights.yaml");
    let mut scenario = scenario(&path).unwrap();
    let (best, objective, _) = solved(&mut scenario, 25);
    let violation = best.largest_violation();
    assert!(best.passes() && violation > 0.92, "{violation}");
    // The least J that 60 seeds have found is 0.2897.
    assert!(objective < 0.2897 * 1.01, "{objective}");
}

/// What passes costs 20 times the J of settings that just fail: before violations outweighed that, one seed of these two
/// at least ended at what fails.
#[test]
fn a_narrow_window_is_found_where_passing_costs_many_times_the_least_j() {
    let changes = [
        ["goals.normal_impulse.tolerance", "12.75 %"],
        ["goals.rebound.allow", "20 uN.s"],
        ["nozzle.body", "[ { ball: { radius: 2.55 mm } } ]"],
        ["contacts.oiled.mu_s", "0.072"],
        ["tolerance.incidence", "1.4 deg"],
        ["tolerance.azimuth", "2.4 deg"],
    ];
    let mut scenario = changed("keyway.yaml", &changes);
    let pass = [1, 2].map(|seed| {
        let (best, objective, _) = solved(&mut scenario, seed);
        // Only there.
        assert!(!best.passes() || objective > 0.09, "{seed}: {objective}");
        best.passes()
    });
    assert_eq!(pass, [true; 2]);
}

/// Only one speed in a hundred passes at the poses that are good here: of speeds 4 % apart none did, and these seeds said
/// FAIL.
#[test]
#[ignore = "takes half a minute"]
fn what_only_a_narrow_band_of_speeds_lets_pass_is_found() {
    let changes = [
        ["goals.miss.share", "0.6355 %"],
        ["goals.rebound.share", "0.3097 %"],
    ];
    let mut scenario = changed("gear-root.yaml", &changes);
    for seed in [2, 3] {
        let (best, objective, _) = solved(&mut scenario, seed);
        // The least J that three seeds have found is 0.01163; one of them was 50 % above.
        assert!(best.passes() && objective < 0.0118, "{seed}: {objective}");
    }
}

/// On the shots of the search alone what this seed finds violates 9 % more than the best known.
#[test]
fn what_violates_least_is_found_where_nothing_passes() {
    assert_eq!(searched(&["window"], 3..4), (1, 1, 0));
}

#[test]
#[ignore = "takes some minutes"]
fn searches_by_the_hundred_are_good_or_say_that_they_may_not_be() {
    let problems = problems();
    let names: Vec<&str> = problems.iter().map(|(name, _)| name.as_str()).collect();
    let quick: Vec<&str> = names
        .into_iter()
        .filter(|name| *name != "circlip-groove")
        .collect();
    let (all, good, untrue) = searched(&quick, 201..202);
    assert!(good * 100 >= all * 80, "{good} of {all}");
    assert!(untrue * 100 <= all * 6, "{untrue} of {all}");
}
