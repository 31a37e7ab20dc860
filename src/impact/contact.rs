//! A contact: friction and restitution between shot and surface.

use std::fmt;

use super::law::Law;
use crate::elementary::power;

/// Friction and restitution between a shot and a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The friction law.
    pub law: Law,
    /// mu_s, at least mu_d.
    pub static_friction: f64,
    /// mu_d, not negative.
    pub dynamic_friction: f64,
    /// E, the normal coefficient of restitution.
    pub restitution: Restitution,
    /// beta of Walton and Braun, -1 to 1; 0 is the paper's model. A sticking contact leaves with
    /// -beta times its slip.
    pub tangential_restitution: f64,
}

impl Contact {
    /// A stick-slip contact with constant restitution.
    ///
    /// # Errors
    /// A [`ContactFault`] when a coefficient is out of its range or mu_d > mu_s.
    pub fn new(
        static_friction: f64,
        dynamic_friction: f64,
        restitution: f64,
    ) -> Result<Self, ContactFault> {
        let contact = Self {
            law: Law::StickSlip,
            static_friction,
            dynamic_friction,
            restitution: Restitution::Constant(restitution),
            tangential_restitution: 0.0,
        };
        contact.validate()?;
        Ok(contact)
    }

    /// Checks every coefficient.
    ///
    /// # Errors
    /// The first [`ContactFault`] found.
    pub fn validate(&self) -> Result<(), ContactFault> {
        self.faults().into_iter().next().map_or(Ok(()), Err)
    }

    /// Everything that is wrong with the coefficients.
    pub fn faults(&self) -> Vec<ContactFault> {
        let friction = |value: f64| value.is_finite() && value >= 0.0;
        let (static_friction, dynamic_friction) = (self.static_friction, self.dynamic_friction);
        let mut faults = Vec::new();
        if !friction(static_friction) {
            faults.push(ContactFault::StaticFriction(static_friction));
        }
        if !friction(dynamic_friction) {
            faults.push(ContactFault::DynamicFriction(dynamic_friction));
        }
        if faults.is_empty() && dynamic_friction > static_friction {
            faults.push(ContactFault::DynamicAboveStatic {
                dynamic_friction,
                static_friction,
            });
        }
        if !(-1.0..=1.0).contains(&self.tangential_restitution) {
            faults.push(ContactFault::TangentialRestitution(
                self.tangential_restitution,
            ));
        }
        faults.extend(self.restitution.validate().err());
        faults
    }

    /// Whether paths stay the same when every speed is multiplied by one factor.
    pub fn is_scale_free(&self) -> bool {
        self.restitution.is_constant()
    }

    /// The steepness tan(theta) from which a flat impact without spin sticks:
    /// 2 / (7 mu_s (1 + E)); infinite without friction.
    pub fn stick_tangent(&self, normal_speed: f64) -> f64 {
        let friction = match self.law {
            Law::Kinetic | Law::AlwaysSlip => self.dynamic_friction,
            Law::StickSlip | Law::Irrotational => self.static_friction,
        };
        let stick_share = self.law.stopping_share() * (1.0 + self.tangential_restitution);
        stick_share / (friction * (1.0 + self.restitution.at(normal_speed)))
    }
}

/// Johnson's exponent. Two square roots take a fraction of the time of a power, and it is the exponent that
/// most contacts fall with.
const PLASTIC_LIMIT: f64 = 0.25;

/// The normal coefficient of restitution E.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Restitution {
    /// The same at every speed.
    Constant(f64),
    /// E = reference (|v_n| / speed)^(-exponent), at most 1. Johnson's plastic limit has
    /// exponent 1/4.
    Falling {
        /// E at the speed at which it was measured.
        reference: f64,
        /// That normal speed, m/s.
        speed: f64,
        /// How steeply E falls.
        exponent: f64,
    },
}

impl Restitution {
    /// E at the normal approach speed `normal_speed` > 0, m/s.
    #[inline]
    pub fn at(&self, normal_speed: f64) -> f64 {
        match *self {
            Self::Constant(value) => value,
            Self::Falling {
                reference,
                speed,
                exponent,
            } => {
                let ratio = normal_speed / speed;
                let fall = if exponent == PLASTIC_LIMIT {
                    ratio.sqrt().sqrt()
                } else {
                    power(ratio, exponent)
                };
                (reference / fall).min(1.0)
            }
        }
    }

    /// Whether E is the same at every speed.
    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Constant(_))
    }

    /// E at a normal approach speed (m/s), for every speed.
    #[must_use]
    pub fn held_at(self, normal_speed: f64) -> Self {
        Self::Constant(self.at(normal_speed))
    }

    /// The same law with E shifted by `change` where it was measured, kept within 0 to 1.
    pub fn shifted(self, change: f64) -> Self {
        let shift = |value: f64| (value + change).clamp(0.0, 1.0);
        match self {
            Self::Constant(value) => Self::Constant(shift(value)),
            Self::Falling {
                reference,
                speed,
                exponent,
            } => Self::Falling {
                reference: shift(reference),
                speed,
                exponent,
            },
        }
    }

    /// E, at the speed at which it was measured where it falls with speed.
    pub fn reference(self) -> f64 {
        match self {
            Self::Constant(value) => value,
            Self::Falling { reference, .. } => reference,
        }
    }

    /// The normal speed, m/s, at which N*/m = (1 + E) |v_n| is `impulse`, m/s.
    pub fn approach_speed(self, impulse: f64) -> f64 {
        match self {
            Self::Constant(value) => impulse / (1.0 + value),
            // (1 + E) v rises with v, and E lies within 0 to 1.
            Self::Falling { .. } => {
                let (mut low, mut high) = (0.5 * impulse, impulse);
                for _ in 0..f64::MANTISSA_DIGITS {
                    let middle = 0.5 * (low + high);
                    if (1.0 + self.at(middle)) * middle < impulse {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                high
            }
        }
    }

    fn validate(self) -> Result<(), ContactFault> {
        let coefficient = |value: f64| {
            (0.0..=1.0)
                .contains(&value)
                .then_some(())
                .ok_or(ContactFault::Restitution(value))
        };
        match self {
            Self::Constant(value) => coefficient(value),
            Self::Falling {
                reference,
                speed,
                exponent,
            } => {
                coefficient(reference)?;
                if !(speed.is_finite() && speed > 0.0) {
                    return Err(ContactFault::ReferenceSpeed(speed));
                }
                if !(0.0..=1.0).contains(&exponent) {
                    return Err(ContactFault::Exponent(exponent));
                }
                Ok(())
            }
        }
    }
}

/// Why a contact cannot be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactFault {
    /// mu_s is negative or not finite.
    StaticFriction(f64),
    /// mu_d is negative or not finite.
    DynamicFriction(f64),
    /// Dynamic friction cannot exceed static friction.
    DynamicAboveStatic {
        /// mu_d.
        dynamic_friction: f64,
        /// mu_s.
        static_friction: f64,
    },
    /// E outside 0 to 1.
    Restitution(f64),
    /// beta outside -1 to 1.
    TangentialRestitution(f64),
    /// The speed at which E was measured is not positive.
    ReferenceSpeed(f64),
    /// The exponent of a falling E is outside 0 to 1.
    Exponent(f64),
}

impl fmt::Display for ContactFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::StaticFriction(value) => {
                write!(f, "static friction {value} must be 0 or more")
            }
            Self::DynamicFriction(value) => {
                write!(f, "dynamic friction {value} must be 0 or more")
            }
            Self::DynamicAboveStatic {
                dynamic_friction,
                static_friction,
            } => write!(
                f,
                "dynamic friction {dynamic_friction} must not exceed static friction {static_friction}"
            ),
            Self::Restitution(value) => {
                write!(
                    f,
                    "coefficient of restitution {value} must lie within 0 to 1"
                )
            }
            Self::TangentialRestitution(value) => {
                write!(f, "tangential restitution {value} must lie within -1 to 1")
            }
            Self::ReferenceSpeed(value) => write!(
                f,
                "the speed {value} m/s at which restitution was measured must be positive"
            ),
            Self::Exponent(value) => {
                write!(
                    f,
                    "the exponent {value} of restitution must lie within 0 to 1"
                )
            }
        }
    }
}

impl std::error::Error for ContactFault {}
