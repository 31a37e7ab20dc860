//! Rare violations are drawn with an importance density, which changes no average.

use peenpose::evaluate::{evaluate, evaluate_adaptively, evaluate_each_adaptively, importance_of};
use peenpose::jet::{ImportanceDensity, Replicates, ValidationSample, purpose};
use peenpose::problem::Problem;
use peenpose::problem::setting::{Setting, Settings, Tolerance};
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::spread_settings;

/// A 40 mm hub whose nozzle is set within a tolerance.
fn hub() -> Problem {
    let mut problem = crate::common::keyway(40e-3);
    problem.tolerance = Tolerance {
        incidence: 2_f64.to_radians(),
        azimuth: 2_f64.to_radians(),
        standoff: 1e-3,
        speed: 0.03,
        restitution: 0.1,
        ..Tolerance::default()
    };
    problem
}

fn at(scenario: &Scenario, degrees: f64) -> Settings {
    let settings = Settings {
        azimuth: 0.0,
        standoff: 8e-3,
        speed: 9.4,
        ..spread_settings(scenario, 2, 1)[0]
    };
    Setting::Incidence.with(&settings, degrees.to_radians())
}

/// Mean of J over seeds, its standard error, and the scatter from seed to seed.
fn statistics(objectives: &[f64]) -> (f64, f64, f64) {
    let count = objectives.len() as f64;
    let mean = objectives.iter().sum::<f64>() / count;
    let squares: f64 = objectives.iter().map(|it| (it - mean).powi(2)).sum();
    let scatter = (squares / (count - 1.0)).sqrt();
    (mean, scatter / count.sqrt(), scatter)
}

/// J of 2048 shots with each of some seeds, as they are and focused.
fn of_seeds(scenario: &mut Scenario, settings: &Settings, seeds: u64) -> [Vec<f64>; 2] {
    let each = (1..=seeds).map(|seed| {
        scenario.problem.seed = seed;
        let plain = Replicates::new(&scenario.problem, purpose::ANSWERS, 2048);
        let validation = ValidationSample::new(&scenario.problem, purpose::ANSWERS, 2048);
        (
            evaluate(scenario, settings, &plain).terms.total(),
            evaluate_adaptively(scenario, settings, &validation)
                .terms
                .total(),
        )
    });
    let (plain, focused) = each.unzip();
    [plain, focused]
}

#[test]
fn what_scouts_find_changes_no_average() {
    let mut scenario = Scenario::new(hub(), Walls::Exact).unwrap();
    // Where next to no shot violates, where few do, where one in eighteen does, where nearly half
    // of them do.
    for degrees in [67.5, 69.0, 72.0, 78.0] {
        let settings = at(&scenario, degrees);
        let [plain, focused] = of_seeds(&mut scenario, &settings, 48).map(|of| statistics(&of));
        let error = plain.1.hypot(focused.1);
        let apart = (plain.0 - focused.0) / error;
        assert!(apart.abs() < 3.5, "{degrees}: {plain:?} {focused:?}");
    }
}

#[test]
fn rare_violations_make_the_objective_scatter_several_times_less() {
    let mut scenario = Scenario::new(hub(), Walls::Exact).unwrap();
    let settings = at(&scenario, 69.0);
    let [plain, focused] = of_seeds(&mut scenario, &settings, 32).map(|of| statistics(&of));
    assert!(focused.2 < plain.2 / 3.0, "{plain:?} {focused:?}");
}

#[test]
fn without_violations_pilot_runs_find_none() {
    let mut problem = hub();
    // No limit on what surfaces may take, and a target that cannot be missed.
    problem.goals.rebound = None;
    problem.target.within = None;
    problem.goals.tangential_impulse = None;
    let scenario = Scenario::new(problem, Walls::Exact).unwrap();
    let (importance, rays) = importance_of(&scenario, &at(&scenario, 67.5));
    assert_eq!(importance, ImportanceDensity::NONE);
    assert!(rays > 3000, "{rays}");
    // One ray tells all about a jet of equal shots.
    let mut parallel = scenario.problem.clone();
    parallel.tolerance = Tolerance::default();
    parallel.jet.divergence = 0.0;
    parallel.jet.exit_diameter = 0.0;
    parallel.jet.speed_spread = 0.0;
    let parallel = Scenario::new(parallel, Walls::Exact).unwrap();
    assert_eq!(
        importance_of(&parallel, &at(&parallel, 67.5)),
        (ImportanceDensity::NONE, 0)
    );
}

#[test]
fn a_focus_leaves_the_shots_of_the_jet_as_they_are_but_for_what_they_stand_for() {
    let scenario = Scenario::new(hub(), Walls::Exact).unwrap();
    let (importance, _) = importance_of(&scenario, &at(&scenario, 69.0));
    assert_ne!(importance, ImportanceDensity::NONE);
    let plain = Replicates::new(&scenario.problem, purpose::ANSWERS, 1 << 14);
    let validation = ValidationSample::new(&scenario.problem, purpose::ANSWERS, 1 << 14);
    let mut weights = Vec::new();
    for (set, pending) in plain.sets.iter().zip(&validation.sets) {
        let focused = pending.with_importance(&scenario.problem, &importance);
        assert_eq!(focused.jet.shots.len(), set.jet.shots.len());
        assert_eq!(focused.boundary.shots.len(), set.boundary.shots.len());
        for (shot, of_jet) in focused.jet.shots.iter().zip(&set.jet.shots) {
            let mut same = *shot;
            same.weight = of_jet.weight;
            assert_eq!(same, *of_jet);
        }
        let changed = focused.boundary.shots.iter().zip(&set.boundary.shots);
        let changed = changed.filter(|(shot, before)| shot.cone != before.cone);
        assert_eq!(changed.count(), set.boundary.shots.len() / 2);
        let shots = focused.jet.shots.iter().chain(&focused.boundary.shots);
        weights.extend(shots.map(|shot| shot.weight));
        // Without an importance density they are the shots that anybody gets.
        let back = pending.with_importance(&scenario.problem, &ImportanceDensity::NONE);
        assert_eq!(back.jet.shots, set.jet.shots);
        assert_eq!(back.boundary.shots, set.boundary.shots);
    }
    let mean = weights.iter().sum::<f64>() / weights.len() as f64;
    assert!((mean - 1.0).abs() < 0.01, "{mean}");
    assert!(weights.iter().all(|&weight| weight > 0.0 && weight <= 1.5));
    // Those that are drawn with an importance density have a small weight.
    let (least, most) = weights
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(least, most), &weight| {
            (least.min(weight), most.max(weight))
        });
    assert!(least < 0.01 * most, "{least} {most}");
}

#[test]
fn settings_that_share_their_shots_get_the_figures_that_each_gets_alone() {
    let scenario = Scenario::new(hub(), Walls::Exact).unwrap();
    let validation = ValidationSample::new(&scenario.problem, purpose::ANSWERS, 1024);
    // Clear of the cliff, beside it and beyond: more than are evaluated at a time.
    let choices = [62.0, 66.0, 68.0, 69.0, 71.0, 76.0].map(|degrees| at(&scenario, degrees));
    let together = evaluate_each_adaptively(&scenario, &choices, &validation);
    assert_eq!(together.len(), choices.len());
    for (settings, together) in choices.iter().zip(&together) {
        let alone = evaluate_adaptively(&scenario, settings, &validation);
        assert_eq!(format!("{together:?}"), format!("{alone:?}"));
    }
    let none = evaluate_each_adaptively(&scenario, &[], &validation);
    assert!(none.is_empty());
}

/// A jet along a keyway's wall that one shot in 60 000 misses, at a cost of 500 mean shots. J is the mean of three times 2^22 shots,
/// known to 3e-6.
#[test]
fn standard_errors_tell_of_events_that_most_samples_do_not_hold() {
    const J: f64 = 0.004_352_8;
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/suite/groove-wall.yaml");
    let (mut scenario, _) = Scenario::load(std::path::Path::new(file)).expect("it is sound");
    let settings = Settings {
        incidence: 24.032_673_922_5_f64.to_radians(),
        azimuth: 1.258_070_446_2_f64.to_radians(),
        standoff: 0.030_048_143_7,
        speed: 64.395_073_387,
        aim_along: -0.002_161_453_1,
        aim_across: 0.000_122_486_4,
        aim_above: 0.000_463_865,
        ..spread_settings(&scenario, 0, 1)[0]
    };
    let settings = Setting::StaticFriction.with(&settings, 0.082_956_344_6);
    let mut apart: Vec<f64> = (1..=96)
        .map(|seed| {
            scenario.problem.seed = seed;
            let validation = ValidationSample::new(&scenario.problem, purpose::ANSWERS, 1 << 14);
            let found = evaluate_adaptively(&scenario, &settings, &validation);
            (found.terms.total() - J).abs() / found.standard_error
        })
        .collect();
    apart.sort_by(f64::total_cmp);
    // One in twelve may be two of them off, none four.
    assert!(apart[87] < 2.0 && apart[95] < 4.0, "{apart:?}");
}
