//! Contacts by themselves: what they may be, and how restitution depends on speed.

use peenpose::impact::{Contact, ContactFault, Law, Oblique, Regime, Restitution, Sphere};

fn steel() -> Contact {
    Contact::new(0.3, 0.27, 0.25).unwrap()
}

fn falling(reference: f64, speed: f64, exponent: f64) -> Contact {
    Contact {
        restitution: Restitution::Falling {
            reference,
            speed,
            exponent,
        },
        ..steel()
    }
}

#[test]
fn coefficients_are_legal_up_to_their_bounds() {
    let contacts = [
        Contact::new(0.0, 0.0, 0.0).unwrap(),
        Contact::new(1e6, 1e6, 1.0).unwrap(),
        falling(1.0, f64::MIN_POSITIVE, 0.0),
        falling(0.0, 1e300, 1.0),
    ];
    for contact in contacts {
        for tangential_restitution in [-1.0, 0.0, 1.0] {
            let contact = Contact {
                tangential_restitution,
                ..contact
            };
            assert_eq!(contact.validate(), Ok(()), "{contact:?}");
            assert_eq!(contact.faults(), []);
        }
    }
}

#[test]
fn each_coefficient_out_of_its_range_is_a_fault_of_its_own() {
    let with = |change: fn(&mut Contact)| {
        let mut contact = steel();
        change(&mut contact);
        contact
    };
    let cases = [
        (
            with(|contact| contact.static_friction = f64::INFINITY),
            ContactFault::StaticFriction(f64::INFINITY),
            "static friction inf must be 0 or more",
        ),
        (
            with(|contact| contact.dynamic_friction = -0.1),
            ContactFault::DynamicFriction(-0.1),
            "dynamic friction -0.1 must be 0 or more",
        ),
        (
            with(|contact| contact.dynamic_friction = 0.31),
            ContactFault::DynamicAboveStatic {
                dynamic_friction: 0.31,
                static_friction: 0.3,
            },
            "dynamic friction 0.31 must not exceed static friction 0.3",
        ),
        (
            with(|contact| contact.tangential_restitution = 1.01),
            ContactFault::TangentialRestitution(1.01),
            "tangential restitution 1.01 must lie within -1 to 1",
        ),
        (
            with(|contact| contact.restitution = Restitution::Constant(-0.01)),
            ContactFault::Restitution(-0.01),
            "coefficient of restitution -0.01 must lie within 0 to 1",
        ),
        (
            falling(1.01, 5.0, 0.25),
            ContactFault::Restitution(1.01),
            "coefficient of restitution 1.01 must lie within 0 to 1",
        ),
        (
            falling(0.5, 0.0, 0.25),
            ContactFault::ReferenceSpeed(0.0),
            "the speed 0 m/s at which restitution was measured must be positive",
        ),
        (
            falling(0.5, f64::INFINITY, 0.25),
            ContactFault::ReferenceSpeed(f64::INFINITY),
            "the speed inf m/s at which restitution was measured must be positive",
        ),
        (
            falling(0.5, 5.0, 1.01),
            ContactFault::Exponent(1.01),
            "the exponent 1.01 of restitution must lie within 0 to 1",
        ),
    ];
    for (contact, fault, message) in cases {
        assert_eq!(contact.faults(), [fault], "{contact:?}");
        assert_eq!(contact.validate(), Err(fault));
        assert_eq!(fault.to_string(), message);
    }
    assert!(Contact::new(0.1, 0.2, 0.25).is_err());
}

#[test]
fn all_faults_are_told_and_friction_is_compared_only_where_it_is_legal() {
    let contact = Contact {
        static_friction: -1.0,
        tangential_restitution: 2.0,
        ..falling(0.5, 5.0, -1.0)
    };
    let expected = [
        ContactFault::StaticFriction(-1.0),
        ContactFault::TangentialRestitution(2.0),
        ContactFault::Exponent(-1.0),
    ];
    assert_eq!(contact.faults(), expected);
    assert_eq!(contact.validate(), Err(expected[0]));
}

#[test]
fn only_a_constant_restitution_is_the_same_at_every_speed() {
    for law in Law::ALL {
        let constant = Contact { law, ..steel() };
        assert!(constant.is_scale_free() && constant.restitution.is_constant());
        let falls = Contact {
            law,
            ..falling(0.5, 5.0, 0.25)
        };
        assert!(!falls.is_scale_free() && !falls.restitution.is_constant());
    }
}

#[test]
fn a_falling_restitution_is_its_reference_there_and_1_at_most() {
    let restitution = falling(0.5, 5.0, 0.25).restitution;
    assert_eq!(restitution.at(5.0), 0.5);
    assert_eq!(restitution.reference(), 0.5);
    assert!((restitution.at(80.0) - 0.25).abs() < 1e-15);
    assert_eq!(restitution.at(1e-9), 1.0);
    assert_eq!(
        restitution.held_at(80.0),
        Restitution::Constant(restitution.at(80.0))
    );
    assert_eq!(Restitution::Constant(0.25).reference(), 0.25);
}

#[test]
fn a_shift_keeps_restitution_within_0_and_1() {
    for (change, expected) in [(0.25, 0.75), (-0.25, 0.25), (0.6, 1.0), (-0.6, 0.0)] {
        let constant = Restitution::Constant(0.5).shifted(change);
        assert_eq!(constant, Restitution::Constant(expected));
        let falls = falling(0.5, 5.0, 0.25).restitution.shifted(change);
        assert_eq!(falls, falling(expected, 5.0, 0.25).restitution);
    }
}

#[test]
fn the_speed_of_an_impulse_gives_that_impulse() {
    for restitution in [
        Restitution::Constant(0.25),
        falling(0.5, 5.0, 0.25).restitution,
        falling(0.9, 2.0, 1.0).restitution,
    ] {
        for impulse in [1e-3, 1.0, 12.5, 300.0] {
            let speed = restitution.approach_speed(impulse);
            let error = (1.0 + restitution.at(speed)) * speed / impulse - 1.0;
            assert!(error.abs() < 1e-14, "{restitution:?} {impulse}: {error}");
        }
    }
}

#[test]
fn laws_and_regimes_have_the_names_that_files_use() {
    let laws = Law::ALL.map(Law::name);
    assert_eq!(
        laws,
        ["stick_slip", "kinetic", "irrotational", "always_slip"]
    );
    assert_eq!(
        [Regime::Stick, Regime::Slip].map(Regime::name),
        ["stick", "slip"]
    );
}

#[test]
fn the_angle_of_sticking_is_that_of_the_normal_speed() {
    let arriving = |contact: Contact| Oblique {
        sphere: Sphere {
            radius: 0.5e-3,
            density: 7000.0,
        },
        contact,
        speed: 80.0,
        angle: 30_f64.to_radians(),
        spin: 0.0,
    };
    let angle = arriving(steel()).stick_angle().unwrap();
    assert!((angle.tan() - 2.0 / (7.0 * 0.3 * 1.25)).abs() < 1e-14);
    let falls = falling(0.5, 2.5, 0.25);
    let angle = arriving(falls).stick_angle().unwrap();
    assert!((angle.tan() - 2.0 / (7.0 * 0.3 * 1.25)).abs() < 1e-14);
    let never = Contact {
        law: Law::AlwaysSlip,
        ..steel()
    };
    assert_eq!(arriving(never).stick_angle(), None);
    let smooth = Contact::new(0.0, 0.0, 0.25).unwrap();
    assert_eq!(arriving(smooth).stick_angle(), None);
}
