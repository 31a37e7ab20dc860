//! The same scene elsewhere, and in other units of length: the same answers, to rounding.

use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;

use crate::stability::{scenario, search, setup_beside};

/// A keyway with a bore target or a floor target; lengths in a unit, moved by whole metres.
struct Keyway {
    /// How many of them are a metre, and its name.
    unit: (f64, &'static str),
    /// m.
    shift: Vector3<f64>,
    target: &'static str,
    mesh: bool,
}

const HOME: Keyway = Keyway {
    unit: (1e3, "mm"),
    shift: Vector3::new(0.0, 0.0, 0.0),
    target: "floor",
    mesh: false,
};

impl Keyway {
    fn point(&self, [x, y, z]: [f64; 3]) -> String {
        let at = (Vector3::new(x, y, z) * 1e-3 + self.shift) * self.unit.0;
        format!("[{:?}, {:?}, {:?}]", at.x, at.y, at.z)
    }

    fn length(&self, millimetres: f64) -> String {
        format!("{:?} {}", millimetres * 1e-3 * self.unit.0, self.unit.1)
    }

    fn text(&self) -> String {
        let length = |millimetres: f64| self.length(millimetres);
        let (shape, place) = if self.mesh {
            ("mesh: hub.obj".to_owned(), String::new())
        } else {
            let shape = format!(
                "keyway: {{ bore: {}, width: {}, depth: {}, length: {} }}",
                length(30.0),
                length(8.0),
                length(3.3),
                length(40.0)
            );
            let at = self.point([0.0; 3]);
            (shape, format!(", place: {{ at: {at} }}"))
        };
        let (low, high, aim) = match self.target {
            "floor" => ([-3.0, 18.0, 15.0], [3.0, 19.0, 25.0], [0.0, 18.3, 20.0]),
            _ => ([-20.0, -20.0, 15.0], [-10.0, 5.0, 25.0], [-15.0, 0.0, 20.0]),
        };
        format!(
            "
format: 1
lengths_in: {}
scene:
  hub: {{ {shape}{place} }}
target: {{ surface: hub.{}, within: {{ min: {}, max: {} }}, aim: {}, along: [0, 0, 1] }}
shot: {{ radius: {}, density: 7000 kg/m3 }}
jet: {{ exit_diameter: {}, divergence: 4 deg, speed_spread: 5 % }}
nozzle: {{ body: [ {{ ball: {{ radius: {} }} }} ], clearance: 0 mm }}
contacts:
  damp: {{ mu_s: 0.15, mu_d: 0.135, restitution: 0.25 }}
settings:
  incidence: [30 deg, 85 deg]
  azimuth: [-90 deg, 90 deg]
  standoff: [{}, {}]
  speed: [5 m/s, 40 m/s]
goals:
  normal_impulse: {{ target: 40 uN.s, tolerance: 15 %, weight: 1 }}
  tangential_impulse: {{ limit: 8 uN.s, weight: 1 }}
  rebound: {{ allow: 10 uN.s, weight: 0.5 }}
  miss: {{ weight: 2 }}
tolerance: {{ incidence: 2 deg, azimuth: 2 deg }}
",
            self.unit.1,
            self.target,
            self.point(low),
            self.point(high),
            self.point(aim),
            length(0.5),
            length(1.5),
            length(3.0),
            length(6.0),
            length(20.0),
        )
    }

    fn scenario(&self) -> Scenario {
        if !self.mesh {
            return scenario(&self.text());
        }
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("hub.obj"), self.obj()).unwrap();
        setup_beside(folder.path(), &self.text(), Walls::Exact)
    }

    /// An open mesh, whose free side has to be found.
    fn obj(&self) -> String {
        let lip = (15.0_f64 * 15.0 - 16.0).sqrt();
        let start = lip.atan2(-4.0);
        let sweep = std::f64::consts::TAU - 2.0 * (start - std::f64::consts::FRAC_PI_2);
        let mut outline = vec![(4.0, lip), (4.0, 18.3), (-4.0, 18.3)];
        outline.extend((0..=120).map(|k| {
            let angle = start + sweep * f64::from(k) / 120.0;
            (15.0 * angle.cos(), 15.0 * angle.sin())
        }));
        let mut text = String::new();
        for (x, y) in &outline {
            for z in [0.0, 40.0] {
                let at = (Vector3::new(*x, *y, z) * 1e-3 + self.shift) * self.unit.0;
                writeln!(text, "v {:?} {:?} {:?}", at.x, at.y, at.z).unwrap();
            }
        }
        for k in 0..outline.len() - 1 {
            let group = ["wall_pos", "floor", "wall_neg", "bore"][k.min(3)];
            let [a, b, c, d] = [1, 2, 4, 3].map(|corner| 2 * k + corner);
            writeln!(text, "g {group}\nf {a} {b} {c} {d}").unwrap();
        }
        text
    }
}

fn choices() -> [Settings; 4] {
    [(60.0, 20.0), (82.0, 0.0), (45.0, -70.0), (70.0, 90.0)].map(
        |(incidence, azimuth): (f64, f64)| Settings {
            incidence: incidence.to_radians(),
            azimuth: azimuth.to_radians(),
            standoff: 9e-3,
            speed: 10.0,
            aim_along: 0.0,
            aim_across: 0.0,
            aim_above: 0.0,
            contact: 0,
            static_friction: 0.15,
        },
    )
}

/// What 4096 shots do from each pose, in one place and in another: as many hits, and terms that
/// agree to within `slack`, relative to the larger of each term and a thousandth.
fn agree(one: &Keyway, other: &Keyway, slack: f64) {
    let (one, other) = (one.scenario(), other.scenario());
    let (here, there) = (one.target.frame, other.target.frame);
    assert!((here.normal - there.normal).norm() < slack, "{there:?}");
    assert!((one.target.area / other.target.area - 1.0).abs() < slack);
    for settings in choices() {
        let tally = |scenario: &Scenario| {
            let samples = Samples::new(&scenario.problem, Stream::Search, 4096);
            Tally::trace(scenario, &settings, settings.speed, &samples.shots)
        };
        let (first, second) = (tally(&one), tally(&other));
        assert_eq!(first.hits.len(), second.hits.len());
        assert_eq!(first.rays, second.rays);
        let goals = &one.problem.goals;
        let (first, second) = (first.terms(goals, 10.0), second.terms(goals, 10.0));
        for (first, second) in [
            (first.normal_impulse, second.normal_impulse),
            (first.tangential_impulse, second.tangential_impulse),
            (first.rebound, second.rebound),
            (first.miss, second.miss),
        ] {
            let off = (first - second).abs() / first.max(1e-3);
            assert!(off < slack, "{first} {second}: {off}");
        }
    }
}

/// Coordinates are rounded to epsilon times the distance from the origin; against the radius of the
/// bore, 15 mm, that turns a normal, and each of up to five flights after it multiplies the error by
/// 1 + 2 L/R with a length L of up to 40 mm: six to the power of five in all.
fn rounding(distance: f64) -> f64 {
    6.0_f64.powi(5) * f64::EPSILON * (distance / 15e-3).max(1.0)
}

/// The farther out, the more places beside a face of the box count as in it: one hit of 4096 on the bore.
fn slack(target: &str, shift: &Vector3<f64>) -> f64 {
    let of_faces = if target == "bore" { 1e-3 } else { 0.0 };
    rounding(shift.norm()).max(of_faces)
}

const PLACES: [Vector3<f64>; 3] = [
    Vector3::new(1.0, 0.0, 0.0),
    Vector3::new(1.0, -2.0, 3.0),
    Vector3::new(-990.0, 990.0, 700.0),
];

#[test]
fn exact_walls_far_away_give_the_same_answers_to_rounding() {
    for target in ["floor", "bore"] {
        let home = Keyway { target, ..HOME };
        for shift in PLACES {
            let away = Keyway { shift, ..home };
            agree(&home, &away, slack(target, &shift));
        }
    }
}

#[test]
fn open_meshes_far_away_face_the_same_side_and_give_the_same_answers() {
    for target in ["floor", "bore"] {
        let home = Keyway {
            target,
            mesh: true,
            ..HOME
        };
        for shift in PLACES {
            agree(&home, &Keyway { shift, ..home }, slack(target, &shift));
        }
    }
}

#[test]
fn micrometres_and_metres_say_the_same_as_millimetres() {
    for mesh in [false, true] {
        let home = Keyway { mesh, ..HOME };
        for unit in [(1e6, "um"), (1.0, "m"), (1e2, "cm")] {
            agree(&home, &Keyway { unit, ..home }, rounding(0.04));
            let shift = PLACES[2];
            agree(
                &home,
                &Keyway {
                    unit,
                    shift,
                    ..home
                },
                rounding(shift.norm()),
            );
        }
    }
}

/// The search decides on differences that are far larger than rounding: it takes the same way.
#[test]
fn a_search_far_away_finds_the_same_settings() {
    let home = search(&HOME.scenario());
    let shift = PLACES[2];
    let away = search(&Keyway { shift, ..HOME }.scenario());
    let (home, away) = (&home.answers[0], &away.answers[0]);
    let off = |of: fn(&Settings) -> f64| (of(&home.settings) - of(&away.settings)).abs();
    assert!(off(|settings| settings.incidence) < 0.5_f64.to_radians());
    assert!(off(|settings| settings.standoff) < 0.5e-3);
    assert!(off(|settings| settings.speed) < 0.1);
    let total =
        |answer: &peenpose::solve::Answer| answer.evaluation.as_ref().unwrap().terms.total();
    assert!((total(home) / total(away) - 1.0).abs() < 5e-3);
    let exit = peenpose::jet::Pose::new(&HOME.scenario().target.frame, &home.settings).exit;
    assert!((exit - Point3::origin()).norm() < 0.05);
}
