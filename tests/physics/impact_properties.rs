//! V7: what holds for every impact, whatever the friction law; and the degenerate cases.
//!
//! All in the form free of mass and radius: impulses per unit mass, and the spin as R w.

use crate::common::cases::cases;
use nalgebra::{UnitQuaternion, Vector3};
use peenpose::impact::{
    Contact, Law, Motion, Rebound, Regime, Restitution, Sphere, impact, rebound,
};
use proptest::prelude::*;

fn vector(largest: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-largest..largest, -largest..largest, -largest..largest].prop_map(Vector3::from)
}

fn unit() -> impl Strategy<Value = Vector3<f64>> {
    (-1.0..=1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(z, turn)| {
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * turn.cos(), across * turn.sin(), z).normalize()
    })
}

/// The laws that physics allows: all but the one that is kept for comparison.
fn passive_law() -> impl Strategy<Value = Law> {
    prop::sample::select(vec![Law::StickSlip, Law::Kinetic])
}

fn contact(law: impl Strategy<Value = Law>) -> impl Strategy<Value = Contact> {
    let coefficients = (0.0..=0.6, 0.0..=1.0, 0.0..=1.0);
    (law, coefficients).prop_map(|(law, (static_friction, ratio, restitution))| Contact {
        law,
        static_friction,
        dynamic_friction: ratio * static_friction,
        restitution: Restitution::Constant(restitution),
        tangential_restitution: 0.0,
    })
}

/// An impact that happens.
#[derive(Clone, Copy, Debug)]
struct Arrival {
    velocity: Vector3<f64>,
    rolling: Vector3<f64>,
    normal: Vector3<f64>,
}

impl Arrival {
    /// Speeds add up to this: the scale of rounding errors.
    fn scale(&self) -> f64 {
        self.velocity.norm() + self.rolling.norm()
    }

    fn slip(&self) -> Vector3<f64> {
        slip(&self.velocity, &self.rolling, &self.normal)
    }

    fn on(&self, contact: &Contact) -> Rebound {
        rebound(contact, &self.velocity, &self.rolling, &self.normal).unwrap()
    }

    fn without_spin(self) -> Self {
        Self {
            rolling: Vector3::zeros(),
            ..self
        }
    }
}

fn arrival() -> impl Strategy<Value = Arrival> {
    (vector(30.0), vector(30.0), unit()).prop_map(|(velocity, rolling, normal)| Arrival {
        velocity,
        rolling,
        // The shot comes from the front.
        normal: if velocity.dot(&normal) < 0.0 {
            normal
        } else {
            -normal
        },
    })
}

/// Velocity of the contact point along the surface.
fn slip(velocity: &Vector3<f64>, rolling: &Vector3<f64>, normal: &Vector3<f64>) -> Vector3<f64> {
    velocity - normal * velocity.dot(normal) + normal.cross(rolling)
}

/// Kinetic energy per unit mass.
fn energy(velocity: &Vector3<f64>, rolling: &Vector3<f64>) -> f64 {
    0.5 * velocity.norm_squared() + 0.2 * rolling.norm_squared()
}

/// Angular momentum about the contact point, per unit mass and radius.
fn angular_momentum(
    velocity: &Vector3<f64>,
    rolling: &Vector3<f64>,
    normal: &Vector3<f64>,
) -> Vector3<f64> {
    normal.cross(velocity) + rolling * 0.4
}

const ROUNDING: f64 = 1e-12;

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn passive_contacts_obey_mechanics(
        contact in contact(passive_law()),
        beta in prop_oneof![Just(0.0), -1.0..=1.0],
        before in arrival(),
    ) {
        let contact = Contact { tangential_restitution: beta, ..contact };
        let after = before.on(&contact);
        let (normal, scale) = (&before.normal, before.scale());
        let off = ROUNDING * scale;
        let normal_speed = -before.velocity.dot(normal);
        let slip_before = before.slip();
        let slip_after = slip(&after.velocity, &after.rolling, normal);

        // Angular momentum about the contact point is kept, and so is the spin about n.
        let turned = angular_momentum(&after.velocity, &after.rolling, normal)
            - angular_momentum(&before.velocity, &before.rolling, normal);
        prop_assert!(turned.norm() <= off);
        prop_assert!((after.rolling - before.rolling).dot(normal).abs() <= off);
        // Energy never grows.
        let (first, last) = (
            energy(&before.velocity, &before.rolling),
            energy(&after.velocity, &after.rolling),
        );
        prop_assert!(last <= first * (1.0 + ROUNDING));
        // Normal restitution, and bounds of the impulses.
        prop_assert!((after.velocity.dot(normal) - after.departure).abs() <= off);
        prop_assert!(after.normal >= 0.0 && after.tangential >= 0.0);
        prop_assert!(after.normal <= 2.0 * before.velocity.norm() * (1.0 + ROUNDING));
        prop_assert!(after.normal >= normal_speed);
        let stick = 2.0 / 7.0 * (1.0 + beta) * slip_before.norm();
        prop_assert!(after.tangential <= contact.static_friction * after.normal + off);
        prop_assert!(after.tangential <= stick + off);
        // Friction acts against the slip: across both, nothing changes.
        let across = normal.cross(&slip_before);
        prop_assert!((after.velocity - before.velocity).dot(&across).abs() <= off * scale);
        // s' = s (1 - f*/f*_stick), with f*_stick of beta = 0.
        let left = slip_before - slip_before * (3.5 * after.tangential / slip_before.norm());
        prop_assert!((slip_after - left).norm() <= off);
        match after.regime {
            Regime::Stick => prop_assert!((slip_after + slip_before * beta).norm() <= off),
            Regime::Slip => {
                prop_assert!(
                    (after.tangential - contact.dynamic_friction * after.normal).abs() <= off
                );
            }
        }
        if beta <= 0.0 {
            prop_assert!(slip_after.dot(&slip_before) >= -off * scale);
        }
    }

    #[test]
    fn identities_without_spin(contact in contact(passive_law()), before in arrival()) {
        let before = before.without_spin();
        let after = before.on(&contact);
        let off = ROUNDING * before.scale();
        let along = before.slip().normalize();
        let sideways = before.velocity.dot(&along);
        let kept = after.velocity.dot(&along);
        let rolled = after.rolling.dot(&before.normal.cross(&along));
        let f = after.tangential;
        prop_assert!((kept + 0.4 * rolled - sideways).abs() <= off);
        prop_assert!((kept - (sideways - f)).abs() <= off);
        prop_assert!((rolled - 2.5 * f).abs() <= off);
        let slip_after = slip(&after.velocity, &after.rolling, &before.normal).dot(&along);
        prop_assert!((slip_after - (sideways - 3.5 * f)).abs() <= off);
        // Energy lost sideways.
        let lost = f * sideways - 1.75 * f * f;
        let normal_loss = 0.5 * (before.velocity.dot(&before.normal).powi(2)
            - after.departure * after.departure);
        let change = energy(&before.velocity, &before.rolling)
            - energy(&after.velocity, &after.rolling);
        prop_assert!((change - normal_loss - lost).abs() <= off * before.scale());
        prop_assert!(lost >= -off * before.scale());
    }

    #[test]
    fn the_answer_turns_with_the_frame(
        contact in contact(prop::sample::select(Law::ALL.to_vec())),
        before in arrival(),
        axis in unit(),
        angle in 0.0..std::f64::consts::TAU,
    ) {
        let turn = UnitQuaternion::from_scaled_axis(axis * angle);
        // At the very threshold rounding may decide between stick and slip.
        let slip_speed = before.slip().norm();
        let here = before.on(&contact);
        let share = if contact.law.spins() { 2.0 / 7.0 } else { 1.0 };
        let threshold = match contact.law {
            Law::Kinetic => contact.dynamic_friction,
            _ => contact.static_friction,
        } * here.normal;
        prop_assume!((share * slip_speed - threshold).abs() > 1e-9 * before.scale());
        let there = Arrival {
            velocity: turn * before.velocity,
            rolling: turn * before.rolling,
            normal: turn * before.normal,
        }
        .on(&contact);
        let off = 10.0 * ROUNDING * before.scale();
        prop_assert_eq!(here.regime, there.regime);
        prop_assert!((turn * here.velocity - there.velocity).norm() <= off);
        prop_assert!((turn * here.rolling - there.rolling).norm() <= off);
        prop_assert!((here.normal - there.normal).abs() <= off);
        prop_assert!((here.tangential - there.tangential).abs() <= off);
    }

    /// With a constant E a common factor on all speeds changes nothing else.
    #[test]
    fn speed_scales_out(
        contact in contact(prop::sample::select(Law::ALL.to_vec())),
        before in arrival(),
        doublings in -6..7,
    ) {
        // Powers of two, so that not even rounding changes.
        let factor = 2.0_f64.powi(doublings);
        let fast = Arrival {
            velocity: before.velocity * factor,
            rolling: before.rolling * factor,
            ..before
        }
        .on(&contact);
        let slow = before.on(&contact);
        prop_assert_eq!(fast.regime, slow.regime);
        prop_assert_eq!(fast.velocity, slow.velocity * factor);
        prop_assert_eq!(fast.rolling, slow.rolling * factor);
        prop_assert_eq!(fast.normal, slow.normal * factor);
        prop_assert_eq!(fast.tangential, slow.tangential * factor);
    }

    #[test]
    fn irrotational_particles_do_not_spin(
        contact in contact(Just(Law::Irrotational)),
        before in arrival(),
    ) {
        let before = before.without_spin();
        let after = before.on(&contact);
        let off = ROUNDING * before.scale();
        prop_assert_eq!(after.rolling, Vector3::zeros());
        prop_assert!(after.velocity.norm() <= before.velocity.norm() * (1.0 + ROUNDING));
        let sideways = before.slip();
        prop_assert!(after.tangential <= sideways.norm() + off);
        prop_assert!(after.tangential <= contact.static_friction * after.normal + off);
        let kept = after.velocity - before.normal * after.departure;
        prop_assert!((kept - sideways * (1.0 - after.tangential / sideways.norm())).norm() <= off);
        if after.regime == Regime::Stick {
            prop_assert!(kept.norm() <= off);
        }
    }

    /// Stick-slip and the kinetic reading differ only for mu_d N* < f*_stick <= mu_s N*.
    #[test]
    fn the_kinetic_reading_differs_only_near_the_threshold(
        contact in contact(Just(Law::StickSlip)),
        before in arrival(),
    ) {
        let here = before.on(&contact);
        let there = before.on(&Contact { law: Law::Kinetic, ..contact });
        let stick = 2.0 / 7.0 * before.slip().norm();
        let between = contact.dynamic_friction * here.normal < stick
            && stick <= contact.static_friction * here.normal;
        if between {
            prop_assert_eq!((here.regime, there.regime), (Regime::Stick, Regime::Slip));
        } else {
            prop_assert_eq!(here, there);
        }
        prop_assert!(
            (there.tangential - stick.min(contact.dynamic_friction * here.normal)).abs()
                <= ROUNDING * before.scale()
        );
    }

    #[test]
    fn restitution_falls_with_speed(
        reference in 0.0..=1.0,
        exponent in 0.0..=1.0_f64,
        slow in 0.01..50.0,
        faster in 1.0_f64..10.0,
    ) {
        let contact = Contact {
            restitution: Restitution::Falling { reference, speed: 5.0, exponent },
            ..Contact::new(0.3, 0.27, 0.0).unwrap()
        };
        prop_assert_eq!(contact.validate(), Ok(()));
        let at = |speed: f64| {
            let velocity = Vector3::new(3.0, 0.0, -speed);
            let after = rebound(&contact, &velocity, &Vector3::zeros(), &Vector3::z()).unwrap();
            after.velocity.z / speed
        };
        let (first, second) = (at(slow), at(slow * faster));
        prop_assert!((0.0..=1.0 + ROUNDING).contains(&first));
        prop_assert!(second <= first + ROUNDING);
        if first < 1.0 - ROUNDING {
            prop_assert!((second - first * faster.powf(-exponent)).abs() <= 1e-11);
        }
    }

    /// Mass and radius put back.
    #[test]
    fn impact_is_rebound_with_mass_and_radius(
        contact in contact(prop::sample::select(Law::ALL.to_vec())),
        before in arrival(),
        radius in 1e-5..1e-2,
        density in 1e3..1e4,
    ) {
        let sphere = Sphere { radius, density };
        let motion = Motion { velocity: before.velocity, spin: before.rolling / radius };
        let full = impact(&contact, &sphere, &motion, &before.normal).unwrap();
        let free = rebound(&contact, &before.velocity, &(motion.spin * radius), &before.normal)
            .unwrap();
        let off = ROUNDING * before.scale();
        prop_assert_eq!(full.regime, free.regime);
        prop_assert!((full.normal_impulse / sphere.mass() - free.normal).abs() <= off);
        prop_assert!((full.tangential_impulse / sphere.mass() - free.tangential).abs() <= off);
        prop_assert!((full.after.velocity - free.velocity).norm() <= off);
        prop_assert!((full.after.spin * radius - free.rolling).norm() <= off);
    }
}

/// The impulses of a flat impact without spin at `steepness` times the threshold of sticking.
fn near_threshold(contact: &Contact, steepness: f64) -> Rebound {
    let tangent = contact.stick_tangent(1.0) * steepness;
    let velocity = Vector3::new(1.0 / tangent, 0.0, -1.0);
    rebound(contact, &velocity, &Vector3::zeros(), &Vector3::z()).unwrap()
}

#[test]
fn sticking_begins_where_it_should_and_only_stick_slip_jumps() {
    for law in [Law::StickSlip, Law::Kinetic, Law::Irrotational] {
        for beta in [-0.5, 0.0, 0.4] {
            let contact = Contact {
                law,
                tangential_restitution: beta,
                ..Contact::new(0.3, 0.24, 0.25).unwrap()
            };
            let slipping = near_threshold(&contact, 1.0 - 1e-9);
            let sticking = near_threshold(&contact, 1.0 + 1e-9);
            assert_eq!(
                (slipping.regime, sticking.regime),
                (Regime::Slip, Regime::Stick),
                "{law:?} {beta}"
            );
            let jump = sticking.tangential / slipping.tangential;
            let expected = if law == Law::Kinetic { 1.0 } else { 0.3 / 0.24 };
            assert!((jump - expected).abs() < 1e-8, "{law:?} {beta}: {jump}");
        }
    }
}

#[test]
fn always_slip_creates_energy_beyond_twice_the_impulse_that_stops() {
    let contact = |friction: f64| Contact {
        law: Law::AlwaysSlip,
        ..Contact::new(friction, friction, 1.0).unwrap()
    };
    let velocity = Vector3::new(1.0, 0.0, -1.0);
    for (friction, grows) in [(0.28, false), (0.29, true)] {
        // f* = 2 mu against 2 f*_stick = 4/7.
        let after = rebound(
            &contact(friction),
            &velocity,
            &Vector3::zeros(),
            &Vector3::z(),
        )
        .unwrap();
        assert_eq!(energy(&after.velocity, &after.rolling) > 1.0, grows);
    }
}

fn laws_with_beta() -> impl Iterator<Item = Contact> {
    let contacts = |law| {
        [-1.0, 0.0, 0.4, 1.0].map(|beta| Contact {
            law,
            tangential_restitution: beta,
            ..Contact::new(0.3, 0.27, 0.25).unwrap()
        })
    };
    Law::ALL.into_iter().flat_map(contacts)
}

#[test]
fn without_slip_there_is_no_friction() {
    for contact in laws_with_beta() {
        // Perpendicular, and perpendicular while spinning about n.
        for spin in [0.0, 7.0] {
            let velocity = Vector3::new(0.0, 0.0, -8.0);
            let rolling = Vector3::new(0.0, 0.0, spin);
            let after = rebound(&contact, &velocity, &rolling, &Vector3::z()).unwrap();
            assert_eq!((after.tangential, after.regime), (0.0, Regime::Stick));
            assert_eq!(after.velocity, Vector3::new(0.0, 0.0, 2.0));
            assert_eq!(after.rolling, rolling);
        }
    }
}

#[test]
fn shots_that_do_not_approach_have_no_impact() {
    for contact in laws_with_beta() {
        for upwards in [0.0, 1e-300, 5.0] {
            let velocity = Vector3::new(3.0, 0.0, upwards);
            assert_eq!(
                rebound(&contact, &velocity, &Vector3::zeros(), &Vector3::z()),
                None
            );
        }
    }
}

#[test]
fn the_faintest_slip_and_approach_give_numbers() {
    for contact in laws_with_beta() {
        for (sideways, downwards) in [(1e-300, 1.0), (1.0, 1e-300), (1e-200, 1e-200), (1e150, 1.0)]
        {
            let velocity = Vector3::new(sideways, 0.0, -downwards);
            let after = rebound(&contact, &velocity, &Vector3::zeros(), &Vector3::z()).unwrap();
            assert!(after.velocity.iter().all(|v| v.is_finite()), "{after:?}");
            assert!(after.rolling.iter().all(|v| v.is_finite()), "{after:?}");
            assert!(after.tangential.is_finite() && after.tangential >= 0.0);
        }
    }
}

#[test]
fn without_friction_nothing_turns() {
    for law in Law::ALL {
        let contact = Contact {
            law,
            ..Contact::new(0.0, 0.0, 0.25).unwrap()
        };
        let velocity = Vector3::new(5.0, -2.0, -8.0);
        let rolling = Vector3::new(1.0, 2.0, 3.0);
        let after = rebound(&contact, &velocity, &rolling, &Vector3::z()).unwrap();
        assert_eq!((after.regime, after.tangential), (Regime::Slip, 0.0));
        assert_eq!(after.velocity, Vector3::new(5.0, -2.0, 2.0));
        assert_eq!(after.rolling, rolling);
    }
}

#[test]
fn without_restitution_a_shot_stays() {
    let contact = Contact::new(0.06, 0.054, 0.0).unwrap();
    let velocity = Vector3::new(5.0, 0.0, -8.0);
    let after = rebound(&contact, &velocity, &Vector3::zeros(), &Vector3::z()).unwrap();
    assert_eq!(after.departure, 0.0);
    assert!(after.velocity.z.abs() <= 1e-14 && after.velocity.x > 0.0);
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn elastic_without_friction_is_a_mirror(before in arrival()) {
        let contact = Contact::new(0.0, 0.0, 1.0).unwrap();
        let after = before.on(&contact);
        let normal = before.normal;
        let mirrored = before.velocity - normal * (2.0 * before.velocity.dot(&normal));
        prop_assert!((after.velocity - mirrored).norm() <= 1e-14 * before.scale());
        let (first, last) = (before.velocity.norm_squared(), after.velocity.norm_squared());
        prop_assert!((last - first).abs() <= 1e-14 * first);
    }
}
