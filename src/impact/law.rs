//! The friction laws: how much tangential impulse a contact gives.

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
}

impl Regime {
    /// Its name in tables and files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stick => "stick",
            Self::Slip => "slip",
        }
    }
}
