//! Impulses of the shots of one pose, kept so that verdicts follow at any launch speed.

use super::ViolationCounts;
use crate::jet::ShotSample;
use crate::objective::{ObjectiveAccumulator, Tally, Terms};
use crate::problem::setting::{Range, Settings};
use crate::scenario::Scenario;
use crate::scene::lanes::LANES;
use crate::trace::{Observer, RayPacket, Tracer};
use crate::verdict::Verdict;

/// The impacts of some shots, per unit of launch speed.
pub(crate) struct LargestImpulses {
    tally: Tally,
    /// First hits on target that stick.
    sticking: usize,
    /// For each surface the largest N* of every shot that hits it off target, N s per m/s.
    largest: Vec<Vec<f64>>,
}

impl LargestImpulses {
    /// Traces the shots of some settings.
    pub fn of(scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) -> Self {
        let surfaces = scenario.surfaces.len();
        let mut accumulator = LargestAccumulator {
            objective: ObjectiveAccumulator::new(
                scenario,
                settings.contact,
                settings.speed,
                shots.len(),
            ),
            sticking: 0,
            per_speed: 1.0 / settings.speed,
            largest: vec![Vec::new(); surfaces],
            in_packet: vec![0.0; surfaces * LANES],
            touched: Vec::new(),
        };
        let tracer = Tracer::new(scenario, settings, settings.speed);
        tracer.fire(shots, &mut accumulator as &mut dyn Observer);
        Self {
            tally: accumulator.objective.finish(),
            sticking: accumulator.sticking,
            largest: accumulator.largest,
        }
    }

    /// Rays cast for each shot.
    pub fn rays_per_shot(&self) -> f64 {
        self.tally.rays as f64 / self.tally.shots.max(1) as f64
    }

    /// Share of the first hits on target that stick; `None` without any hit.
    pub fn share_sticking(&self) -> Option<f64> {
        let hits = self.tally.hits.len();
        (hits > 0).then(|| self.sticking as f64 / hits as f64)
    }

    /// The terms of the objective at a launch speed, m/s.
    pub fn terms(&self, scenario: &Scenario, speed: f64) -> Terms {
        self.tally.terms(&scenario.problem.goals, speed)
    }

    /// Rays cast.
    pub fn rays(&self) -> usize {
        self.tally.rays
    }

    /// The largest share of shots that break a goal or a limit, over a share `slack` of what is allowed, at a launch
    /// speed, m/s. As much of that is left as the share of so few shots may be off.
    pub fn violation(&self, scenario: &Scenario, speed: f64, slack: f64) -> f64 {
        let verdicts = Verdict::on(scenario, &self.counts(scenario, speed));
        let shares = verdicts
            .iter()
            .map(|verdict| verdict.violation_on_few_shots(slack));
        shares.fold(0.0, f64::max)
    }

    /// The speed in `range` at which J and a cost that depends on it are least together: where that costs nothing the
    /// one with the least J, or else the best of some round it.
    pub fn best_speed(&self, scenario: &Scenario, range: Range, cost: impl Fn(f64) -> f64) -> f64 {
        let least = self.tally.best_speed(&scenario.problem.goals, range);
        if cost(least) <= 0.0 {
            return least;
        }
        let total = |speed: f64| self.terms(scenario, speed).total() + cost(speed);
        let within = |factor: f64| (least * factor).max(range.min).min(range.max);
        let speeds = (0..=2 * SPEEDS).map(|step| {
            let offset = f64::from(step) / f64::from(SPEEDS) - 1.0;
            within(1.0 + FARTHEST_SPEED * offset)
        });
        let mut best = (least, total(least));
        for speed in speeds {
            let total = total(speed);
            if total < best.1 {
                best = (speed, total);
            }
        }
        // Towards the least J as far as it costs no more.
        let (mut near, mut far) = (best.0, least);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            let there = total(middle);
            if there <= best.1 {
                (near, best) = (middle, (middle, there));
            } else {
                far = middle;
            }
        }
        best.0
    }

    /// Violations at a launch speed, m/s.
    pub fn counts(&self, scenario: &Scenario, speed: f64) -> ViolationCounts {
        let goals = &scenario.problem.goals;
        let hits = &self.tally.hits;
        let mut over = vec![0; scenario.surfaces.len()];
        for ((over, limits), largest) in over.iter_mut().zip(&scenario.surfaces).zip(&self.largest)
        {
            if let Some(allow) = limits.allow {
                *over = largest.iter().filter(|n| **n * speed > allow).count();
            }
        }
        ViolationCounts {
            shots: self.tally.shots,
            is_exact: scenario.problem.has_one_ray(),
            hits: hits.len(),
            off_target: hits.off_target(goals, speed),
            over_limit: hits.over_limit(goals, speed),
            over,
        }
    }
}

/// Speeds on either side of that with the least J, and how far they go.
const SPEEDS: u32 = 12;
const FARTHEST_SPEED: f64 = 0.5;
/// Halvings of the way to it.
const HALVINGS: u32 = 6;

/// Collects [`LargestImpulses`].
struct LargestAccumulator {
    objective: ObjectiveAccumulator,
    sticking: usize,
    per_speed: f64,
    largest: Vec<Vec<f64>>,
    /// The largest N* per launch speed of each shot of the packet on each surface.
    in_packet: Vec<f64>,
    /// Where that is not 0.
    touched: Vec<usize>,
}

impl Observer for LargestAccumulator {
    fn impacts(&mut self, packet: &RayPacket) {
        self.objective.impacts(packet);
        for i in (0..packet.rays.count).filter(|&i| packet.impacts.counts[i] != 0.0) {
            if self.objective.is_on_target(i) {
                let is_first = packet.number[i] == 1.0;
                self.sticking += usize::from(is_first && packet.impacts.sticks[i] != 0.0);
                continue;
            }
            let surface = packet.hits.surface[i] as usize;
            let place = packet.shot[i] as usize * self.largest.len() + surface;
            let normal = packet.impacts.normal[i] * self.per_speed;
            if self.in_packet[place] == 0.0 && normal > 0.0 {
                self.touched.push(place);
            }
            self.in_packet[place] = self.in_packet[place].max(normal);
        }
    }

    fn packet_ends(&mut self, shots: &[ShotSample], rays: usize) {
        self.objective.packet_ends(shots, rays);
        let surfaces = self.largest.len();
        for place in self.touched.drain(..) {
            self.largest[place % surfaces].push(self.in_packet[place]);
            self.in_packet[place] = 0.0;
        }
    }
}
