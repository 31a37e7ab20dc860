//! How a contact limits the tangential impulse.

use super::collision::Coefficients;
use super::contact::Contact;
use super::law::Law;

/// The friction of a contact, free of the law's name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Friction {
    /// Impulse per unit mass and slip speed that stops the slip.
    pub stick_share: f64,
    /// The contact sticks while the impulse that stops the slip is at most this share of N*.
    pub holds: f64,
    /// Otherwise the impulse is this share of N*.
    pub slides: f64,
    /// R^2 m/I when friction changes the spin, else 0.
    pub spin: f64,
}

impl Friction {
    pub fn of(contact: &Contact) -> Self {
        Self {
            stick_share: contact.law.stopping_share() * (1.0 + contact.tangential_restitution),
            holds: match contact.law {
                // Eq. 22.
                Law::StickSlip | Law::Irrotational => contact.static_friction,
                Law::Kinetic => contact.dynamic_friction,
                // No impulse is that small.
                Law::AlwaysSlip => -1.0,
            },
            slides: contact.dynamic_friction,
            // 5/2 for a solid sphere.
            spin: if contact.law.spins() { 2.5 } else { 0.0 },
        }
    }

    /// With E at the speed of an impact, in the precision that it is computed in.
    #[inline(always)]
    pub fn at(&self, restitution: f64) -> Coefficients {
        Coefficients {
            restitution,
            stick_share: self.stick_share,
            holds: self.holds,
            slides: self.slides,
            spin: self.spin,
        }
    }
}
