//! What several benches share.

use peenpose::problem::setting::Settings;

/// Settings with the first contact; angles in degrees, else SI.
pub fn settings(incidence: f64, azimuth: f64, standoff: f64, speed: f64) -> Settings {
    Settings {
        incidence: incidence.to_radians(),
        azimuth: azimuth.to_radians(),
        standoff,
        speed,
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact: 0,
        static_friction: 0.0,
    }
}
