//! The impact that the flags describe.

use std::fmt::Display;

use peenpose::impact::{Contact, ContactFault, Law, Oblique, Restitution, Sphere, zohdi};
use peenpose::units::{Dimension, parse, parse_number};

use super::ImpactArgs;

/// The impact that was asked for.
pub fn shot(args: &ImpactArgs) -> Result<Oblique, String> {
    let mut faults = Vec::new();
    let mut flags = Flags {
        faults: &mut faults,
    };
    let speed = flags.within("speed", &SPEED, &args.speed);
    let angle = flags.angle(&args.angle);
    let spin = flags.spin(&args.spin);
    let radius = flags.within("radius", &RADIUS, &args.radius);
    let density = flags.within("density", &DENSITY, &args.density);
    let static_friction = flags.number("mu-s", &args.mu_s);
    let dynamic_friction = match &args.mu_d {
        Some(text) => flags.number("mu-d", text),
        None => static_friction.map(|friction| zohdi::DYNAMIC_RATIO * friction),
    };
    let restitution = flags.number("restitution", &args.restitution);
    let tangential_restitution =
        flags.number("tangential-restitution", &args.tangential_restitution);
    let law = Law::ALL.into_iter().find(|law| law.name() == args.law);

    if law.is_some_and(|law| !law.spins()) && spin.is_some_and(|spin| spin != 0.0) {
        flags.fault("spin", "a shot under the irrotational law does not spin");
    }

    // What could not be read stands in as 0, which is always allowed, to check the rest.
    let contact = Contact {
        law: law.unwrap_or_default(),
        static_friction: static_friction
            .or(dynamic_friction.filter(|friction| *friction >= 0.0))
            .unwrap_or(0.0),
        dynamic_friction: dynamic_friction.unwrap_or(0.0),
        restitution: Restitution::Constant(restitution.unwrap_or(0.0)),
        tangential_restitution: tangential_restitution.unwrap_or(0.0),
    };
    for fault in contact.faults() {
        let follows_from_static =
            args.mu_d.is_none() && matches!(fault, ContactFault::DynamicFriction(_));
        if !follows_from_static {
            flags.fault(flag_of(&fault), fault);
        }
    }
    match (speed, angle, spin, radius, density) {
        (Some(speed), Some(angle), Some(spin), Some(radius), Some(density))
            if faults.is_empty() =>
        {
            Ok(Oblique {
                sphere: Sphere { radius, density },
                contact,
                speed,
                angle,
                spin,
            })
        }
        _ => Err(faults.join("\n")),
    }
}

/// Values of a quantity within which masses, energies and impulses can be computed; as in problem files.
struct Range {
    dimension: Dimension,
    least: f64,
    most: f64,
    /// What is expected, in messages.
    expected: &'static str,
}

const SPEED: Range = Range {
    dimension: Dimension::Speed,
    least: 1e-6,
    most: 1e4,
    expected: "a speed from 0.001 mm/s to 10000 m/s",
};
const RADIUS: Range = Range {
    dimension: Dimension::Length,
    least: 1e-9,
    most: 1e3,
    expected: "a length from 0.001 um to 1000 m",
};
const DENSITY: Range = Range {
    dimension: Dimension::Density,
    least: 1.0,
    most: 1e5,
    expected: "a density from 1 kg/m3 to 100000 kg/m3",
};
/// Either way, rad/s.
const FASTEST_SPIN: f64 = 1e12;

/// Reads flags and keeps what is wrong with them.
struct Flags<'a> {
    faults: &'a mut Vec<String>,
}

impl Flags<'_> {
    fn fault(&mut self, flag: &str, fault: impl Display) {
        self.faults.push(format!("--{flag}: {fault}"));
    }

    fn quantity(&mut self, flag: &str, dimension: Dimension, text: &str) -> Option<f64> {
        parse(dimension, text)
            .map_err(|fault| self.fault(flag, fault))
            .ok()
    }

    fn within(&mut self, flag: &str, range: &Range, text: &str) -> Option<f64> {
        let value = self.quantity(flag, range.dimension, text)?;
        if (range.least..=range.most).contains(&value) {
            return Some(value);
        }
        self.fault(
            flag,
            format!("`{text}` is out of range; expected {}", range.expected),
        );
        None
    }

    fn angle(&mut self, text: &str) -> Option<f64> {
        let value = self.quantity("angle", Dimension::Angle, text)?;
        if value > 0.0 && value <= std::f64::consts::FRAC_PI_2 {
            return Some(value);
        }
        self.fault(
            "angle",
            format!("`{text}` must be above 0 deg and at most 90 deg, the perpendicular"),
        );
        None
    }

    fn spin(&mut self, text: &str) -> Option<f64> {
        let number = text.trim().strip_suffix("rad/s").and_then(parse_number);
        match number {
            None => self.fault(
                "spin",
                format!("`{text}` is not a spin; expected one such as `100 rad/s`"),
            ),
            Some(spin) if spin.abs() > FASTEST_SPIN => self.fault(
                "spin",
                format!("`{text}` is out of range; expected at most 1e12 rad/s either way"),
            ),
            Some(_) => return number,
        }
        None
    }

    fn number(&mut self, flag: &str, text: &str) -> Option<f64> {
        let number = parse_number(text);
        if number.is_none() {
            self.fault(flag, format!("`{text}` is not a number"));
        }
        number
    }
}

fn flag_of(fault: &ContactFault) -> &'static str {
    match fault {
        ContactFault::StaticFriction(_) => "mu-s",
        ContactFault::DynamicFriction(_) | ContactFault::DynamicAboveStatic { .. } => "mu-d",
        ContactFault::TangentialRestitution(_) => "tangential-restitution",
        ContactFault::Restitution(_)
        | ContactFault::ReferenceSpeed(_)
        | ContactFault::Exponent(_) => "restitution",
    }
}
