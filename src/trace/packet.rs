//! Shots that fly side by side, impact after impact.
//!
//! Tests follow the same shots one by one, with the same bits.

mod impacts;

use multiversion::multiversion;

use super::compaction::Compaction;
use super::{End, MOST_DEFLECTIONS, Tracer, energy};
use crate::jet::ShotSample;
use crate::scene::lanes::{LANES, Lane, any, components, padded, put};
use crate::scene::nozzle_frame::NozzleFrames;
use crate::scene::ray::Ray;
use crate::scene::rays::{Hits, Rays};
use crate::triple::{along, unit};
use impacts::{Impacts, Rules, path_state};

/// Up to [`LANES`] shots in flight, side by side.
pub(crate) struct RayPacket {
    /// Their rays to the next impacts.
    pub rays: Rays,
    /// What these meet.
    pub hits: Hits,
    /// What the impacts there do.
    pub impacts: Impacts,
    /// Index of each shot among those that were fired together.
    pub shot: [u32; LANES],
    /// Number of impacts so far; hits on deflectors do not count.
    pub number: Lane,
    /// Importance weights.
    pub weight: Lane,
    /// 1 for nominal samples, 0 for boundary samples.
    pub of_jet: Lane,
    /// Factor on its speed.
    pub speed: Lane,
    /// Velocity of the centre, m/s.
    pub velocity: [Lane; 3],
    /// R w, m/s.
    pub rolling: [Lane; 3],
    mass: Lane,
    least_energy: Lane,
    /// The chosen contact as this shot meets it, when it is the same everywhere.
    restitution: Lane,
    holds: Lane,
    slides: Lane,
}

/// Observes what happens to the shots of a packet.
pub(crate) trait Observer {
    /// All shots in flight have come to their next impact, or left.
    fn impacts(&mut self, packet: &RayPacket);

    /// A shot's path has ended after `rays` rays.
    fn ends(&mut self, _shot: usize, _end: End, _rays: usize) {}

    /// The paths of all `shots` of the packet have ended, after `rays` rays together.
    fn packet_ends(&mut self, shots: &[ShotSample], rays: usize);
}

/// Fires `shots` together, at most [`LANES`], from the exit or all from one start.
///
/// Observers that are asked in every evaluation are compiled into the tracing, for the instructions of the processor at
/// hand; the others are passed as `dyn Observer`, as each type of its own is one more copy of all tracing to compile.
pub(super) fn fire<W: Observer + ?Sized>(
    tracer: &Tracer,
    packet: &mut RayPacket,
    shots: &[ShotSample],
    start: Option<&Ray>,
    observer: &mut W,
) {
    let rays = if tracer.scenario.scene.has_exact_walls() {
        fire_at_walls(tracer, packet, shots, start, observer)
    } else {
        fire_at_facets(tracer, packet, shots, start, observer)
    };
    observer.packet_ends(shots, rays);
}

#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+fma",
    "x86_64+avx+avx2+bmi1+bmi2+fma"
))]
fn fire_at_walls<W: Observer + ?Sized>(
    tracer: &Tracer,
    packet: &mut RayPacket,
    shots: &[ShotSample],
    start: Option<&Ray>,
    observer: &mut W,
) -> usize {
    packet.fly(tracer, shots, start, observer)
}

/// Without AVX-512, for which some processors slow down all that they do; the walk through a tree
/// gains nothing from it.
#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+fma"))]
fn fire_at_facets<W: Observer + ?Sized>(
    tracer: &Tracer,
    packet: &mut RayPacket,
    shots: &[ShotSample],
    start: Option<&Ray>,
    observer: &mut W,
) -> usize {
    packet.fly(tracer, shots, start, observer)
}

impl RayPacket {
    pub fn none() -> Self {
        let zeros = [0.0; LANES];
        Self {
            rays: Rays::none(),
            hits: Hits::none(),
            impacts: Impacts::none(),
            shot: [0; LANES],
            number: zeros,
            weight: zeros,
            of_jet: zeros,
            speed: [1.0; LANES],
            velocity: [zeros; 3],
            rolling: [zeros; 3],
            mass: zeros,
            least_energy: zeros,
            restitution: zeros,
            holds: zeros,
            slides: zeros,
        }
    }

    /// Puts shots at the exit, or where they start.
    #[inline(always)]
    fn load(&mut self, tracer: &Tracer, shots: &[ShotSample], start: Option<&Ray>) {
        let as_asked = shots.iter().all(ShotSample::leaves_pose);
        self.rays.count = shots.len().min(LANES);
        self.rays.leaving = None;
        self.rays.are_spheres = tracer.radius > 0.0;
        for (i, sample) in shots.iter().take(LANES).enumerate() {
            let ray = match start {
                Some(start) => *start,
                None if as_asked => tracer.pose.shot(sample),
                None => tracer.aim.shot(&tracer.frame_of(sample), sample),
            };
            put(&mut self.rays.origin, i, ray.origin.into());
            put(&mut self.rays.direction, i, ray.direction.into());
            let velocity = ray.direction * (tracer.speed * sample.speed);
            put(&mut self.velocity, i, velocity.into());
            put(&mut self.rolling, i, [0.0; 3]);
            self.rays.radius[i] = tracer.radius * sample.size;
            self.shot[i] = i as u32;
            self.number[i] = 0.0;
            self.weight[i] = sample.weight;
            self.of_jet[i] = mask(sample.of_jet);
            self.speed[i] = sample.speed;
            self.mass[i] = tracer.mass * sample.mass();
            if let Some(contact) = &tracer.only_contact {
                let (restitution, factor) =
                    (contact.restitution + sample.restitution, sample.friction);
                self.restitution[i] = restitution.clamp(0.0, 1.0);
                self.holds[i] = contact.friction.holds * factor;
                self.slides[i] = contact.friction.slides * factor;
            }
        }
        self.rays.nozzle_frames = tracer.moves_parts.then(|| nozzle_frames(tracer, shots));
        let share = tracer.scenario.problem.paths.least_energy;
        for i in 0..padded(self.rays.count) {
            self.least_energy[i] = share * energy(components(&self.velocity, i), [0.0; 3]);
        }
    }

    #[inline(always)]
    fn fly<W: Observer + ?Sized>(
        &mut self,
        tracer: &Tracer,
        shots: &[ShotSample],
        start: Option<&Ray>,
        observer: &mut W,
    ) -> usize {
        self.load(tracer, shots, start);
        let most_impacts = tracer.scenario.problem.paths.impacts as f64;
        let (mut rays, mut flights) = (0, 0);
        while self.rays.count > 0 {
            rays += self.rays.count;
            flights += 1;
            let rules = Rules {
                most_impacts,
                too_few_impacts: f64::from(flights) - f64::from(MOST_DEFLECTIONS),
            };
            tracer.scenario.scene.first_hits(&self.rays, &mut self.hits);
            if tracer.has_deflectors {
                self.mark_deflections(tracer);
            }
            match &tracer.only_contact {
                Some(only) if !tracer.has_rough_surfaces => {
                    self.collide(&only.friction.at(only.restitution), &rules);
                }
                _ => self.collide_one_by_one(tracer, shots, flights, &rules),
            }
            observer.impacts(self);
            self.end_paths(flights, observer);
            if !tracer.scenario.problem.paths.spin {
                self.rolling = [[0.0; LANES]; 3];
            }
            self.leave();
        }
        rays
    }

    /// Drops the shots whose paths have ended; the last of the others take their lanes.
    #[inline(always)]
    fn end_paths<W: Observer + ?Sized>(&mut self, flights: u32, observer: &mut W) {
        let goes_on = path_state::GOES_ON;
        let path_states = &self.impacts.path_state[..self.rays.count];
        if !any(path_states, |path_state| path_state != goes_on) {
            return;
        }
        for (&path_state, &shot) in path_states.iter().zip(&self.shot) {
            if path_state != goes_on {
                observer.ends(shot as usize, path_state::end(path_state), flights as usize);
            }
        }
        let compaction = Compaction::among(path_states.len(), |lane| path_states[lane] == goes_on);
        self.rays.count = compaction.left;
        compaction.fill_all(&mut self.velocity);
        compaction.fill_all(&mut self.rolling);
        compaction.fill_all(&mut self.hits.point);
        if self.rays.are_spheres {
            compaction.fill_all(&mut self.hits.normal);
            compaction.fill(&mut self.rays.radius);
        }
        compaction.fill_all([
            &mut self.number,
            &mut self.weight,
            &mut self.of_jet,
            &mut self.speed,
            &mut self.mass,
            &mut self.least_energy,
            &mut self.restitution,
            &mut self.holds,
            &mut self.slides,
        ]);
        if let Some(nozzle_frames) = &mut self.rays.nozzle_frames {
            compaction.fill_all(nozzle_frames.lanes_mut());
        }
        compaction.fill(&mut self.shot);
        compaction.fill(&mut self.hits.hit_ids.part);
        compaction.fill(&mut self.hits.hit_ids.piece);
        compaction.fill(&mut self.hits.hit_ids.front);
    }

    /// From the places of contact to the centres of the shots.
    #[inline(always)]
    fn rise_by_radius(&mut self) {
        for i in 0..padded(self.rays.count) {
            let (point, normal) = (
                components(&self.rays.origin, i),
                components(&self.hits.normal, i),
            );
            put(
                &mut self.rays.origin,
                i,
                along(point, normal, self.rays.radius[i]),
            );
        }
    }

    /// The rays on which the shots leave the surfaces that they have hit.
    #[inline(always)]
    fn leave(&mut self) {
        self.rays.origin = self.hits.point;
        if self.rays.are_spheres {
            self.rise_by_radius();
        }
        self.rays.leaving = Some(self.hits.hit_ids.clone());
        for i in 0..padded(self.rays.count) {
            put(
                &mut self.rays.direction,
                i,
                unit(components(&self.velocity, i)),
            );
        }
    }
}

/// The nozzle frame of each shot, with its setup errors.
fn nozzle_frames(tracer: &Tracer, shots: &[ShotSample]) -> Box<NozzleFrames> {
    let mut nozzle_frames = Box::new(NozzleFrames::none());
    for (i, sample) in shots.iter().take(LANES).enumerate() {
        nozzle_frames.set(i, &tracer.nozzle_frame(sample));
    }
    nozzle_frames
}

/// 1 for what is true, 0 for what is not.
#[inline(always)]
pub(crate) fn mask(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}
