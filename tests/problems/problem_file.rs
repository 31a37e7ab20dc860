//! Problem files: good ones give SI values, bad ones say what is wrong and where.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};
use std::path::Path;

use crate::common::cases::cases;
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};
use peenpose::impact::{Contact, Law, Restitution};
use peenpose::problem::equipment::{Body, Dent, Jet, Nozzle, PathLimits, Role, Shot, Spread};
use peenpose::problem::fault_code::FaultCode;
use peenpose::problem::goal::{Goals, Miss, NormalImpulse, Rebound, TangentialImpulse};
use peenpose::problem::model::{Effect, Model};
use peenpose::problem::part::{Ends, Keyway, Part, Place, RegionPlace, Shape, Target};
use peenpose::problem::setting::{Range, Tolerance};
use peenpose::problem::{self, LengthUnit, Problem, Reading};
use proptest::prelude::*;

const KEYWAY: &str = include_str!("../../problems/keyway.yaml");

fn reading(text: &str) -> Reading {
    problem::read_text(text, Path::new("problems/some file.yaml")).unwrap()
}

/// The problem in `text`, which must be sound.
fn sound(text: &str) -> Problem {
    let reading = reading(text);
    let faults = problem::render(&reading.source, &reading.faults, false);
    reading.problem.unwrap_or_else(|| panic!("{faults}"))
}

#[test]
fn the_keyway_is_read_in_si() {
    let problem = sound(KEYWAY);
    assert_eq!(problem.title, "Keyway floor, 30 mm hub bore (DIN 6885)");
    assert_eq!(
        problem.parts,
        [Part {
            name: "hub".to_owned(),
            shape: Shape::Keyway(Keyway {
                bore: 0.030,
                width: 0.008,
                depth: 0.0033,
                length: 0.040,
                root_radius: 0.0,
            }),
            place: Place::default(),
            on_nozzle: false,
            cut: Vec::new(),
        }]
    );
    assert_eq!(problem.target.surface, "hub.floor");
    assert_eq!(
        problem.target.within,
        Some((
            Point3::new(-0.003, 0.018, 0.015),
            Point3::new(0.003, 0.019, 0.025)
        ))
    );
    assert_eq!(problem.target.aim, Some(Point3::new(0.0, 0.0183, 0.020)));
    assert_eq!(problem.target.along, Some(Vector3::z()));
    assert_eq!(
        problem.shot,
        Shot {
            radius: 0.0005,
            density: 7000.0,
            size_spread: 0.0,
            medium: None,
        }
    );
    assert_eq!(
        problem.jet,
        Jet {
            exit_diameter: 0.0015,
            divergence: 4.0 * (PI / 180.0),
            spread: Spread::Uniform,
            speed_spread: 0.05,
            mass_flow: None,
            air_speed: None,
        }
    );
    assert_eq!(
        problem.nozzle,
        Nozzle {
            body: vec![Body::Ball { radius: 0.003 }],
            clearance: 0.0,
        }
    );
    let names: Vec<_> = problem.contacts.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["dry", "damp", "oiled"]);
    assert_eq!(
        problem.contacts[1].contact,
        Contact::new(0.15, 0.135, 0.25).unwrap()
    );
    assert!(problem.contacts[1].static_friction.is_held());
    let settings = &problem.ranges;
    assert_eq!(
        settings.azimuth,
        Range {
            min: -FRAC_PI_2,
            max: FRAC_PI_2
        }
    );
    assert_eq!(
        settings.standoff,
        Range {
            min: 0.006,
            max: 0.020
        }
    );
    assert_eq!(
        settings.speed,
        Range {
            min: 5.0,
            max: 40.0
        }
    );
    assert_eq!(settings.aim_along, Range::held(0.0));
    assert_eq!(settings.contact, [0, 1, 2]);
    assert_eq!(
        problem.goals,
        Goals {
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
        }
    );
    assert_eq!(problem.tolerance.incidence, 2.0 * (PI / 180.0));
    assert_eq!(problem.tolerance.standoff, 0.001);
    assert_eq!(problem.tolerance.speed, 0.03);
    assert_eq!(problem.tolerance.restitution, 0.1);
    assert_eq!((problem.accuracy, problem.seed), (0.01, 1));
}

#[test]
fn the_plate_holds_every_setting_of_the_pose() {
    let reading = problem::read(Path::new("problems/plate.yaml")).unwrap();
    let problem = reading.problem.unwrap();
    let settings = &problem.ranges;
    assert!((settings.incidence.min - FRAC_PI_3).abs() < 1e-15);
    for range in [
        settings.incidence,
        settings.azimuth,
        settings.standoff,
        settings.speed,
    ] {
        assert!(range.is_held());
    }
    assert_eq!(settings.contact.len(), problem.contacts.len());
    // Absent keys take their defaults.
    assert_eq!(problem.nozzle, Nozzle::default());
    assert_eq!(problem.tolerance, Tolerance::default());
    assert_eq!(problem.goals.normal_impulse.tolerance, 0.10);
    assert_eq!(problem.goals.normal_impulse.share, 0.05);
    assert_eq!(problem.goals.tangential_impulse, None);
    assert_eq!(problem.goals.rebound, None);
    assert_eq!(
        problem.goals.miss,
        Miss {
            share: 0.01,
            weight: 1.0
        }
    );
    assert_eq!(
        problem.paths,
        PathLimits {
            impacts: 6,
            least_energy: 0.01,
            shot_size: true,
            spin: true,
            exit_width: true,
        }
    );
    // N* = (1 + E) m v sin(60 deg) of the paper.
    let approach = settings.speed.min * settings.incidence.min.sin();
    let impulse = 1.25 * problem.shot.mass() * approach;
    assert!((impulse / problem.goals.normal_impulse.target - 1.0).abs() < 1e-5);
}

const EVERYTHING_ELSE: &str = r"
format: 1
lengths_in: cm
scene:
  slot:
    extrude:
      length: 48 mm
      ends: { near: closed }
      profile:
        - { from: [-1, 0], line_to: [1, 0], surface: floor }
        - { arc_to: [-1, 0], via: [0, 2], surface: roof }
    place: { at: [1, 2, 3], rotate: [90 deg, 0 deg, 90 deg] }
  groove:
    keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm, root_radius: 0.4 mm }
  pin: { bore: { diameter: 12 mm, length: 1 in, ends: closed }, place: nozzle }
  mask: { mesh: parts/mask.obj, lengths_in: in, regions: { lip: { min: [0, 0, 0], max: [1, 2, 3] } } }
  cover: { mesh: ./cover.stl, place: { on: nozzle, at: [0, 0, 4] } }
target: { surface: mask.rim, facing: [0, 0, -2] }
shot: { radius: 250 um, density: 7.8 g/cm3, size_spread: 4 % }
jet: { exit_diameter: 0 mm, divergence: 0 deg, spread: gaussian, mass_flow: 6 kg/min, air_speed: 250 m/s,
  pressure: [ { pressure: 2 bar, speed: 22 m/s }, { pressure: 0.4 MPa, speed: 36 m/s } ] }
coverage: { dent_diameter: 0.2 mm }
nozzle:
  body:
    - { capsule: { length: 60 mm, radius: 2 mm } }
    - { capsule: { length: 60 mm, radius: 3 mm, direction: [0, 0, 5] } }
  clearance: 0.5 mm
contacts:
  tuned: { mu_s: [0.05, 0.30], mu_d_ratio: 0.9, restitution: 0.25, law: kinetic }
  scaled: { mu_s: 0.2, mu_d_ratio: 0.5, restitution: { value: 0.5, at: 10 m/s, exponent: 0.25 } }
  sprung: { mu_s: 0.2, mu_d: 0.2, restitution: 1, tangential_restitution: -0.5, law: irrotational }
settings:
  incidence: 90 deg
  azimuth: [-180 deg, 180 deg]
  standoff: 1 cm
  speed: [18 km/h, 10 m/s]
  aim_along: [-2 mm, 2 mm]
  aim_across: 1 mm
  aim_above: [0.5 mm, 3 mm]
  contact: scaled
goals: { normal_impulse: { target: 40 µN s } }
surfaces:
  pin.wall: { role: deflector, contact: { mu_s: 0.8, mu_d: 0.7, restitution: 0.4, law: always_slip } }
  slot.near: { allow: 5 uN.s, share: 0.1 %, weight: 2, roughness: 18 deg }
tolerance: { azimuth: 1 deg, friction: 10 %, aim_along: 0.5 mm, aim_across: 0.25 mm, aim_above: 0.1 mm }
paths: { impacts: 3, least_energy: 0 % }
solve: { accuracy: 0.5 %, seed: 18446744073709551615 }
";

#[test]
fn every_other_key_is_read() {
    let problem = sound(EVERYTHING_ELSE);
    assert_eq!(problem.title, "some file");
    let [slot, groove, pin, mask, cover] = problem.parts.as_slice() else {
        panic!("five parts, in the order of the file");
    };

    let Shape::Extrude {
        profile,
        length,
        ends,
    } = &slot.shape
    else {
        panic!("{slot:?}");
    };
    assert_eq!(
        (*length, ends.near_closed, ends.far_closed),
        (0.048, true, false)
    );
    assert_eq!(profile[0].to, Point2::new(0.01, 0.0));
    assert_eq!(profile[0].via, None);
    assert_eq!(profile[1].from, profile[0].to);
    assert_eq!(profile[1].via, Some(Point2::new(0.0, 0.02)));
    assert_eq!(profile[1].surface, "roof");
    assert_eq!(slot.place.shift, Vector3::new(0.01, 0.02, 0.03));
    // About fixed x first, which takes y to z; then about fixed z, which takes x to y.
    let turned = slot.place.rotation * Vector3::y();
    assert!((turned - Vector3::z()).norm() < 1e-15, "{turned}");
    let turned = slot.place.rotation * Vector3::x();
    assert!((turned - Vector3::y()).norm() < 1e-15, "{turned}");
    assert_eq!(groove.place.rotation, UnitQuaternion::identity());

    assert!(matches!(
        groove.shape,
        Shape::Keyway(Keyway {
            root_radius: 0.0004,
            ..
        })
    ));
    assert_eq!(
        pin.shape,
        Shape::Bore {
            diameter: 0.012,
            length: 0.0254,
            ends: Ends {
                near_closed: true,
                far_closed: true
            },
            free: None,
        }
    );
    let Shape::Mesh {
        file,
        metres_per_unit,
        regions,
    } = &mask.shape
    else {
        panic!("{mask:?}");
    };
    assert_eq!(file.path, Path::new("problems/parts/mask.obj"));
    assert_eq!(*metres_per_unit, 0.0254);
    assert_eq!(regions[0].name, "lip");
    let RegionPlace::Box { max, .. } = regions[0].place else {
        panic!("it is a box")
    };
    assert_eq!(max.z, 3.0 * 0.0254);
    assert!(
        matches!(&cover.shape, Shape::Mesh { metres_per_unit, regions, .. }
            if *metres_per_unit == 0.01 && regions.is_empty())
    );

    assert_eq!(
        problem.target,
        Target {
            lengths_in: LengthUnit::Centimetre,
            // A group of the mesh file, which nobody has read yet.
            surface: "mask.rim".to_owned(),
            within: None,
            aim: None,
            aim_key: "target.aim",
            along: None,
            facing: Some(-Vector3::z()),
        }
    );
    assert_eq!(
        problem.shot,
        Shot {
            radius: 250e-6,
            density: 7800.0,
            size_spread: 0.04,
            medium: None,
        }
    );
    assert_eq!(problem.jet.spread, Spread::Gaussian);
    assert_eq!(problem.jet.mass_flow, Some(0.1));
    assert_eq!(problem.jet.air_speed, Some(250.0));
    let calibration = problem.calibration.unwrap();
    assert_eq!(calibration.rows, [(2e5, 22.0), (4e5, 36.0)]);
    // Linear between the rows, and nothing beyond them.
    assert_eq!(calibration.pressure_at(29.0), Some(3e5));
    assert_eq!(calibration.pressure_at(22.0), Some(2e5));
    assert_eq!(calibration.pressure_at(36.0), Some(4e5));
    assert_eq!(calibration.pressure_at(21.999), None);
    assert_eq!(calibration.pressure_at(36.001), None);
    let coverage = problem.coverage.unwrap();
    assert_eq!(coverage.dent, Dent::Diameter(0.2e-3));
    assert_eq!((coverage.wanted, coverage.times), (0.98, 1.0));
    assert_eq!(
        (problem.jet.exit_diameter, problem.jet.divergence),
        (0.0, 0.0)
    );
    assert_eq!(
        problem.nozzle.body,
        [
            Body::Capsule {
                length: 0.060,
                radius: 0.002,
                direction: None
            },
            Body::Capsule {
                length: 0.060,
                radius: 0.003,
                direction: Some(Vector3::z())
            },
        ]
    );
    assert_eq!(problem.nozzle.clearance, 0.0005);

    let [tuned, scaled, sprung] = problem.contacts.as_slice() else {
        panic!("three contacts");
    };
    assert_eq!(
        tuned.static_friction,
        Range {
            min: 0.05,
            max: 0.30
        }
    );
    assert_eq!(tuned.dynamic_ratio, Some(0.9));
    assert_eq!(tuned.contact.static_friction, 0.05);
    assert_eq!(tuned.contact.dynamic_friction, 0.9 * 0.05);
    assert_eq!(tuned.contact.law, Law::Kinetic);
    assert_eq!(scaled.dynamic_ratio, None);
    assert_eq!(scaled.contact.dynamic_friction, 0.1);
    assert_eq!(
        scaled.contact.restitution,
        Restitution::Falling {
            reference: 0.5,
            speed: 10.0,
            exponent: 0.25
        }
    );
    assert_eq!(sprung.contact.tangential_restitution, -0.5);
    assert_eq!(sprung.contact.restitution, Restitution::Constant(1.0));
    assert_eq!(sprung.contact.law, Law::Irrotational);

    let on_nozzle: Vec<bool> = problem.parts.iter().map(|part| part.on_nozzle).collect();
    assert_eq!(on_nozzle, [false, false, true, false, true]);
    assert_eq!(problem.parts[4].place.shift.z, 0.04);
    let settings = &problem.ranges;
    assert_eq!(settings.incidence, Range::held(FRAC_PI_2));
    assert_eq!(settings.azimuth, Range { min: -PI, max: PI });
    assert_eq!(
        settings.speed,
        Range {
            min: 5.0,
            max: 10.0
        }
    );
    assert_eq!(
        settings.aim_along,
        Range {
            min: -0.002,
            max: 0.002
        }
    );
    assert_eq!(settings.aim_across, Range::held(0.001));
    assert_eq!(
        settings.aim_above,
        Range {
            min: 0.0005,
            max: 0.003
        }
    );
    assert_eq!(settings.contact, [1]);

    let [pin_wall, slot_near] = problem.surfaces.as_slice() else {
        panic!("two rules");
    };
    assert_eq!(pin_wall.role, Role::Deflector);
    assert_eq!(pin_wall.contact.unwrap().law, Law::AlwaysSlip);
    assert_eq!(pin_wall.allow, None);
    assert_eq!(slot_near.surface, "slot.near");
    assert_eq!(slot_near.allow, Some(5e-6));
    assert_eq!(slot_near.share, Some(0.001));
    assert_eq!(slot_near.weight, Some(2.0));
    assert_eq!(slot_near.roughness, PI / 10.0);
    assert_eq!(slot_near.role, Role::Part);
    assert_eq!(pin_wall.roughness, 0.0);
    assert_eq!(problem.tolerance.friction, 0.1);
    assert_eq!(problem.tolerance.aim_along, 0.0005);
    assert_eq!(problem.tolerance.aim_across, 0.00025);
    assert_eq!(problem.tolerance.aim_above, 0.0001);
    assert_eq!(problem.tolerance.azimuth, PI / 180.0);
    assert_eq!(
        problem.paths,
        PathLimits {
            impacts: 3,
            least_energy: 0.0,
            shot_size: true,
            spin: true,
            exit_width: true,
        }
    );
    assert_eq!((problem.accuracy, problem.seed), (0.005, u64::MAX));
}

#[test]
fn a_root_may_reach_up_to_the_round_of_the_bore() {
    // The groove leaves the bore at sqrt(15^2 - 9^2) = 12 mm; its floor is at 15 mm + 3.3 mm.
    let groove = "width: 18 mm, depth: 3.3 mm, root_radius: 6.3 mm";
    let text = KEYWAY.replace("width: 8 mm, depth: 3.3 mm", groove);
    let problem = sound(&text);
    assert!(matches!(
        problem.parts[0].shape,
        Shape::Keyway(Keyway {
            root_radius: 0.0063,
            ..
        })
    ));
}

#[test]
fn a_root_may_be_half_as_wide_as_the_groove() {
    let groove = "width: 8 mm, depth: 6 mm, root_radius: 4 mm";
    sound(&KEYWAY.replace("width: 8 mm, depth: 3.3 mm", groove));
}

#[test]
fn a_range_may_be_a_single_value() {
    let text = KEYWAY.replace("speed: [5 m/s, 40 m/s]", "speed: [10 m/s, 10 m/s]");
    assert_eq!(sound(&text).ranges.speed, Range::held(10.0));
}

/// Such a file has nothing that is in that unit; what is said of places is then in mm.
#[test]
fn a_file_without_coordinates_needs_no_unit_for_them() {
    let without = ["lengths_in: ", "  within: ", "  aim: "];
    let is_kept = |line: &&str| !without.iter().any(|start| line.starts_with(start));
    let kept: Vec<&str> = KEYWAY.lines().filter(is_kept).collect();
    assert_eq!(kept.len() + without.len(), KEYWAY.lines().count());
    let bare = kept.join("\n");
    let lengths_in = sound(&bare).target.lengths_in;
    assert_eq!((lengths_in.name(), lengths_in.metres(1.0)), ("mm", 1e-3));
}

#[test]
fn the_path_of_a_mesh_may_lead_up_within_the_folder() {
    sound(&EVERYTHING_ELSE.replace("parts/mask.obj", "parts/../parts/mask.obj"));
}

#[test]
fn a_model_is_chosen_or_searched() {
    let model = |text: &str| sound(&format!("{KEYWAY}model: {text}\n")).model;
    assert_eq!(model("auto"), Model::Auto);
    assert_eq!(model("full"), Model::Full);
    assert_eq!(
        model("[spin, rebounds]"),
        Model::Only(vec![Effect::Spin, Effect::Rebounds])
    );
}

#[test]
fn an_empty_text_is_not_taken_for_a_bad_number() {
    for (radius, rule) in [
        ("''", FaultCode::EmptyText),
        ("'wide'", FaultCode::NotAQuantity),
    ] {
        let text = KEYWAY.replace("radius: 0.5 mm", &format!("radius: {radius}"));
        let faults = reading(&text).faults;
        let found: Vec<_> = faults.iter().map(|it| (it.key.as_str(), it.rule)).collect();
        assert_eq!(found, [("shot.radius", rule)]);
    }
}

#[test]
fn line_ends_and_a_byte_order_mark_change_nothing() {
    let plain = format!("{:?}", sound(KEYWAY));
    let windows = format!("\u{feff}{}", KEYWAY.replace('\n', "\r\n"));
    assert_eq!(format!("{:?}", sound(&windows)), plain);
}

#[test]
fn aliases_repeat_a_value() {
    let text = KEYWAY.replace(
        "incidence: 2 deg, azimuth: 2 deg",
        "incidence: &a 2 deg, azimuth: *a",
    );
    assert_eq!(sound(&text).tolerance, sound(KEYWAY).tolerance);
}

#[test]
fn keys_are_found_in_the_text() {
    let source = reading(KEYWAY).source;
    let written = |key: &str| {
        let span = source.locate(key).unwrap();
        &source.text[span.start..span.end]
    };
    assert_eq!(written("shot.radius"), "0.5 mm");
    assert_eq!(written("settings.speed[1]"), "40 m/s");
    assert_eq!(written("settings.speed"), "[5 m/s, 40 m/s]");
    assert_eq!(written("scene.hub"), "hub");
    assert_eq!(written("scene.hub.keyway.root_radius"), "keyway");
    assert_eq!(written("scene.hub.mesh.lip"), "hub");
    assert_eq!(written("nozzle.body[0].ball.radius"), "3 mm");
    let jet = source.locate("jet.divergence").unwrap();
    assert_eq!((jet.line, jet.column), (20, 15));
    assert_eq!(source.locate("surfaces").unwrap().line, 1);
    let name = source.locate_name("shot.radius").unwrap();
    assert_eq!(&source.text[name.start..name.end], "radius");
    assert_eq!(source.sha256.len(), 64);
}

#[test]
fn sound_blocks_are_there_beside_faulty_ones() {
    let reading = reading(&KEYWAY.replace("radius: 0.5 mm", "radius: 0.5"));
    assert!(reading.problem.is_none());
    assert_eq!(reading.faults.len(), 1);
    assert!(reading.scene.is_some());
    assert!(reading.target.is_some());

    let reading = self::reading(&KEYWAY.replace("depth: 3.3 mm", "depth: -3.3 mm"));
    assert!(reading.scene.is_none());
    assert!(reading.target.is_some());
}

#[test]
fn faults_are_shown_where_they_stand() {
    let reading = reading("format: 1\nshot: { radius: 0.5, density: 7000 kg/m3 }\n");
    let text = problem::render(&reading.source, &reading.faults, false);
    let radius = "\
error: shot.radius: `0.5` has no unit
 --> problems/some file.yaml:2:17
  |
2 | shot: { radius: 0.5, density: 7000 kg/m3 }
  |                 ^^^ expected a length such as `0.5 mm`
  |
  = help: did you mean `0.5 mm`?
";
    assert!(text.contains(radius), "{text}");
    let coloured = problem::render(&reading.source, &reading.faults, true);
    assert!(coloured.contains('\u{1b}'));
}

#[test]
fn unreadable_files_are_faults() {
    let missing = problem::read(Path::new("problems/no such.yaml")).unwrap_err();
    assert_eq!(
        missing.to_string(),
        "cannot read problems/no such.yaml: there is no such file"
    );
    let folder = problem::read(Path::new("problems")).unwrap_err();
    assert_eq!(
        folder.to_string(),
        "cannot read problems: it is a folder, not a file"
    );
    let huge = "#".repeat(1_000_001);
    let fault = problem::read_text(&huge, Path::new("huge.yaml")).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "huge.yaml is too large for a problem file; \
         expected at most 1 MB; meshes belong into files of their own"
    );
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), &huge).unwrap();
    let fault = problem::read(file.path()).unwrap_err();
    assert_eq!(fault.rule, FaultCode::FileTooLarge);
}

#[test]
fn a_file_full_of_faults_is_read_in_reasonable_time() {
    let mut text = "format: 1\nscene:\n".to_owned();
    let keys: String = (0..100).map(|key| format!("k{key}: 0, ")).collect();
    for part in 0..1000 {
        text += &format!("  p{part}: {{ {keys}boks: {{ min: [0, x] }} }}\n");
    }
    let reading = reading(&text);
    assert!(reading.faults.len() > 100_000);
    let shown = problem::render(&reading.source, &reading.faults, false);
    assert!(shown.trim_end().ends_with("more faults"));
    // Linear work takes a fraction of a second; anything quadratic takes minutes.
}

#[test]
fn hostile_files_are_refused() {
    let nested = |open: &str| open.repeat(900_000 / open.len());
    let stairs: String = (0..1000)
        .map(|depth| format!("{:depth$}a:\n", ""))
        .collect();
    let keys: String = (0..60_000).map(|key| format!("k{key}: 1, ")).collect();
    let texts = [
        nested("["),
        nested("{a: "),
        nested("- "),
        nested("? "),
        nested("&a "),
        nested("!a "),
        nested("*a "),
        nested("'"),
        nested("\""),
        nested("a"),
        nested("%a\n"),
        nested("---\n"),
        nested("#\n"),
        stairs,
        format!("{{ {keys} }}"),
    ];
    for text in texts {
        let reading = reading(&text);
        assert!(reading.problem.is_none());
        assert!(!reading.faults.is_empty());
        problem::render(&reading.source, &reading.faults, false);
    }
}

/// One careless edit of a text.
#[derive(Clone, Debug)]
enum Edit {
    Delete { at: usize, length: usize },
    Replace { at: usize, by: u8 },
    Repeat { at: usize, length: usize },
}

fn edit() -> impl Strategy<Value = Edit> {
    let at = 0..KEYWAY.len().max(EVERYTHING_ELSE.len());
    let telling = prop::sample::select(b"\t\n []{}:,-#&*!|>'\"%@0e.~<\x00\xff".to_vec());
    prop_oneof![
        (at.clone(), 1..20_usize).prop_map(|(at, length)| Edit::Delete { at, length }),
        (at.clone(), prop_oneof![any::<u8>(), telling])
            .prop_map(|(at, by)| Edit::Replace { at, by }),
        (at, 1..40_usize).prop_map(|(at, length)| Edit::Repeat { at, length }),
    ]
}

fn edited(text: &str, edits: &[Edit]) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for edit in edits {
        match *edit {
            Edit::Delete { at, length } => {
                let at = at.min(bytes.len());
                let end = (at + length).min(bytes.len());
                bytes.drain(at..end);
            }
            Edit::Replace { at, by } => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte = by;
                }
            }
            Edit::Repeat { at, length } => {
                let at = at.min(bytes.len());
                let end = (at + length).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

proptest! {
    #![proptest_config(cases(1500))]

    #[test]
    fn a_careless_edit_never_panics(
        edits in prop::collection::vec(edit(), 1..5),
        long in any::<bool>(),
        color in any::<bool>(),
    ) {
        let text = edited(if long { EVERYTHING_ELSE } else { KEYWAY }, &edits);
        let reading = reading(&text);
        prop_assert_eq!(reading.problem.is_some(), reading.faults.is_empty());
        for fault in &reading.faults {
            let at = fault.at.unwrap();
            prop_assert!(reading.source.text.get(at.start..at.end).is_some(), "{:?}", fault);
        }
        problem::render(&reading.source, &reading.faults, color);
    }
}
