//! Maps: each place is what an evaluation there says, whichever way it was computed.

mod common;

use std::path::Path;

use peenpose::evaluate::evaluate;
use peenpose::impact::Restitution;
use peenpose::jet::{Replicate, Replicates, Samples, Stream};
use peenpose::map::{Axis, Map, standard_maps};
use peenpose::problem::setting::{Choice, Range, Setting};
use peenpose::record::{MapRecord, MapTerm};
use peenpose::scene::Walls;
use peenpose::setup::Setup;
use peenpose::solve::clearance_violation;
use peenpose::verdict::Verdict;

const SHOTS: usize = 512;

fn keyway() -> Setup {
    let mut problem = common::keyway(40e-3);
    problem.paths.shot_size = true;
    Setup::new(problem, Walls::Exact).unwrap()
}

fn good() -> Choice {
    Choice {
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
fn agrees_with_evaluations(setup: &Setup, map: &Map) {
    let same_shots = Samples::new(
        &setup.problem,
        Stream::Fresh(Replicates::COUNT as u32),
        SHOTS,
    );
    let shots = Replicates {
        sets: vec![Replicate {
            jet: same_shots,
            rim: Samples { deviates: vec![] },
        }],
    };
    let columns = map.x.values.len();
    let (mut blocked, mut failing) = (0, 0);
    for (index, cell) in map.cells.iter().enumerate() {
        let across = map.x.setting.with(&good(), map.x.values[index % columns]);
        let choice = map.y.setting.with(&across, map.y.values[index / columns]);
        let Some(cell) = cell else {
            assert!(clearance_violation(setup, &choice).is_some());
            blocked += 1;
            continue;
        };
        assert!(clearance_violation(setup, &choice).is_none());
        let there = evaluate(setup, &choice, &shots);
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-9 * b.abs() + 1e-15, "{a} {b}");
        close(cell.terms.normal_impulse, there.terms.normal_impulse);
        close(
            cell.terms.tangential_impulse,
            there.terms.tangential_impulse,
        );
        close(cell.terms.rebound, there.terms.rebound);
        close(cell.terms.miss, there.terms.miss);
        let fails: Vec<_> = Verdict::all(setup, &there)
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
    assert!(failing > 0 && blocked + failing < map.cells.len());
}

#[test]
fn a_map_without_speed_is_what_evaluations_say() {
    let setup = keyway();
    let x = axis(Setting::Incidence, 0.6, 1.4, 9);
    let y = axis(Setting::Azimuth, -0.6, 0.6, 7);
    let map = Map::of(&setup, &good(), x, y, SHOTS, None);
    assert!(map.cells.iter().any(Option::is_none));
    agrees_with_evaluations(&setup, &map);
}

#[test]
fn one_set_of_paths_does_for_every_speed() {
    let setup = keyway();
    let standoff = || axis(Setting::Standoff, 2e-3, 34e-3, 6);
    let speed = || axis(Setting::Speed, 5.0, 20.0, 9);
    agrees_with_evaluations(
        &setup,
        &Map::of(&setup, &good(), standoff(), speed(), SHOTS, None),
    );
    agrees_with_evaluations(
        &setup,
        &Map::of(&setup, &good(), speed(), standoff(), SHOTS, None),
    );
}

#[test]
fn every_speed_has_its_own_paths_where_restitution_falls() {
    let mut setup = keyway();
    for contact in &mut setup.problem.contacts {
        contact.contact.restitution = Restitution::Falling {
            reference: 0.4,
            speed: 5.0,
            exponent: 0.25,
        };
    }
    let x = axis(Setting::Speed, 5.0, 15.0, 5);
    let y = axis(Setting::Incidence, 1.0, 1.3, 4);
    agrees_with_evaluations(&setup, &Map::of(&setup, &good(), x, y, SHOTS, None));
}

#[test]
fn on_a_plate_the_map_is_a_formula() {
    let path = Path::new("problems/plate.yaml");
    let (setup, _) = Setup::load(path).unwrap();
    let choice = Choice {
        contact: 0,
        ..setup.problem.settings.middle()
    };
    let x = axis(Setting::Incidence, 0.5, 1.5, 11);
    let y = axis(Setting::Speed, 2.0, 20.0, 10);
    let map = Map::of(&setup, &choice, x, y, SHOTS, None);
    assert_eq!(map.shots, 1);
    let restitution = setup.problem.contacts[0].contact.restitution.reference();
    let target = setup.problem.goals.normal_impulse.target;
    for (index, cell) in map.cells.iter().enumerate() {
        let (incidence, speed) = (map.x.values[index % 11], map.y.values[index / 11]);
        let normal = setup.problem.shot.mass() * speed * incidence.sin() * (1.0 + restitution);
        let expected = setup.problem.goals.normal_impulse.weight * (normal / target - 1.0).powi(2);
        let found = cell.as_ref().unwrap().terms.normal_impulse;
        assert!((found - expected).abs() < 1e-9 * (1.0 + expected));
    }
}

#[test]
fn records_keep_seven_digits_and_name_what_fails() {
    let setup = keyway();
    let x = axis(Setting::Incidence, 0.6, 1.4, 5);
    let y = axis(Setting::Azimuth, -0.6, 0.6, 4);
    let map = Map::of(&setup, &good(), x, y, SHOTS, None);
    let record = MapRecord::new(&setup, &map);
    assert_eq!(record.x.setting, "incidence_deg");
    assert!((record.x.values[0] - 0.6_f64.to_degrees()).abs() < 1e-6);
    assert_eq!(record.subjects.last().unwrap(), "clearance");
    let clearance = record.subjects.len() as u32 - 1;
    for (cell, kept) in map.cells.iter().zip(&record.cells) {
        assert_eq!(cell.is_none(), kept.fails == [clearance]);
        let total = cell.as_ref().map(|cell| cell.terms.total());
        assert_eq!(total.is_some(), MapTerm::Total.of(kept).is_some());
        if let (Some(total), Some(kept)) = (total, MapTerm::Total.of(kept)) {
            assert!((total - kept).abs() <= 1e-6 * total);
        }
    }
}

#[test]
fn a_report_has_maps_of_what_is_free() {
    let axes = |file: &str| -> Vec<(Setting, Setting)> {
        let (setup, _) = Setup::load(&Path::new("problems").join(file)).unwrap();
        let middle = setup.problem.settings.middle();
        let maps = standard_maps(&setup, &middle);
        for map in &maps {
            let values = [&map.x.values, &map.y.values];
            assert!(values.iter().all(|values| (9..=41).contains(&values.len())));
            assert_eq!(map.cells.len(), values[0].len() * values[1].len());
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

    let mut setup = keyway();
    setup.problem.settings.azimuth = Range::held(0.0);
    let axes: Vec<_> = standard_maps(&setup, &good())
        .iter()
        .map(|map| (map.x.setting, map.y.setting))
        .collect();
    assert_eq!(axes, [(Standoff, Speed), (Incidence, Standoff)]);
}
