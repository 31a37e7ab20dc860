//! The friction laws: how much tangential impulse a contact gives.

use super::contact::Contact;

/// Which friction law a contact follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Law {
    /// Static friction decides whether the contact sticks, dynamic friction acts while it slips
    /// (Eqs. 19, 22 and 23). The paper's law and the default.
    #[default]
    StickSlip,
    /// A contact that arrives sliding feels dynamic friction until it stops:
    /// f* = min(mu_d N*, f*_stick). Continuous where stick-slip jumps.
    Kinetic,
    /// As stick-slip for a particle that cannot spin (Sec. 2.5): f*_stick = m |v_t|.
    Irrotational,
    /// Slip even where the contact would stick. Creates energy; only to compare with the tables
    /// that the paper printed.
    AlwaysSlip,
}

/// Whether the contact point came to rest during the impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// It came to rest (or, with tangential restitution, sprang back).
    Stick,
    /// It kept sliding.
    Slip,
}

/// Friction of one impact.
pub(super) struct Friction {
    /// Tangential impulse per unit mass over the slip speed; finite even without slip.
    pub per_slip: f64,
    pub regime: Regime,
}

impl Law {
    /// Every law, in the order of the documentation.
    pub const ALL: [Self; 4] = [
        Self::StickSlip,
        Self::Kinetic,
        Self::Irrotational,
        Self::AlwaysSlip,
    ];

    /// The name used in problem files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::StickSlip => "stick_slip",
            Self::Kinetic => "kinetic",
            Self::Irrotational => "irrotational",
            Self::AlwaysSlip => "always_slip",
        }
    }

    /// Whether friction changes the spin.
    pub const fn spins(self) -> bool {
        !matches!(self, Self::Irrotational)
    }

    /// Impulse per unit mass and slip speed that stops the slip: 2/7 for a solid sphere (Eq. 19),
    /// 1 for a particle that cannot spin (Eq. 38).
    pub(super) const fn stopping_share(self) -> f64 {
        if self.spins() { 2.0 / 7.0 } else { 1.0 }
    }

    /// The tangential impulse of a contact with `normal_impulse` and `slip_speed`, both in m/s.
    #[inline]
    pub(super) fn friction(
        self,
        contact: &Contact,
        normal_impulse: f64,
        slip_speed: f64,
    ) -> Friction {
        let stick_share = self.stopping_share() * (1.0 + contact.tangential_restitution);
        let stick_impulse = stick_share * slip_speed;
        let slip_impulse = contact.dynamic_friction * normal_impulse;
        let holds = match self {
            // Eq. 22.
            Self::StickSlip | Self::Irrotational => {
                stick_impulse <= contact.static_friction * normal_impulse
            }
            Self::Kinetic => stick_impulse <= slip_impulse,
            Self::AlwaysSlip => false,
        };
        if holds || slip_speed == 0.0 {
            Friction {
                per_slip: stick_share,
                regime: Regime::Stick,
            }
        } else {
            Friction {
                per_slip: slip_impulse / slip_speed,
                regime: Regime::Slip,
            }
        }
    }
}
