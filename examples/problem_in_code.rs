//! A problem that is changed in code: how long may a hub be before rebounds stay inside?
//!
//!     cargo run --release --example problem_in_code

use std::error::Error;
use std::path::Path;

use peenpose::control::Control;
use peenpose::problem;
use peenpose::problem::part::Shape;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::solve;

/// Quantities carry their units here; the checked problem is in SI.
const TEXT: &str = "
format: 1
scene:
  hub: { keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm } }
target: { surface: hub.floor }      # aimed at its centre
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1.5 mm, divergence: 4 deg, speed_spread: 5 % }
nozzle: { body: [ { ball: { radius: 3 mm } } ] }
contacts: { oiled: { mu_s: 0.06, mu_d: 0.054, restitution: 0.25 } }
settings:
  incidence: [30 deg, 85 deg]
  azimuth: 0 deg
  standoff: [6 mm, 20 mm]
  speed: [5 m/s, 40 m/s]
goals:
  normal_impulse: { target: 40 uN.s }
  rebound: { allow: 10 uN.s }
";

fn main() -> Result<(), Box<dyn Error>> {
    let reading = problem::read_text(TEXT, Path::new("in code"))?;
    let faults = problem::render(&reading.source, &reading.faults, false);
    let problem = reading.problem.ok_or(faults)?;

    for length in [40e-3, 60e-3, 100e-3, 200e-3] {
        let mut longer = problem.clone();
        if let Shape::Keyway(keyway) = &mut longer.parts[0].shape {
            keyway.length = length;
        }
        // The scene is built once, and every pose is tried in it.
        let scenario =
            Scenario::new(longer, Walls::Exact).map_err(|faults| format!("{faults:?}"))?;
        let best = &solve(&scenario, &Control::default()).answers[0];
        let (millimetres, incidence) = (length * 1e3, best.settings.incidence.to_degrees());
        match &best.evaluation {
            Some(found) => println!(
                "{millimetres:3.0} mm: {incidence:.1} deg, J {:.5}",
                found.terms.total()
            ),
            None => println!("{millimetres:3.0} mm: the nozzle fits nowhere"),
        }
    }
    Ok(())
}
