//! Parts turned about an axis.

use std::path::Path;

use peenpose::feasibility::infeasibility;
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::Settings;
use peenpose::study::Study;

/// A hole of 12 mm, as a part goes into the scene.
const TEXT: &str = "\
format: 1
lengths_in: mm
scene:
  hole: PART
target: { surface: hole.wall, within: { min: [-3, 5, 10], max: [3, 7, 20] }, along: [0, 0, 1] }
shot: { radius: 0.3 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1 mm, divergence: 3 deg, speed_spread: 5 % }
contacts: { dry: { mu_s: 0.3, mu_d: 0.27, restitution: 0.5 } }
settings: { incidence: [50 deg, 85 deg], azimuth: 0 deg, standoff: 4 mm, speed: 30 m/s }
goals:
  normal_impulse: { target: 30 uN.s, tolerance: 15 %, share: 50 % }
  rebound: { allow: 3 uN.s, share: 50 % }
";

fn study(part: &str) -> Study {
    let text = TEXT.replace("PART", part);
    Study::from_text(&text, Path::new("hole.yaml"))
        .unwrap_or_else(|rejection| panic!("{rejection}"))
}

/// A straight line turned about the axis is a bore: the same objective with exact walls and with facets, whose corners lie on it.
#[test]
fn a_line_turned_about_the_axis_is_a_bore() {
    let bore = study("{ bore: { diameter: 12 mm, length: 48 mm } }");
    let turned =
        study("{ revolve: { profile: [ { from: [6, 0], line_to: [6, 48], surface: wall } ] } }");
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
    let ring = study(
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
