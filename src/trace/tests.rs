//! Packets take the paths that are followed one by one, to the last bit.

use std::path::Path;

use nalgebra::Vector3;

use super::*;
use crate::impact::{Law, rebound};
use crate::jet::{Samples, Stream};
use crate::problem;
use crate::scene::Walls;
use crate::scene::ray::HitId;
use crate::triple::unit;

impl Tracer<'_> {
    /// The oracle: one shot after the other, on nalgebra's vectors, with the tested impact of one shot.
    fn one_by_one(&self, sample: &ShotSample, mut report: impl FnMut(&PathImpact)) -> (End, usize) {
        let scenario = self.scenario;
        let limits = scenario.problem.paths;
        let mass = self.mass * sample.mass();
        let radius = self.radius * sample.size;
        let nozzle_frame = self.moves_parts.then(|| self.nozzle_frame(sample));
        let mut ray = self.launch(sample);
        let mut velocity = ray.direction * (self.speed * sample.speed);
        let mut rolling = Vector3::zeros();
        let mut leaving: Option<HitId> = None;
        let least_energy = limits.least_energy * energy(velocity.into(), rolling.into());
        let (mut number, mut deflections, mut rays) = (0, 0, 0);
        loop {
            rays += 1;
            let met = scenario
                .scene
                .first_contact(&ray, radius, leaving, nozzle_frame.as_ref());
            let Some(hit) = met else {
                return (End::Left, rays);
            };
            let centre = hit.point + hit.normal * radius;
            let surface = &scenario.surfaces[hit.surface as usize];
            let contact = self.contact_with(hit.surface as usize, sample);
            let normal = if surface.roughness > 0.0 {
                let tilt = rough::tilt(sample, rays as u32, surface.roughness);
                rough_normal(&contact, &velocity, &rolling, &hit.normal, tilt)
            } else {
                hit.normal
            };
            let Some(after) = rebound(&contact, &velocity, &rolling, &normal) else {
                return (End::Left, rays);
            };
            (velocity, rolling) = (after.velocity, after.rolling);
            if surface.deflector {
                deflections += 1;
            } else {
                number += 1;
            }
            report(&PathImpact {
                number: if surface.deflector { 0 } else { number },
                surface: hit.surface,
                on_target: scenario.target.holds(&hit),
                normal_impulse: mass * after.normal,
                tangential_impulse: mass * after.tangential,
                regime: after.regime,
                point: hit.point,
                normal: hit.normal,
                centre,
                velocity,
                rolling,
            });
            if after.departure == 0.0 {
                return (End::Stays, rays);
            }
            if energy(velocity.into(), rolling.into()) < least_energy {
                return (End::Spent, rays);
            }
            if number == limits.impacts || deflections == MOST_DEFLECTIONS {
                return (End::Limit, rays);
            }
            if !limits.spin {
                rolling = Vector3::zeros();
            }
            ray = Ray {
                origin: centre,
                direction: unit(velocity.into()).into(),
            };
            leaving = Some(hit.hit_id);
        }
    }
}

/// The normal that a shot finds where a surface is rough.
fn rough_normal(
    contact: &Contact,
    velocity: &Vector3<f64>,
    rolling: &Vector3<f64>,
    normal: &Vector3<f64>,
    tilt: [f64; 2],
) -> Vector3<f64> {
    let departure = |normal: Triple| {
        let after = rebound(contact, velocity, rolling, &normal.into());
        after.map_or([0.0; 3], |after| after.velocity.into())
    };
    let (normal, velocity) = ((*normal).into(), (*velocity).into());
    rough::normal_of_impact(normal, tilt, velocity, departure).into()
}

/// As points and with the size that they have.
fn same_paths(scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) {
    for shot_size in [false, true] {
        let mut scenario = scenario.clone();
        scenario.problem.paths.shot_size = shot_size;
        same_paths_in(&scenario, settings, shots);
    }
}

fn same_paths_in(scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) {
    let tracer = Tracer::new(scenario, settings, settings.speed);
    let paths = tracer.paths(shots);
    assert_eq!(paths.len(), shots.len());
    for (sample, path) in shots.iter().zip(paths) {
        let mut impacts = Vec::new();
        let (end, rays) = tracer.one_by_one(sample, |impact| impacts.push(*impact));
        let followed = super::Path { impacts, end, rays };
        assert_eq!(path, followed, "{settings:?} {sample:?}");
        let alone = tracer.path_from(tracer.launch(sample), sample);
        assert_eq!(alone, followed, "{settings:?} {sample:?}");
    }
}

/// Poses all over the settings of a problem, with every contact.
fn poses(scenario: &Scenario, count: u32) -> impl Iterator<Item = Settings> + '_ {
    let ranges = &scenario.problem.ranges;
    (0..count).map(move |index| {
        let share = |axis| f64::from(sobol_burley::sample(index, axis, 5));
        Settings {
            incidence: ranges.incidence.at(share(0)),
            azimuth: ranges.azimuth.at(share(1)),
            standoff: ranges.standoff.at(share(2)),
            speed: ranges.speed.at(share(3)),
            aim_along: 0.0,
            aim_across: 0.0,
            aim_above: 0.0,
            contact: ranges.contact[index as usize % ranges.contact.len()],
            static_friction: 0.2,
        }
    })
}

fn shipped(file: &str, walls: Walls) -> Scenario {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    let reading = problem::read(&folder.join(file)).expect("it can be read");
    let problem = reading.problem.expect("it has no faults");
    Scenario::new(problem, walls).expect("its scene has no faults")
}

#[test]
fn shipped_problems() {
    let facets = Walls::TriangleMesh { chord_angle: 0.05 };
    for (file, walls) in [
        ("keyway.yaml", Walls::Exact),
        ("keyway.yaml", facets),
        ("keyway-long.yaml", Walls::Exact),
        ("keyway-blind.yaml", Walls::Exact),
        ("plate.yaml", Walls::Exact),
    ] {
        let scenario = shipped(file, walls);
        let samples = Samples::with_boundary(&scenario.problem, Stream::Search, 300);
        for settings in poses(&scenario, 12) {
            same_paths(&scenario, &settings, &samples.shots);
        }
    }
}

#[test]
fn laws_and_contacts_of_all_kinds() {
    let mut scenario = shipped("keyway.yaml", Walls::Exact);
    let samples = Samples::new(&scenario.problem, Stream::Search, 200);
    for law in Law::ALL {
        for contact in &mut scenario.problem.contacts {
            contact.contact.law = law;
            contact.contact.tangential_restitution = 0.3;
        }
        for settings in poses(&scenario, 6) {
            same_paths(&scenario, &settings, &samples.shots);
        }
    }
    for contact in &mut scenario.problem.contacts {
        contact.contact.restitution = Restitution::Falling {
            reference: 0.5,
            speed: 3.0,
            exponent: 0.25,
        };
    }
    for settings in poses(&scenario, 6) {
        same_paths(&scenario, &settings, &samples.shots);
    }
}

#[test]
fn surfaces_that_differ() {
    let mut scenario = shipped("keyway-long.yaml", Walls::Exact);
    let samples = Samples::new(&scenario.problem, Stream::Search, 200);
    let contact = Contact::new(0.8, 0.7, 0.9).expect("a legal contact");
    scenario.surfaces[3].contact = Some(contact);
    for settings in poses(&scenario, 6) {
        same_paths(&scenario, &settings, &samples.shots);
    }
    scenario.surfaces[3].deflector = true;
    scenario.surfaces[1].contact = Some(Contact {
        restitution: Restitution::Constant(0.0),
        ..contact
    });
    for settings in poses(&scenario, 6) {
        same_paths(&scenario, &settings, &samples.shots);
    }
}

/// A pot with a pin in it, moved, beside a block; any further parts and groups of keys.
fn pot(parts: &str, groups: &str) -> Scenario {
    let text = format!(
        "
format: 1
lengths_in: mm
scene:
  pot:
    bore: {{ diameter: 20 mm, length: 30 mm, ends: {{ far: closed }} }}
    place: {{ at: [5, -3, 7], rotate: [40 deg, 20 deg, 70 deg] }}
  pin:
    bore: {{ diameter: 3 mm, length: 12 mm, ends: {{ near: closed, far: closed }} }}
    place: {{ at: [5, -3, 7], rotate: [30 deg, 20 deg, 70 deg] }}
  block: {{ box: {{ min: [20, 20, 20], max: [40, 40, 40] }} }}
{parts}
target: {{ surface: pot.far }}
shot: {{ radius: 0.2 mm, density: 7800 kg/m3, size_spread: 5 % }}
jet: {{ exit_diameter: 3 mm, divergence: 20 deg, speed_spread: 5 % }}
contacts: {{ dry: {{ mu_s: 0.3, mu_d: 0.25, restitution: 0.6 }} }}
settings:
  incidence: [30 deg, 85 deg]
  azimuth: [-180 deg, 180 deg]
  standoff: [3 mm, 15 mm]
  speed: [5 m/s, 40 m/s]
goals: {{ normal_impulse: {{ target: 1 uN.s }}, rebound: {{ allow: 1 uN.s }} }}
paths: {{ impacts: 12, least_energy: 0.01 % }}
{groups}
"
    );
    let reading = problem::read_text(&text, Path::new("pot.yaml")).expect("it can be read");
    let problem = reading
        .problem
        .unwrap_or_else(|| panic!("{:?}", reading.faults));
    let scenario = Scenario::new(problem, Walls::Exact);
    scenario.unwrap_or_else(|faults| panic!("{faults:?}"))
}

#[test]
fn parts_that_are_moved_and_closed() {
    let scenario = pot("", "");
    let samples = Samples::new(&scenario.problem, Stream::Search, 300);
    for settings in poses(&scenario, 40) {
        same_paths(&scenario, &settings, &samples.shots);
    }
}

/// How many of the impacts of some shots are on the surfaces of a part.
fn impacts_on(part: &str, scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) -> usize {
    let tracer = Tracer::new(scenario, settings, settings.speed);
    let mut count = 0;
    for sample in shots {
        tracer.follow(sample, |impact| {
            let surface = &scenario.scene.surfaces()[impact.surface as usize];
            count += usize::from(surface.starts_with(part));
        });
    }
    count
}

#[test]
fn parts_that_move_with_the_nozzle() {
    let parts = "
  stub:
    bore: { diameter: 2 mm, length: 3 mm, ends: closed }
    place: { on: nozzle, at: [-0.5, 1.5, 2], rotate: [50 deg, 20 deg, 0 deg] }
  brick: { box: { min: [-1.5, -1, 1.5], max: [0.2, 0.5, 3] }, place: nozzle }
";
    let tolerance = "
tolerance: { incidence: 2 deg, azimuth: 3 deg, standoff: 1 mm, aim_along: 0.5 mm, aim_above: 0.3 mm }
";
    for groups in ["", tolerance] {
        let scenario = pot(parts, groups);
        let samples = Samples::with_boundary(&scenario.problem, Stream::Search, 300);
        let (mut on_stub, mut on_brick) = (0, 0);
        for settings in poses(&scenario, 20) {
            same_paths(&scenario, &settings, &samples.shots);
            on_stub += impacts_on("stub.", &scenario, &settings, &samples.shots);
            on_brick += impacts_on("brick.", &scenario, &settings, &samples.shots);
        }
        assert!(on_stub > 500 && on_brick > 500, "{on_stub} {on_brick}");
    }
}

#[test]
fn rough_surfaces() {
    let of_one_contact = pot("", "surfaces: { pot.wall: { roughness: 15 deg } }");
    let samples = Samples::new(&of_one_contact.problem, Stream::Search, 100);
    for settings in poses(&of_one_contact, 10) {
        same_paths(&of_one_contact, &settings, &samples.shots);
    }
    let rough = "
surfaces:
  pot.far: { roughness: 3 deg }
  pot.wall: { roughness: 15 deg, contact: { mu_s: 0.1, mu_d: 0.1, restitution: { value: 0.5, at: 5 m/s, exponent: 0.2 } } }
";
    let (scenario, smooth) = (pot("", rough), pot("", ""));
    let samples = Samples::new(&scenario.problem, Stream::Search, 300);
    for settings in poses(&scenario, 20) {
        same_paths(&scenario, &settings, &samples.shots);
    }
    // Without rough surfaces nothing is drawn for them, and every other number is the same.
    let drawn = Samples::new(&smooth.problem, Stream::Search, 300);
    for (rough, smooth) in samples.shots.iter().zip(&drawn.shots) {
        assert_eq!(smooth.tilts, 0.0);
        assert_eq!(
            *smooth,
            ShotSample {
                tilts: 0.0,
                ..*rough
            }
        );
    }
}

#[test]
fn energy_of_a_rolling_sphere() {
    // 1/2 v^2 and 1/5 (R w)^2, per unit mass.
    assert_eq!(energy([1.0, 2.0, 2.0], [0.0; 3]), 4.5);
    assert!((energy([0.0; 3], [1.0, 2.0, 2.0]) - 1.8_f64).abs() < 1e-15);
    assert!((energy([3.0, 0.0, 0.0], [0.0, 2.0, 0.0]) - 5.3_f64).abs() < 1e-15);
}

#[test]
fn deviates_change_restitution_and_friction_of_a_contact() {
    let contact = Contact::new(0.3, 0.24, 0.5).unwrap();
    assert_eq!(perturbed(contact, &ShotSample::NONE), contact);
    let rougher = ShotSample {
        friction: 1.5,
        ..ShotSample::NONE
    };
    let met = perturbed(contact, &rougher);
    assert_eq!(met.static_friction, 0.3 * 1.5);
    assert_eq!(met.dynamic_friction, 0.24 * 1.5);
    assert_eq!(met.restitution, contact.restitution);
    let livelier = ShotSample {
        restitution: 0.1,
        ..ShotSample::NONE
    };
    let met = perturbed(contact, &livelier);
    assert_eq!(met.restitution, contact.restitution.shifted(0.1));
    assert_ne!(met.restitution, contact.restitution);
    assert_eq!(met.static_friction, 0.3);
    assert_eq!(met.dynamic_friction, 0.24);
}

#[test]
fn friction_that_scatters() {
    let scenario = pot("", "tolerance: { restitution: 0.1, friction: 30 % }");
    let samples = Samples::new(&scenario.problem, Stream::Search, 100);
    for settings in poses(&scenario, 10) {
        same_paths(&scenario, &settings, &samples.shots);
    }
}

/// In a cage of lossless deflectors nothing else would ever end a path.
#[test]
fn deflections_end_a_path_when_they_are_very_many() {
    let cage = "
  cage:
    bore: { diameter: 300 mm, length: 300 mm, ends: closed }
    place: { at: [0, 0, -150] }
";
    let mut scenario = pot(cage, "");
    for limits in &mut scenario.surfaces {
        limits.deflector = true;
        limits.contact = Some(Contact::new(0.0, 0.0, 1.0).expect("a legal contact"));
    }
    let samples = Samples::new(&scenario.problem, Stream::Search, 20);
    for settings in poses(&scenario, 5) {
        same_paths(&scenario, &settings, &samples.shots);
        let tracer = Tracer::new(&scenario, &settings, settings.speed);
        for sample in &samples.shots {
            let end = tracer.follow(sample, |_| ());
            assert_eq!(end, (End::Limit, MOST_DEFLECTIONS as usize));
        }
    }
}
