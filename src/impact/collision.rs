//! The arithmetic of one impact, without branches, so that compilers work on many at once.

use crate::precision::{Real, Triple, along, cross, dot, scaled};

/// What a contact is made of at one impact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coefficients<R> {
    /// E at the speed of this impact.
    pub restitution: R,
    /// See [`super::friction::Friction`].
    pub stick_share: R,
    pub holds: R,
    pub slides: R,
    pub spin: R,
}

/// What one impact does, free of mass and radius.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Collision<R> {
    /// N*/m, m/s.
    pub normal: R,
    /// f*/m, m/s.
    pub tangential: R,
    pub sticks: bool,
    /// E |v_n|, m/s.
    pub departure: R,
    /// Velocity of the centre afterwards, m/s.
    pub velocity: Triple<R>,
    /// R w afterwards, m/s.
    pub rolling: Triple<R>,
}

/// One impact at the normal speed `normal_speed` = v.n < 0.
#[inline(always)]
pub(crate) fn collide<R: Real>(
    contact: &Coefficients<R>,
    velocity: Triple<R>,
    rolling: Triple<R>,
    normal: Triple<R>,
    normal_speed: R,
) -> Collision<R> {
    // Velocity of the contact point, v_t + w x r with r = -R n.
    let [x, y, z] = along(velocity, normal, -normal_speed);
    let turn = cross(normal, rolling);
    let slip = [x + turn[0], y + turn[1], z + turn[2]];
    let slip_speed = dot(slip, slip).sqrt();
    // Eq. 10.
    let normal_impulse = -(R::ONE + contact.restitution) * normal_speed;
    let stick_impulse = contact.stick_share * slip_speed;
    let sticks = (stick_impulse <= contact.holds * normal_impulse) | (slip_speed == R::ZERO);
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
    let velocity = along(lifted, tangential, -R::ONE);
    Collision {
        normal: normal_impulse,
        tangential: per_slip * slip_speed,
        sticks,
        departure: -contact.restitution * normal_speed,
        velocity,
        rolling: along(rolling, cross(normal, tangential), contact.spin),
    }
}
