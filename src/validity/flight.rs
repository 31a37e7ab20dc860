//! What acts on a shot between exit and target: gravity and the drag of the air.

use super::Note;
use crate::digits::{fixed, plain};
use crate::elementary::{exp, power};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// Air at 20 deg C and 1013 hPa: density, kg/m3, and dynamic viscosity, Pa s (ISO 2533 values).
const AIR: (f64, f64) = (1.204, 1.81e-5);
/// Standard gravity, m/s2.
const GRAVITY: f64 = 9.806_65;
/// A loss of speed from which N* misses its target by about as much.
const MATTERS: f64 = 0.03;
/// Steps along the flight; the loss is then right to far better than the drag law is.
const STEPS: usize = 64;

pub(super) fn gravity(settings: &Settings) -> Note {
    let time = settings.standoff / settings.speed;
    let drop = 0.5 * GRAVITY * time * time;
    Note {
        name: "gravity",
        value: drop,
        text: format!(
            "gravity is left out: a shot falls {} um on its way to the target",
            fixed(drop * 1e6, 2)
        ),
    }
}

/// Share of the speed lost or gained on the way to the target.
pub(super) fn drag(scenario: &Scenario, settings: &Settings) -> Note {
    let shot = scenario.problem.shot;
    let end = speed_at_end(
        2.0 * shot.radius,
        shot.density,
        settings,
        scenario.problem.jet.air_speed,
    );
    let gain = end / settings.speed - 1.0;
    let follows = |how: &str| {
        if gain.abs() > MATTERS {
            format!("; N* {how} by as much, unless the speed is measured at the target")
        } else {
            String::new()
        }
    };
    let Some(air) = scenario.problem.jet.air_speed else {
        return Note {
            name: "drag",
            value: -gain,
            text: format!(
                "drag is left out: in still air a shot loses {:.2} % of its speed before the target{}; the air \
                 of an air nozzle is faster than its shot and speeds it up (jet.air_speed tells by how much)",
                -gain * 100.0,
                follows("falls"),
            ),
        };
    };
    let (what, how) = if gain < 0.0 {
        ("loses", "falls")
    } else {
        ("gains", "rises")
    };
    Note {
        name: "air",
        value: gain,
        text: format!(
            "the air is left out: in air of {} m/s up to the target a shot {what} {} % of its speed{}; slower \
             air beside and beyond the jet's core changes less",
            plain(air),
            fixed(gain.abs() * 100.0, 2),
            follows(how),
        ),
    }
}

/// Speed at the end of the flight, m/s, in air that moves along at a speed, or rests.
fn speed_at_end(diameter: f64, density: f64, settings: &Settings, air: Option<f64>) -> f64 {
    match air {
        None => speed_left(diameter, density, settings),
        Some(air) => speed_in_moving_air(diameter, density, settings, air),
    }
}

/// The same in air at rest: dv/dx = -decay(v) v, each step with the decay of its middle.
fn speed_left(diameter: f64, density: f64, settings: &Settings) -> f64 {
    let step = settings.standoff / STEPS as f64;
    let after = |speed: f64, at: f64, way: f64| speed * exp(-decay(diameter, density, at) * way);
    let mut speed = settings.speed;
    for _ in 0..STEPS {
        let middle = after(speed, speed, 0.5 * step);
        speed = after(speed, middle, step);
    }
    speed
}

/// The same in moving air, which draws at the shot with the speed u that it has relative to it:
/// dv/dt = decay(u) u |u|. The shot never gets past the air.
fn speed_in_moving_air(diameter: f64, density: f64, settings: &Settings, air: f64) -> f64 {
    // u falls by this rate in time; within a step it is that of the middle.
    let rate = |speed: f64| {
        let relative = (air - speed).abs();
        if relative > 0.0 {
            decay(diameter, density, relative) * relative
        } else {
            0.0
        }
    };
    let after = |speed: f64, at: f64, time: f64| air - (air - speed) * exp(-rate(at) * time);
    let step = settings.standoff / STEPS as f64;
    let mut speed = settings.speed;
    for _ in 0..STEPS {
        let middle = after(speed, speed, 0.5 * step / speed);
        let mean = after(speed, middle, 0.5 * step / middle);
        speed = after(speed, mean, step / mean);
    }
    speed
}

/// Relative loss of speed per length, 1/m: (3/4) C_d rho_air / (rho d), with the C_d of Schiller and
/// Naumann (1933): 24/Re (1 + 0.15 Re^0.687) below Re = 1000, 0.44 above.
fn decay(diameter: f64, density: f64, speed: f64) -> f64 {
    let (air, viscosity) = AIR;
    let reynolds = air * speed * diameter / viscosity;
    if reynolds >= 1000.0 {
        return 0.75 * 0.44 * air / (density * diameter);
    }
    // C_d goes with 1/Re, so the density of the air drops out of the first factor. A shot that has
    // come to rest has an infinite decay, and stays.
    18.0 * viscosity / (density * diameter * diameter * speed)
        * (1.0 + 0.15 * power(reynolds, 0.687))
}
