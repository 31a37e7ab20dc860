//! Shot and contacts out of the library: what they are, and how they go together with keys of the file.

use std::path::Path;

use nalgebra::Vector3;
use peenpose::impact::{Contact, Motion, Restitution, Sphere, impact};
use peenpose::problem::media::{self, Origin};
use peenpose::problem::{self, Problem};

const REST: &str = "
format: 1
lengths_in: mm
scene: { plate: { box: { min: [-50, -50, -10], max: [50, 50, 0] } } }
target: { surface: plate.z_max }
jet: { exit_diameter: 0 mm, divergence: 0 deg }
settings: { incidence: 60 deg, azimuth: 0 deg, standoff: 10 mm, speed: 10 m/s }
goals: { normal_impulse: { target: 40 uN.s } }
";
const SHOT: &str = "shot: { radius: 0.5 mm, density: 7000 kg/m3 }\n";
const DRY: &str = "contacts: { dry: { mu_s: 0.3, mu_d: 0.27, restitution: 0.25 } }\n";

fn read(more: &[&str]) -> Problem {
    let text = format!("{REST}{}", more.concat());
    let reading = problem::read_text(&text, Path::new("test.yaml")).unwrap();
    let faults = problem::render(&reading.source, &reading.faults, false);
    reading.problem.unwrap_or_else(|| panic!("{faults}"))
}

#[test]
fn names_are_sizes() {
    let inch = 0.0254;
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
    for medium in media::media() {
        let digits: String = medium.name.chars().filter(char::is_ascii_digit).collect();
        let number: f64 = digits.parse().unwrap();
        let letters = medium.name.trim_end_matches(char::is_numeric);
        let diameter = medium.diameter.value;
        let expected = match letters {
            "S" => number * 1e-4 * inch,
            "CW-" => number * 1e-3 * inch,
            "GB-" => number * 1e-5,
            "Z" => {
                assert!(diameter > number * 1e-6 && diameter < 1.5 * number * 1e-6);
                diameter
            }
            other => panic!("{other}"),
        };
        assert!(near(diameter, expected), "{}", medium.name);
        assert!((2000.0..9000.0).contains(&medium.density.value));
    }
}

#[test]
fn names_are_given_once_and_every_number_has_a_source() {
    let mut names: Vec<&str> = media::media().iter().map(|medium| medium.name).collect();
    names.extend(media::contacts().iter().map(|contact| contact.name));
    let all = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), all);

    let shot = media::media()
        .iter()
        .flat_map(|medium| [medium.diameter, medium.density]);
    let contacts = media::contacts().iter().flat_map(|contact| {
        [
            contact.static_friction,
            contact.dynamic_friction,
            contact.restitution,
            contact.restitution_speed,
            contact.restitution_exponent,
        ]
    });
    for number in shot.chain(contacts) {
        let (Origin::Published(source) | Origin::Assumed(source)) = number.source;
        assert!(source.len() > 10, "{source}");
        assert_eq!(
            number.source.to_string().starts_with("assumed"),
            number.source.is_assumed()
        );
    }
}

#[test]
fn a_medium_stands_in_for_the_numbers_that_are_not_given() {
    let s110 = media::medium("S110").unwrap();
    let shot = read(&["shot: { use: S110 }\n", DRY]).shot;
    assert_eq!(
        (2.0 * shot.radius, shot.density),
        (s110.diameter.value, s110.density.value)
    );
    assert_eq!(shot.medium, Some(s110));

    let shot = read(&[
        "shot: { use: S110, radius: 0.2 mm, size_spread: 5 % }\n",
        DRY,
    ])
    .shot;
    assert_eq!(
        (shot.radius, shot.density, shot.size_spread),
        (0.0002, 7800.0, 0.05)
    );
    assert_eq!(read(&[SHOT, DRY]).shot.medium, None);
}

#[test]
fn contacts_of_the_library_stand_beside_those_of_the_file() {
    let known = media::contact("steel-on-steel-oiled").unwrap();
    let problem = read(&[
        SHOT,
        "contacts:\n  dry: { mu_s: 0.3, mu_d: 0.27, restitution: 0.25 }\n",
        "  use: [steel-on-steel-oiled, steel-on-steel-dry]\n",
        "  steel-on-steel-dry: { mu_s: 0.5, mu_d: 0.4, restitution: 0.1 }\n",
        "  mine: { use: steel-on-steel-oiled, restitution: 0.5 }\n",
        "  tuned: { use: steel-on-steel-oiled, mu_s: [0.1, 0.2], mu_d_ratio: 0.9 }\n",
    ]);
    let names: Vec<&str> = problem
        .contacts
        .iter()
        .map(|settings| settings.name.as_str())
        .collect();
    // What the file gives under the same name goes before the library's.
    assert_eq!(
        names,
        [
            "dry",
            "steel-on-steel-oiled",
            "steel-on-steel-dry",
            "mine",
            "tuned"
        ]
    );
    let friction = |index: usize| {
        let contact = problem.contacts[index].contact;
        (contact.static_friction, contact.dynamic_friction)
    };
    assert_eq!(
        friction(1),
        (known.static_friction.value, known.dynamic_friction.value)
    );
    assert_eq!(friction(2), (0.5, 0.4));
    assert_eq!(friction(3), friction(1));
    assert_eq!(problem.contacts[1].library, Some(known));
    assert_eq!(problem.contacts[2].library, None);
    assert_eq!(problem.contacts[4].dynamic_ratio, Some(0.9));
    assert_eq!(problem.ranges.contact, [0, 1, 2, 3, 4]);
}

/// Restitution was measured on slow impacts; shot arrives ten times as fast.
#[test]
fn restitution_of_the_library_falls_with_speed() {
    let one = media::contact("steel-on-steel-dry").unwrap();
    let falling = Restitution::Falling {
        reference: 0.71,
        speed: 4.43,
        exponent: 0.25,
    };
    assert_eq!(one.restitution_law(), falling);
    for known in media::contacts() {
        let named = read(&[SHOT, &format!("contacts: {{ use: {} }}\n", known.name)]);
        assert_eq!(
            named.contacts[0].contact.restitution,
            known.restitution_law()
        );
        // Slower than it was measured it is not said to be higher than 1, faster it is lower.
        let at = |speed: f64| known.restitution_law().at(speed);
        assert_eq!(at(known.restitution_speed.value), known.restitution.value);
        assert!(at(50.0) < 0.6 && at(1e-3) <= 1.0, "{}", known.name);
    }
    let under_a_name = read(&[
        SHOT,
        "contacts: { mine: { use: steel-on-steel-dry, mu_d: 0.1 } }\n",
    ]);
    assert_eq!(under_a_name.contacts[0].contact.restitution, falling);
    let constant = read(&[
        SHOT,
        "contacts: { mine: { use: steel-on-steel-dry, restitution: 0.5 } }\n",
    ]);
    assert_eq!(
        constant.contacts[0].contact.restitution,
        Restitution::Constant(0.5)
    );

    // S110 at 50 m/s and 45 deg arrives at 35.4 m/s along the normal, with 0.422 instead of 0.71. It grips, and keeps
    // 5/7 of its speed along the surface.
    let s110 = media::medium("S110").unwrap();
    let sphere = Sphere {
        radius: s110.diameter.value / 2.0,
        density: s110.density.value,
    };
    let contact = read(&[SHOT, "contacts: { use: steel-on-steel-dry }\n"]).contacts[0].contact;
    let held = Contact {
        restitution: Restitution::Constant(0.71),
        ..contact
    };
    for (contact, impulse, angle) in [(contact, 4.480, 30.60), (held, 5.386, 44.83)] {
        let s = 50.0 * 0.5_f64.sqrt();
        let motion = Motion {
            velocity: Vector3::new(s, 0.0, -s),
            spin: Vector3::zeros(),
        };
        let found = impact(&contact, &sphere, &motion, &Vector3::z()).unwrap();
        let after = found.after.velocity;
        let rebound = after.z.atan2(after.x).to_degrees();
        assert!(
            (found.normal_impulse * 1e6 - impulse).abs() < 0.005,
            "{}",
            found.normal_impulse
        );
        assert!((rebound - angle).abs() < 0.05, "{rebound}");
    }
}

#[test]
fn a_single_name_and_a_contact_called_use() {
    let problem = read(&[SHOT, "contacts: { use: steel-on-steel-dry }\n"]);
    assert_eq!(problem.contacts[0].name, "steel-on-steel-dry");
    let own = "contacts: { use: { mu_s: 0.3, mu_d: 0.27, restitution: 0.25 } }\n";
    let problem = read(&[SHOT, own]);
    assert_eq!(problem.contacts[0].name, "use");
    assert_eq!(problem.contacts[0].library, None);
}

mod sheets {
    use std::path::Path;

    use peenpose::control::Control;
    use peenpose::problem;
    use peenpose::record::{Record, RunInfo, WorkRecord};
    use peenpose::report::sheet;
    use peenpose::scenario::Scenario;
    use peenpose::scene::Walls;
    use peenpose::solve::{passing_windows, solve};
    use peenpose::unknowns::Unknowns;

    use super::{REST, SHOT};

    fn record(more: &[&str]) -> Record {
        let text = format!("{REST}{}", more.concat());
        let reading = problem::read_text(&text, Path::new("test.yaml")).unwrap();
        let scenario = Scenario::new(reading.problem.unwrap(), Walls::Exact).unwrap();
        let solution = solve(
            &scenario,
            &Control {
                most_shots: 64,
                validation_shots: 64,
                ..Control::default()
            },
        );
        let run = RunInfo {
            segments: &[],
            ablations: &solution.ablations,
            source: &reading.source,
            status: solution.status.into(),
            spread: None,
            command: "peenpose solve test.yaml".into(),
            work: WorkRecord {
                poses: 1,
                shots_per_pose: 1,
                rays: 1,
                seconds: 0.0,
            },
        };
        let windows = passing_windows(
            &scenario,
            &solution.answers[0],
            &peenpose::control::Cancel::default(),
        );
        let unknowns = Unknowns::of(&scenario, &solution.answers[0].settings);
        Record::new(
            &scenario,
            &solution.answers,
            &windows,
            Vec::new(),
            unknowns,
            run,
        )
        .unwrap()
    }

    #[test]
    fn sheet_and_result_say_what_is_published_and_what_is_assumed() {
        let record = record(&[
            "shot: { use: Z300 }\n",
            "contacts: { use: glass-on-metal-dry }\n",
        ]);
        assert_eq!(
            Record::from_json(&record.to_json().unwrap()).unwrap(),
            record
        );
        let medium = record.problem.medium.as_ref().unwrap();
        assert!(
            medium.diameter.as_ref().unwrap().assumed && !medium.density.as_ref().unwrap().assumed
        );
        let sheet = sheet(&record);
        for line in [
            "\n  shot       Z300, 0.3625 mm diameter, 3760 kg/m3",
            "\n  library    density of Z300; mu_s of glass-on-metal-dry",
            "\n  assumed    diameter of Z300; mu_d, restitution, exponent of restitution of\n             glass-on-metal-dry",
            "restitution 0.71 at 4.43 m/s, falling with exponent 0.25",
        ] {
            let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(words(&sheet).contains(&words(line)), "{line}\n{sheet}");
        }
    }

    #[test]
    fn numbers_of_the_file_are_not_said_to_be_the_librarys() {
        let own = "contacts: { dry: { use: glass-on-metal-dry, mu_d: 0.5, restitution: 0.4 } }\n";
        let known = &record(&[SHOT, own]).problem.library_contacts[0];
        assert_eq!(
            (known.contact.as_str(), known.library.as_str()),
            ("dry", "glass-on-metal-dry")
        );
        assert!(known.mu_s.is_some() && known.mu_d.is_none() && known.restitution.is_none());

        let plain = record(&[SHOT, super::DRY]);
        let json = plain.to_json().unwrap();
        assert!(
            !json.contains("\"medium\"") && !json.contains("library"),
            "{json}"
        );
        assert!(!sheet(&plain).contains("library"));
    }
}
