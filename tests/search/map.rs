//! Maps: each place is what an evaluation there says, whichever way it was computed.

use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use peenpose::checkpoint::Checkpoint;
use peenpose::control::Control;
use peenpose::evaluate::evaluate;
use peenpose::feasibility::infeasibility;
use peenpose::impact::Restitution;
use peenpose::jet::{Replicate, Replicates, Samples, Stream};
use peenpose::map::{Axis, Map, Place, standard_maps};
use peenpose::problem::setting::{Range, Setting, Settings};
use peenpose::record::{MapRecord, MapTerm};
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::verdict::Verdict;
use tempfile::TempDir;

use crate::common::shipped;

const SHOTS: usize = 512;

fn keyway() -> Scenario {
    let mut problem = crate::common::keyway(40e-3);
    problem.paths.shot_size = true;
    Scenario::new(problem, Walls::Exact).unwrap()
}

fn good() -> Settings {
    Settings {
        incidence: 67_f64.to_radians(),
        azimuth: 0.0,
        standoff: 8e-3,
        speed: 9.4,
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact: 2,
        static_friction: 0.06,
    }
}

fn axis(setting: Setting, min: f64, max: f64, steps: usize) -> Axis {
    Axis::over(setting, Range { min, max }, steps)
}

/// Every place of a map against an evaluation on the same shots.
fn agrees_with_evaluations(scenario: &Scenario, map: &Map) {
    let same_shots = Samples::new(
        &scenario.problem,
        Stream::Validation(Replicates::COUNT as u32),
        SHOTS,
    );
    let shots = Replicates {
        sets: vec![Replicate {
            jet: same_shots,
            boundary: Samples { shots: vec![] },
        }],
    };
    let columns = map.x.values.len();
    let (mut blocked, mut failing) = (0, 0);
    for (index, place) in map.places.iter().enumerate() {
        let across = map.x.setting.with(&good(), map.x.values[index % columns]);
        let settings = map.y.setting.with(&across, map.y.values[index / columns]);
        let Place::Open(cell) = place else {
            assert_eq!(*place, Place::Blocked);
            assert!(infeasibility(scenario, &settings).is_some());
            blocked += 1;
            continue;
        };
        assert!(infeasibility(scenario, &settings).is_none());
        let there = evaluate(scenario, &settings, &shots);
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-9 * b.abs() + 1e-15, "{a} {b}");
        close(cell.terms.normal_impulse, there.terms.normal_impulse);
        close(
            cell.terms.tangential_impulse,
            there.terms.tangential_impulse,
        );
        close(cell.terms.rebound, there.terms.rebound);
        close(cell.terms.miss, there.terms.miss);
        let fails: Vec<_> = Verdict::all(scenario, &there)
            .into_iter()
            .filter(|verdict| !verdict.passes())
            .map(|verdict| verdict.subject)
            .collect();
        assert_eq!(cell.failing, fails);
        failing += usize::from(!fails.is_empty());
        let hits = there.target.hits;
        let sticking = (hits > 0).then(|| there.target.sticking as f64 / hits as f64);
        assert_eq!(cell.share_sticking, sticking);
    }
    assert!(failing > 0 && blocked + failing < map.places.len());
}

#[test]
fn a_map_without_speed_is_what_evaluations_say() {
    let scenario = keyway();
    let x = axis(Setting::Incidence, 0.6, 1.4, 9);
    let y = axis(Setting::Azimuth, -0.6, 0.6, 7);
    let map = Map::of(&scenario, &good(), x, y, SHOTS, &Control::default());
    assert!(map.places.contains(&Place::Blocked));
    agrees_with_evaluations(&scenario, &map);
}

#[test]
fn one_set_of_paths_does_for_every_speed() {
    let scenario = keyway();
    let standoff = || axis(Setting::Standoff, 2e-3, 34e-3, 6);
    let speed = || axis(Setting::Speed, 5.0, 20.0, 9);
    agrees_with_evaluations(
        &scenario,
        &Map::of(
            &scenario,
            &good(),
            standoff(),
            speed(),
            SHOTS,
            &Control::default(),
        ),
    );
    agrees_with_evaluations(
        &scenario,
        &Map::of(
            &scenario,
            &good(),
            speed(),
            standoff(),
            SHOTS,
            &Control::default(),
        ),
    );
}

#[test]
fn every_speed_has_its_own_paths_where_restitution_falls() {
    let mut scenario = keyway();
    for contact in &mut scenario.problem.contacts {
        contact.contact.restitution = Restitution::Falling {
            reference: 0.4,
            speed: 5.0,
            exponent: 0.25,
        };
    }
    let x = axis(Setting::Speed, 5.0, 15.0, 5);
    let y = axis(Setting::Incidence, 1.0, 1.3, 4);
    agrees_with_evaluations(
        &scenario,
        &Map::of(&scenario, &good(), x, y, SHOTS, &Control::default()),
    );
}

#[test]
fn on_a_plate_the_map_is_a_formula() {
    let path = Path::new("problems/plate.yaml");
    let (scenario, _) = Scenario::load(path).unwrap();
    let settings = Settings {
        contact: 0,
        ..scenario.problem.ranges.middle()
    };
    let x = axis(Setting::Incidence, 0.5, 1.5, 11);
    let y = axis(Setting::Speed, 2.0, 20.0, 10);
    let map = Map::of(&scenario, &settings, x, y, SHOTS, &Control::default());
    assert_eq!(map.shots, 1);
    let restitution = scenario.problem.contacts[0].contact.restitution.reference();
    let target = scenario.problem.goals.normal_impulse.target;
    for (index, place) in map.places.iter().enumerate() {
        let (incidence, speed) = (map.x.values[index % 11], map.y.values[index / 11]);
        let normal = scenario.problem.shot.mass() * speed * incidence.sin() * (1.0 + restitution);
        let expected =
            scenario.problem.goals.normal_impulse.weight * (normal / target - 1.0).powi(2);
        let found = place.cell().unwrap().terms.normal_impulse;
        assert!((found - expected).abs() < 1e-9 * (1.0 + expected));
    }
}

/// What is known of it is what the whole map says, and the rest is told apart from places without room.
#[test]
fn a_map_that_is_stopped_shows_what_is_known() {
    let scenario = keyway();
    let map = |control: &Control| {
        let x = axis(Setting::Incidence, 0.6, 1.4, 20);
        let y = axis(Setting::Azimuth, -0.6, 0.6, 40);
        Map::of(&scenario, &good(), x, y, SHOTS, control)
    };
    let whole = map(&Control::default());
    let folder = TempDir::new().unwrap();
    let checkpoint = Arc::new(Checkpoint::open(folder.path(), &scenario).unwrap());
    let control = Control {
        checkpoint: Some(Arc::clone(&checkpoint)),
        ..Control::default()
    };
    let stopped = thread::scope(|scope| {
        scope.spawn(|| {
            while checkpoint.added() < 20 {
                thread::sleep(Duration::from_millis(1));
            }
            control.cancel.end();
        });
        map(&control)
    });
    let known = |place: &&Place| **place != Place::Unknown;
    let count = stopped.places.iter().filter(known).count();
    assert!((20..whole.places.len()).contains(&count), "{count}");
    let pairs = stopped.places.iter().zip(&whole.places);
    let mut pairs = pairs.filter(|(place, _)| known(place));
    assert!(pairs.all(|(place, there)| place == there));
    assert!(!whole.places.contains(&Place::Unknown));

    let record = MapRecord::new(&scenario, &stopped);
    assert_eq!(record.known_places(), count);
    for (place, kept) in stopped.places.iter().zip(&record.cells) {
        assert_eq!(*place != Place::Unknown, kept.is_known());
        assert_eq!(*place == Place::Blocked, kept.is_blocked());
        assert!(kept.is_known() || !kept.passes());
    }

    // Nothing is begun that need not be ended.
    assert!(!map(&control).places.iter().any(|place| known(&place)));
}

#[test]
fn records_keep_seven_digits_and_name_what_fails() {
    let scenario = keyway();
    let x = axis(Setting::Incidence, 0.6, 1.4, 5);
    let y = axis(Setting::Azimuth, -0.6, 0.6, 4);
    let map = Map::of(&scenario, &good(), x, y, SHOTS, &Control::default());
    let record = MapRecord::new(&scenario, &map);
    assert_eq!(record.x.setting, "incidence_deg");
    assert!((record.x.values[0] - 0.6_f64.to_degrees()).abs() < 1e-6);
    assert_eq!(record.subjects.last().unwrap(), "clearance");
    let clearance = record.subjects.len() as u32 - 1;
    for (place, kept) in map.places.iter().zip(&record.cells) {
        assert_eq!(*place == Place::Blocked, kept.fails == [clearance]);
        assert_eq!(*place == Place::Blocked, kept.is_blocked());
        let total = place.cell().map(|cell| cell.terms.total());
        assert_eq!(total.is_some(), MapTerm::Total.of(kept).is_some());
        if let (Some(total), Some(kept)) = (total, MapTerm::Total.of(kept)) {
            assert!((total - kept).abs() <= 1e-6 * total);
        }
    }
}

#[test]
fn a_report_has_maps_of_what_is_free() {
    let axes = |file: &str| -> Vec<(Setting, Setting)> {
        let scenario = shipped::scenario(file);
        let middle = scenario.problem.ranges.middle();
        let maps = standard_maps(&scenario, &middle, &peenpose::control::Control::default());
        for map in &maps {
            let values = [&map.x.values, &map.y.values];
            assert!(values.iter().all(|values| (9..=41).contains(&values.len())));
            assert_eq!(map.places.len(), values[0].len() * values[1].len());
        }
        maps.iter()
            .map(|map| (map.x.setting, map.y.setting))
            .collect()
    };
    use Setting::{Azimuth, Incidence, Speed, Standoff};
    assert_eq!(
        axes("keyway.yaml"),
        [(Incidence, Azimuth), (Standoff, Speed)]
    );
    // Nothing but the contact is left open on the plate.
    assert_eq!(axes("plate.yaml"), []);

    let mut scenario = keyway();
    scenario.problem.ranges.azimuth = Range::held(0.0);
    let axes: Vec<_> = standard_maps(&scenario, &good(), &peenpose::control::Control::default())
        .iter()
        .map(|map| (map.x.setting, map.y.setting))
        .collect();
    assert_eq!(axes, [(Standoff, Speed), (Incidence, Standoff)]);
}
