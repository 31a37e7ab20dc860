//! Searches that leave out what does not matter find the answers of the whole model.

use std::path::Path;

use peenpose::precision::Precision;
use peenpose::problem::model::{Effect, Model};
use peenpose::problem::setting::Tolerance;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::{Control, Solution, solve};

fn shipped(file: &str) -> Scenario {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    let (scenario, _) = Scenario::load(&folder.join(file)).unwrap();
    scenario
}

/// J of shots whose impulses are what is wanted but for rounding, at most.
const ROUNDING_OF_OBJECTIVE: f64 = 1e-28;

fn with_model(scenario: &Scenario, model: Model) -> Solution {
    let mut scenario = scenario.clone();
    scenario.problem.model = model;
    solve(&scenario, &Control::default())
}

/// J and its standard error.
fn objective(solution: &Solution) -> (f64, f64) {
    let evaluation = solution.answers[0].evaluation.as_ref().unwrap();
    (evaluation.terms.total(), evaluation.standard_error)
}

/// Solves with the model left to the program and with the whole one; returns what was left out.
fn same_answer(scenario: &Scenario) -> Vec<Effect> {
    let auto = with_model(scenario, Model::Auto);
    let full = with_model(scenario, Model::Full);
    let ((found, error), (expected, other)) = (objective(&auto), objective(&full));
    let accuracy = scenario.problem.accuracy * expected + 2.0 * error.hypot(other);
    assert!(
        found - expected <= accuracy.max(ROUNDING_OF_OBJECTIVE),
        "{found} {expected} {accuracy}"
    );
    assert!(full.ladder.rungs.is_empty() && full.ladder.left_out().is_empty());
    // Everything that the problem has was measured.
    let measured: Vec<Effect> = auto.ladder.rungs.iter().map(|rung| rung.effect).collect();
    assert_eq!(measured, scenario.problem.effects());
    for rung in &auto.ladder.rungs {
        assert!(rung.change.abs() <= rung.largest_change, "{rung:?}");
        assert!(
            rung.regret.is_finite() && rung.relative_rays > 0.0,
            "{rung:?}"
        );
    }
    auto.ladder.left_out()
}

/// The precision that is chosen after screening.
fn precision(scenario: &Scenario) -> Precision {
    let control = Control {
        most_shots: 64,
        validation_shots: 64,
        ..Control::default()
    };
    solve(scenario, &control).ladder.precision
}

#[test]
fn single_precision_is_for_exact_walls_where_it_changes_next_to_nothing() {
    let keyway = shipped("keyway.yaml");
    assert_eq!(precision(&keyway), Precision::F32);
    let facets = Walls::TriangleMesh { chord_angle: 0.1 };
    let of_facets = Scenario::new(keyway.problem.clone(), facets).unwrap();
    assert_eq!(precision(&of_facets), Precision::F64);
    let mut demanding = keyway;
    demanding.problem.accuracy = 1e-9;
    assert_eq!(precision(&demanding), Precision::F64);
    // J is rounding there, of which f32 leaves another one.
    assert_eq!(precision(&shipped("plate.yaml")), Precision::F64);
}

#[test]
fn on_a_plate_nothing_matters_and_one_ray_is_enough() {
    let scenario = shipped("plate.yaml");
    let left_out = same_answer(&scenario);
    assert_eq!(
        left_out,
        [
            Effect::ShotSize,
            Effect::Rebounds,
            Effect::LaterRebounds,
            Effect::Spin
        ]
    );
    let solution = with_model(&scenario, Model::Auto);
    let evaluation = solution.answers[0].evaluation.as_ref().unwrap();
    assert!(evaluation.is_exact && evaluation.shots == 1);
    assert!(solution.rays < 200, "{}", solution.rays);
    assert_eq!(solution.answers[0].verdicts[0].interval(), [0.0; 2]);
}

#[test]
fn in_a_keyway_rebounds_and_the_size_of_the_shot_matter() {
    for file in ["keyway.yaml", "keyway-long.yaml"] {
        let left_out = same_answer(&shipped(file));
        assert!(
            !left_out.contains(&Effect::Rebounds),
            "{file}: {left_out:?}"
        );
        assert!(
            !left_out.contains(&Effect::ShotSize),
            "{file}: {left_out:?}"
        );
        assert!(
            !left_out.contains(&Effect::Divergence),
            "{file}: {left_out:?}"
        );
    }
}

/// From afar the size of the shot and the width of the exit do nothing in this keyway: J is the same without
/// them until the jet is half a degree from the cliff that they make.
#[test]
fn what_makes_a_cliff_is_not_left_out_from_afar() {
    let mut scenario = shipped("keyway.yaml");
    scenario.problem.tolerance = Tolerance::default();
    for seed in [1, 2, 3, 10] {
        scenario.problem.seed = seed;
        let ladder = with_model(&scenario, Model::Auto).ladder;
        let size = &ladder.rungs[0];
        assert_eq!(size.effect, Effect::ShotSize);
        assert_eq!(
            (size.largest_change, size.regret),
            (0.0, 0.0),
            "seed {seed}"
        );
        let left_out = [Effect::LaterRebounds, Effect::Spin];
        assert_eq!(ladder.left_out(), left_out, "seed {seed}");
        assert_eq!(ladder.put_back, 0, "seed {seed}");
    }
}

#[test]
fn in_slots_and_between_teeth_all_but_the_spin_matters() {
    for file in ["firtree.yaml", "gear-root.yaml"] {
        let left_out = same_answer(&shipped(file));
        assert_eq!(left_out, [Effect::Spin], "{file}");
    }
}

#[test]
fn in_a_blind_keyway_given_as_a_mesh() {
    let left_out = same_answer(&shipped("keyway-blind.yaml"));
    assert!(!left_out.contains(&Effect::Rebounds), "{left_out:?}");
}

#[test]
fn a_list_of_effects_is_what_figures_come_from() {
    let scenario = shipped("keyway-long.yaml");
    let points: Vec<Effect> = scenario
        .problem
        .effects()
        .into_iter()
        .filter(|e| *e != Effect::ShotSize)
        .collect();
    let asked = with_model(&scenario, Model::Only(points.clone()));
    assert_eq!(asked.ladder.left_out(), [Effect::ShotSize]);
    assert_eq!(asked.ladder.rungs.len(), 1);
    let mut by_hand = scenario.clone();
    by_hand.problem.paths.shot_size = false;
    by_hand.problem.model = Model::Full;
    let expected = solve(&by_hand, &Control::default());
    assert_eq!(objective(&asked), objective(&expected));
    assert_eq!(asked.answers[0].settings, expected.answers[0].settings);
    // And the size of the shot does matter there.
    assert!(asked.ladder.rungs[0].regret > scenario.problem.accuracy);
}

/// A plate whose only spread is one that cannot matter there.
fn wide_jet_on_a_plate(extra: &str) -> Scenario {
    let text = format!(
        "
format: 1
lengths_in: mm
scene: {{ plate: {{ box: {{ min: [-200, -200, -5], max: [200, 200, 0] }} }} }}
target: {{ surface: plate.z_max, aim: [0, 0, 0] }}
shot: {{ radius: 0.3 mm, density: 7800 kg/m3 }}
jet: {{ exit_diameter: 3 mm, divergence: 0 deg }}
contacts: {{ dry: {{ mu_s: 0.3, mu_d: 0.25, restitution: 0.5 {extra} }} }}
settings: {{ incidence: [40 deg, 80 deg], azimuth: 0 deg, standoff: 20 mm, speed: [5 m/s, 50 m/s] }}
goals:
  normal_impulse: {{ target: 20 uN.s }}
  tangential_impulse: {{ limit: 1 uN.s }}
"
    );
    let reading = peenpose::problem::read_text(&text, Path::new("plate.yaml")).unwrap();
    let problem = reading
        .problem
        .unwrap_or_else(|| panic!("{:?}", reading.faults));
    Scenario::new(problem, peenpose::scene::Walls::Exact).unwrap()
}

#[test]
fn a_parallel_jet_on_a_plate_needs_one_ray() {
    let scenario = wide_jet_on_a_plate("");
    let left_out = same_answer(&scenario);
    assert!(left_out.contains(&Effect::ExitWidth), "{left_out:?}");
    // Screening and the first descents have the whole jet; afterwards there is one ray a pose.
    let [auto, full] = [Model::Auto, Model::Full].map(|model| with_model(&scenario, model));
    assert!(auto.rays < full.rays, "{} {}", auto.rays, full.rays);
}

#[test]
fn restitution_that_falls_with_speed_is_searched_with_where_it_matters() {
    // Its own value at 10 m/s, whatever the speed, against one that falls steeply.
    let falling = "".to_owned();
    let mut scenario = wide_jet_on_a_plate(&falling);
    scenario.problem.contacts[0].contact.restitution = peenpose::impact::Restitution::Falling {
        reference: 0.5,
        speed: 10.0,
        exponent: 0.25,
    };
    let auto = with_model(&scenario, Model::Auto);
    // The best of a fine grid over both settings, on single rays.
    let mut least = f64::INFINITY;
    for i in 0..=400 {
        for k in 0..=400 {
            let mut settings = auto.answers[0].settings;
            settings.incidence = scenario.problem.ranges.incidence.at(f64::from(i) / 400.0);
            settings.speed = scenario.problem.ranges.speed.at(f64::from(k) / 400.0);
            let shot = peenpose::jet::ShotSample::NONE;
            let tally =
                peenpose::objective::Tally::trace(&scenario, &settings, settings.speed, &[shot]);
            least = least.min(tally.terms(&scenario.problem.goals, settings.speed).total());
        }
    }
    let (found, _) = objective(&auto);
    assert!(found <= least * 1.01, "{found} {least}");
}
