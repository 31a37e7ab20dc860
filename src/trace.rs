//! Shots through the scene: from the exit, through every impact, to where the path ends.

mod rough;
#[cfg(test)]
mod tests;
mod vacancies;
mod volley;

pub(crate) use volley::{Volley, Witness, truth};

use std::hint::black_box;

use nalgebra::{Point3, Vector3};

use crate::impact::{Contact, Friction, Regime, Restitution, rebound};
use crate::jet::{Aim, Deviate, Pose};
use crate::precision::{Real, Triple, dot, unit};
use crate::problem::setting::Choice;
use crate::scene::lanes::LANES;
use crate::scene::ray::{Ray, Spot};
use crate::scene::stand::Stand;
use crate::setup::Setup;
use volley::fire;

/// Traces the shots of one choice of settings.
pub struct Tracer<'a> {
    setup: &'a Setup,
    aim: Aim,
    contact: Contact,
    speed: f64,
    /// Of the mean shot, kg.
    mass: f64,
    /// Of the mean shot in flight, m; 0 where shots fly as points.
    radius: f64,
    has_deflectors: bool,
    has_rough_surfaces: bool,
    /// Whether parts of the scene move with the nozzle.
    moves_parts: bool,
    /// The pose that is asked for.
    pose: Pose,
    /// The contact, when it is the same on every surface and at every speed.
    only_contact: Option<OnlyContact>,
}

/// A contact that is the same everywhere.
struct OnlyContact {
    restitution: f64,
    friction: Friction,
}

/// One impact of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathImpact {
    /// 1 for the first hit; 0 on a deflector, where hits are not counted.
    pub number: usize,
    /// Index of the surface.
    pub surface: u32,
    /// Whether it is on the target patch.
    pub on_target: bool,
    /// N*, N s.
    pub normal_impulse: f64,
    /// f*, N s.
    pub tangential_impulse: f64,
    /// Stick or slip.
    pub regime: Regime,
    /// The place of contact, m.
    pub point: Point3<f64>,
    /// Unit normal of the surface there, towards the side that the shot comes from.
    pub normal: Vector3<f64>,
    /// Where the centre of the shot is, m.
    pub centre: Point3<f64>,
    /// Velocity of the centre afterwards, m/s.
    pub velocity: Vector3<f64>,
    /// R w afterwards, m/s, R being the shot's radius.
    pub rolling: Vector3<f64>,
}

/// Why a path ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// It left the scene.
    Left,
    /// It stays on a surface (E = 0).
    Stays,
    /// Its energy fell below the least share.
    Spent,
    /// It had as many impacts as are followed.
    Limit,
}

/// Hits on deflectors that one flight may have before it counts as caught between them.
const MOST_DEFLECTIONS: u32 = 100;

impl<'a> Tracer<'a> {
    /// A tracer of shots that leave the exit at `speed` (m/s) times their own factor.
    pub fn new(setup: &'a Setup, choice: &Choice, speed: f64) -> Self {
        let contact = setup.problem.contacts[choice.contact].at(choice.static_friction);
        let has_one = setup
            .surfaces
            .iter()
            .all(|surface| surface.contact.is_none());
        let only_contact = match contact.restitution {
            Restitution::Constant(restitution) if has_one => Some(OnlyContact {
                restitution,
                friction: Friction::of(&contact),
            }),
            _ => None,
        };
        Self {
            pose: Pose::new(&setup.target.frame, choice),
            has_deflectors: setup.surfaces.iter().any(|surface| surface.deflector),
            has_rough_surfaces: setup.surfaces.iter().any(|surface| surface.roughness > 0.0),
            moves_parts: setup.scene.moves_with_nozzle(),
            only_contact,
            setup,
            aim: Aim::new(choice),
            contact,
            speed,
            mass: setup.problem.shot.mass(),
            radius: if setup.problem.paths.shot_size {
                setup.problem.shot.radius
            } else {
                0.0
            },
        }
    }

    /// Follows one shot of the jet; reports each impact but those on deflectors. Returns why the
    /// path ended and how many rays it took.
    #[inline]
    pub fn follow(&self, deviate: &Deviate, report: impl FnMut(&PathImpact)) -> (End, usize) {
        self.follow_from(self.launch(deviate), deviate, report)
    }

    /// The ray along which a shot of the jet leaves the nozzle.
    #[inline]
    pub fn launch(&self, deviate: &Deviate) -> Ray {
        self.aim.shot(&self.setup.target.frame, deviate)
    }

    /// Follows a shot that starts anywhere in the scene, with the mass, speed, contact and pose of
    /// the nozzle that `deviate` gives it.
    #[inline]
    pub fn follow_from(
        &self,
        start: Ray,
        deviate: &Deviate,
        mut report: impl FnMut(&PathImpact),
    ) -> (End, usize) {
        self.follow_all_from(start, deviate, |impact| {
            if impact.number > 0 {
                report(impact);
            }
        })
    }

    /// The same, with the hits on deflectors.
    #[inline]
    pub fn follow_all_from(
        &self,
        start: Ray,
        deviate: &Deviate,
        mut report: impl FnMut(&PathImpact),
    ) -> (End, usize) {
        let setup = self.setup;
        let limits = setup.problem.paths;
        let mass = self.mass * deviate.mass();
        let radius = self.radius * deviate.size;
        let stand = self.moves_parts.then(|| self.stand(deviate));
        let mut ray = start;
        let mut velocity = ray.direction * (self.speed * deviate.speed);
        let mut rolling = Vector3::zeros();
        let mut leaving: Option<Spot> = None;
        let least_energy = limits.least_energy * energy(velocity.into(), rolling.into());
        let (mut number, mut deflections, mut rays) = (0, 0, 0);
        loop {
            rays += 1;
            let met = setup
                .scene
                .first_contact(&ray, radius, leaving, stand.as_ref());
            let Some(hit) = met else {
                return (End::Left, rays);
            };
            let centre = hit.point + hit.normal * radius;
            let surface = &setup.surfaces[hit.surface as usize];
            let contact = self.contact_with(hit.surface as usize, deviate);
            let normal = if surface.roughness > 0.0 {
                let tilt = rough::tilt(deviate, rays as u32, surface.roughness);
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
                on_target: setup.target.holds(&hit),
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
            leaving = Some(hit.spot);
        }
    }

    /// Fires shots in volleys and tells the witness about them; `end_volley` is told the shots of
    /// each volley and the rays that they took together.
    pub(crate) fn fire<R: Real, W: Witness<R>>(
        &self,
        shots: &[Deviate],
        witness: &mut W,
        mut end_volley: impl FnMut(&mut W, &[Deviate], usize),
    ) {
        if shots.is_empty() {
            return;
        }
        let mut volley = Volley::none();
        for shots in shots.chunks(LANES) {
            fetch(shots);
            let rays = fire(self, &mut volley, shots, witness);
            end_volley(witness, shots, rays);
        }
    }

    /// Where the nozzle really stands for a shot.
    fn stand(&self, deviate: &Deviate) -> Stand<f64> {
        let frame = &self.setup.target.frame;
        self.aim.pose_set_for(frame, deviate).stand()
    }

    /// The contact of a shot with a surface, when restitution and friction are not exactly known.
    fn contact_with(&self, surface: usize, deviate: &Deviate) -> Contact {
        let contact = self.setup.surfaces[surface].contact.unwrap_or(self.contact);
        perturbed(contact, deviate)
    }
}

/// Reads from all over some shots, so that they come from memory together. Where they are needed one
/// by one, between arithmetic, each is waited for by itself.
fn fetch(shots: &[Deviate]) {
    let lines =
        |shot: &Deviate| shot.exit[0].to_bits() ^ shot.azimuth[0].to_bits() ^ shot.weight.to_bits();
    black_box(shots.iter().fold(0, |all, shot| all ^ lines(shot)));
}

/// The normal that a shot finds where a surface is rough.
fn rough_normal(
    contact: &Contact,
    velocity: &Vector3<f64>,
    rolling: &Vector3<f64>,
    normal: &Vector3<f64>,
    tilt: [f64; 2],
) -> Vector3<f64> {
    let departure = |normal: Triple<f64>| {
        let after = rebound(contact, velocity, rolling, &normal.into());
        after.map_or([0.0; 3], |after| after.velocity.into())
    };
    let (normal, velocity) = ((*normal).into(), (*velocity).into());
    rough::normal_of_impact(normal, tilt, velocity, departure).into()
}

/// Kinetic energy per unit mass of a solid sphere, translation and rotation, J/kg.
#[inline(always)]
fn energy<R: Real>(velocity: Triple<R>, rolling: Triple<R>) -> R {
    R::of(0.5) * dot(velocity, velocity) + R::of(0.2) * dot(rolling, rolling)
}

/// The contact that a shot meets when restitution and friction are not exactly known.
fn perturbed(contact: Contact, deviate: &Deviate) -> Contact {
    if deviate.restitution == 0.0 && deviate.friction == 1.0 {
        return contact;
    }
    Contact {
        static_friction: contact.static_friction * deviate.friction,
        dynamic_friction: contact.dynamic_friction * deviate.friction,
        restitution: contact.restitution.shifted(deviate.restitution),
        ..contact
    }
}
