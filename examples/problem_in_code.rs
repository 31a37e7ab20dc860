//! A problem that is changed in code: how long may a hub be before rebounds stay inside?
//!
//!     cargo run --release --example problem_in_code

use std::error::Error;
use std::path::Path;

use peenpose::control::Control;
use peenpose::problem::part::Shape;
use peenpose::study::{Extras, Study};

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
    let study = Study::from_text(TEXT, Path::new("in code"))?;

    for length in [40e-3, 60e-3, 100e-3, 200e-3] {
        let mut problem = study.problem().clone();
        if let Shape::Keyway(keyway) = &mut problem.parts[0].shape {
            keyway.length = length;
        }
        // The scene is built once, and every pose is tried in it.
        let longer = study.clone().with_problem(problem);
        let longer = longer.map_err(|faults| format!("{faults:?}"))?;
        let record = longer.solve(Extras::default(), &Control::default());
        let best = record.ok_or("no contact to choose")?.best;
        let (millimetres, incidence) = (length * 1e3, best.settings.incidence_deg);
        match &best.objective {
            Some(objective) => println!(
                "{millimetres:3.0} mm: {incidence:.1} deg, J {:.5}",
                objective.total
            ),
            None => println!("{millimetres:3.0} mm: the nozzle fits nowhere"),
        }
    }
    Ok(())
}
