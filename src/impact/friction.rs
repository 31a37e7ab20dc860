//! How much tangential impulse a contact gives.

use super::contact::Contact;
use super::law::{Law, Regime};

/// Friction of one impact.
pub(super) struct Friction {
    /// Tangential impulse per unit mass over the slip speed; finite even without slip.
    pub per_slip: f64,
    pub regime: Regime,
}

impl Friction {
    /// The friction of a contact with `normal_impulse` and `slip_speed`, both in m/s.
    #[inline]
    pub fn of(contact: &Contact, normal_impulse: f64, slip_speed: f64) -> Self {
        let stick_share = contact.law.stopping_share() * (1.0 + contact.tangential_restitution);
        let stick_impulse = stick_share * slip_speed;
        let slip_impulse = contact.dynamic_friction * normal_impulse;
        let holds = match contact.law {
            // Eq. 22.
            Law::StickSlip | Law::Irrotational => {
                stick_impulse <= contact.static_friction * normal_impulse
            }
            Law::Kinetic => stick_impulse <= slip_impulse,
            Law::AlwaysSlip => false,
        };
        if holds || slip_speed == 0.0 {
            Self {
                per_slip: stick_share,
                regime: Regime::Stick,
            }
        } else {
            Self {
                per_slip: slip_impulse / slip_speed,
                regime: Regime::Slip,
            }
        }
    }
}
