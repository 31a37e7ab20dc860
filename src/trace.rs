//! Shots through the scene: from the exit, through every impact, to where the path ends.

mod compaction;
mod packet;
mod path;
mod rough;
#[cfg(test)]
mod tests;

pub(crate) use packet::{Observer, RayPacket, mask};
pub use path::{Path, PathImpact};

use std::hint::black_box;

use crate::impact::{Contact, Friction, Restitution};
use crate::jet::{Aim, Pose, ShotSample};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::lanes::LANES;
use crate::scene::nozzle_frame::NozzleFrame;
use crate::scene::patch::Frame;
use crate::scene::ray::Ray;
use crate::triple::{Triple, dot};
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

    /// The ray along which a shot of the jet leaves the nozzle.
    #[inline]
    pub fn launch(&self, sample: &ShotSample) -> Ray {
        self.aim.shot(&self.frame_of(sample), sample)
    }

    /// Fires shots in packets for an observer.
    pub(crate) fn fire<W: Observer + ?Sized>(&self, shots: &[ShotSample], observer: &mut W) {
        if shots.is_empty() {
            return;
        }
        let mut packet = RayPacket::none();
        for shots in shots.chunks(LANES) {
            fetch(shots);
            fire(self, &mut packet, shots, None, observer);
        }
    }

    /// Where a shot is aimed: on a stroke, at its place.
    #[inline]
    fn frame_of(&self, sample: &ShotSample) -> Frame {
        match &self.scenario.traverse {
            Some(traverse) => traverse.frame_at(sample.place),
            None => self.scenario.target.frame,
        }
    }

    /// The nozzle frame of a shot, with its setup errors.
    fn nozzle_frame(&self, sample: &ShotSample) -> NozzleFrame {
        let frame = self.frame_of(sample);
        self.aim.pose_set_for(&frame, sample).nozzle_frame()
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
