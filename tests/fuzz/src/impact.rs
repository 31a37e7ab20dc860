//! The impact law, on any contact that is legal and any motion that is finite.

use nalgebra::Vector3;
use peenpose::impact::{Contact, Law, Motion, Rebound, Regime, Restitution, Sphere};
use peenpose::impact::{impact, rebound};

use super::bytes::Bytes;

/// Squares of larger and of smaller speeds leave the range of numbers.
const FASTEST: f64 = 1e100;
const SLOWEST: f64 = 1e-100;
/// The same for the slip, which may be what is left of two speeds.
const LEAST_SLIP: f64 = 1e-140;
/// A contact that slips whatever happens does so in the direction of the slip, of which rounding
/// leaves nothing when it is smaller than this share of all speeds.
const CLEAR_SLIP: f64 = 1e-2;
/// Rounding, relative to all speeds.
const ROUNDING: f64 = 1e-12;
/// As a problem file limits it.
const MOST_FRICTION: f64 = 10.0;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let contact = contact(&mut bytes);
    let normal = bytes.direction();
    let velocity = vector(&mut bytes);
    let rolling = vector(&mut bytes);
    assert_eq!(contact.validate().is_ok(), contact.faults().is_empty());
    if contact.validate().is_err() {
        return;
    }
    let hit = rebound(&contact, &velocity, &rolling, &normal);
    assert_eq!(hit.is_some(), velocity.dot(&normal) < 0.0);
    let Some(hit) = hit else {
        return;
    };
    let before = Before {
        velocity,
        rolling,
        normal,
    };
    if before.is_in_range(&contact) && contact.static_friction <= MOST_FRICTION {
        before.obeys_mechanics(&contact, &hit);
        before.is_the_same_with_mass(&contact, &hit, &mut bytes);
    }
}

fn contact(bytes: &mut Bytes<'_>) -> Contact {
    let law = *bytes.of(&Law::ALL);
    let usual = bytes.yes();
    let mut number = |largest| {
        if usual {
            bytes.within(0.0, largest)
        } else {
            bytes.any()
        }
    };
    let static_friction = number(1.0);
    let dynamic_friction = number(static_friction);
    let tangential_restitution = number(1.0);
    let (reference, speed, exponent) = (number(1.0), number(100.0), number(1.0));
    let restitution = if bytes.yes() {
        Restitution::Constant(reference)
    } else {
        Restitution::Falling {
            reference,
            speed,
            exponent,
        }
    };
    Contact {
        law,
        static_friction,
        dynamic_friction,
        restitution,
        tangential_restitution,
    }
}

fn vector(bytes: &mut Bytes<'_>) -> Vector3<f64> {
    let [x, y, z] = [0; 3].map(|_| bytes.finite(f64::MAX));
    Vector3::new(x, y, z)
}

/// A shot that approaches.
struct Before {
    velocity: Vector3<f64>,
    rolling: Vector3<f64>,
    normal: Vector3<f64>,
}

impl Before {
    /// The size of everything: rounding is relative to it.
    fn scale(&self) -> f64 {
        self.velocity.norm() + self.rolling.norm()
    }

    fn is_in_range(&self, contact: &Contact) -> bool {
        let largest = self.velocity.amax().max(self.rolling.amax());
        let slip = self.slip().amax();
        let is_clear = contact.law != Law::AlwaysSlip || slip >= CLEAR_SLIP * largest;
        (SLOWEST..=FASTEST).contains(&largest) && (slip == 0.0 || slip >= LEAST_SLIP) && is_clear
    }

    /// Velocity of the contact point along the surface.
    fn slip(&self) -> Vector3<f64> {
        let sideways = self.velocity - self.normal * self.velocity.dot(&self.normal);
        sideways + self.normal.cross(&self.rolling)
    }

    fn obeys_mechanics(&self, contact: &Contact, hit: &Rebound) {
        let off = ROUNDING * self.scale() * (1.0 + MOST_FRICTION);
        let vectors = hit.velocity.iter().chain(&hit.rolling);
        let numbers = [hit.normal, hit.tangential, hit.departure];
        assert!(
            vectors.chain(&numbers).all(|value| value.is_finite()),
            "{hit:?}"
        );
        assert!(hit.departure >= 0.0);
        assert!(
            (hit.velocity.dot(&self.normal) - hit.departure).abs() <= off,
            "{hit:?}"
        );
        // The impulse changes the velocity, and nothing else does.
        let change = hit.velocity - self.velocity;
        assert!(
            (change.dot(&self.normal) - hit.normal).abs() <= off,
            "{hit:?}"
        );
        let sideways = change - self.normal * change.dot(&self.normal);
        assert!(
            (sideways.norm() - hit.tangential.abs()).abs() <= off,
            "{hit:?}"
        );
        // Friction stays in its cone, unless it springs back sideways without any.
        let cone = match hit.regime {
            Regime::Stick => contact.static_friction.max(contact.dynamic_friction),
            Regime::Slip => contact.dynamic_friction,
        };
        assert!(
            hit.tangential >= -off && hit.tangential <= cone * hit.normal + off,
            "{hit:?}"
        );
        // A particle that cannot spin must not, and the comparison with the paper creates energy.
        let is_passive = match contact.law {
            Law::StickSlip | Law::Kinetic => true,
            Law::Irrotational => self.rolling == Vector3::zeros(),
            Law::AlwaysSlip => false,
        };
        if is_passive {
            let energy = |velocity: &Vector3<f64>, rolling: &Vector3<f64>| {
                0.5 * velocity.norm_squared() + 0.2 * rolling.norm_squared()
            };
            let (first, last) = (
                energy(&self.velocity, &self.rolling),
                energy(&hit.velocity, &hit.rolling),
            );
            assert!(
                last <= first + off * self.scale(),
                "{first} to {last}: {hit:?}"
            );
        }
    }

    /// Mass and radius only scale impulses and spins.
    fn is_the_same_with_mass(&self, contact: &Contact, hit: &Rebound, bytes: &mut Bytes<'_>) {
        let sphere = Sphere {
            radius: bytes.within(1e-9, 1e3),
            density: bytes.within(1.0, 1e5),
        };
        let arriving = Motion {
            velocity: self.velocity,
            spin: self.rolling / sphere.radius,
        };
        let heavy = impact(contact, &sphere, &arriving, &self.normal).expect("it approaches");
        let impulse = sphere.mass() * hit.normal;
        assert!((heavy.normal_impulse - impulse).abs() <= ROUNDING * impulse);
        assert!(heavy.tangential_impulse.is_finite());
        assert!(heavy.after.velocity.iter().all(|value| value.is_finite()));
        assert!(heavy.after.spin.iter().all(|value| value.is_finite()));
    }
}
