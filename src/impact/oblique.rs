//! A shot on a flat surface, seen in the plane of its motion.

use nalgebra::Vector3;

use super::{Contact, Impact, Law, Motion, Regime, Sphere, impact};
use crate::elementary::{atan, atan2, sin, sin_cos};

/// A shot about to hit a flat surface.
///
/// The plane of motion holds the surface's normal n and the direction t of travel along the
/// surface; spin is counted about e_o = t x n, so a shot that rolls forwards has a negative spin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oblique {
    /// The shot.
    pub sphere: Sphere,
    /// Its contact with the surface.
    pub contact: Contact,
    /// Speed of its centre, m/s.
    pub speed: f64,
    /// Angle between its path and the surface, rad; pi/2 is perpendicular.
    pub angle: f64,
    /// Angular velocity about e_o, rad/s.
    pub spin: f64,
}

/// What an oblique impact did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Whether the contact point came to rest.
    pub regime: Regime,
    /// N*, N s.
    pub normal_impulse: f64,
    /// f*, N s.
    pub tangential_impulse: f64,
    /// v_n' along n, m/s.
    pub normal_velocity: f64,
    /// v_t' along t, m/s.
    pub tangential_velocity: f64,
    /// theta', angle between the path and the surface afterwards, rad; beyond pi/2 the shot flies
    /// back.
    pub angle: f64,
    /// Angular velocity about e_o afterwards, rad/s.
    pub spin: f64,
    /// Kinetic energy before.
    pub before: Energy,
    /// Kinetic energy afterwards.
    pub after: Energy,
}

/// Kinetic energy of a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy {
    /// Of the centre's motion, J.
    pub translation: f64,
    /// Of the spin, J.
    pub rotation: f64,
}

impl Energy {
    /// Of a sphere in motion.
    pub fn of(sphere: &Sphere, motion: &Motion) -> Self {
        Self {
            translation: sphere.translation_energy(motion),
            rotation: sphere.rotation_energy(motion),
        }
    }

    /// Both together, J.
    pub fn total(&self) -> f64 {
        self.translation + self.rotation
    }
}

impl Outcome {
    /// Energy afterwards over energy before.
    pub fn energy_ratio(&self) -> f64 {
        self.after.total() / self.before.total()
    }
}

impl Oblique {
    /// What the impact does; `None` when the shot does not approach the surface.
    pub fn outcome(&self) -> Option<Outcome> {
        // t is x, n is y and e_o is z.
        let (sin, cos) = sin_cos(self.angle);
        let before = Motion {
            velocity: Vector3::new(self.speed * cos, -self.speed * sin, 0.0),
            spin: Vector3::new(0.0, 0.0, self.spin),
        };
        let Impact {
            normal_impulse,
            tangential_impulse,
            regime,
            after,
        } = impact(&self.contact, &self.sphere, &before, &Vector3::y())?;
        Some(Outcome {
            regime,
            normal_impulse,
            tangential_impulse,
            normal_velocity: after.velocity.y,
            tangential_velocity: after.velocity.x,
            angle: atan2(after.velocity.y, after.velocity.x),
            spin: after.spin.z,
            before: Energy::of(&self.sphere, &before),
            after: Energy::of(&self.sphere, &after),
        })
    }

    /// The angle (rad) from which the shot would stick if it arrived without spin; `None` when the
    /// contact never sticks.
    pub fn stick_angle(&self) -> Option<f64> {
        let tangent = self.contact.stick_tangent(self.speed * sin(self.angle));
        (self.contact.law != Law::AlwaysSlip && tangent.is_finite()).then(|| atan(tangent))
    }
}
