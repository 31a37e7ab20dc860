//! Problems and what else several tests share.
#![allow(dead_code)]

pub mod cases;
pub mod held;
pub mod kept;
pub mod program;
pub mod shipped;

use nalgebra::{Point3, Vector3};
use peenpose::impact::Contact;
use peenpose::problem::Problem;
use peenpose::problem::equipment::{Body, ContactChoice, Jet, Nozzle, PathLimits, Shot, Spread};
use peenpose::problem::goal::{Goals, Miss, NormalImpulse, Rebound, TangentialImpulse};
use peenpose::problem::model::Model;
use peenpose::problem::part::{Keyway, Part, Place, Shape, Target};
use peenpose::problem::setting::{Range, SettingRanges, Tolerance};

pub fn keyway(length: f64) -> Problem {
    let middle = length / 2.0;
    let contact = |name: &str, mu: f64| ContactChoice {
        name: name.into(),
        contact: Contact::new(mu, 0.9 * mu, 0.25).unwrap(),
        static_friction: Range::held(mu),
        dynamic_ratio: None,
        library: None,
    };
    let degrees = f64::to_radians;
    Problem {
        title: "keyway".into(),
        parts: vec![Part {
            name: "hub".into(),
            shape: Shape::Keyway(Keyway {
                bore: 30e-3,
                width: 8e-3,
                depth: 3.3e-3,
                length,
                root_radius: 0.0,
            }),
            place: Place::default(),
            on_nozzle: false,
            cut: Vec::new(),
        }],
        target: Target {
            lengths_in: Default::default(),
            surface: "hub.floor".into(),
            within: Some((
                Point3::new(-3e-3, 18e-3, middle - 5e-3),
                Point3::new(3e-3, 19e-3, middle + 5e-3),
            )),
            aim: Some(Point3::new(0.0, 18.3e-3, middle)),
            aim_key: "target.aim",
            along: Some(Vector3::z()),
            facing: None,
        },
        shot: Shot {
            radius: 0.5e-3,
            density: 7000.0,
            size_spread: 0.0,
            medium: None,
        },
        jet: Jet {
            exit_diameter: 1.5e-3,
            divergence: degrees(4.0),
            spread: Spread::Uniform,
            speed_spread: 0.05,
            mass_flow: None,
            air_speed: None,
        },
        calibration: None,
        nozzle: Nozzle {
            body: vec![Body::Ball { radius: 3e-3 }],
            clearance: 0.0,
        },
        contacts: vec![
            contact("dry", 0.3),
            contact("damp", 0.15),
            contact("oiled", 0.06),
        ],
        ranges: SettingRanges {
            incidence: Range {
                min: degrees(30.0),
                max: degrees(85.0),
            },
            azimuth: Range {
                min: degrees(-90.0),
                max: degrees(90.0),
            },
            standoff: Range {
                min: 6e-3,
                max: 20e-3,
            },
            speed: Range {
                min: 5.0,
                max: 40.0,
            },
            aim_along: Range::held(0.0),
            aim_across: Range::held(0.0),
            aim_above: Range::held(0.0),
            contact: vec![0, 1, 2],
        },
        goals: Goals {
            normal_impulse: NormalImpulse {
                target: 40e-6,
                tolerance: 0.15,
                share: 0.05,
                weight: 1.0,
            },
            tangential_impulse: Some(TangentialImpulse {
                limit: 8e-6,
                share: 0.05,
                weight: 1.0,
            }),
            rebound: Some(Rebound {
                allow: 10e-6,
                share: 0.01,
                weight: 0.5,
            }),
            miss: Miss {
                share: 0.01,
                weight: 2.0,
            },
        },
        surfaces: vec![],
        paths: PathLimits {
            impacts: 6,
            least_energy: 0.01,
            shot_size: false,
            spin: true,
            exit_width: true,
        },
        stroke: None,
        coverage: None,
        tolerance: Tolerance::default(),
        model: Model::Full,
        accuracy: 0.01,
        seed: 1,
    }
}

/// What the comments of a bad file announce: line, column and message.
///
/// `#   ^ message` points at the character above its caret in the last line that is not such a
/// comment; `#< message` at the first character of that line.
pub fn announced(text: &str) -> Vec<(usize, usize, String)> {
    let mut announced = Vec::new();
    let mut line = 1;
    for (index, content) in text.lines().enumerate() {
        let rest = content.strip_prefix('#').unwrap_or_default();
        if let Some(message) = rest.strip_prefix("< ") {
            announced.push((line, 1, message.to_owned()));
        } else if let Some(message) = rest.trim_start().strip_prefix("^ ") {
            let column = rest.chars().take_while(|c| *c == ' ').count() + 2;
            announced.push((line, column, message.to_owned()));
        } else {
            line = index + 1;
        }
    }
    announced
}
