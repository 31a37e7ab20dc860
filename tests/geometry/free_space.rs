//! The nozzle stands in free space: which side of a target is free, for every kind of mesh that people
//! have, and no setting that puts the nozzle into the material passes.

mod kinds;

use crate::common::program;
use std::path::Path;

use nalgebra::{Point3, Vector3};
use peenpose::control::Control;
use peenpose::feasibility::{Infeasible, Obstacle, gap_within_tolerance, infeasibility};
use peenpose::problem::fault_code::FaultCode;
use peenpose::problem::model::Effect;
use peenpose::problem::part::{Part, Place, Shape};
use peenpose::problem::setting::{Range, Setting, Tolerance};
use peenpose::problem::stroke::Leg;
use peenpose::scenario::Scenario;
use peenpose::scene::{Scene, Walls};
use peenpose::solve::{passing_windows, solve, spread_settings};
use peenpose::stroke::Program;
use peenpose::verdict::Subject;
use rayon::prelude::*;

use kinds::Free;

fn shipped(name: &str) -> Scenario {
    let path = format!("tests/free_space/{name}.yaml");
    Scenario::load(path.as_ref()).expect("it is sound").0
}

fn quick() -> Control {
    Control {
        most_shots: 1024,
        validation_shots: 4096,
        ..Control::default()
    }
}

#[test]
fn meshes_that_are_nearly_sound_are_peened_from_outside() {
    for name in [
        "missing_triangle",
        "inside_out_with_lug",
        "one_of_two_mirrored",
    ] {
        let scenario = shipped(name);
        assert_eq!(scenario.target.frame.normal, Vector3::y(), "{name}");
        let solution = solve(&scenario, &quick());
        let best = &solution.answers[0];
        assert!(best.passes(), "{name}");
        assert_eq!(infeasibility(&scenario, &best.settings), None, "{name}");
    }
}

#[test]
fn a_nozzle_in_the_metal_is_named() {
    let only = |scenario: &Scenario| spread_settings(scenario, 0, 1)[0];
    for (name, reason) in [
        ("exit_in_bore_wall", "the nozzle's exit is inside hole"),
        (
            "jet_through_lance",
            "the jet leaves through the nozzle's own body",
        ),
        (
            "exit_in_slot_wall",
            "the nozzle comes too near to disc.flanks",
        ),
        (
            "exit_wider_than_slot",
            "the nozzle comes too near to left.x_max",
        ),
        (
            "exit_wider_than_body",
            "the nozzle comes too near to left.x_max",
        ),
        ("pin_in_bore_wall", "a part on the nozzle meets hole.wall"),
        (
            "jet_through_lance_with_bracket",
            "the jet leaves through the nozzle's own body",
        ),
    ] {
        let scenario = shipped(name);
        let found = infeasibility(&scenario, &only(&scenario)).expect("it is infeasible");
        assert_eq!(found.obstacle.reason(&scenario), reason);
        assert!(found.violation > 0.0);
        let solution = solve(&scenario, &quick());
        assert!(!solution.answers[0].passes(), "{name}");
    }
}

/// Effects are what shots do; the nozzle stays what it is.
#[test]
fn a_model_without_an_effect_has_the_same_nozzle() {
    let mut infeasible = 0;
    for path in [
        "tests/free_space/exit_wider_than_slot.yaml",
        "tests/suite/bridge.yaml",
        "problems/keyway.yaml",
    ] {
        let mut scenario = Scenario::load(path.as_ref()).expect("it is sound").0;
        // Without a body the exit is what must not touch a wall.
        scenario.problem.nozzle.body.clear();
        for settings in spread_settings(&scenario, 0, 64) {
            let whole = infeasibility(&scenario, &settings);
            infeasible += usize::from(whole.is_some());
            for effect in Effect::ALL {
                let without = scenario.without(&[effect], &settings);
                let found = infeasibility(&without, &settings);
                assert_eq!(found, whole, "{path} without {effect:?}");
            }
        }
    }
    assert!(infeasible > 20, "{infeasible}");
}

/// A post beside a stroke that turns a corner, wherever its stations are; and how near the nozzle may pass it.
#[test]
fn a_nozzle_that_turns_a_corner_is_clear_between_its_stations() {
    let path = "tests/free_space/post_between_stations.yaml";
    let text = std::fs::read_to_string(path).expect("it is shipped");
    let folder = tempfile::tempdir().expect("there is space");
    let file = folder.path().join("post.yaml");
    for stations in [3, 4, 7, 20] {
        for (beside, fits) in [(3.0, false), (4.9, false), (5.2, true)] {
            let text = text.replace("stations: 3 ", &format!("stations: {stations} "));
            let post = format!("min: [6.9, {beside}, 0], max: [7.1, {}, 60]", beside + 0.2);
            let text = text.replace("min: [6.9, 3, 0], max: [7.1, 3.2, 60]", &post);
            std::fs::write(&file, text).expect("it can be written");
            let scenario = Scenario::load(&file).expect("it is sound").0;
            let settings = spread_settings(&scenario, 0, 1)[0];
            let found = infeasibility(&scenario, &settings);
            assert_eq!(found.is_none(), fits, "{stations} {beside}: {found:?}");
        }
    }
}

/// A post that is thinner than the steps in which a run-out is tried ends it wherever it stands.
#[test]
fn a_thin_post_ends_a_run_out() {
    let text = std::fs::read_to_string("tests/free_space/post_in_run_out.yaml");
    let text = text.expect("it is shipped");
    let folder = tempfile::tempdir().expect("there is space");
    let file = folder.path().join("post.yaml");
    for at in [18.3, 18.85, 19.4, 20.5] {
        let post = format!("min: [{at}, 0.98, 0], max: [{}, 1.5, 60]", at + 0.01);
        let text = text.replace("min: [20, 0.98, 0], max: [20.01, 1.5, 60]", &post);
        std::fs::write(&file, text).expect("it can be written");
        let scenario = Scenario::load(&file).expect("it is sound").0;
        let legs = [Leg::whole(&spread_settings(&scenario, 0, 1)[0])];
        let program = Program::of(&scenario, &legs).expect("it is a stroke");
        let [before, after] = program.run_outs;
        assert!(before.limit.is_none() && before.length > 4e-3, "{before:?}");
        assert_eq!(after.limit, Some(Subject::Clearance), "{at}: {after:?}");
        assert!(18e-3 + after.length < at * 1e-3, "{at}: {after:?}");
    }
}

/// What moves with the aim point never moves farther than it is said to: on a line that turns with the wall of a bore, past
/// a corner, and round an axis.
#[test]
fn nothing_moves_farther_along_a_stroke_than_its_bound() {
    const REACH: f64 = 0.02;
    for path in [
        "tests/free_space/line_round_a_bore.yaml",
        "tests/free_space/post_between_stations.yaml",
        "problems/bore-turning.yaml",
    ] {
        let scenario = Scenario::load(path.as_ref()).expect("it is sound").0;
        let traverse = scenario.traverse.as_ref().expect("it has a stroke");
        let mut closest = 0.0_f64;
        for index in 0..4000_u32 {
            let at = |axis| f64::from(sobol_burley::sample(index, axis, 7));
            let from = 1.4 * at(0) - 0.7;
            let to = from + 0.02 * at(1);
            let there = Vector3::new(at(2) - 0.5, at(3) - 0.5, at(4) - 0.5).normalize() * REACH;
            let [a, b] = [from, to].map(|place| {
                let frame = traverse.frame_at(place);
                frame.aim + frame.along * there.x + frame.across * there.y + frame.normal * there.z
            });
            let bound = traverse.motion([from, to], REACH);
            assert!((b - a).norm() <= bound + 1e-12, "{path} {from} {to}");
            closest = closest.max((b - a).norm() / bound.max(1e-12));
        }
        // A bound that is far too large would cost as much as none.
        assert!(closest > 0.5, "{path}: {closest}");
    }
}

/// The pin of a lance in a bore: where it fits with every error of the tolerance, it fits with each.
#[test]
fn a_pin_on_the_nozzle_fits_with_every_error_of_its_tolerance() {
    let mut scenario = Scenario::load("problems/deflector.yaml".as_ref())
        .expect("it is sound")
        .0;
    scenario.problem.nozzle.body.clear();
    scenario.problem.nozzle.clearance = 0.0;
    scenario.problem.ranges.aim_above = Range {
        min: 1e-3,
        max: 9e-3,
    };
    let mut exact = scenario.clone();
    exact.problem.tolerance = Tolerance::default();
    let moved = [
        Setting::Incidence,
        Setting::Azimuth,
        Setting::Standoff,
        Setting::AimAcross,
        Setting::AimAbove,
    ];
    let is_carried = |found: Infeasible| matches!(found.obstacle, Obstacle::Carried(_));
    let (mut met, mut fitted) = (0, 0);
    for settings in spread_settings(&scenario, 0, 64) {
        if let Some(found) = infeasibility(&scenario, &settings) {
            met += usize::from(is_carried(found));
            assert!(found.violation > 0.0);
            continue;
        }
        fitted += 1;
        for errors in 0..1 << moved.len() {
            let pairs = moved.iter().enumerate();
            let set = pairs.fold(settings, |set, (index, setting)| {
                let sign = if errors >> index & 1 == 0 { -1.0 } else { 1.0 };
                let error = sign * scenario.problem.tolerance.half_width(*setting);
                setting.with(&set, setting.of(&set) + error)
            });
            assert_eq!(infeasibility(&exact, &set), None, "{set:?}");
        }
    }
    assert!(met > 8 && fitted > 8, "{met} {fitted}");
}

/// Every kind of mesh, what is decided about it, and that nothing passes from inside.
#[test]
fn each_kind_of_mesh_is_decided_rightly_or_refused() {
    let folder = tempfile::tempdir().expect("there is space");
    for kind in kinds::all() {
        let scenario = kind.scenario(folder.path(), None);
        match (kind.free, scenario) {
            (Free::Outside, Ok(scenario)) => {
                let away = (scenario.target.frame.normal - kind.outward).norm();
                assert!(
                    away < 1e-6,
                    "{}: {:?}",
                    kind.name,
                    scenario.target.frame.normal
                );
            }
            (Free::Refused, Err(rules)) => {
                assert_eq!(rules, [FaultCode::FreeSideUnclear], "{}", kind.name);
            }
            (free, found) => panic!(
                "{}: {free:?} expected, found {:?}",
                kind.name,
                found.map(|scenario| scenario.target.frame.normal)
            ),
        }
        // Told the side, it is peened from there; and what is solid refuses the other one.
        let told = kind.scenario(folder.path(), Some(kind.outward));
        let told = told.unwrap_or_else(|rules| panic!("{}: {rules:?}", kind.name));
        assert!((told.target.frame.normal - kind.outward).norm() < 1e-6);
        let settings = spread_settings(&told, 0, 1)[0];
        assert_eq!(infeasibility(&told, &settings), None, "{}", kind.name);
    }
}

/// Where the nozzle stands on the other side of the same places, it is in the material.
#[test]
fn the_exit_behind_the_target_is_infeasible() {
    let folder = tempfile::tempdir().expect("there is space");
    // Behind a skin of a micrometre there is free space again.
    let kinds = kinds::all().into_iter();
    for kind in kinds.filter(|kind| kind.name != "a skin of a micrometre") {
        let scenario = kind.scenario(folder.path(), Some(kind.outward));
        let mut scenario = scenario.unwrap_or_else(|rules| panic!("{}: {rules:?}", kind.name));
        scenario.problem.nozzle.body.clear();
        scenario.target.frame.normal = -scenario.target.frame.normal;
        let settings = spread_settings(&scenario, 0, 1)[0];
        let found = infeasibility(&scenario, &settings);
        let found = found.unwrap_or_else(|| panic!("{} fits inside", kind.name));
        let is_named = matches!(found.obstacle, Obstacle::Material(_) | Obstacle::Surface(_));
        assert!(is_named, "{}: {found:?}", kind.name);
    }
}

/// Rays in three directions, counted by another test of triangles, against the winding numbers.
#[test]
fn the_inside_of_eleven_meshes_is_that_of_counted_rays() {
    const POINTS: u32 = 9100;
    let folder = tempfile::tempdir().expect("there is space");
    let mut checked = 0;
    for (number, body) in kinds::bodies().into_iter().enumerate() {
        let path = folder.path().join(format!("{number}.obj"));
        std::fs::write(&path, body.text()).expect("there is space");
        let part = Part {
            name: "body".into(),
            shape: Shape::Mesh {
                file: path.into(),
                metres_per_unit: 1e-3,
                regions: Vec::new(),
            },
            place: Place::default(),
            on_nozzle: false,
            cut: Vec::new(),
        };
        let scene = Scene::build(&[part], Walls::Exact).expect("it is sound");
        let (low, high) = body.bounds();
        let wrong: Vec<Point3<f64>> = (0..POINTS)
            .into_par_iter()
            .filter_map(|index| {
                let share = |axis| f64::from(sobol_burley::sample(index, axis, number as u32));
                let at = Vector3::new(share(0), share(1), share(2));
                let point = low + (high - low).component_mul(&at.map(|it| 1.1 * it - 0.05));
                let inside = scene.in_material(&(point * 1e-3), &(point * 1e-3));
                (inside.is_some() != body.holds(&point)).then_some(point)
            })
            .collect();
        assert!(wrong.is_empty(), "{}: {wrong:?}", body.name);
        checked += POINTS;
    }
    assert!(checked >= 100_000);
}

/// The worst gap over the tolerance is at most that of any of many poses within it, and hardly less
/// than the least of them.
#[test]
fn the_gap_within_tolerance_is_that_of_the_worst_of_many_poses() {
    let with = |nozzle: &str| {
        let text = include_str!("../free_space/lance_in_hub.yaml");
        let old = "  body: [ { capsule: { length: 80 mm, radius: 4 mm } } ]";
        let text = text.replace(old, nozzle);
        let folder = tempfile::tempdir().expect("there is space");
        let path = folder.path().join("hub.yaml");
        std::fs::write(&path, text).expect("there is space");
        Scenario::load(&path).expect("it is sound").0
    };
    for nozzle in [
        "  body: [ { ball: { radius: 2 mm } } ]",
        "  body: [ { capsule: { length: 80 mm, radius: 2 mm } } ]",
        "  body: [ { capsule: { length: 80 mm, radius: 2 mm, direction: [0, 0.2, -1] } } ]",
        "  body: []",
    ] {
        let scenario = with(nozzle);
        let tolerance = scenario.problem.tolerance;
        let mut exact = scenario.clone();
        exact.problem.tolerance = Default::default();
        let choices = spread_settings(&scenario, 0, 24);
        choices.par_iter().for_each(|settings| {
            if infeasibility(&exact, settings).is_some() {
                return;
            }
            let found = gap_within_tolerance(&scenario, settings)
                .expect("it is near")
                .distance;
            let mut least = f64::INFINITY;
            for (inc, az, off) in grid(4) {
                let mut set = *settings;
                set = Setting::Incidence.with(&set, set.incidence + inc * tolerance.incidence);
                set = Setting::Azimuth.with(&set, set.azimuth + az * tolerance.azimuth);
                set = Setting::Standoff.with(&set, set.standoff + off * tolerance.standoff);
                let gap = gap_within_tolerance(&exact, &set)
                    .expect("it is near")
                    .distance;
                least = least.min(gap);
            }
            // The lance is 80 mm long; its end turns by 1 deg and 2 deg.
            let bulge = 0.12 * (0.0175_f64.powi(2) + 0.035_f64.powi(2)) / 2.0;
            assert!(
                found < least + 1e-9,
                "{nozzle} {settings:?}: {found} {least}"
            );
            assert!(
                found > (least - bulge).min(-1e-3) || found > least - bulge,
                "{nozzle} {settings:?}: {found} {least}"
            );
        });
    }
}

/// Every corner of a cube of so many steps each way, in -1 to 1.
fn grid(steps: i32) -> impl Iterator<Item = (f64, f64, f64)> {
    let at = move |k: i32| 2.0 * f64::from(k) / f64::from(steps) - 1.0;
    let count = steps + 1;
    (0..count * count * count)
        .map(move |k| (at(k % count), at(k / count % count), at(k / count / count)))
}

/// The windows of an answer end where the verdict on the clearance turns, errors included.
#[test]
fn windows_and_the_verdict_on_the_clearance_agree() {
    let scenario = shipped("lance_in_hub");
    let solution = solve(&scenario, &quick());
    let best = &solution.answers[0];
    assert!(best.passes());
    let clearance = best
        .verdicts
        .iter()
        .find(|it| it.subject == Subject::Clearance);
    assert!(clearance.expect("it is judged").passes());
    let gap = gap_within_tolerance(&scenario, &best.settings).expect("it is near");
    assert!(gap.distance >= scenario.problem.nozzle.clearance, "{gap:?}");
    let mut ends = 0;
    for window in passing_windows(
        &scenario,
        &solution.answers[0],
        &peenpose::control::Cancel::default(),
    ) {
        let start = window.setting.of(&best.settings);
        for drift in [window.down, window.up] {
            let fits = |value: f64| {
                infeasibility(&scenario, &window.setting.with(&best.settings, value)).is_none()
            };
            assert!(fits(drift.to), "{window:?}");
            if drift.turns == Some(peenpose::solve::Turn::Clearance) {
                let beyond = drift.to + 1.001 * drift.within * (drift.to - start).signum();
                let beyond = if drift.to == start {
                    // It turns at once, one way or the other.
                    ends += 1;
                    continue;
                } else {
                    beyond
                };
                assert!(!fits(beyond), "{window:?}");
                ends += 1;
            }
        }
    }
    assert!(ends > 0);
}

/// Mesh warnings are on stderr of the commands that answer.
#[test]
fn solve_and_evaluate_warn_about_meshes() {
    for command in ["solve", "evaluate"] {
        let mut arguments = vec![command, "tests/free_space/one_of_two_mirrored.yaml"];
        if command == "evaluate" {
            for set in [
                "incidence=90deg",
                "azimuth=0deg",
                "standoff=8mm",
                "speed=17m/s",
            ] {
                arguments.extend(["--set", set]);
            }
        }
        let run = program::peenpose(arguments, Path::new(env!("CARGO_MANIFEST_DIR")));
        let words = &run.messages;
        assert!(words.contains("a closed body is inside out"), "{words}");
    }
}
