//! Tables 1 and 2 of Zohdi's paper: one impact for a series of friction coefficients.
//!
//! The published rows all follow the slip formula (Eq. 23), although by the paper's own check
//! (Eq. 22) those with mu_s from [`least_sticking_friction`] on stick. [`Law::AlwaysSlip`]
//! reproduces the tables as published, [`Law::StickSlip`] gives them as they should be.
//!
//! ```
//! use peenpose::impact::{Law, Regime, zohdi};
//!
//! let row = &zohdi::rows(Law::StickSlip)[0];
//! assert_eq!((row.static_friction, row.outcome.regime), (0.30, Regime::Stick));
//! assert!((row.outcome.tangential_velocity - 25.0 / 7.0).abs() < 1e-12);
//! ```

use super::Sphere;
use super::contact::{Contact, Restitution};
use super::law::Law;
use super::oblique::{Oblique, Outcome};
use crate::elementary::tan;

/// mu_s of the rows, as printed from top to bottom.
pub const STATIC_FRICTIONS: [f64; 11] = [
    0.30, 0.27, 0.24, 0.21, 0.18, 0.15, 0.12, 0.09, 0.06, 0.03, 0.0,
];

/// mu_d over mu_s.
pub const DYNAMIC_RATIO: f64 = 0.9;

/// E.
pub const RESTITUTION: f64 = 0.25;

/// The shot.
pub const SPHERE: Sphere = Sphere {
    radius: 0.5e-3,
    density: 7000.0,
};

/// Its speed, m/s.
pub const SPEED: f64 = 10.0;

/// Its angle to the surface, rad: 60 deg.
pub const ANGLE: f64 = std::f64::consts::FRAC_PI_3;

/// One row of both tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// mu_s.
    pub static_friction: f64,
    /// What the impact does.
    pub outcome: Outcome,
}

/// The rows of both tables under a law.
pub fn rows(law: Law) -> Vec<Row> {
    let row = |static_friction| {
        let outcome = case(law, static_friction).outcome()?;
        Some(Row {
            static_friction,
            outcome,
        })
    };
    STATIC_FRICTIONS.into_iter().filter_map(row).collect()
}

/// The impact of the tables.
pub fn case(law: Law, static_friction: f64) -> Oblique {
    Oblique {
        sphere: SPHERE,
        contact: Contact {
            law,
            static_friction,
            dynamic_friction: DYNAMIC_RATIO * static_friction,
            restitution: Restitution::Constant(RESTITUTION),
            tangential_restitution: 0.0,
        },
        speed: SPEED,
        angle: ANGLE,
        spin: 0.0,
    }
}

/// The least mu_s that sticks by Eq. 22: 2 / (7 tan(theta) (1 + E)).
pub fn least_sticking_friction() -> f64 {
    2.0 / (7.0 * tan(ANGLE) * (1.0 + RESTITUTION))
}
