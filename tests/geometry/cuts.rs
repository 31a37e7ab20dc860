//! Parts that others are cut out of.

use std::f64::consts::FRAC_PI_2;

use peenpose::feasibility::infeasibility;
use peenpose::jet::{Samples, Stream};
use peenpose::objective::{Tally, Terms};
use peenpose::problem::setting::Settings;
use peenpose::study::Study;

use crate::small_shot::study;

/// J of settings, term by term.
fn terms(study: &Study, settings: &Settings) -> Terms {
    let shots = Samples::new(study.problem(), Stream::Search, 1 << 17);
    let tally = Tally::trace(study.scenario(), settings, settings.speed, &shots.shots);
    tally.terms(&study.problem().goals, settings.speed)
}

/// A hole that no shot reaches makes facets of the hub, and changes nothing else.
#[test]
fn the_objective_beside_a_hole_is_that_of_exact_walls() {
    let hub = "  hub: { keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm }CUT }\n";
    let hole = "  hole: { bore: { diameter: 4 mm, length: 20 mm }, \
                place: { at: [0, -30, 35], rotate: [-90 deg, 0 deg, 0 deg] } }\n";
    let target = "{ surface: hub.floor, within: { min: [-3, 18, 5], max: [3, 19, 12] } }";
    let exact = study(&hub.replace("CUT", ""), target);
    let drilled = study(&(hub.replace("CUT", ", cut: [hole]") + hole), target);
    assert!(exact.scenario().scene.has_exact_walls());
    assert!(!drilled.scenario().scene.has_exact_walls());
    for degrees in [55.0, 75.0] {
        let [exact, drilled] = [&exact, &drilled].map(|study| {
            let mut settings = study.problem().ranges.middle();
            settings.incidence = f64::to_radians(degrees);
            terms(study, &settings).total()
        });
        assert!(
            (drilled / exact - 1.0).abs() < 5e-3,
            "{degrees}: {exact} {drilled}"
        );
    }
}

/// A hole of 8 mm across a shaft of 30 mm: the nozzle may be in the hole, but not in the metal beside it.
#[test]
fn a_cross_hole_is_free_and_the_shaft_round_it_is_metal() {
    let shaft = |cut: &str| {
        format!("  shaft: {{ bore: {{ diameter: 30 mm, length: 60 mm, free: outside }}{cut} }}\n")
    };
    let hole = "  hole: { bore: { diameter: 8 mm, length: 40 mm }, \
                place: { at: [-20, 0, 30], rotate: [0 deg, 90 deg, 0 deg] } }\n";
    let target =
        "{ surface: hole.wall, within: { min: [-3, -2, 33], max: [3, 2, 35] }, along: [1, 0, 0] }";
    let drilled = study(&(shaft(", cut: [hole]") + hole), target);
    let mut settings = drilled.problem().ranges.middle();
    let fits =
        |study: &Study, settings: &Settings| infeasibility(study.scenario(), settings).is_none();
    assert!(fits(&drilled, &settings));
    // Flat along the hole, from before its mouth; not cut, the skin of the shaft is across that.
    settings.incidence = 0.2;
    settings.standoff = 18e-3;
    assert!(fits(&drilled, &settings));
    assert!(terms(&drilled, &settings).miss < 0.5);
    let whole = study(&(shaft("") + hole), target);
    assert_eq!(terms(&whole, &settings).miss, 1.0);
    // Upright, the other side of the hole is 8 mm away.
    settings.incidence = FRAC_PI_2;
    settings.standoff = 9e-3;
    assert!(!fits(&drilled, &settings));
}

/// What a pin says of its side settles what only the target would tell.
#[test]
fn a_bore_may_say_that_it_is_a_pin() {
    let pin = "  pin: { bore: { diameter: 30 mm, length: 60 mm, free: SIDE } }\n";
    let target = "{ surface: pin.wall, within: { min: [-2, 10, 20], max: [2, 16, 40] } }";
    let normal = |side: &str| {
        let study = study(&pin.replace("SIDE", side), target);
        study.scenario().target.frame.normal.y
    };
    assert!(normal("outside") > 0.99);
    assert!(normal("inside") < -0.99);
}
