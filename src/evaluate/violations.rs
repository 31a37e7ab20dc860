//! Pilot runs that find where violating shots come from.

use crate::elementary::square;
use crate::jet::{ImportanceDensity, PilotRun, Replicates, ShotSample, purpose};
use crate::objective::ObjectiveAccumulator;
use crate::problem::goal::TangentialImpulse;
use crate::problem::setting::Settings;
use crate::scenario::{Scenario, SurfaceLimits};
use crate::scene::lanes::LANES;
use crate::trace::{Observer, RayPacket, Tracer};

/// The importance density of some settings, and the rays that its pilot runs took. Violations are misses,
/// tangential impulses over their limit and impacts on secondary surfaces, each with its part in J.
///
/// Rare violations come from a corner of what exit, cone and tolerance allow. A wider jet reaches beyond that
/// corner; the next, narrower one looks more closely where it found violations (the cross-entropy method for
/// rare events: Rubinstein, European Journal of Operational Research 99, 1997).
pub fn importance_of(scenario: &Scenario, settings: &Settings) -> (ImportanceDensity, usize) {
    let (mut importance, mut rays) = (ImportanceDensity::NONE, 0);
    if scenario.problem.has_one_ray() {
        return (importance, rays);
    }
    for (number, stretch) in STRETCHES.into_iter().enumerate() {
        let stream = Replicates::stream(purpose::PILOT_RUNS, number as u32);
        let pilot_run = PilotRun::new(&scenario.problem, stretch, stream, SHOTS, &importance);
        let accumulator = ViolationAccumulator::of(scenario, settings, &pilot_run.shots);
        importance =
            pilot_run.adapted(&importance, &rare(&accumulator.violation, &pilot_run.shots));
        rays += accumulator.objective.finish().rays;
    }
    (importance, rays)
}

/// Widths of the pilot runs' jets, relative to the jet, in their order. From one to the next, violations become so much rarer that a
/// few are still seen: straight from 1.2 to 1, where a violation costs 500 mean shots and one shot in 60 000 does it, a quarter of all
/// runs saw none, and J was up to 16 standard errors off.
const STRETCHES: [f64; 6] = [1.7, 1.4, 1.2, 1.1, 1.05, 1.0];
/// Shots of each pilot run.
const SHOTS: usize = 2048;

/// Weighted violations of the shots whose violation is rare; others are averaged well enough as it is.
fn rare(violation: &[f64], shots: &[ShotSample]) -> Vec<f64> {
    let pairs = || violation.iter().zip(shots);
    let weight: f64 = shots.iter().map(|shot| shot.weight).sum();
    let mean = pairs()
        .map(|(violation, shot)| violation * shot.weight)
        .sum::<f64>()
        / weight;
    let counted = pairs().map(|(&violation, shot)| {
        if violation > RARE * mean {
            violation * shot.weight
        } else {
            0.0
        }
    });
    counted.collect()
}

/// A violation is rare if it is this many times the mean.
const RARE: f64 = 3.0;

/// Adds up what each shot's violations cost.
struct ViolationAccumulator {
    objective: ObjectiveAccumulator,
    /// What (N*)^2 costs on each surface.
    costs: Vec<f64>,
    tangential: Option<TangentialImpulse>,
    miss: f64,
    /// Of each shot of the packet.
    in_packet: [f64; LANES],
    /// Of each shot.
    violation: Vec<f64>,
}

impl ViolationAccumulator {
    fn of(scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) -> Self {
        let goals = &scenario.problem.goals;
        let cost = |limits: &SurfaceLimits| {
            let allow = limits.allow?;
            Some(limits.weight / (allow * allow))
        };
        let costs = scenario.surfaces.iter().map(|it| cost(it).unwrap_or(0.0));
        let mut accumulator = Self {
            objective: ObjectiveAccumulator::new(
                scenario,
                settings.contact,
                settings.speed,
                shots.len(),
            ),
            costs: costs.collect(),
            tangential: goals.tangential_impulse,
            miss: goals.miss.weight,
            in_packet: [0.0; LANES],
            violation: Vec::with_capacity(shots.len()),
        };
        let tracer = Tracer::new(scenario, settings, settings.speed);
        tracer.fire(shots, &mut accumulator as &mut dyn Observer);
        accumulator
    }
}

impl Observer for ViolationAccumulator {
    fn impacts(&mut self, packet: &RayPacket) {
        self.objective.impacts(packet);
        for i in (0..packet.rays.count).filter(|&i| packet.impacts.counts[i] != 0.0) {
            let shot = packet.shot[i] as usize;
            if !self.objective.is_on_target(i) {
                let cost = self.costs[packet.hits.surface[i] as usize];
                self.in_packet[shot] += cost * square(packet.impacts.normal[i]);
            } else if packet.number[i] == 1.0 {
                let excess = |goal: TangentialImpulse| {
                    let excess = (packet.impacts.tangential[i] / goal.limit - 1.0).max(0.0);
                    goal.weight * excess * excess
                };
                self.in_packet[shot] += self.tangential.map_or(0.0, excess);
            }
        }
    }

    fn packet_ends(&mut self, shots: &[ShotSample], rays: usize) {
        for i in 0..shots.len() {
            let miss = if self.objective.has_hit_target(i) {
                0.0
            } else {
                self.miss
            };
            self.violation.push(self.in_packet[i] + miss);
        }
        self.in_packet = [0.0; LANES];
        self.objective.packet_ends(shots, rays);
    }
}
