//! Which of those that a shop rarely knows moves the result most: restitution, friction, or where the walls are.
//!
//! Where a problem gives restitution or friction a tolerance, each shot of an answer draws its own. Here one of
//! them at a time is held at the end of its range for all shots, while the others keep their nominal
//! values; all ends are evaluated on the same shots. Walls from CAD are as far off as their mesh file says.

use rayon::prelude::*;

use crate::elementary::atan2;
use crate::evaluate::evaluate;
use crate::jet::{Replicate, Replicates, ShotSample, purpose};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::trace::{PathImpact, Tracer};
use crate::verdict::{Subject, Verdict};

/// What is not known exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The normal coefficient of restitution.
    Restitution,
    /// Both friction coefficients at once.
    Friction,
    /// How far the walls are on the near side of the triangles that approximate them, m.
    Walls,
}

/// What the nominal contact does, and what the ends of each range do.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknowns {
    /// With all at their nominal values.
    pub nominal: Outcome,
    /// One for each that is not known exactly.
    pub ranges: Vec<UnknownRange>,
}

/// One that is not known exactly, at both ends of its range.
#[derive(Clone, Debug, PartialEq)]
pub struct UnknownRange {
    /// Which one.
    pub quantity: Quantity,
    /// Restitution or static friction at the target, or where walls are, at the ends and what that does, low end first.
    pub ends: [(f64, Outcome); 2],
}

/// What an answer does with one contact for all shots.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// J.
    pub objective: f64,
    /// Mean angle between path and surface after first hits on target, rad; `None` without any.
    /// A shot that stays on the surface has 0.
    pub rebound_angle: Option<f64>,
    /// Mean N* of first hits on target, N s; 0 without any.
    pub normal_impulse: f64,
    /// The share of shots over each limit.
    pub shares: Vec<(Subject, f64)>,
}

/// Shots behind each effect.
const SHOTS: usize = 4096;

impl Unknowns {
    /// Evaluates both ends of what is not known exactly; `None` where everything is.
    pub fn of(scenario: &Scenario, settings: &Settings) -> Option<Self> {
        let tolerance = &scenario.problem.tolerance;
        let given = [
            (Quantity::Restitution, tolerance.restitution),
            (Quantity::Friction, tolerance.friction),
            (Quantity::Walls, scenario.scene.deflection()),
        ];
        if given.iter().all(|(_, half_width)| *half_width == 0.0) {
            return None;
        }
        let shots = common_shots(scenario);
        let effect = |quantity: Quantity, change: f64| {
            let settings = quantity.changed_settings(settings, change);
            Outcome::of(scenario, &settings, &with(&shots, quantity, change))
        };
        let ranges = given
            .into_iter()
            .filter(|(_, half_width)| *half_width > 0.0)
            .map(|(quantity, half_width)| UnknownRange {
                quantity,
                ends: [-half_width, half_width].map(|change| {
                    let value = quantity.at_target(scenario, settings, change);
                    (value, effect(quantity, change))
                }),
            })
            .collect();
        Some(Self {
            nominal: effect(Quantity::Restitution, 0.0),
            ranges,
        })
    }
}

impl Quantity {
    /// Its value at the target after a change: relative for friction, absolute for the others.
    fn at_target(self, scenario: &Scenario, settings: &Settings, change: f64) -> f64 {
        let contact = scenario.contact_on(scenario.target.surface, settings);
        match self {
            Self::Restitution => contact.restitution.shifted(change).reference(),
            Self::Friction => contact.static_friction * (1.0 + change),
            Self::Walls => change,
        }
    }

    /// Settings that are to walls in their place what these are to walls that are nearer.
    fn changed_settings(self, settings: &Settings, change: f64) -> Settings {
        match self {
            Self::Restitution | Self::Friction => *settings,
            Self::Walls => Settings {
                aim_above: settings.aim_above - change,
                ..*settings
            },
        }
    }

    /// The shot with this one changed and the other one nominal.
    fn change(self, sample: &ShotSample, change: f64) -> ShotSample {
        match self {
            Self::Restitution => ShotSample {
                restitution: change,
                ..*sample
            },
            Self::Friction => ShotSample {
                friction: 1.0 + change,
                ..*sample
            },
            Self::Walls => *sample,
        }
    }
}

/// Shots that meet the nominal contact.
fn common_shots(scenario: &Scenario) -> Replicates {
    let mut problem = scenario.problem.clone();
    problem.tolerance.restitution = 0.0;
    problem.tolerance.friction = 0.0;
    Replicates::new(&problem, purpose::UNKNOWNS, SHOTS)
}

fn with(shots: &Replicates, quantity: Quantity, change: f64) -> Replicates {
    let mut shots = shots.clone();
    for Replicate { jet, boundary } in &mut shots.sets {
        for sample in jet.shots.iter_mut().chain(&mut boundary.shots) {
            *sample = quantity.change(sample, change);
        }
    }
    shots
}

impl Outcome {
    fn of(scenario: &Scenario, settings: &Settings, shots: &Replicates) -> Self {
        let evaluation = evaluate(scenario, settings, shots);
        let shares = Verdict::all(scenario, &evaluation)
            .iter()
            .map(|verdict| (verdict.subject, verdict.share()))
            .collect();
        Self {
            objective: evaluation.terms.total(),
            rebound_angle: mean_rebound_angle(scenario, settings, shots),
            normal_impulse: evaluation.target.normal_impulse.mean,
            shares,
        }
    }
}

fn mean_rebound_angle(scenario: &Scenario, settings: &Settings, shots: &Replicates) -> Option<f64> {
    let sums: Vec<(f64, usize)> = shots
        .sets
        .par_iter()
        .map(|set| sum_of_rebound_angles(scenario, settings, &set.jet.shots))
        .collect();
    let (sum, count) = sums.iter().fold((0.0, 0), |(sum, count), (more, hits)| {
        (sum + more, count + hits)
    });
    (count > 0).then(|| sum / count as f64)
}

/// Sum over first hits on target, and their number.
fn sum_of_rebound_angles(
    scenario: &Scenario,
    settings: &Settings,
    shots: &[ShotSample],
) -> (f64, usize) {
    let tracer = Tracer::new(scenario, settings, settings.speed);
    let contact = scenario.contact_on(scenario.target.surface, settings);
    let (mut sum, mut hits) = (0.0, 0);
    for (shot, path) in shots.iter().zip(tracer.paths(shots)) {
        let restitution = contact.restitution.shifted(shot.restitution);
        let mass = scenario.problem.shot.mass() * shot.mass();
        let first = |impact: &&PathImpact| impact.number == 1 && impact.on_target;
        if let Some(impact) = path.impacts.iter().find(first) {
            // What N* tells of the speed of arrival, E tells of the departure.
            let arriving = restitution.approach_speed(impact.normal_impulse / mass);
            let leaving = restitution.at(arriving) * arriving;
            sum += atan2(leaving, tangential_part(impact.velocity.norm(), leaving));
            hits += 1;
        }
    }
    (sum, hits)
}

/// The other leg of a right-angled triangle; 0 where rounding leaves none.
fn tangential_part(speed: f64, normal: f64) -> f64 {
    (speed * speed - normal * normal).max(0.0).sqrt()
}
