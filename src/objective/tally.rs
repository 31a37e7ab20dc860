//! What the objective needs to know of the shots of one pose, and the best speed for them.

use super::hits::{Hits, Moments, moments};
use super::{Sums, Terms};
use crate::jet::ShotSample;
use crate::problem::goal::Goals;
use crate::problem::setting::Range;

/// What the objective needs to know of the shots of one pose, per unit of launch speed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Number of shots.
    pub shots: usize,
    /// Sum of their importance weights.
    pub weight: f64,
    /// The same of those whose first hit is off target.
    pub missed: f64,
    /// The first hits on target.
    pub hits: Hits,
    /// Sum over shots and impacts on secondary surfaces of weight (N*/N_allow)^2, per (m/s)^2.
    pub rebound: f64,
    /// The largest part that one shot has in `missed`.
    pub worst_miss: f64,
    /// The largest part that one impact has in `rebound`.
    pub worst_rebound: f64,
    /// Variance of the shots' factors on the speed, over which all that is quadratic in the speed is
    /// averaged exactly; 0 where paths depend on the speed, and every shot has its own.
    pub speed_variance: f64,
    /// Number of rays cast.
    pub rays: usize,
}

/// Shots that are not traced yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rest {
    /// The sum of their weights.
    weight: f64,
    /// Number of nominal samples among them.
    of_jet: f64,
}

impl Rest {
    /// Of these shots.
    pub fn of(shots: &[ShotSample]) -> Self {
        Self {
            weight: shots.iter().map(|shot| shot.weight).sum(),
            of_jet: shots.iter().filter(|shot| shot.of_jet).count() as f64,
        }
    }
}

impl Tally {
    /// The tally of several sets of shots together.
    pub fn join(parts: Vec<Self>) -> Self {
        let mut all = Self::default();
        for part in parts {
            all.shots += part.shots;
            all.weight += part.weight;
            all.missed += part.missed;
            all.hits.append(part.hits);
            all.rebound += part.rebound;
            all.worst_miss = all.worst_miss.max(part.worst_miss);
            all.worst_rebound = all.worst_rebound.max(part.worst_rebound);
            all.speed_variance = part.speed_variance;
            all.rays += part.rays;
        }
        all
    }

    /// A lower bound of J of all shots over J of these, at any speed: no term is below what it is when the rest
    /// hit the target exactly as wanted and violate nothing.
    pub(crate) fn least_share_with(&self, rest: &Rest) -> f64 {
        let share = |here: f64, there: f64| {
            if here > 0.0 {
                here / (here + there)
            } else {
                1.0
            }
        };
        let shares = [
            share(self.weight, rest.weight),
            share(self.weight - self.missed, rest.weight),
            share(self.hits.of_jet(), rest.of_jet),
        ];
        shares.into_iter().fold(1.0, f64::min)
    }

    /// The terms at a launch speed, m/s.
    pub fn terms(&self, goals: &Goals, speed: f64) -> Terms {
        self.sums(goals, speed).terms(goals)
    }

    /// The sums behind the terms at a launch speed, m/s.
    pub fn sums(&self, goals: &Goals, speed: f64) -> Sums {
        Sums {
            weight: self.weight,
            missed: self.missed,
            hits_of_jet: self.hits.of_jet(),
            normal: self.normal_moments(goals, speed).square,
            tangential: self.tangential_moments(goals, speed).square,
            rebound: self.rebound * speed * speed,
            worst_miss: self.worst_miss,
            worst_rebound: self.worst_rebound * speed * speed,
        }
    }

    /// The speed in `range` that makes J least on these paths.
    ///
    /// On fixed paths J is convex and piecewise quadratic in the speed: its slope is continuous
    /// and rises, so Newton steps inside a shrinking bracket end at the exact minimum.
    pub fn best_speed(&self, goals: &Goals, range: Range) -> f64 {
        let (mut low, mut high) = (range.min, range.max);
        let mut speed = range.at(0.5);
        let smooth = self.smooth_slope(goals, speed);
        let most_tangential = self.hits.most_tangential();
        for _ in 0..MOST_NEWTON_STEPS {
            let excess = self.excess_slope(goals, speed, most_tangential);
            let slope = smooth.at(speed) + excess.value;
            let curvature = smooth.rise + excess.rise;
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

    /// Half the slope of the terms that are quadratic in the speed.
    fn smooth_slope(&self, goals: &Goals, speed: f64) -> Slope {
        let normal = self.normal_moments(goals, speed);
        let rebound = self.rebound / self.weight;
        let weight = goals.normal_impulse.weight / self.hits.of_jet().max(1.0);
        Slope {
            speed,
            value: weight * normal.slope + rebound * speed,
            rise: weight * normal.curvature + rebound,
        }
    }

    /// Half the slope of the term that starts where impulses exceed their limit.
    fn excess_slope(&self, goals: &Goals, speed: f64, most_tangential: f64) -> Slope {
        let exceeds = |limit: f64| most_tangential * speed > limit;
        let goal = goals.tangential_impulse.filter(|goal| exceeds(goal.limit));
        goal.map_or_else(Slope::default, |goal| {
            let moments = self.tangential_moments(goals, speed);
            let weight = goal.weight / self.weight_of_hits();
            Slope {
                speed,
                value: weight * moments.slope,
                rise: weight * moments.curvature,
            }
        })
    }

    fn weight_of_hits(&self) -> f64 {
        if self.hits.is_empty() {
            1.0
        } else {
            self.weight - self.missed
        }
    }

    fn normal_moments(&self, goals: &Goals, speed: f64) -> Moments {
        let Hits {
            normal_at_mean,
            of_jet,
            ..
        } = &self.hits;
        let target = goals.normal_impulse.target;
        moments(normal_at_mean, of_jet, target, speed, false).scattered(self.speed_variance, speed)
    }

    fn tangential_moments(&self, goals: &Goals, speed: f64) -> Moments {
        let Hits {
            tangential, weight, ..
        } = &self.hits;
        goals
            .tangential_impulse
            .map_or_else(Moments::default, |goal| {
                moments(tangential, weight, goal.limit, speed, true)
            })
    }
}

/// Half the slope of a part of J in the speed, and how that rises.
#[derive(Clone, Copy, Debug, Default)]
struct Slope {
    /// Where it is known, m/s.
    speed: f64,
    value: f64,
    rise: f64,
}

impl Slope {
    /// Elsewhere, where it rises evenly.
    fn at(&self, speed: f64) -> f64 {
        self.value + self.rise * (speed - self.speed)
    }
}

const MOST_NEWTON_STEPS: usize = 100;
