//! What the jet is made of: shot, jet, nozzle, contacts, and surfaces with rules of their own.

use nalgebra::{Rotation3, Vector3};

use crate::elementary::square;
use crate::impact::{Contact, Sphere};
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::media::{LibraryContact, Medium};
use crate::problem::setting::Range;

/// The shot: solid spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Mean radius, m.
    pub radius: f64,
    /// Density, kg/m3.
    pub density: f64,
    /// Standard deviation of the radius relative to its mean, cut at two.
    pub size_spread: f64,
    /// The medium that the file names; its numbers hold where the file gives none.
    pub medium: Option<&'static Medium>,
}

impl Shot {
    /// Mass of a sphere of the mean radius, kg.
    pub fn mass(&self) -> f64 {
        Sphere {
            radius: self.radius,
            density: self.density,
        }
        .mass()
    }
}

/// How the shots leave the nozzle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Diameter of the exit disc, m.
    pub exit_diameter: f64,
    /// Half-angle of the cone, rad.
    pub divergence: f64,
    /// How directions fill the cone.
    pub spread: Spread,
    /// Standard deviation of the speed relative to its mean, cut at two.
    pub speed_spread: f64,
    /// Mass of shot per time, kg/s, where it is known. No path depends on it; it tells whether
    /// shots get into each other's way.
    pub mass_flow: Option<f64>,
    /// Speed of the air that carries the shot, m/s, where it is known. No path depends on it; it tells
    /// how much faster the shot is at the target.
    pub air_speed: Option<f64>,
}

/// Which pressure gives which speed, as measured on the machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// Pressure, Pa, and mean speed at the exit, m/s: at least two rows, both strictly rising.
    pub rows: Vec<(f64, f64)>,
}

impl Calibration {
    /// The pressure that gives a speed, Pa: linear between two rows; `None` outside all of them.
    pub fn pressure_at(&self, speed: f64) -> Option<f64> {
        self.rows.windows(2).find_map(|pair| {
            let [(low, slow), (high, fast)] = [pair[0], pair[1]];
            let is_between = slow <= speed && speed <= fast;
            is_between.then(|| low + (high - low) * (speed - slow) / (fast - slow))
        })
    }
}

/// What is to be said about coverage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoverageWish {
    /// The dent that one hit leaves.
    pub dent: Dent,
    /// Share of the target's area that is to be dented; below 1.
    pub wanted: f64,
    /// How many times the mass of shot until then is to be fired: 2 for a wanted coverage of 200 %.
    pub times: f64,
}

/// Share that counts as full coverage, of which more than 100 % are multiples (SAE J2277).
pub const FULL: f64 = 0.98;

/// The dent that one hit leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dent {
    /// The same for every hit.
    Diameter(f64),
    /// As one that was measured, m, at a normal speed, m/s: it grows with the root of the normal speed and with the shot.
    Measured {
        /// Its diameter, m.
        diameter: f64,
        /// Normal speed of the hit that left it, m/s.
        normal_speed: f64,
    },
    /// From the target's dynamic hardness, Pa: the work of the hit over it is the volume of the dent.
    Hardness(f64),
}

/// What (d/D)^4 is of rho v_n^2 (1 - E^2) / B for the cap of a ball: a volume of pi d^4 / 32 D.
const CAP: f64 = 8.0 / 3.0;

impl Dent {
    /// Diameter of the dent of a shot, m, from its own diameter, m, its density, kg/m3, the restitution and the normal
    /// speed, m/s, of its hit. Of a measured dent only the ratio of the shot's diameter to that of the mean shot counts.
    pub fn diameter(
        &self,
        shot: &Shot,
        relative_size: f64,
        restitution: f64,
        normal_speed: f64,
    ) -> f64 {
        match *self {
            Self::Diameter(diameter) => diameter,
            Self::Measured {
                diameter,
                normal_speed: reference,
            } => diameter * relative_size * (normal_speed / reference).sqrt(),
            Self::Hardness(hardness) => {
                let lost = 1.0 - square(restitution);
                let ratio = CAP * shot.density * square(normal_speed) * lost / hardness;
                2.0 * shot.radius * relative_size * ratio.sqrt().sqrt()
            }
        }
    }
}

/// How directions fill the cone of the jet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// Uniform in solid angle.
    Uniform,
    /// Normal in the two transverse angles with a standard deviation of half the half-angle,
    /// cut at the half-angle.
    Gaussian,
}

/// The solid body that carries the jet; it must stay clear of every surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nozzle {
    /// Pieces of the body; none means that the nozzle takes no room.
    pub body: Vec<Body>,
    /// Least distance from every surface, m.
    pub clearance: f64,
}

/// One piece of the nozzle's body, placed at the exit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A ball round the exit.
    Ball {
        /// m.
        radius: f64,
    },
    /// A rod with round ends that starts at the exit.
    Capsule {
        /// m.
        length: f64,
        /// m.
        radius: f64,
        /// Fixed unit direction in the scene; back along the jet axis when absent.
        direction: Option<Vector3<f64>>,
    },
}

impl Body {
    /// Turns a fixed direction.
    pub fn turn(&mut self, turn: &Rotation3<f64>) {
        if let Self::Capsule {
            direction: Some(direction),
            ..
        } = self
        {
            *direction = turn * *direction;
        }
    }
}

/// A contact that may be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactChoice {
    /// Its name in the file.
    pub name: String,
    /// The contact at the lower end of the friction range.
    pub contact: Contact,
    /// Static friction; more than a point when the search may tune it.
    pub static_friction: Range,
    /// Dynamic over static friction, for a tuned contact.
    pub dynamic_ratio: Option<f64>,
    /// The contact of the library that the file names; its numbers hold where the file gives none.
    pub library: Option<&'static LibraryContact>,
}

impl ContactChoice {
    /// The contact with the given static friction (ignored unless the friction is tuned).
    pub fn at(&self, static_friction: f64) -> Contact {
        match self.dynamic_ratio {
            Some(ratio) => Contact {
                static_friction,
                dynamic_friction: ratio * static_friction,
                ..self.contact
            },
            None => self.contact,
        }
    }
}

/// Where one surface differs from the others.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceRule {
    /// Full name, `part.surface`.
    pub surface: String,
    /// Normal impulse that it may take, N s.
    pub allow: Option<f64>,
    /// Share of all shots that may exceed it.
    pub share: Option<f64>,
    /// Weight of its impacts in the objective.
    pub weight: Option<f64>,
    /// Its own contact, whatever contact is chosen.
    pub contact: Option<Contact>,
    /// The contact of the library that its own contact takes from.
    pub library: Option<&'static LibraryContact>,
    /// Standard deviation of the tilt of its normal about each direction in it, rad.
    pub roughness: f64,
    /// What a hit on it counts as.
    pub role: Role,
}

impl SurfaceRule {
    /// What is wrong with it as the rule of the target, if anything.
    pub(crate) fn fault_on_target(&self) -> Option<Fault> {
        (self.role == Role::Deflector).then(|| {
            let key = format!("surfaces.{}.role", self.surface);
            let message = "hits on a deflector do not count, and this is the target";
            Fault::at_key(FaultCode::TargetDeflects, key, message).expecting("another surface")
        })
    }
}

/// What a hit on a surface counts as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Role {
    /// As any surface: first hit or rebound.
    #[default]
    Part,
    /// Hits belong to the flight: neither first hit nor rebound.
    Deflector,
}

/// How paths begin, what shots keep on them, and when they end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathLimits {
    /// Most impacts; the first hit is number 1.
    pub impacts: usize,
    /// Share of its first kinetic energy below which a shot is followed no further.
    pub least_energy: f64,
    /// Whether shots have their size in flight; otherwise they fly as points.
    pub shot_size: bool,
    /// Whether a shot takes its spin from one impact to the next.
    pub spin: bool,
    /// Whether shots leave from all over the exit; otherwise from its centre, though the exit keeps its width.
    pub exit_width: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tuned_friction_keeps_its_ratio_and_held_friction_its_values() {
        let contact = Contact::new(0.1, 0.05, 0.25).expect("it is sound");
        let mut settings = ContactChoice {
            name: "any".to_owned(),
            contact,
            static_friction: Range { min: 0.1, max: 0.4 },
            dynamic_ratio: Some(0.5),
            library: None,
        };
        let tuned = settings.at(0.25);
        assert_eq!(
            (tuned.static_friction, tuned.dynamic_friction),
            (0.25, 0.125)
        );
        assert_eq!(tuned.restitution, contact.restitution);
        settings.dynamic_ratio = None;
        assert_eq!(settings.at(0.25), contact);
    }
}
