//! Impulses of the shots of one pose, kept so that verdicts follow at any launch speed.

use rayon::prelude::*;

use super::ViolationCounts;
use crate::jet::ShotSample;
use crate::objective::{ObjectiveAccumulator, Tally, Terms};
use crate::problem::setting::{Range, Settings};
use crate::scenario::Scenario;
use crate::scene::lanes::LANES;
use crate::trace::{Observer, RayPacket, Tracer};
use crate::verdict::{Asked, ShareEstimate, Subject, allowed_shares};

/// The impacts of some shots, per unit of launch speed.
pub(crate) struct LargestImpulses {
    tally: Tally,
    /// First hits on target that stick.
    sticking: usize,
    /// Weights of the shots that do not hit the target.
    missed: Vec<f64>,
    /// For each surface those of every shot that hits it off target.
    largest: Vec<Vec<Largest>>,
}

/// The hardest impact of a shot on a surface.
#[derive(Clone, Copy)]
struct Largest {
    /// N* per unit of launch speed, N s per m/s.
    normal: f64,
    /// Importance weight of the shot.
    weight: f64,
}

impl LargestImpulses {
    /// Traces the shots of some settings, on all threads where they are many.
    pub fn of(scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) -> Self {
        let some = |shots: &[ShotSample]| Self::of_some(scenario, settings, shots);
        if shots.len() <= MOST_ALONE {
            return some(shots);
        }
        let parts = shots.par_chunks(CHUNK).map(some).collect();
        Self::join(parts, scenario.surfaces.len())
    }

    /// Those of several sets of shots together.
    fn join(parts: Vec<Self>, surfaces: usize) -> Self {
        let mut tallies = Vec::with_capacity(parts.len());
        let (mut sticking, mut missed) = (0, Vec::new());
        let mut largest = vec![Vec::new(); surfaces];
        for mut part in parts {
            tallies.push(part.tally);
            sticking += part.sticking;
            missed.append(&mut part.missed);
            for (all, some) in largest.iter_mut().zip(&mut part.largest) {
                all.append(some);
            }
        }
        Self {
            tally: Tally::join(tallies),
            sticking,
            missed,
            largest,
        }
    }

    fn of_some(scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) -> Self {
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
            missed: Vec::new(),
            largest: vec![Vec::new(); surfaces],
            in_packet: vec![0.0; surfaces * LANES],
            touched: Vec::new(),
        };
        let tracer = Tracer::new(scenario, settings, settings.speed);
        tracer.fire(shots, &mut accumulator as &mut dyn Observer);
        Self {
            tally: accumulator.objective.finish(),
            sticking: accumulator.sticking,
            missed: accumulator.missed,
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

    /// The shares of shots that break goals and limits at a launch speed, m/s, in the order of
    /// [`allowed_shares`].
    pub fn shares(&self, scenario: &Scenario, speed: f64) -> impl Iterator<Item = ShareEstimate> {
        let is_exact = scenario.problem.has_one_ray();
        allowed_shares(scenario).map(move |(subject, allowed)| {
            let asked = Asked { allowed, is_exact };
            self.share(scenario, (subject, asked), speed)
        })
    }

    /// The share of shots that break a goal or a limit at a launch speed, m/s.
    fn share(
        &self,
        scenario: &Scenario,
        (subject, asked): (Subject, Asked),
        speed: f64,
    ) -> ShareEstimate {
        let goals = &scenario.problem.goals;
        let Tally { hits, weight, .. } = &self.tally;
        let hit = match hits.is_empty() {
            true => 0.0,
            false => weight - self.tally.missed,
        };
        match subject {
            Subject::NormalImpulse => ShareEstimate::of(hits.off_target(goals, speed), hit, asked),
            Subject::TangentialImpulse => {
                ShareEstimate::of(hits.over_limit(goals, speed), hit, asked)
            }
            Subject::Surface(index) => {
                let over = self.over(scenario, index as usize, speed);
                ShareEstimate::of(over, *weight, asked)
            }
            _ => ShareEstimate::of(self.missed.iter().copied(), *weight, asked),
        }
    }

    /// The weights of the shots with an impact over what a surface may take, at a launch speed, m/s.
    fn over(&self, scenario: &Scenario, surface: usize, speed: f64) -> impl Iterator<Item = f64> {
        let allow = scenario.surfaces[surface].allow.unwrap_or(f64::INFINITY);
        let impacts = self.largest[surface].iter();
        let over = impacts.filter(move |impact| impact.normal * speed > allow);
        over.map(|impact| impact.weight)
    }

    /// The speed in `range` at which J and a cost that depends on it are least together: the one with the least J where
    /// that costs nothing, or else the best of some round it and, where these cost something, of a compass search from there.
    pub fn best_speed(&self, scenario: &Scenario, range: Range, cost: impl Fn(f64) -> f64) -> f64 {
        let least = self.tally.best_speed(&scenario.problem.goals, range);
        let there = cost(least);
        if there <= 0.0 {
            return least;
        }
        let priced = |speed: f64, cost: f64| PricedSpeed {
            speed,
            cost,
            total: self.terms(scenario, speed).total() + cost,
        };
        let better = |best: PricedSpeed, speed: f64| {
            let found = priced(speed, cost(speed));
            if found.total < best.total {
                found
            } else {
                best
            }
        };
        let within = |speed: f64| speed.max(range.min).min(range.max);
        let offsets = (0..=2 * SPEEDS).map(|step| f64::from(step) / f64::from(SPEEDS) - 1.0);
        let speeds = offsets.map(|offset| within(least * (1.0 + FARTHEST_SPEED * offset)));
        let mut best = speeds.fold(priced(least, there), better);
        // What passes may do so between two of them only.
        let mut step = least * FARTHEST_SPEED / f64::from(SPEEDS);
        for _ in 0..HALVINGS {
            if best.cost <= 0.0 {
                break;
            }
            step *= 0.5;
            let beside = [best.speed - step, best.speed + step].map(within);
            best = beside.into_iter().fold(best, better);
        }
        // Towards the least J as far as it costs no more.
        let mut far = least;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (best.speed + far);
            let found = priced(middle, cost(middle));
            if found.total <= best.total {
                best = found;
            } else {
                far = middle;
            }
        }
        best.speed
    }

    /// Violations at a launch speed, m/s.
    pub fn counts(&self, scenario: &Scenario, speed: f64) -> ViolationCounts {
        let goals = &scenario.problem.goals;
        let hits = &self.tally.hits;
        let surfaces = 0..scenario.surfaces.len();
        let over = surfaces.map(|surface| self.over(scenario, surface, speed).count());
        ViolationCounts {
            shots: self.tally.shots,
            is_exact: scenario.problem.has_one_ray(),
            hits: hits.len(),
            off_target: hits.off_target(goals, speed).count(),
            over_limit: hits.over_limit(goals, speed).count(),
            over: over.collect(),
        }
    }
}

/// A launch speed, m/s, with a cost there, and that with J.
struct PricedSpeed {
    speed: f64,
    cost: f64,
    total: f64,
}

/// One thread traces up to this many shots alone,
const MOST_ALONE: usize = 2048;
/// or this many of more at a time.
const CHUNK: usize = 1024;
/// Speeds on either side of that with the least J, and how far they go.
const SPEEDS: u32 = 12;
const FARTHEST_SPEED: f64 = 0.5;
/// Halvings of the step of a compass search, and of the way to that with the least J.
const HALVINGS: u32 = 6;

/// Collects [`LargestImpulses`].
struct LargestAccumulator {
    objective: ObjectiveAccumulator,
    sticking: usize,
    per_speed: f64,
    missed: Vec<f64>,
    largest: Vec<Vec<Largest>>,
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
        let missed = (0..shots.len()).filter(|&i| !self.objective.has_hit_target(i));
        self.missed.extend(missed.map(|i| shots[i].weight));
        self.objective.packet_ends(shots, rays);
        let surfaces = self.largest.len();
        for place in self.touched.drain(..) {
            self.largest[place % surfaces].push(Largest {
                normal: self.in_packet[place],
                weight: shots[place / surfaces].weight,
            });
            self.in_packet[place] = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::evaluate::importance_of;
    use crate::jet::{Samples, Stream};
    use crate::study::Study;

    /// A T-slot on whose floor one shot in a thousand rebounds too hard.
    fn t_slot() -> (Scenario, Settings) {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/search/t_slot.yaml");
        let study = Study::open(&file).expect("it is sound");
        let scenario = study.scenario().clone();
        let settings = Settings {
            incidence: 74.0_f64.to_radians(),
            azimuth: 80.0_f64.to_radians(),
            standoff: 5e-3,
            speed: 36.0,
            ..scenario.problem.ranges.at(0.0)
        };
        (scenario, settings)
    }

    fn mean_and_variance(values: &[f64]) -> (f64, f64) {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares = values.iter().map(|value| (value - mean) * (value - mean));
        (mean, squares.sum::<f64>() / (count - 1.0))
    }

    #[test]
    fn the_best_speed_passes_where_only_those_of_a_narrow_band_do() {
        let (scenario, settings) = t_slot();
        let samples = Samples::new(&scenario.problem, Stream::Search, 1024);
        let impulses = LargestImpulses::of(&scenario, &settings, &samples.shots);
        let whole = scenario.problem.ranges.speed;
        let least = impulses.best_speed(&scenario, whole, |_| 0.0);
        let price = 1e4 * impulses.terms(&scenario, least).total();
        let range = Range {
            min: 0.4 * least,
            max: 2.0 * least,
        };
        for middle in [0.6, 0.89, 0.985, 0.99, 1.015, 1.2, 1.39] {
            let [slowest, fastest] = [0.998, 1.002].map(|part| least * middle * part);
            let excess = |speed: f64| (slowest / speed).max(speed / fastest) - 1.0;
            let cost = |speed: f64| price * excess(speed).max(0.0);
            let speed = impulses.best_speed(&scenario, range, cost);
            assert!((slowest..=fastest).contains(&speed), "{middle}: {speed}");
        }
    }

    #[test]
    fn shares_from_weighted_shots_are_those_of_the_jet_and_rare_ones_more_certain() {
        let (mut scenario, settings) = t_slot();
        let (importance, _) = importance_of(&scenario, &settings);
        let floor = scenario
            .scene
            .surface_named("table.floor")
            .expect("it has one");
        let subjects = [Subject::Surface(floor), Subject::NormalImpulse];
        let asked = Asked {
            allowed: 1.0,
            is_exact: false,
        };
        let share = |scenario: &Scenario, samples: &Samples, subject| {
            let impulses = LargestImpulses::of(scenario, &settings, &samples.shots);
            let share = impulses.share(scenario, (subject, asked), settings.speed);
            share.utilisation()
        };
        let all = Samples::new(&scenario.problem, Stream::Search, 1 << 18);
        for (subject, gains) in subjects.into_iter().zip([0.9, 1.8]) {
            let expected = share(&scenario, &all, subject);
            let (mut weighted, mut plain) = (Vec::new(), Vec::new());
            for seed in 1..=24 {
                scenario.problem.seed = seed;
                let problem = &scenario.problem;
                let samples = Samples::for_shares(problem, Stream::Search, 4096, Some(&importance));
                weighted.push(share(&scenario, &samples, subject));
                let samples = Samples::for_shares(problem, Stream::Search, 4096, None);
                plain.push(share(&scenario, &samples, subject));
            }
            let (mean, variance) = mean_and_variance(&weighted);
            let error = (variance / 24.0).sqrt();
            assert!(
                (mean - expected).abs() < 4.0 * error,
                "{mean} {expected} {error}"
            );
            let (_, of_plain) = mean_and_variance(&plain);
            assert!(
                variance < gains * of_plain,
                "{subject:?}: {variance} {of_plain}"
            );
        }
    }
}
