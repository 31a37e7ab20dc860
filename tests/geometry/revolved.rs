//! Parts turned about an axis.

use peenpose::feasibility::infeasibility;
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::Settings;
use peenpose::study::Study;

use crate::small_shot::study;

/// A hole of 12 mm, as a part goes into the scene.
fn hole(part: &str) -> Study {
    let target =
        "{ surface: hole.wall, within: { min: [-3, 5, 10], max: [3, 7, 20] }, along: [0, 0, 1] }";
    study(&format!("  hole: {part}\n"), target)
}

/// A straight line turned about the axis is a bore: the same objective with exact walls and with facets, whose corners lie on it.
#[test]
fn a_line_turned_about_the_axis_is_a_bore() {
    let bore = hole("{ bore: { diameter: 12 mm, length: 48 mm } }");
    let turned =
        hole("{ revolve: { profile: [ { from: [6, 0], line_to: [6, 48], surface: wall } ] } }");
    let shots = Samples::new(bore.problem(), Stream::Search, 1 << 17);
    for degrees in [55.0_f64, 70.0] {
        let mut settings = bore.problem().ranges.middle();
        settings.incidence = degrees.to_radians();
        let objective = |study: &Study| {
            let scenario = study.scenario();
            let tally = Tally::trace(scenario, &settings, settings.speed, &shots.shots);
            tally.terms(&scenario.problem.goals, settings.speed).total()
        };
        let (exact, facets) = (objective(&bore), objective(&turned));
        assert!(
            (facets / exact - 1.0).abs() < 2e-3,
            "{degrees}: {exact} {facets}"
        );
    }
}

/// What is closed is a body: a nozzle in it is in material, and one in the bore of it is not.
#[test]
fn a_closed_outline_is_a_body() {
    // A ring round the z axis, from 6 to 20 mm: outwards at its top, inwards along its bore.
    let ring = hole(
        "{ revolve: { profile: [ { from: [6, 0], line_to: [6, 48], surface: wall }, { line_to: [20, 48], surface: top }, \
         { line_to: [20, 0], surface: outside }, { line_to: [6, 0], surface: bottom } ] } }",
    );
    let scenario = ring.scenario();
    assert_eq!(scenario.scene.surfaces().len(), 4);
    let aim = scenario.target.frame.aim;
    // The default aim is on the wall, in front of the middle of the strip.
    assert!(
        (aim.x.abs() < 1e-5) && (aim.y - 6e-3).abs() < 2e-6 && (aim.z - 15e-3).abs() < 1e-4,
        "{aim}"
    );
    let mut settings = ring.problem().ranges.middle();
    let fits = |settings: &Settings| infeasibility(scenario, settings).is_none();
    assert!(fits(&settings));
    // Beyond the other side of the bore is metal.
    settings.incidence = std::f64::consts::FRAC_PI_2;
    settings.standoff = 14e-3;
    assert!(!fits(&settings));
}
