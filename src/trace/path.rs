//! Paths of single shots, impact by impact.

use nalgebra::{Point3, Vector3};

use super::packet::{Observer, RayPacket, fire};
use super::{End, Tracer};
use crate::impact::Regime;
use crate::jet::ShotSample;
use crate::scene::lanes::{LANES, components};
use crate::scene::patch::Patch;
use crate::scene::ray::{Hit, Ray};

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

/// The path of one shot.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Its impacts; those on deflectors have the number 0.
    pub impacts: Vec<PathImpact>,
    /// Why it ended.
    pub end: End,
    /// Number of rays cast.
    pub rays: usize,
}

impl Tracer<'_> {
    /// The paths of shots of the jet, in their order.
    pub fn paths(&self, shots: &[ShotSample]) -> Vec<Path> {
        let mut recorder = Recorder::new(&self.scenario.target);
        self.fire(shots, &mut recorder as &mut dyn Observer);
        recorder.paths
    }

    /// The first hits of shots of the jet that are on the target's surface, in their order.
    pub fn first_hits(&self, shots: &[ShotSample]) -> Vec<Option<PathImpact>> {
        let target = &self.scenario.target;
        let mut first = FirstHits {
            target,
            in_packet: [None; LANES],
            hits: Vec::with_capacity(shots.len()),
        };
        self.fire(shots, &mut first as &mut dyn Observer);
        first.hits
    }

    /// The path of a shot that starts anywhere in the scene, with the mass, speed, contact and nozzle pose of
    /// `sample`: a packet of one.
    pub fn path_from(&self, start: Ray, sample: &ShotSample) -> Path {
        let mut recorder = Recorder::new(&self.scenario.target);
        let mut packet = RayPacket::none();
        let shots = std::slice::from_ref(sample);
        let observer: &mut dyn Observer = &mut recorder;
        fire(self, &mut packet, shots, Some(&start), observer);
        recorder.paths.swap_remove(0)
    }

    /// Reports each impact of one shot of the jet but those on deflectors; returns why its path ended, and the
    /// number of rays.
    pub fn follow(&self, sample: &ShotSample, report: impl FnMut(&PathImpact)) -> (End, usize) {
        self.follow_from(self.launch(sample), sample, report)
    }

    /// The same for a shot that [starts anywhere](Self::path_from).
    pub fn follow_from(
        &self,
        start: Ray,
        sample: &ShotSample,
        report: impl FnMut(&PathImpact),
    ) -> (End, usize) {
        let path = self.path_from(start, sample);
        let counted = path.impacts.iter().filter(|impact| impact.number > 0);
        counted.for_each(report);
        (path.end, path.rays)
    }
}

/// Records the paths of packets.
struct Recorder<'a> {
    target: &'a Patch,
    /// Of the packet in flight.
    in_packet: Vec<Path>,
    paths: Vec<Path>,
}

impl<'a> Recorder<'a> {
    fn new(target: &'a Patch) -> Self {
        Self {
            target,
            in_packet: vec![Path::NONE; LANES],
            paths: Vec::new(),
        }
    }
}

/// Records first hits on one surface, for which whole paths would be too much.
struct FirstHits<'a> {
    target: &'a Patch,
    /// Of the packet in flight.
    in_packet: [Option<PathImpact>; LANES],
    hits: Vec<Option<PathImpact>>,
}

impl Observer for FirstHits<'_> {
    fn impacts(&mut self, packet: &RayPacket) {
        for i in 0..packet.rays.count {
            let impact = packet.impact(i, self.target);
            let is_first = |it: &PathImpact| it.number == 1 && it.surface == self.target.surface;
            let first = impact.filter(is_first);
            if first.is_some() {
                self.in_packet[packet.shot[i] as usize] = first;
            }
        }
    }

    fn packet_ends(&mut self, shots: &[ShotSample], _: usize) {
        self.hits.extend(&self.in_packet[..shots.len()]);
        self.in_packet = [None; LANES];
    }
}

impl Path {
    /// Without an impact.
    const NONE: Self = Self {
        impacts: Vec::new(),
        end: End::Left,
        rays: 0,
    };
}

impl Observer for Recorder<'_> {
    fn impacts(&mut self, packet: &RayPacket) {
        for i in 0..packet.rays.count {
            let path = &mut self.in_packet[packet.shot[i] as usize];
            path.impacts.extend(packet.impact(i, self.target));
        }
    }

    fn ends(&mut self, shot: usize, end: End, rays: usize) {
        let path = &mut self.in_packet[shot];
        (path.end, path.rays) = (end, rays);
    }

    fn packet_ends(&mut self, shots: &[ShotSample], _: usize) {
        let none = std::iter::repeat_n(Path::NONE, shots.len());
        self.paths
            .extend(self.in_packet.splice(..shots.len(), none));
    }
}

impl RayPacket {
    /// The impact of a shot in flight, if there is one.
    fn impact(&self, i: usize, target: &Patch) -> Option<PathImpact> {
        let [counts, deflected] =
            [&self.impacts.counts, &self.impacts.deflected].map(|it| it[i] != 0.0);
        let vector = |lanes| Vector3::from(components(lanes, i));
        let hit = Hit {
            distance: self.hits.distance[i],
            point: vector(&self.hits.point).into(),
            // Lanes carry signs of zero that nobody wants to read in a record.
            normal: vector(&self.hits.normal).add_scalar(0.0),
            surface: self.hits.surface[i],
            hit_id: self.hits.hit_ids.at(i),
        };
        let is_met = counts || (deflected && self.impacts.is_met(i));
        is_met.then(|| PathImpact {
            number: if counts { self.number[i] as usize } else { 0 },
            surface: hit.surface,
            on_target: target.holds(&hit),
            normal_impulse: self.impacts.normal[i],
            tangential_impulse: self.impacts.tangential[i],
            regime: if self.impacts.sticks[i] != 0.0 {
                Regime::Stick
            } else {
                Regime::Slip
            },
            point: hit.point,
            normal: hit.normal,
            centre: hit.point + hit.normal * self.rays.radius[i],
            velocity: vector(&self.velocity),
            rolling: vector(&self.rolling),
        })
    }
}
