//! How much rounding may move the impacts of a path: what a small change of the shot grows to until
//! then, which has no limit where a shot grazes a round wall or comes to an edge between two facets.
//!
//! A mesh that is turned has its corners rounded anew, to 1e-17 m where it stands 0.1 m from the origin;
//! its facets, at least 0.2 mm high here, are tilted by up to 1e-13. What is allowed for is ten times that.
//! Beyond an edge a facet is tilted by far more: whichever shot comes to one as near as it is nudged
//! is compared up to there. Of 256 shots 99 % are compared to their end, and in each world an eighth.

use nalgebra::Vector3;
use peenpose::jet::ShotSample;
use peenpose::scenario::Scenario;
use peenpose::trace::{PathImpact, Tracer};

use crate::common::held::held;
use crate::physics_properties::view::path;

/// Relative rounding of a place, a direction or a speed where nothing makes it grow.
const ROUNDING: f64 = 1e-12;
/// Relative change of the shots that are traced beside one.
const NUDGE: f64 = 1e-9;
/// Where impacts are moved by more than this, they say no more of each other.
pub const MOST: f64 = 1e-6;

/// Whether all impacts of a shot can be compared.
pub fn is_steady(scenario: &Scenario, shot: &ShotSample) -> bool {
    roundings(scenario, shot).len() == path(scenario, shot).len()
}

/// Relative rounding of the impacts of a path, one after the other, as far as they can be compared.
pub fn roundings(scenario: &Scenario, shot: &ShotSample) -> Vec<f64> {
    let size = scenario.scene.size();
    let settings = held(scenario);
    let momentum = scenario.problem.shot.mass() * settings.speed;
    if starts_in_a_wall(scenario, shot) {
        return Vec::new();
    }
    let here = path(scenario, shot);
    let beside = beside(shot, size).map(|shot| path(scenario, &shot));
    // Of what comes in at the start and at each impact, what it is worth at the start.
    let mut sources = 1.0;
    let mut all = Vec::new();
    for (number, impact) in here.iter().enumerate() {
        let growth = beside.iter().map(|path| match path.get(number) {
            Some(moved) => apart(impact, moved, size, momentum) / NUDGE,
            None => f64::INFINITY,
        });
        let growth = growth.fold(0.0, f64::max);
        sources += 1.0 / growth;
        let off = ROUNDING * (growth * sources).max(1.0);
        if off.is_nan() || off > MOST {
            break;
        }
        all.push(off);
    }
    all
}

/// Whether a shot leaves the nozzle inside a wall, or inside two at once.
pub fn starts_in_a_wall(scenario: &Scenario, shot: &ShotSample) -> bool {
    let settings = held(scenario);
    let tracer = Tracer::new(scenario, &settings, settings.speed);
    let exit = tracer.launch(shot).origin;
    let path = path(scenario, shot);
    path.first().is_some_and(|first| first.centre == exit)
}

/// The shot with each coordinate of its exit and of its direction nudged.
fn beside(shot: &ShotSample, size: f64) -> [ShotSample; 4] {
    let [x, y] = shot.exit;
    let [across, upward, forward] = shot.cone;
    let exit = |x: f64, y: f64| ShotSample {
        exit: [x, y],
        ..*shot
    };
    let cone = |across: f64, upward: f64| ShotSample {
        cone: Vector3::new(across, upward, forward).normalize().into(),
        ..*shot
    };
    [
        exit(x + NUDGE * size, y),
        exit(x, y + NUDGE * size),
        cone(across + NUDGE, upward),
        cone(across, upward + NUDGE),
    ]
}

/// Relative difference of two impacts; infinite where they are different events.
fn apart(one: &PathImpact, other: &PathImpact, size: f64, momentum: f64) -> f64 {
    if (one.number, one.surface, one.regime) != (other.number, other.surface, other.regime) {
        return f64::INFINITY;
    }
    let speed = one.velocity.norm() + one.rolling.norm();
    let moved = [
        (one.point - other.point).norm() / size,
        (one.normal - other.normal).norm(),
        (one.velocity - other.velocity).norm() / speed,
        (one.rolling - other.rolling).norm() / speed,
        (one.normal_impulse - other.normal_impulse).abs() / momentum,
        (one.tangential_impulse - other.tangential_impulse).abs() / momentum,
    ];
    moved.into_iter().fold(0.0, f64::max)
}
