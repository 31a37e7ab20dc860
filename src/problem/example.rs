//! Problems that unit tests start from.

use std::path::Path;

use super::Problem;
use super::equipment::{Role, SurfaceRule};

/// The keyway: N* = 40 uN.s with 15 %, 5 m/s to 40 m/s with 5 %, 30 deg to 85 deg, shot of
/// 3.665 mg, friction up to 0.30 and restitution 0.25.
pub fn keyway() -> Problem {
    let text = include_str!("../../problems/keyway.yaml");
    let reading = super::read_text(text, Path::new("keyway.yaml"));
    let reading = reading.expect("it is short enough");
    reading.problem.expect("it is sound")
}

/// A rule that says nothing of a surface.
pub fn rule(surface: &str) -> SurfaceRule {
    SurfaceRule {
        surface: surface.to_owned(),
        allow: None,
        share: None,
        weight: None,
        contact: None,
        library: None,
        roughness: 0.0,
        role: Role::Part,
    }
}
