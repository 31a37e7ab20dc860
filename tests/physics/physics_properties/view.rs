//! Views of the same world from elsewhere, in other units, at another scale, in a mirror, under other
//! names.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use nalgebra::{Point3, UnitQuaternion, Vector3};
use peenpose::jet::ShotSample;
use peenpose::problem;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::trace::{PathImpact, Tracer};
use tempfile::TempDir;

use crate::common::held::held;
use crate::physics_properties::world::World;

/// How a world is written down.
#[derive(Clone, Debug)]
pub struct View {
    /// How many of them are a metre, and its name.
    pub unit: (f64, &'static str),
    /// Factors on lengths, densities and speeds.
    pub length: f64,
    pub density: f64,
    pub speed: f64,
    /// Angles about fixed x, then y, then z, degrees.
    pub turn: [f64; 3],
    /// m.
    pub shift: Vector3<f64>,
    /// What all names begin with.
    pub prefix: &'static str,
    /// Whether parts, rules of surfaces, contacts and sections come in the opposite order.
    pub backwards: bool,
}

pub const PLAIN: View = View {
    unit: (1e3, "mm"),
    length: 1.0,
    density: 1.0,
    speed: 1.0,
    turn: [0.0; 3],
    shift: Vector3::new(0.0, 0.0, 0.0),
    prefix: "",
    backwards: false,
};

impl View {
    pub fn rotation(&self) -> UnitQuaternion<f64> {
        let [x, y, z] = self.turn.map(f64::to_radians);
        UnitQuaternion::from_euler_angles(x, y, z)
    }

    /// Where a point of the plain view is, m.
    pub fn there(&self, point: &Point3<f64>) -> Point3<f64> {
        self.rotation() * (point * self.length) + self.shift
    }

    /// The factor on impulses.
    pub fn impulse(&self) -> f64 {
        self.length.powi(3) * self.density * self.speed
    }

    fn list(&self, [x, y, z]: [f64; 3]) -> String {
        let unit = self.unit.0;
        format!("[{:?}, {:?}, {:?}]", x * unit, y * unit, z * unit)
    }

    /// A point of the plain view, mm.
    fn point(&self, [x, y, z]: [f64; 3]) -> String {
        let there = self.there(&Point3::new(x * 1e-3, y * 1e-3, z * 1e-3));
        self.list(there.coords.into())
    }

    fn metres(&self, millimetres: f64) -> f64 {
        millimetres * 1e-3 * self.length
    }

    fn size(&self, millimetres: f64) -> String {
        let length = self.metres(millimetres) * self.unit.0;
        format!("{length:?} {}", self.unit.1)
    }

    fn place(&self, at: [f64; 3]) -> String {
        let [x, y, z] = self.turn;
        let at = self.point(at);
        format!("place: {{ at: {at}, rotate: [{x:?} deg, {y:?} deg, {z:?} deg] }}")
    }

    fn contact(&self, [static_friction, ratio, restitution, exponent]: [f64; 4]) -> String {
        let restitution = if exponent > 0.0 {
            let at = 10.0 * self.speed;
            format!("{{ value: {restitution:?}, at: {at:?} m/s, exponent: {exponent:?} }}")
        } else {
            format!("{restitution:?}")
        };
        let dynamic = static_friction * ratio;
        format!("{{ mu_s: {static_friction:?}, mu_d: {dynamic:?}, restitution: {restitution} }}")
    }

    /// Lines under a heading.
    fn section(&self, heading: &str, mut lines: Vec<String>) -> String {
        if self.backwards {
            lines.reverse();
        }
        let mut text = format!("{heading}:\n");
        lines
            .iter()
            .for_each(|line| writeln!(text, "  {line}").unwrap());
        text
    }

    fn parts(&self, world: &World) -> String {
        let prefix = self.prefix;
        let flat = |x: f64, y: f64| {
            let unit = self.unit.0;
            format!("[{:?}, {:?}]", self.metres(x) * unit, self.metres(y) * unit)
        };
        let (World { mouth, foot, .. }, depth) = (world, world.depth);
        let slot = format!(
            "{prefix}slot: {{ {}, extrude: {{ length: {}, profile: [ \
             {{ from: {}, line_to: {}, surface: {prefix}left }}, \
             {{ arc_to: {}, via: {}, surface: {prefix}floor }}, \
             {{ line_to: {}, surface: {prefix}right }} ] }} }}",
            self.place([0.0, 0.0, -15.0]),
            self.size(30.0),
            flat(-mouth[0], depth),
            flat(-foot[0], 0.0),
            flat(foot[1], 0.0),
            flat(0.0, -world.sag),
            flat(mouth[1], depth),
        );
        let [x, y, diameter] = world.pin;
        let pin = format!(
            "{prefix}pin: {{ {}, bore: {{ diameter: {}, length: {}, ends: closed }} }}",
            self.place([x, y, -11.0]),
            self.size(diameter),
            self.size(22.0),
        );
        let (low, high) = ([-6.0, depth + 4.0, -15.0], [6.0, depth + 5.0, 15.0]);
        let corner = |corner: [f64; 3]| self.list(corner.map(|x| self.metres(x)));
        let lid = format!(
            "{prefix}lid: {{ {}, box: {{ min: {}, max: {} }} }}",
            self.place([0.0; 3]),
            corner(low),
            corner(high),
        );
        let mut parts = vec![slot, pin, lid];
        if world.bumps.is_some() {
            // One is turned by the file that says where it stands, the other one in its own file.
            let place = self.place([0.0; 3]);
            parts[0] = format!("{prefix}slot: {{ {place}, mesh: slot.obj }}");
            parts[1] = format!("{prefix}pin: {{ mesh: pin.obj }}");
        }
        self.section("scene", parts)
    }

    fn rules(&self, world: &World) -> String {
        let prefix = self.prefix;
        let allow = 1e-6 * self.impulse();
        let walls = ["left", "right"].into_iter().zip(world.is_weak);
        let weak = walls.filter(|(_, is_weak)| *is_weak);
        let mut rules: Vec<String> = weak
            .map(|(wall, _)| format!("{prefix}slot.{prefix}{wall}: {{ allow: {allow:?} N.s }}"))
            .collect();
        rules.push(format!(
            "{prefix}pin.wall: {{ contact: {} }}",
            self.contact(world.hard)
        ));
        self.section("surfaces", rules)
    }

    fn text(&self, world: &World) -> String {
        let prefix = self.prefix;
        let impulse = |newton_seconds: f64| format!("{:?} N.s", newton_seconds * self.impulse());
        let along = self.rotation() * Vector3::z();
        let mut sections = vec![
            self.parts(world),
            format!(
                "target: {{ surface: {prefix}slot.{prefix}floor, aim: {}, along: [{:?}, {:?}, {:?}] }}\n",
                self.point(world.aim()),
                along.x,
                along.y,
                along.z
            ),
            format!(
                "shot: {{ radius: {}, density: {:?} kg/m3 }}\n",
                self.size(world.radius),
                world.density * self.density
            ),
            format!(
                "jet: {{ exit_diameter: {}, divergence: 5 deg, speed_spread: 5 % }}\n",
                self.size(0.7)
            ),
            self.section(
                "contacts",
                vec![
                    format!("{prefix}soft: {}", self.contact(world.contact)),
                    format!("{prefix}hard: {}", self.contact(world.hard)),
                ],
            ),
            format!(
                "settings: {{ incidence: {:?} deg, azimuth: {:?} deg, standoff: {}, speed: {:?} m/s, \
                 contact: {prefix}soft }}\n",
                world.incidence,
                world.azimuth,
                self.size(world.standoff),
                world.speed * self.speed
            ),
            format!(
                "goals: {{ normal_impulse: {{ target: {} }}, tangential_impulse: {{ limit: {} }}, \
                 rebound: {{ allow: {} }}, miss: {{ weight: 2 }} }}\n",
                impulse(5e-6),
                impulse(1e-6),
                impulse(3e-6)
            ),
            self.rules(world),
            "paths: { impacts: 5, least_energy: 0.1 % }\n".to_owned(),
        ];
        if self.backwards {
            sections.reverse();
        }
        format!(
            "format: 1\nlengths_in: {}\n{}",
            self.unit.1,
            sections.concat()
        )
    }

    /// Writes the meshes of a world, if it has any.
    fn write_meshes(&self, world: &World, folder: &Path) {
        let Some([slot, pin]) = world.meshes() else {
            return;
        };
        let metres = |point: &Point3<f64>| point.map(|x| x * 1e-3);
        let in_place = |point: &Point3<f64>| {
            let lengths = metres(point).coords * (self.length * self.unit.0);
            lengths.into()
        };
        let there = |point: &Point3<f64>| (self.there(&metres(point)).coords * self.unit.0).into();
        let named = |name: &str| format!("{}{name}", self.prefix);
        let slot = slot.obj(in_place, named, self.backwards);
        let pin = pin.obj(there, str::to_owned, self.backwards);
        for (name, text) in [("slot.obj", slot), ("pin.obj", pin)] {
            fs::write(folder.join(name), text).unwrap();
        }
    }

    pub fn of(&self, world: &World) -> Scenario {
        let text = self.text(world);
        let folder = TempDir::new().unwrap();
        self.write_meshes(world, folder.path());
        let reading = problem::read_text(&text, &folder.path().join("world.yaml")).unwrap();
        let Some(mut problem) = reading.problem else {
            let faults = problem::render(&reading.source, &reading.faults, false);
            panic!("{text}\n{faults}");
        };
        problem.paths.shot_size = world.shots_have_size;
        Scenario::new(problem, Walls::Exact).unwrap_or_else(|faults| panic!("{text}\n{faults:?}"))
    }
}

/// Every impact of a shot.
pub fn path(scenario: &Scenario, shot: &ShotSample) -> Vec<PathImpact> {
    let settings = held(scenario);
    let mut impacts = Vec::new();
    Tracer::new(scenario, &settings, settings.speed).follow(shot, |impact| impacts.push(*impact));
    impacts
}
