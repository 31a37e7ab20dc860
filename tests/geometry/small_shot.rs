//! A jet of shot of 0.6 mm, for parts and a target of one's own.

use std::path::Path;

use peenpose::study::Study;

const REST: &str = "\
shot: { radius: 0.3 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1 mm, divergence: 3 deg, speed_spread: 5 % }
contacts: { dry: { mu_s: 0.3, mu_d: 0.27, restitution: 0.5 } }
settings: { incidence: [50 deg, 85 deg], azimuth: 0 deg, standoff: 4 mm, speed: 30 m/s }
goals:
  normal_impulse: { target: 30 uN.s, tolerance: 15 %, share: 50 % }
  rebound: { allow: 3 uN.s, share: 50 % }
";

/// A problem with these parts, each on lines of its own, and this target.
pub fn study(scene: &str, target: &str) -> Study {
    let text = format!("format: 1\nlengths_in: mm\nscene:\n{scene}target: {target}\n{REST}");
    Study::from_text(&text, Path::new("small_shot.yaml"))
        .unwrap_or_else(|rejection| panic!("{rejection}"))
}
