//! From impacts to named terms, to J, and to the speed that makes J least.

use crate::jet::Deviate;
use crate::problem::goal::Goals;
use crate::problem::setting::{Choice, Range};
use crate::setup::Setup;
use crate::trace::{PathImpact, Tracer};

/// The terms of the objective with their weights, so that they add up to J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Terms {
    /// First hits on target: squared relative error of the normal impulse.
    pub normal_impulse: f64,
    /// First hits on target: squared excess of the tangential impulse.
    pub tangential_impulse: f64,
    /// Impacts on secondary surfaces: squared normal impulse over what they may take.
    pub rebound: f64,
    /// Shots whose first hit is not on the target.
    pub miss: f64,
}

impl Terms {
    /// J.
    pub fn total(&self) -> f64 {
        self.normal_impulse + self.tangential_impulse + self.rebound + self.miss
    }
}

/// What the objective needs to know of the shots of one pose, per unit of launch speed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Number of shots.
    pub shots: usize,
    /// What those shots stand for together.
    pub weight: f64,
    /// What those whose first hit is not on the target stand for.
    pub missed: f64,
    /// Impulses of the first hits on target, N s per m/s.
    pub hits: Vec<Impulses>,
    /// Sum over shots and impacts on secondary surfaces of weight (N*/N_allow)^2, per (m/s)^2.
    pub rebound: f64,
    /// Number of rays cast.
    pub rays: usize,
}

/// Impulses per unit of launch speed, N s per m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulses {
    /// Normal.
    pub normal: f64,
    /// Tangential.
    pub tangential: f64,
    /// What the shot stands for.
    pub weight: f64,
}

/// Shots whose sums are added up first, so that sums do not depend on how work is shared out.
const CHUNK: usize = 256;

impl Tally {
    /// Traces shots that leave at `speed` times their own factor, m/s.
    pub fn trace(setup: &Setup, choice: &Choice, speed: f64, shots: &[Deviate]) -> Self {
        let tracer = Tracer::new(setup, choice, speed);
        let mut tallier = Tallier::new(setup, speed, shots.len());
        for deviate in shots {
            let (_, rays) =
                tracer.follow(deviate, |impact| tallier.add_impact(impact, deviate.weight));
            tallier.end_shot(rays, deviate.weight);
        }
        tallier.finish()
    }

    /// The terms at a launch speed, m/s.
    pub fn terms(&self, goals: &Goals, speed: f64) -> Terms {
        self.sums(goals, speed).terms(goals)
    }

    /// The sums behind the terms at a launch speed, m/s.
    pub fn sums(&self, goals: &Goals, speed: f64) -> Sums {
        let target = goals.normal_impulse.target;
        let limit = goals
            .tangential_impulse
            .map_or(f64::INFINITY, |goal| goal.limit);
        let mut total = Sums {
            weight: self.weight,
            missed: self.missed,
            normal: 0.0,
            tangential: 0.0,
            rebound: self.rebound * speed * speed,
        };
        for chunk in self.hits.chunks(CHUNK) {
            let (mut normal, mut tangential) = (0.0, 0.0);
            for hit in chunk {
                normal += hit.weight * (hit.normal * speed / target - 1.0).powi(2);
                tangential += hit.weight * (hit.tangential * speed / limit - 1.0).max(0.0).powi(2);
            }
            total.normal += normal;
            total.tangential += tangential;
        }
        total
    }

    /// The speed in `range` that makes J least on these paths.
    ///
    /// On fixed paths J is convex and piecewise quadratic in the speed: its slope is continuous
    /// and rises, so Newton steps inside a shrinking bracket end at the exact minimum.
    pub fn best_speed(&self, goals: &Goals, range: Range) -> f64 {
        let (mut low, mut high) = (range.min, range.max);
        let mut speed = range.at(0.5);
        for _ in 0..MOST_NEWTON_STEPS {
            let (slope, curvature) = self.slope_and_curvature(goals, speed);
            if slope > 0.0 {
                high = speed;
            } else {
                low = speed;
            }
            if slope == 0.0 || curvature == 0.0 {
                break;
            }
            let newton = speed - slope / curvature;
            let next = if newton > low && newton < high {
                newton
            } else if slope > 0.0 && newton <= range.min {
                range.min
            } else if slope < 0.0 && newton >= range.max {
                range.max
            } else {
                0.5 * (low + high)
            };
            let settled = (next - speed).abs() <= 4.0 * f64::EPSILON * speed;
            speed = next;
            if settled {
                break;
            }
        }
        speed
    }

    fn slope_and_curvature(&self, goals: &Goals, speed: f64) -> (f64, f64) {
        let target = goals.normal_impulse.target;
        let (mut slope, mut curvature) = (0.0, 0.0);
        let tangential = goals.tangential_impulse;
        for chunk in self.hits.chunks(CHUNK) {
            let (mut chunk_slope, mut chunk_curvature) = (0.0, 0.0);
            for hit in chunk {
                let gain = hit.normal / target;
                let weight = hit.weight * goals.normal_impulse.weight;
                chunk_slope += weight * (gain * speed - 1.0) * gain;
                chunk_curvature += weight * gain * gain;
                if let Some(goal) = tangential {
                    let gain = hit.tangential / goal.limit;
                    if gain * speed > 1.0 {
                        let weight = hit.weight * goal.weight;
                        chunk_slope += weight * (gain * speed - 1.0) * gain;
                        chunk_curvature += weight * gain * gain;
                    }
                }
            }
            slope += chunk_slope;
            curvature += chunk_curvature;
        }
        let hits = if self.hits.is_empty() {
            1.0
        } else {
            self.weight - self.missed
        };
        let rebound = self.rebound / self.weight;
        (
            2.0 * (slope / hits + rebound * speed),
            2.0 * (curvature / hits + rebound),
        )
    }
}

const MOST_NEWTON_STEPS: usize = 100;

/// Builds a [`Tally`] impact by impact.
pub struct Tallier<'a> {
    setup: &'a Setup,
    speed: f64,
    tally: Tally,
    hit_target: bool,
    chunk_weight: f64,
    chunk_missed: f64,
    chunk_rebound: f64,
}

impl<'a> Tallier<'a> {
    /// For shots that were traced at a launch speed, m/s.
    pub fn new(setup: &'a Setup, speed: f64, shots: usize) -> Self {
        let tally = Tally {
            hits: Vec::with_capacity(shots),
            ..Tally::default()
        };
        Self {
            setup,
            speed,
            tally,
            hit_target: false,
            chunk_weight: 0.0,
            chunk_missed: 0.0,
            chunk_rebound: 0.0,
        }
    }

    /// Adds one impact of the current shot.
    #[inline]
    pub fn add_impact(&mut self, impact: &PathImpact, weight: f64) {
        self.hit_target |= impact.on_target && impact.number == 1;
        if !impact.on_target {
            let limits = &self.setup.surfaces[impact.surface as usize];
            if let Some(allow) = limits.allow {
                self.chunk_rebound +=
                    weight * limits.weight * (impact.normal_impulse / allow).powi(2);
            }
        } else if impact.number == 1 {
            self.tally.hits.push(Impulses {
                normal: impact.normal_impulse / self.speed,
                tangential: impact.tangential_impulse / self.speed,
                weight,
            });
        }
    }

    /// Ends the current shot, which took this many rays.
    #[inline]
    pub fn end_shot(&mut self, rays: usize, weight: f64) {
        self.tally.shots += 1;
        self.chunk_weight += weight;
        if !self.hit_target {
            self.chunk_missed += weight;
        }
        self.hit_target = false;
        self.tally.rays += rays;
        if self.tally.shots.is_multiple_of(CHUNK) {
            self.close_chunk();
        }
    }

    /// Adds a whole shot that stands for itself.
    pub fn add_shot(&mut self, path: &[PathImpact], rays: usize) {
        path.iter().for_each(|impact| self.add_impact(impact, 1.0));
        self.end_shot(rays, 1.0);
    }

    /// The tally of all shots.
    pub fn finish(mut self) -> Tally {
        self.close_chunk();
        self.tally
    }

    fn close_chunk(&mut self) {
        self.tally.rebound += self.chunk_rebound / (self.speed * self.speed);
        self.tally.weight += self.chunk_weight;
        self.tally.missed += self.chunk_missed;
        (self.chunk_rebound, self.chunk_weight, self.chunk_missed) = (0.0, 0.0, 0.0);
    }
}

/// Sums over shots from which the terms follow; those of several sets of shots add up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    weight: f64,
    missed: f64,
    normal: f64,
    tangential: f64,
    rebound: f64,
}

impl Sums {
    /// The sums of both sets of shots.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            weight: self.weight + other.weight,
            missed: self.missed + other.missed,
            normal: self.normal + other.normal,
            tangential: self.tangential + other.tangential,
            rebound: self.rebound + other.rebound,
        }
    }

    /// The terms, averaged as the objective says.
    pub fn terms(&self, goals: &Goals) -> Terms {
        let tangential_weight = goals.tangential_impulse.map_or(0.0, |goal| goal.weight);
        let share_of_hits = |sum: f64| {
            let hits = self.weight - self.missed;
            if hits > 0.0 { sum / hits } else { 0.0 }
        };
        Terms {
            normal_impulse: goals.normal_impulse.weight * share_of_hits(self.normal),
            tangential_impulse: tangential_weight * share_of_hits(self.tangential),
            rebound: self.rebound / self.weight,
            miss: goals.miss.weight * self.missed / self.weight,
        }
    }
}
