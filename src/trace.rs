//! Shots through the scene: from the exit, through every impact, to where the path ends.

mod compaction;
mod packet;
mod rough;
#[cfg(test)]
mod tests;

pub(crate) use packet::{Observer, RayPacket, mask};

use std::hint::black_box;

use nalgebra::{Point3, Vector3};

use crate::impact::{Contact, Friction, Regime, Restitution, rebound};
use crate::jet::{Aim, Pose, ShotSample};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::lanes::LANES;
use crate::scene::nozzle_frame::NozzleFrame;
use crate::scene::ray::{HitId, Ray};
use crate::triple::{Triple, dot, unit};
use packet::fire;

/// Traces shots of some settings.
pub struct Tracer<'a> {
    scenario: &'a Scenario,
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
    pub fn new(scenario: &'a Scenario, settings: &Settings, speed: f64) -> Self {
        let contact = scenario.problem.contacts[settings.contact].at(settings.static_friction);
        let has_one = scenario
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
            pose: Pose::new(&scenario.target.frame, settings),
            has_deflectors: scenario.surfaces.iter().any(|surface| surface.deflector),
            has_rough_surfaces: scenario
                .surfaces
                .iter()
                .any(|surface| surface.roughness > 0.0),
            moves_parts: scenario.scene.moves_with_nozzle(),
            only_contact,
            scenario,
            aim: Aim::new(settings),
            contact,
            speed,
            mass: scenario.problem.shot.mass(),
            radius: if scenario.problem.paths.shot_size {
                scenario.problem.shot.radius
            } else {
                0.0
            },
        }
    }

    /// Follows one shot of the jet; reports each impact but those on deflectors. Returns why the
    /// path ended and how many rays it took.
    #[inline]
    pub fn follow(&self, sample: &ShotSample, report: impl FnMut(&PathImpact)) -> (End, usize) {
        self.follow_from(self.launch(sample), sample, report)
    }

    /// The ray along which a shot of the jet leaves the nozzle.
    #[inline]
    pub fn launch(&self, sample: &ShotSample) -> Ray {
        self.aim.shot(&self.scenario.target.frame, sample)
    }

    /// Follows a shot that starts anywhere in the scene, with the mass, speed, contact and pose of
    /// the nozzle that `sample` gives it.
    #[inline]
    pub fn follow_from(
        &self,
        start: Ray,
        sample: &ShotSample,
        mut report: impl FnMut(&PathImpact),
    ) -> (End, usize) {
        self.follow_all_from(start, sample, |impact| {
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
        sample: &ShotSample,
        mut report: impl FnMut(&PathImpact),
    ) -> (End, usize) {
        let scenario = self.scenario;
        let limits = scenario.problem.paths;
        let mass = self.mass * sample.mass();
        let radius = self.radius * sample.size;
        let nozzle_frame = self.moves_parts.then(|| self.nozzle_frame(sample));
        let mut ray = start;
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

    /// Fires shots in packets for an observer; `end_packet` gets the shots of each packet and the number of rays
    /// that they took together.
    pub(crate) fn fire<W: Observer>(
        &self,
        shots: &[ShotSample],
        observer: &mut W,
        mut end_packet: impl FnMut(&mut W, &[ShotSample], usize),
    ) {
        if shots.is_empty() {
            return;
        }
        let mut packet = RayPacket::none();
        for shots in shots.chunks(LANES) {
            fetch(shots);
            let rays = fire(self, &mut packet, shots, observer);
            end_packet(observer, shots, rays);
        }
    }

    /// The nozzle frame of a shot, with its setup errors.
    fn nozzle_frame(&self, sample: &ShotSample) -> NozzleFrame {
        let frame = &self.scenario.target.frame;
        self.aim.pose_set_for(frame, sample).nozzle_frame()
    }

    /// The contact of a shot with a surface, when restitution and friction are not exactly known.
    fn contact_with(&self, surface: usize, sample: &ShotSample) -> Contact {
        let contact = self.scenario.surfaces[surface]
            .contact
            .unwrap_or(self.contact);
        perturbed(contact, sample)
    }
}

/// Reads from all over some shots, so that they come from memory together. Where they are needed one
/// by one, between arithmetic, each is waited for by itself.
fn fetch(shots: &[ShotSample]) {
    let lines = |shot: &ShotSample| {
        shot.exit[0].to_bits() ^ shot.azimuth[0].to_bits() ^ shot.weight.to_bits()
    };
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
    let departure = |normal: Triple| {
        let after = rebound(contact, velocity, rolling, &normal.into());
        after.map_or([0.0; 3], |after| after.velocity.into())
    };
    let (normal, velocity) = ((*normal).into(), (*velocity).into());
    rough::normal_of_impact(normal, tilt, velocity, departure).into()
}

/// Kinetic energy per unit mass of a solid sphere, translation and rotation, J/kg.
#[inline(always)]
fn energy(velocity: Triple, rolling: Triple) -> f64 {
    0.5 * dot(velocity, velocity) + 0.2 * dot(rolling, rolling)
}

/// The contact that a shot meets when restitution and friction are not exactly known.
fn perturbed(contact: Contact, sample: &ShotSample) -> Contact {
    if sample.restitution == 0.0 && sample.friction == 1.0 {
        return contact;
    }
    Contact {
        static_friction: contact.static_friction * sample.friction,
        dynamic_friction: contact.dynamic_friction * sample.friction,
        restitution: contact.restitution.shifted(sample.restitution),
        ..contact
    }
}
