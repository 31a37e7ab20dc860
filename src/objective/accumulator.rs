//! Impacts of a packet, added up as they happen.

use super::hits::Hits;
use super::tally::Tally;
use crate::jet::{ShotSample, speed_variance};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::lanes::{LANES, Lane, WIDEST, components, larger, padded};
use crate::scene::patch::Patch;
use crate::trace::{Observer, RayPacket, Tracer, mask};

/// Builds a [`Tally`] from packets of shots.
pub(crate) struct ObjectiveAccumulator {
    tally: Tally,
    /// Launch speed, m/s.
    speed: f64,
    /// The mean square of the shots' factors on it, where paths do not depend on them.
    mean_square: Option<f64>,
    /// Cost of (N*)^2 on each surface.
    surface_cost: Vec<f64>,
    /// The same on the first surface.
    usual_cost: f64,
    /// Whether it is the same on all surfaces.
    costs_alike: bool,
    target: Target,
    /// Whether the last impact of each shot in flight was on target.
    on_target: Lane,
    /// Whether each shot of the packet has hit the target first.
    hit_target: [bool; LANES],
}

/// The target patch.
#[derive(Clone, Copy)]
struct Target {
    surface: u32,
    /// Whether its free side is that in front.
    front: bool,
    low: [f64; 3],
    high: [f64; 3],
}

impl Target {
    fn of(patch: &Patch) -> Self {
        let everywhere = [-f64::INFINITY, f64::INFINITY].map(|bound| [bound; 3]);
        let [low, high] = patch
            .reach()
            .map_or(everywhere, |(low, high)| [low.into(), high.into()]);
        Self {
            surface: patch.surface,
            front: patch.front,
            low,
            high,
        }
    }

    #[inline(always)]
    fn holds(&self, point: [f64; 3]) -> bool {
        let within =
            |axis: usize| (self.low[axis] <= point[axis]) & (point[axis] <= self.high[axis]);
        within(0) & within(1) & within(2)
    }
}

impl ObjectiveAccumulator {
    /// For `shots` shots that leave with a contact at a launch speed, m/s.
    pub fn new(scenario: &Scenario, contact: usize, speed: f64, shots: usize) -> Self {
        let scales_out = scenario.speed_scales_out(contact);
        let speed_variance = scales_out.then(|| speed_variance(&scenario.problem));
        let surface_cost: Vec<f64> = scenario
            .surfaces
            .iter()
            .map(|limits| {
                let cost = |allow: f64| limits.weight / (allow * allow);
                limits.allow.map_or(0.0, cost)
            })
            .collect();
        let usual_cost = surface_cost.first().copied().unwrap_or(0.0);
        Self {
            tally: Tally {
                hits: Hits::with_capacity(shots),
                speed_variance: speed_variance.unwrap_or(0.0),
                ..Tally::default()
            },
            speed,
            mean_square: speed_variance.map(|variance| 1.0 + variance),
            costs_alike: surface_cost
                .iter()
                .all(|&surface_cost| surface_cost == usual_cost),
            usual_cost,
            surface_cost,
            target: Target::of(&scenario.target),
            on_target: [0.0; LANES],
            hit_target: [false; LANES],
        }
    }

    /// Whether the last impact of a shot in flight was on target.
    pub fn is_on_target(&self, index: usize) -> bool {
        self.on_target[index] != 0.0
    }

    /// Whether a shot of the packet in flight has hit the target first.
    pub fn has_hit_target(&self, shot: usize) -> bool {
        self.hit_target[shot]
    }

    /// The tally of all packets.
    pub fn finish(self) -> Tally {
        self.tally
    }

    #[inline(always)]
    fn add_hits_on_target(&mut self, packet: &RayPacket, is_first: &Lane) {
        let (mut normal, mut tangential) = ([0.0; LANES], [0.0; LANES]);
        let mut normal_at_mean = [0.0; LANES];
        let (mut weight, mut of_jet) = ([0.0; LANES], [0.0; LANES]);
        let per_speed = 1.0 / self.speed;
        let mut count = 0;
        for (i, &first) in is_first.iter().enumerate().take(packet.rays.count) {
            let hit = first != 0.0;
            normal[count] = packet.impacts.normal[i] * per_speed;
            let factor = self.mean_square.map_or(1.0, |_| packet.speed[i]);
            normal_at_mean[count] = normal[count] / factor;
            tangential[count] = packet.impacts.tangential[i] * per_speed;
            weight[count] = packet.weight[i];
            of_jet[count] = packet.of_jet[i];
            self.hit_target[packet.shot[i] as usize % LANES] |= hit;
            count += usize::from(hit);
        }
        let hits = &mut self.tally.hits;
        hits.normal.extend_from_slice(&normal[..count]);
        hits.normal_at_mean
            .extend_from_slice(&normal_at_mean[..count]);
        hits.tangential.extend_from_slice(&tangential[..count]);
        hits.weight.extend_from_slice(&weight[..count]);
        hits.of_jet.extend_from_slice(&of_jet[..count]);
    }
}

impl Tally {
    /// Traces shots that leave at `speed` times their own factor, m/s.
    pub fn trace(
        scenario: &Scenario,
        settings: &Settings,
        speed: f64,
        shots: &[ShotSample],
    ) -> Self {
        let mut objective =
            ObjectiveAccumulator::new(scenario, settings.contact, speed, shots.len());
        let tracer = Tracer::new(scenario, settings, speed);
        tracer.fire(shots, &mut objective);
        objective.finish()
    }
}

impl Observer for ObjectiveAccumulator {
    #[inline(always)]
    fn impacts(&mut self, packet: &RayPacket) {
        let count = packet.rays.count;
        let mut surface_cost = [self.usual_cost; LANES];
        if !self.costs_alike {
            for (surface_cost, &surface) in surface_cost
                .iter_mut()
                .zip(&packet.hits.surface)
                .take(count)
            {
                *surface_cost = self.surface_cost[surface as usize];
            }
        }
        let target = self.target;
        let mut on_surface = [0.0; LANES];
        let sides = packet.hits.surface.iter().zip(&packet.hits.hit_ids.front);
        for (on_it, (&surface, &front)) in on_surface.iter_mut().zip(sides) {
            *on_it = mask((surface == target.surface) & (front == target.front));
        }
        let mut speed_share = [1.0; LANES];
        if let Some(mean_square) = self.mean_square {
            for (share, &speed) in speed_share.iter_mut().zip(&packet.speed) {
                *share = mean_square / (speed * speed);
            }
        }
        let (mut on_target, mut is_first) = ([0.0; LANES], [0.0; LANES]);
        let mut rebound = [0.0; LANES];
        for i in 0..padded(count) {
            let inside = target.holds(components(&packet.hits.point, i));
            let hit = inside & (on_surface[i] != 0.0);
            let counts = packet.impacts.counts[i] != 0.0;
            let first = counts & hit & (packet.number[i] == 1.0);
            let normal = packet.impacts.normal[i];
            let cost = packet.weight[i] * surface_cost[i] * speed_share[i] * normal * normal;
            on_target[i] = mask(hit);
            is_first[i] = mask(first);
            rebound[i] = if counts & !hit { cost } else { 0.0 };
        }
        self.on_target = on_target;
        let per_speed_squared = 1.0 / (self.speed * self.speed);
        self.tally.rebound += sum(&rebound, count) * per_speed_squared;
        let worst = largest(&rebound, count) * per_speed_squared;
        self.tally.worst_rebound = self.tally.worst_rebound.max(worst);
        if sum(&is_first, count) > 0.0 {
            self.add_hits_on_target(packet, &is_first);
        }
    }

    fn packet_ends(&mut self, shots: &[ShotSample], rays: usize) {
        self.tally.shots += shots.len();
        self.tally.rays += rays;
        let (mut all, mut missed, mut worst) = (0.0, 0.0, 0.0_f64);
        for (shot, hit) in shots.iter().zip(&mut self.hit_target) {
            let miss = if *hit { 0.0 } else { shot.weight };
            all += shot.weight;
            missed += miss;
            worst = worst.max(miss);
            *hit = false;
        }
        self.tally.weight += all;
        self.tally.missed += missed;
        self.tally.worst_miss = self.tally.worst_miss.max(worst);
    }
}

/// The largest of the first `count` numbers, which are not negative.
#[inline(always)]
pub(super) fn largest(values: &Lane, count: usize) -> f64 {
    let mut parts = [0.0; WIDEST];
    let (whole, rest) = values[..count].as_chunks::<WIDEST>();
    for chunk in whole {
        for (part, &value) in parts.iter_mut().zip(chunk) {
            *part = larger(value, *part);
        }
    }
    for (part, &value) in parts.iter_mut().zip(rest) {
        *part = larger(value, *part);
    }

    parts.into_iter().fold(0.0, larger)
}

/// The sum of the first `count` numbers, in a fixed order that compilers can work on side by side.
#[inline(always)]
fn sum(values: &Lane, count: usize) -> f64 {
    const PARTS: usize = 8;
    let mut parts = [0.0; PARTS];
    let (whole, rest) = values[..count].as_chunks::<PARTS>();
    for chunk in whole {
        for part in 0..PARTS {
            parts[part] += chunk[part];
        }
    }
    for (part, value) in parts.iter_mut().zip(rest) {
        *part += value;
    }
    parts.iter().sum()
}
