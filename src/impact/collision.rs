//! The arithmetic of one impact, without branches, so that compilers work on many at once.

use crate::triple::{Triple, along, cross, dot, scaled};

/// What a contact is made of at one impact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coefficients {
    /// E at the speed of this impact.
    pub restitution: f64,
    /// See [`super::friction::Friction`].
    pub stick_share: f64,
    pub holds: f64,
    pub slides: f64,
    pub spin: f64,
}

/// What one impact does, free of mass and radius.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Collision {
    /// N*/m, m/s.
    pub normal: f64,
    /// f*/m, m/s.
    pub tangential: f64,
    pub sticks: bool,
    /// E |v_n|, m/s.
    pub departure: f64,
    /// Velocity of the centre afterwards, m/s.
    pub velocity: Triple,
    /// R w afterwards, m/s.
    pub rolling: Triple,
}

/// One impact at the normal speed `normal_speed` = v.n < 0.
#[inline(always)]
pub(crate) fn collide(
    contact: &Coefficients,
    velocity: Triple,
    rolling: Triple,
    normal: Triple,
    normal_speed: f64,
) -> Collision {
    // Velocity of the contact point, v_t + w x r with r = -R n.
    let [x, y, z] = along(velocity, normal, -normal_speed);
    let turn = cross(normal, rolling);
    let slip = [x + turn[0], y + turn[1], z + turn[2]];
    let slip_speed = dot(slip, slip).sqrt();
    // Eq. 10.
    let normal_impulse = -(1.0 + contact.restitution) * normal_speed;
    let stick_impulse = contact.stick_share * slip_speed;
    let sticks = (stick_impulse <= contact.holds * normal_impulse) | (slip_speed == 0.0);
    // Per slip speed, so that it is finite even without slip.
    let per_slip = if sticks {
        contact.stick_share
    } else {
        // Eq. 23.
        contact.slides * normal_impulse / slip_speed
    };
    let tangential = scaled(slip, per_slip);
    // Eqs. 8, 17 and 14.
    let lifted = along(velocity, normal, normal_impulse);
    let velocity = along(lifted, tangential, -1.0);
    Collision {
        normal: normal_impulse,
        tangential: per_slip * slip_speed,
        sticks,
        departure: -contact.restitution * normal_speed,
        velocity,
        rolling: along(rolling, cross(normal, tangential), contact.spin),
    }
}
