//! Parts that move with the nozzle: against closed forms, and a deflector pin in a blind bore.

use std::path::Path;

use nalgebra::{Rotation3, Unit, Vector3};
use peenpose::control::Control;
use peenpose::feasibility::infeasibility;
use peenpose::jet::{Pose, Samples, ShotSample, Stream};
use peenpose::problem;
use peenpose::problem::equipment::{Body, Nozzle};
use peenpose::problem::setting::{Settings, Tolerance};
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::solve;
use peenpose::trace::{PathImpact, Tracer};

use crate::common::shipped;

/// A wall at z = 0, and a mirror at 45 deg on the nozzle, 10 mm in front of the exit, which turns
/// the jet to -x of the nozzle.
const MIRROR: &str = "
format: 1
lengths_in: mm
scene:
  wall:
    extrude:
      length: 1000 mm
      profile: [ { from: [500, 0], line_to: [-500, 0], surface: face } ]
    place: { at: [0, -500, 0], rotate: [-90 deg, 0 deg, 0 deg] }
  mirror:
    extrude:
      length: 10 mm
      profile: [ { from: [5, 0], line_to: [-5, 0], surface: face } ]
    place: { on: nozzle, at: [0, 5, 10], rotate: [90 deg, 45 deg, 0 deg] }
target: { surface: wall.face, aim: [0, 0, 0], along: [1, 0, 0] }
shot: { radius: 0.4 mm, density: 7800 kg/m3 }
jet: { exit_diameter: 2 mm, divergence: 5 deg }
contacts: { dry: { mu_s: 0.3, mu_d: 0.25, restitution: 0.5 } }
settings:
  incidence: 0 deg
  azimuth: 0 deg
  standoff: 10 mm
  speed: 20 m/s
  aim_above: 15 mm
goals: { normal_impulse: { target: 1 uN.s } }
surfaces:
  mirror.face: { role: deflector, contact: { mu_s: 0, mu_d: 0, restitution: 1 } }
";

fn mirror(shot_size: bool) -> Scenario {
    let reading = problem::read_text(MIRROR, Path::new("mirror.yaml")).unwrap();
    let mut problem = reading
        .problem
        .unwrap_or_else(|| panic!("{:?}", reading.faults));
    problem.paths.shot_size = shot_size;
    Scenario::new(problem, Walls::Exact).unwrap()
}

fn settings(incidence_deg: f64, azimuth_deg: f64) -> Settings {
    Settings {
        incidence: incidence_deg.to_radians(),
        azimuth: azimuth_deg.to_radians(),
        standoff: 10e-3,
        speed: 20.0,
        aim_along: 1e-3,
        aim_across: -2e-3,
        aim_above: 15e-3,
        contact: 0,
        static_friction: 0.3,
    }
}

fn first_impact(scenario: &Scenario, settings: &Settings, sample: &ShotSample) -> PathImpact {
    let mut first = None;
    Tracer::new(scenario, settings, settings.speed).follow(sample, |impact| {
        first.get_or_insert(*impact);
    });
    first.expect("it hits the wall")
}

#[test]
fn a_mirror_on_the_nozzle_turns_the_jet_wherever_the_nozzle_is() {
    for radius in [0.0, 0.4e-3] {
        let scenario = mirror(radius > 0.0);
        // A shot touches the mirror when its centre is a radius away.
        let reach = 10e-3 - radius * 2.0_f64.sqrt();
        for incidence in [0.0, 1.0, 20.0, 45.0, 60.0] {
            for azimuth in [0.0, 37.0, -120.0] {
                let settings = settings(incidence, azimuth);
                let pose = Pose::new(&scenario.target.frame, &settings);
                let turn = pose.exit + pose.direction * reach;
                // From there against x of the nozzle, to where the centre is a radius above z = 0.
                let flight = (turn.z - radius) / pose.up.z;
                let expected = turn - pose.up * flight - Vector3::z() * radius;
                let impact = first_impact(&scenario, &settings, &ShotSample::NONE);
                let what = format!("{incidence} deg, {azimuth} deg: {impact:?}");
                assert!((impact.point - expected).norm() < 1e-12, "{what}");
                let normal_speed = 20.0 * pose.up.z;
                let impulse = 1.5 * scenario.problem.shot.mass() * normal_speed;
                assert!(
                    (impact.normal_impulse / impulse - 1.0).abs() < 1e-12,
                    "{what}"
                );
            }
        }
    }
}

#[test]
fn along_the_wall_the_height_does_not_matter_but_for_the_flight() {
    let scenario = mirror(false);
    let impact = first_impact(&scenario, &settings(0.0, 0.0), &ShotSample::NONE);
    // The aim point is 1 mm along and -2 mm across; b = a x n = -y.
    assert!((impact.point.coords - Vector3::new(1e-3, 2e-3, 0.0)).norm() < 1e-12);
}

#[test]
fn turning_the_pose_turns_the_path() {
    for shot_size in [false, true] {
        let scenario = mirror(shot_size);
        let samples = Samples::new(&scenario.problem, Stream::Search, 200);
        let (start, turned) = (settings(10.0, 0.0), settings(10.0, 75.0));
        // The aim points differ by the turn as well.
        let turned = Settings {
            aim_along: 0.0,
            aim_across: 0.0,
            ..turned
        };
        let start = Settings {
            aim_along: 0.0,
            aim_across: 0.0,
            ..start
        };
        let axis = Unit::new_normalize(scenario.target.frame.normal);
        let across = scenario.target.frame.across;
        let along = scenario.target.frame.along;
        let angle = 75.0_f64.to_radians() * along.cross(&across).dot(&axis).signum();
        let turn = Rotation3::from_axis_angle(&axis, angle);
        for sample in &samples.shots {
            let before = first_impact(&scenario, &start, sample);
            let after = first_impact(&scenario, &turned, sample);
            assert!((turn * before.point - after.point).norm() < 1e-12);
            assert!((turn * before.velocity - after.velocity).norm() < 1e-9);
            assert!((turn * before.rolling - after.rolling).norm() < 1e-9);
        }
    }
}

#[test]
fn scenes_know_their_moving_parts() {
    let scenario = mirror(true);
    assert!(scenario.scene.moves_with_nozzle());
    // Distances are to what stands, and the mirror is in front of every exit.
    let nozzle = Nozzle {
        body: vec![Body::Ball { radius: 20e-3 }],
        clearance: 0.0,
    };
    let pose = Pose::new(&scenario.target.frame, &settings(0.0, 0.0));
    let scene = &scenario.scene;
    let nearest = scene.clearance(&nozzle, &pose.exit, &pose.direction, f64::INFINITY);
    let (gap, surface) = nearest.unwrap();
    assert!((gap + 5e-3).abs() < 1e-12, "{gap}");
    assert_eq!(scene.surfaces()[surface as usize], "wall.face");
    let mut problem = scenario.problem.clone();
    problem.target.surface = "mirror.face".into();
    let faults = Scenario::new(problem, Walls::Exact).err().unwrap();
    assert_eq!(faults[0].key, "target.surface");
    assert!(faults[0].message.contains("moves with the nozzle"));
}

/// Share of the shots whose first hit is on the target, with more than sin(45 deg) of their speed at
/// the exit against it.
fn useful_share(scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) -> f64 {
    let contact = scenario.problem.contacts[settings.contact].at(settings.static_friction);
    let restitution = contact.restitution.at(settings.speed);
    let full = (1.0 + restitution) * scenario.problem.shot.mass() * settings.speed;
    let tracer = Tracer::new(scenario, settings, settings.speed);
    let mut useful = 0;
    for sample in shots {
        let least = full * sample.speed * 45.0_f64.to_radians().sin();
        tracer.follow(sample, |impact| {
            let counts = impact.number == 1 && impact.on_target;
            useful += usize::from(counts && impact.normal_impulse > least);
        });
    }
    useful as f64 / shots.len() as f64
}

/// Poses all round the target and as far away as the mouth of the bore and beyond.
fn poses() -> impl Iterator<Item = Settings> {
    let steps = |from: f64, to: f64, count: u32| {
        (0..count).map(move |i| from + (to - from) * f64::from(i) / f64::from(count - 1))
    };
    let angles =
        steps(1.0, 90.0, 30).flat_map(move |i| steps(-90.0, 90.0, 13).map(move |a| (i, a)));
    let angles = angles.flat_map(move |a| steps(2e-3, 50e-3, 25).map(move |s| (a, s)));
    let aims = angles.flat_map(move |(a, s)| steps(-6e-3, 6e-3, 5).map(move |along| (a, s, along)));
    aims.flat_map(move |((incidence, azimuth), standoff, along)| {
        steps(0.0, 6e-3, 3).map(move |above| Settings {
            standoff,
            aim_along: along,
            aim_across: 0.0,
            aim_above: above,
            speed: 40.0,
            ..settings(incidence, azimuth)
        })
    })
}

#[test]
fn without_the_pin_no_pose_reaches_the_wall_steeply() {
    let with_pin = shipped::scenario("deflector.yaml");
    let mut problem = with_pin.problem.clone();
    problem.tolerance = Tolerance::default();
    problem.parts.retain(|part| !part.on_nozzle);
    problem
        .surfaces
        .retain(|rule| !rule.surface.starts_with("pin."));
    // The lance alone, as near to the walls as can be.
    problem.nozzle.body.truncate(1);
    problem.nozzle.clearance = 0.0;
    let scenario = Scenario::new(problem, Walls::Exact).unwrap();
    let samples = Samples::new(&scenario.problem, Stream::Search, 64);
    let (mut fitting, mut best, mut with) = (0, 0.0_f64, None);
    for settings in poses() {
        // Round the bore is solid metal, of which the scene has the wall only.
        let exit = Pose::new(&scenario.target.frame, &settings).exit;
        let in_bore = exit.x.hypot(exit.y) < 6e-3;
        if in_bore && infeasibility(&scenario, &settings).is_none() {
            fitting += 1;
            let share = useful_share(&scenario, &settings, &samples.shots);
            if share > best {
                (best, with) = (share, Some(settings));
            }
        }
    }
    assert!(fitting > 1000, "{fitting}");
    assert!(best < 0.01, "{best} with {with:?}");

    let answer = &solve(&with_pin, &Control::default()).answers[0];
    assert!(answer.passes());
    let mut exact = with_pin.clone();
    exact.problem.tolerance = Tolerance::default();
    let samples = Samples::new(&exact.problem, Stream::Search, 4096);
    let share = useful_share(&exact, &answer.settings, &samples.shots);
    assert!(share > 0.98, "{share}");
}
