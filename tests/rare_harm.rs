//! Rare harm is looked for where it comes from, which changes no average.

mod common;

use peenpose::evaluate::{evaluate, evaluate_each_focused, evaluate_focused, focus_on_harm};
use peenpose::jet::{Focus, Fresh, Replicates, purpose};
use peenpose::problem::Problem;
use peenpose::problem::setting::{Choice, Setting, Tolerance};
use peenpose::scene::Walls;
use peenpose::setup::Setup;
use peenpose::solve::spread_choices;

/// A 40 mm hub whose nozzle is set within a tolerance.
fn hub() -> Problem {
    let mut problem = common::keyway(40e-3);
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

fn at(setup: &Setup, degrees: f64) -> Choice {
    let choice = Choice {
        azimuth: 0.0,
        standoff: 8e-3,
        speed: 9.4,
        ..spread_choices(setup, 2, 1)[0]
    };
    Setting::Incidence.with(&choice, degrees.to_radians())
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
fn of_seeds(setup: &mut Setup, choice: &Choice, seeds: u64) -> [Vec<f64>; 2] {
    let each = (1..=seeds).map(|seed| {
        setup.problem.seed = seed;
        let plain = Replicates::new(&setup.problem, purpose::ANSWERS, 2048);
        let fresh = Fresh::new(&setup.problem, purpose::ANSWERS, 2048);
        (
            evaluate(setup, choice, &plain).terms.total(),
            evaluate_focused(setup, choice, &fresh).terms.total(),
        )
    });
    let (plain, focused) = each.unzip();
    [plain, focused]
}

#[test]
fn what_scouts_find_changes_no_average() {
    let mut setup = Setup::new(hub(), Walls::Exact).unwrap();
    // Where next to no shot does harm, where few do, where one in eighteen does, where nearly half
    // of them do.
    for degrees in [67.5, 69.0, 72.0, 78.0] {
        let choice = at(&setup, degrees);
        let [plain, focused] = of_seeds(&mut setup, &choice, 48).map(|of| statistics(&of));
        let error = plain.1.hypot(focused.1);
        let apart = (plain.0 - focused.0) / error;
        assert!(apart.abs() < 3.5, "{degrees}: {plain:?} {focused:?}");
    }
}

#[test]
fn rare_harm_makes_the_objective_scatter_several_times_less() {
    let mut setup = Setup::new(hub(), Walls::Exact).unwrap();
    let choice = at(&setup, 69.0);
    let [plain, focused] = of_seeds(&mut setup, &choice, 32).map(|of| statistics(&of));
    assert!(focused.2 < plain.2 / 3.0, "{plain:?} {focused:?}");
}

#[test]
fn where_there_is_no_harm_scouts_find_none() {
    let mut problem = hub();
    // No limit on what surfaces may take, and a target that cannot be missed.
    problem.goals.rebound = None;
    problem.target.within = None;
    problem.goals.tangential_impulse = None;
    let setup = Setup::new(problem, Walls::Exact).unwrap();
    let (focus, rays) = focus_on_harm(&setup, &at(&setup, 67.5));
    assert_eq!(focus, Focus::NONE);
    assert!(rays > 3000, "{rays}");
    // One ray tells all about a jet of equal shots.
    let mut parallel = setup.problem.clone();
    parallel.tolerance = Tolerance::default();
    parallel.jet.divergence = 0.0;
    parallel.jet.exit_diameter = 0.0;
    parallel.jet.speed_spread = 0.0;
    let parallel = Setup::new(parallel, Walls::Exact).unwrap();
    assert_eq!(
        focus_on_harm(&parallel, &at(&parallel, 67.5)),
        (Focus::NONE, 0)
    );
}

#[test]
fn a_focus_leaves_the_shots_of_the_jet_as_they_are_but_for_what_they_stand_for() {
    let setup = Setup::new(hub(), Walls::Exact).unwrap();
    let (focus, _) = focus_on_harm(&setup, &at(&setup, 69.0));
    assert_ne!(focus, Focus::NONE);
    let plain = Replicates::new(&setup.problem, purpose::ANSWERS, 1 << 14);
    let fresh = Fresh::new(&setup.problem, purpose::ANSWERS, 1 << 14);
    let mut weights = Vec::new();
    for (set, unfocused) in plain.sets.iter().zip(&fresh.sets) {
        let focused = unfocused.focused(&setup.problem, &focus);
        assert_eq!(focused.jet.deviates.len(), set.jet.deviates.len());
        assert_eq!(focused.rim.deviates.len(), set.rim.deviates.len());
        for (shot, of_jet) in focused.jet.deviates.iter().zip(&set.jet.deviates) {
            let mut same = *shot;
            same.weight = of_jet.weight;
            assert_eq!(same, *of_jet);
        }
        let changed = focused.rim.deviates.iter().zip(&set.rim.deviates);
        let changed = changed.filter(|(shot, before)| shot.cone != before.cone);
        assert_eq!(changed.count(), set.rim.deviates.len() / 2);
        let shots = focused.jet.deviates.iter().chain(&focused.rim.deviates);
        weights.extend(shots.map(|shot| shot.weight));
        // Without a focus they are the shots that anybody gets.
        let back = unfocused.focused(&setup.problem, &Focus::NONE);
        assert_eq!(back.jet.deviates, set.jet.deviates);
        assert_eq!(back.rim.deviates, set.rim.deviates);
    }
    let mean = weights.iter().sum::<f64>() / weights.len() as f64;
    assert!((mean - 1.0).abs() < 0.01, "{mean}");
    assert!(weights.iter().all(|&weight| weight > 0.0 && weight <= 1.5));
    // Those that are drawn where harm comes from stand for a small part of a shot.
    let (least, most) = weights
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(least, most), &weight| {
            (least.min(weight), most.max(weight))
        });
    assert!(least < 0.01 * most, "{least} {most}");
}

#[test]
fn settings_that_share_their_shots_get_the_figures_that_each_gets_alone() {
    let setup = Setup::new(hub(), Walls::Exact).unwrap();
    let fresh = Fresh::new(&setup.problem, purpose::ANSWERS, 1024);
    // Clear of the cliff, beside it and beyond: more than are evaluated at a time.
    let choices = [62.0, 66.0, 68.0, 69.0, 71.0, 76.0].map(|degrees| at(&setup, degrees));
    let together = evaluate_each_focused(&setup, &choices, &fresh);
    assert_eq!(together.len(), choices.len());
    for (choice, together) in choices.iter().zip(&together) {
        let alone = evaluate_focused(&setup, choice, &fresh);
        assert_eq!(format!("{together:?}"), format!("{alone:?}"));
    }
    let none = evaluate_each_focused(&setup, &[], &fresh);
    assert!(none.is_empty());
}
