//! Restitution and friction at the ends of their ranges, against single impacts by hand.

use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

use peenpose::evaluate::evaluate;
use peenpose::jet::Replicates;
use peenpose::problem;
use peenpose::problem::setting::Settings;
use peenpose::record::{Record, RunInfo, StatusRecord, WorkRecord};
use peenpose::report::sheet;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::Answer;
use peenpose::study::Study;
use peenpose::unknowns::{Outcome, Quantity, Unknowns};
use peenpose::verdict::Subject;

/// A parallel jet on a plate: every shot does the same.
const PLATE: &str = "
format: 1
lengths_in: mm
scene: { part: { box: { min: [-50, -50, -10], max: [50, 50, 0] } } }
target: { surface: part.z_max, aim: [0, 0, 0], along: [1, 0, 0] }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1 mm, divergence: 0 deg }
contacts: { dry: { mu_s: 0.25, mu_d: 0.25, restitution: 0.5 } }
settings: { incidence: 45 deg, azimuth: 0 deg, standoff: 10 mm, speed: 10 m/s }
goals: { normal_impulse: { target: 40 uN.s, tolerance: 10 % } }
tolerance: { restitution: 0.2, friction: 60 % }
";

const MASS: f64 = 3.665_191_429_188_092e-6;

struct Case {
    source: problem::Source,
    scenario: Scenario,
    settings: Settings,
}

fn case(changes: &[(&str, &str)]) -> Case {
    let mut text = PLATE.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    let reading = problem::read_text(&text, Path::new("plate.yaml")).unwrap();
    let scenario = Scenario::new(reading.problem.unwrap(), Walls::Exact).unwrap();
    let ranges = &scenario.problem.ranges;
    let settings = Settings {
        incidence: ranges.incidence.min,
        azimuth: 0.0,
        standoff: ranges.standoff.min,
        speed: ranges.speed.min,
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact: 0,
        static_friction: 0.0,
    };
    Case {
        source: reading.source,
        scenario,
        settings,
    }
}

fn unknowns(case: &Case) -> Unknowns {
    Unknowns::of(&case.scenario, &case.settings).unwrap()
}

/// Angle between path and surface after one impact without spin, deg.
fn rebound_angle(incidence: f64, restitution: f64, friction: f64) -> f64 {
    let (normal, tangential) = incidence.to_radians().sin_cos();
    let stops = 2.0 / 7.0 * tangential;
    let tangential = tangential - stops.min(friction * (1.0 + restitution) * normal);
    (restitution * normal).atan2(tangential).to_degrees()
}

fn degrees(effect: &Outcome) -> f64 {
    effect.rebound_angle.unwrap().to_degrees()
}

fn assert_close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() < 1e-9 * expected.abs(),
        "{found} is not {expected}"
    );
}

/// Half of a plate's top is the target: walls nearer or farther by what their file says move the footprint of a
/// slanted jet along it, and the share of its disc that hits the other half is known.
#[test]
fn walls_are_as_far_off_as_their_file_says() {
    let corners = "v -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nv 0 0 -10\n";
    let sides = "g sides\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\n";
    let mesh = |comment: &str| format!("{comment}\n{corners}g top\nf 1 2 3\nf 1 3 4\n{sides}");
    let text = PLATE
        .replace(
            "box: { min: [-50, -50, -10], max: [50, 50, 0] }",
            "mesh: plate.obj",
        )
        .replace(
            "part.z_max,",
            "part.top, within: { min: [-50, -50, -1], max: [0, 50, 1] },",
        )
        .replace(
            "tolerance: 10 % } }",
            "tolerance: 10 % }, miss: { share: 60 % } }",
        )
        .replace("tolerance: { restitution: 0.2, friction: 60 % }", "");
    let unknowns = |comment: &str| {
        let contents = mesh(comment).into_bytes();
        let meshes = [("plate.obj", Arc::from(contents))];
        let study = Study::from_memory(&text, Path::new("plate.yaml"), &meshes).unwrap();
        let settings = study.problem().ranges.middle();
        Unknowns::of(study.scenario(), &settings)
    };
    for comment in [
        "",
        "# deflection",
        "# deflection 0",
        "# deflection unknown",
        "#deflection 1",
    ] {
        assert_eq!(unknowns(comment), None, "{comment}");
    }
    let unknowns = unknowns("# deflection 0.05").unwrap();
    let [walls] = &unknowns.ranges[..] else {
        panic!("{unknowns:?}");
    };
    assert_eq!(walls.quantity, Quantity::Walls);
    let share = |effect: &Outcome| {
        let mut shares = effect.shares.iter();
        shares
            .find(|(subject, _)| *subject == Subject::Miss)
            .unwrap()
            .1
    };
    // A shot touches the plate before its centre comes to the line; the part of the disc beyond a chord.
    let beyond = |nearer: f64| {
        let chord = (0.5 + nearer) * 45_f64.to_radians().sin() / 0.5;
        (chord.acos() - chord * (1.0 - chord * chord).sqrt()) / PI
    };
    let [(farther, at_farther), (nearer, at_nearer)] = &walls.ends;
    assert_eq!((*farther, *nearer), (-5e-5, 5e-5));
    for (effect, nearer) in [
        (at_farther, -0.05),
        (&unknowns.nominal, 0.0),
        (at_nearer, 0.05),
    ] {
        let (found, expected) = (share(effect), beyond(nearer));
        assert!((found - expected).abs() < 0.002, "{found} {expected}");
    }
}

#[test]
fn rebounds_turn_as_single_impacts_do() {
    for incidence in [30.0, 45.0, 60.0, 75.0] {
        let case = case(&[("45 deg", &format!("{incidence} deg"))]);
        let unknowns = unknowns(&case);
        assert_close(
            degrees(&unknowns.nominal),
            rebound_angle(incidence, 0.5, 0.25),
        );
        let [restitution, friction] = &unknowns.ranges[..] else {
            panic!("{unknowns:?}");
        };
        assert_eq!(restitution.quantity, Quantity::Restitution);
        assert_eq!(friction.quantity, Quantity::Friction);
        for ((value, effect), e) in restitution.ends.iter().zip([0.3, 0.7]) {
            assert_close(*value, e);
            assert_close(degrees(effect), rebound_angle(incidence, e, 0.25));
            let arriving = 10.0 * incidence.to_radians().sin();
            assert_close(effect.normal_impulse, MASS * arriving * (1.0 + e));
        }
        for ((value, effect), mu) in friction.ends.iter().zip([0.1, 0.4]) {
            assert_close(*value, mu);
            assert_close(degrees(effect), rebound_angle(incidence, 0.5, mu));
        }
    }
}

/// At 45 deg restitution turns the rebound five times as far as friction; steeper ones stick anyway.
#[test]
fn restitution_turns_rebounds_further_than_friction() {
    let turns = |incidence: &str| {
        let case = case(&[("45 deg", incidence)]);
        let turns = unknowns(&case).ranges.into_iter().map(|range| {
            let [(_, low), (_, high)] = &range.ends;
            degrees(high) - degrees(low)
        });
        turns.collect::<Vec<f64>>()
    };
    let at_45 = turns("45 deg");
    assert!((21.0..22.0).contains(&at_45[0]), "{at_45:?}");
    assert!((4.0..5.0).contains(&at_45[1]), "{at_45:?}");
    let at_60 = turns("60 deg");
    assert!((23.0..24.0).contains(&at_60[0]), "{at_60:?}");
    assert!((0.9..1.2).contains(&at_60[1]), "{at_60:?}");
}

#[test]
fn the_objective_and_the_shares_are_those_of_the_end() {
    let case = case(&[]);
    let unknowns = unknowns(&case);
    let arriving = 10.0 * 0.5_f64.sqrt();
    let off = |e: f64| (MASS * arriving * (1.0 + e) / 40e-6 - 1.0).powi(2);
    assert_close(unknowns.nominal.objective, off(0.5));
    for ((_, effect), e) in unknowns.ranges[0].ends.iter().zip([0.3, 0.7]) {
        assert_close(effect.objective, off(e));
        let share = |wanted| effect.shares.iter().find(|(s, _)| *s == wanted).unwrap().1;
        // 33.7 and 44.1 uN.s: both off 40 by more than 10 %.
        assert_eq!(share(Subject::NormalImpulse), 1.0);
        assert_eq!(share(Subject::Miss), 0.0);
    }
    // N* does not depend on friction.
    for (_, effect) in &unknowns.ranges[1].ends {
        assert_close(effect.objective, off(0.5));
    }
}

#[test]
fn falling_restitution_and_contacts_of_the_target_itself_are_followed() {
    let falling = case(&[(
        "restitution: 0.5",
        "restitution: { value: 0.5, at: 2 m/s, exponent: 0.25 }",
    )]);
    let at = |reference: f64| reference * (10.0 * 0.5_f64.sqrt() / 2.0).powf(-0.25);
    for ((value, effect), e) in unknowns(&falling).ranges[0].ends.iter().zip([0.3, 0.7]) {
        assert_close(*value, e);
        assert_close(degrees(effect), rebound_angle(45.0, at(e), 0.25));
    }
    let own = case(&[(
        "\ntolerance:",
        "\nsurfaces: { part.z_max: { contact: { mu_s: 0.1, mu_d: 0.1, restitution: 0.8 } } }\ntolerance:",
    )]);
    let unknowns = unknowns(&own);
    assert_close(degrees(&unknowns.nominal), rebound_angle(45.0, 0.8, 0.1));
    // 0.8 + 0.2 is all there is.
    assert_close(unknowns.ranges[0].ends[1].0, 1.0);
    assert_close(unknowns.ranges[1].ends[1].0, 0.16);
}

#[test]
fn what_is_known_is_not_asked() {
    let known = case(&[("restitution: 0.2, friction: 60 %", "speed: 3 %")]);
    assert_eq!(Unknowns::of(&known.scenario, &known.settings), None);
    let one = case(&[("restitution: 0.2, friction: 60 %", "friction: 60 %")]);
    let ranges = unknowns(&one).ranges;
    assert_eq!(ranges.len(), 1);
    assert_eq!(ranges[0].quantity, Quantity::Friction);
}

fn record(case: &Case) -> Record {
    let fresh = Replicates::new(&case.scenario.problem, 0, 4096);
    let evaluation = evaluate(&case.scenario, &case.settings, &fresh);
    let answer = Answer::evaluated(&case.scenario, &case.settings, Some(evaluation));
    let run = RunInfo {
        source: &case.source,
        status: StatusRecord::Evaluated,
        spread: None,
        command: "peenpose evaluate plate.yaml".into(),
        segments: &[],
        ablations: &[],
        work: WorkRecord {
            poses: 1,
            shots_per_pose: 4096,
            rays: 8192,
            seconds: 0.0,
        },
    };
    let unknowns = Unknowns::of(&case.scenario, &case.settings);
    Record::new(&case.scenario, &[answer], &[], vec![], unknowns, run).unwrap()
}

#[test]
fn the_sheet_names_the_one_that_moves_the_result_most() {
    let text = sheet(&record(&case(&[])));
    let joined = text.split_whitespace().collect::<Vec<_>>().join(" ");
    // J is 0.0000798 at E = 0.5, 0.0247 at 0.3 and 0.0103 at 0.7.
    assert!(
        joined.contains(
            "Over its range restitution moves J most, by 0.024 and turns the rebound by 21.6 deg"
        ),
        "{text}"
    );
    assert!(
        joined.contains("friction moves J by 0 and turns the rebound by 4.5 deg"),
        "{text}"
    );
    assert!(joined.contains("restitution 0.3 22.8 33.7"), "{text}");
    assert!(
        text.lines().all(|line| line.chars().count() <= 92),
        "{text}"
    );
    let known = case(&[("restitution: 0.2, friction: 60 %", "speed: 3 %")]);
    assert!(!sheet(&record(&known)).contains("UNKNOWNS"));
}

#[test]
fn records_of_before_are_still_read() {
    let record = record(&case(&[]));
    let text = record.to_json().unwrap();
    assert_eq!(Record::from_json(&text).unwrap(), record);
    let mut value: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert!(value.as_object_mut().unwrap().remove("unknowns").is_some());
    let older = Record::from_json(&value.to_string()).unwrap();
    assert_eq!(older.unknowns, None);
    assert_eq!(older.best, record.best);
}
