//! One impact of a rigid sphere on a massive surface, oblique and inelastic, with stick-slip
//! friction and spin.
//!
//! The model is that of T. I. Zohdi, "Modeling and simulation of the post-impact trajectories of
//! particles in oblique precision shot-peening", Computational Particle Mechanics (2015). Equation
//! numbers in this module are the paper's; `docs/model.md` lists its misprints. The functions are
//! pure, work in f64 and allocate nothing.
//!
//! Nothing in an impact depends on the mass and the radius one by one: with impulses per unit mass
//! and the spin as the speed R w of the sphere's equator, both drop out. [`rebound`] is the model
//! in that form; [`impact`] is the same with mass and radius put back.
//!
//! ```
//! use nalgebra::Vector3;
//! use peenpose::impact::{Contact, Motion, Regime, Sphere, impact};
//!
//! let dry = Contact::new(0.30, 0.27, 0.25)?;
//! let shot = Sphere { radius: 0.5e-3, density: 7000.0 };
//! let arriving = Motion { velocity: Vector3::new(5.0, 0.0, -75.0_f64.sqrt()), spin: Vector3::zeros() };
//! let hit = impact(&dry, &shot, &arriving, &Vector3::z()).expect("it approaches");
//! assert_eq!(hit.regime, Regime::Stick);
//! assert!((hit.after.velocity.x - 25.0 / 7.0).abs() < 1e-12);
//! # Ok::<(), peenpose::impact::ContactFault>(())
//! ```

mod collision;
mod contact;
mod friction;
mod law;
mod oblique;
pub mod zohdi;

pub use contact::{Contact, ContactFault, Restitution};
pub use law::{Law, Regime};
pub use oblique::{Energy, Oblique, Outcome};

use crate::elementary::cube;
pub(crate) use collision::{Coefficients, collide};
pub(crate) use friction::Friction;
use nalgebra::Vector3;

/// A solid homogeneous sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// m.
    pub radius: f64,
    /// kg/m3.
    pub density: f64,
}

impl Sphere {
    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        4.0 / 3.0 * std::f64::consts::PI * cube(self.radius) * self.density
    }

    /// Moment of inertia about the centre, (2/5) m R^2, kg m2.
    pub fn moment_of_inertia(&self) -> f64 {
        0.4 * self.mass() * self.radius * self.radius
    }

    /// Kinetic energy of translation, J.
    pub fn translation_energy(&self, motion: &Motion) -> f64 {
        0.5 * self.mass() * motion.velocity.norm_squared()
    }

    /// Kinetic energy of rotation, J.
    pub fn rotation_energy(&self, motion: &Motion) -> f64 {
        0.5 * self.moment_of_inertia() * motion.spin.norm_squared()
    }
}

/// How a sphere moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Velocity of the centre, m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity, rad/s.
    pub spin: Vector3<f64>,
}

/// What one impact did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// N* (Eq. 10), N s.
    pub normal_impulse: f64,
    /// f* (Eqs. 19 and 23), N s.
    pub tangential_impulse: f64,
    /// Whether the contact point came to rest.
    pub regime: Regime,
    /// The motion afterwards.
    pub after: Motion,
}

/// One impact of `sphere` on a resting surface with unit normal `normal` towards the sphere.
///
/// `None` when the sphere does not approach (v.n >= 0).
pub fn impact(
    contact: &Contact,
    sphere: &Sphere,
    before: &Motion,
    normal: &Vector3<f64>,
) -> Option<Impact> {
    let rolling = before.spin * sphere.radius;
    let hit = rebound(contact, &before.velocity, &rolling, normal)?;
    let mass = sphere.mass();
    Some(Impact {
        normal_impulse: mass * hit.normal,
        tangential_impulse: mass * hit.tangential,
        regime: hit.regime,
        after: Motion {
            velocity: hit.velocity,
            spin: hit.rolling / sphere.radius,
        },
    })
}

/// What one impact did, free of mass and radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// N*/m, m/s.
    pub normal: f64,
    /// f*/m, m/s.
    pub tangential: f64,
    /// Whether the contact point came to rest.
    pub regime: Regime,
    /// Speed at which the sphere leaves the surface, E |v_n|, m/s; exactly 0 when it stays.
    pub departure: f64,
    /// Velocity of the centre afterwards, m/s.
    pub velocity: Vector3<f64>,
    /// R w afterwards, m/s.
    pub rolling: Vector3<f64>,
}

/// One impact, free of mass and radius: `velocity` of the centre and `rolling` = R w, both in m/s.
///
/// `None` when the sphere does not approach (v.n >= 0).
#[inline]
pub fn rebound(
    contact: &Contact,
    velocity: &Vector3<f64>,
    rolling: &Vector3<f64>,
    normal: &Vector3<f64>,
) -> Option<Rebound> {
    let normal_speed = velocity.dot(normal);
    if normal_speed >= 0.0 {
        return None;
    }
    let contact = Friction::of(contact).at(contact.restitution.at(-normal_speed));
    let after = collide(
        &contact,
        (*velocity).into(),
        (*rolling).into(),
        (*normal).into(),
        normal_speed,
    );
    Some(Rebound {
        normal: after.normal,
        tangential: after.tangential,
        regime: if after.sticks {
            Regime::Stick
        } else {
            Regime::Slip
        },
        departure: after.departure,
        velocity: after.velocity.into(),
        rolling: after.rolling.into(),
    })
}
