//! What each effect of the model does at the answer, and models that leave effects out.

use std::path::Path;

use peenpose::control::Control;
use peenpose::problem::model::{Effect, Model};
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::{Ablation, Solution, solve};

use crate::common::shipped;

fn with_model(scenario: &Scenario, model: Model) -> Solution {
    let mut scenario = scenario.clone();
    scenario.problem.model = model;
    solve(&scenario, &Control::default())
}

/// J and its standard error.
pub fn objective(solution: &Solution) -> (f64, f64) {
    let evaluation = solution.answers[0].evaluation.as_ref().unwrap();
    (evaluation.terms.total(), evaluation.standard_error)
}

/// Share of the accuracy above which an effect matters.
const MATTERS: f64 = 0.5;

/// Solves with the model left to the program; returns the effects that matter at the answer.
fn that_matter(scenario: &Scenario) -> Vec<Effect> {
    let solution = with_model(scenario, Model::Auto);
    let measured = |ablation: &Ablation| ablation.effect;
    let effects: Vec<Effect> = solution.ablations.iter().map(measured).collect();
    assert_eq!(effects, scenario.problem.effects());
    for ablation in &solution.ablations {
        assert!(!ablation.left_out);
        assert!(
            ablation.change.abs() <= ablation.largest_change,
            "{ablation:?}"
        );
        assert!(
            ablation.regret.is_finite() && ablation.relative_rays > 0.0,
            "{ablation:?}"
        );
    }
    let tolerable = MATTERS * scenario.problem.accuracy;
    let matters = |it: &&Ablation| it.largest_change > tolerable || it.regret > tolerable;
    let all = solution.ablations.iter().filter(matters);
    all.map(measured).collect()
}

#[test]
fn on_a_plate_nothing_matters_and_one_ray_is_enough() {
    let scenario = shipped::scenario("plate.yaml");
    assert_eq!(that_matter(&scenario), []);
    let solution = with_model(&scenario, Model::Auto);
    let evaluation = solution.answers[0].evaluation.as_ref().unwrap();
    assert!(evaluation.is_exact && evaluation.shots == 1);
    assert!(solution.rays < 250, "{}", solution.rays);
    assert_eq!(solution.answers[0].verdicts[0].interval(), [0.0; 2]);
}

#[test]
fn in_a_keyway_rebounds_and_the_cone_of_the_jet_matter() {
    for file in ["keyway.yaml", "keyway-long.yaml"] {
        let matter = that_matter(&shipped::scenario(file));
        for effect in [Effect::Rebounds, Effect::Divergence] {
            assert!(matter.contains(&effect), "{file}: {matter:?}");
        }
    }
}

#[test]
fn in_slots_and_between_teeth_all_but_the_spin_matters() {
    for file in ["firtree.yaml", "gear-root.yaml"] {
        let scenario = shipped::scenario(file);
        let mut expected = scenario.problem.effects();
        expected.retain(|&effect| effect != Effect::Spin);
        assert_eq!(that_matter(&scenario), expected, "{file}");
    }
}

#[test]
fn in_a_blind_keyway_given_as_a_mesh() {
    let matter = that_matter(&shipped::scenario("keyway-blind.yaml"));
    assert!(matter.contains(&Effect::Rebounds), "{matter:?}");
}

#[test]
fn a_list_of_effects_is_what_figures_come_from() {
    let scenario = shipped::scenario("keyway-long.yaml");
    let mut points = scenario.problem.effects();
    points.retain(|&effect| effect != Effect::ShotSize);
    let asked = with_model(&scenario, Model::Only(points.clone()));
    let (left_out, others): (Vec<_>, Vec<_>) = asked.ablations.iter().partition(|it| it.left_out);
    assert_eq!(
        others.iter().map(|it| it.effect).collect::<Vec<_>>(),
        points
    );
    assert_eq!(left_out.len(), 1);
    assert_eq!(left_out[0].effect, Effect::ShotSize);
    // And the size of the shot does matter there.
    assert!(left_out[0].regret > scenario.problem.accuracy);
    let mut by_hand = scenario.clone();
    by_hand.problem.paths.shot_size = false;
    by_hand.problem.model = Model::Auto;
    let expected = solve(&by_hand, &Control::default());
    assert_eq!(objective(&asked), objective(&expected));
    assert_eq!(asked.answers[0].settings, expected.answers[0].settings);
}

/// A plate whose only spread is one that cannot matter there.
fn wide_jet_on_a_plate() -> Scenario {
    let text = "
format: 1
lengths_in: mm
scene: { plate: { box: { min: [-200, -200, -5], max: [200, 200, 0] } } }
target: { surface: plate.z_max, aim: [0, 0, 0] }
shot: { radius: 0.3 mm, density: 7800 kg/m3 }
jet: { exit_diameter: 3 mm, divergence: 0 deg }
contacts: { dry: { mu_s: 0.3, mu_d: 0.25, restitution: 0.5 } }
settings: { incidence: [40 deg, 80 deg], azimuth: 0 deg, standoff: 20 mm, speed: [5 m/s, 50 m/s] }
goals:
  normal_impulse: { target: 20 uN.s }
  tangential_impulse: { limit: 1 uN.s }
";
    let reading = peenpose::problem::read_text(text, Path::new("plate.yaml")).unwrap();
    let problem = reading
        .problem
        .unwrap_or_else(|| panic!("{:?}", reading.faults));
    Scenario::new(problem, Walls::Exact).unwrap()
}

#[test]
fn the_width_of_a_parallel_jet_does_not_matter_on_a_plate() {
    let matter = that_matter(&wide_jet_on_a_plate());
    assert!(!matter.contains(&Effect::ExitWidth), "{matter:?}");
}

#[test]
fn restitution_that_falls_with_speed_is_searched_with() {
    let mut scenario = wide_jet_on_a_plate();
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
