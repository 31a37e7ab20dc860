//! What acts on a shot between exit and target: gravity and the drag of the air.

use super::Note;
use crate::elementary::{exp, power};
use crate::problem::setting::Choice;
use crate::setup::Setup;

/// Air at 20 deg C and 1013 hPa: density, kg/m3, and dynamic viscosity, Pa s (ISO 2533 values).
const AIR: (f64, f64) = (1.204, 1.81e-5);
/// Standard gravity, m/s2.
const GRAVITY: f64 = 9.806_65;
/// A loss of speed from which N* misses its target by about as much.
const MATTERS: f64 = 0.03;
/// Steps along the flight; the loss is then right to far better than the drag law is.
const STEPS: usize = 64;

pub(super) fn gravity(choice: &Choice) -> Note {
    let time = choice.standoff / choice.speed;
    let drop = 0.5 * GRAVITY * time * time;
    Note {
        name: "gravity",
        value: drop,
        text: format!(
            "gravity is left out: a shot falls {:.2} um on its way to the target",
            drop * 1e6
        ),
    }
}

/// Share of the speed lost on the way to the target.
pub(super) fn drag(setup: &Setup, choice: &Choice) -> Note {
    let shot = setup.problem.shot;
    let left = speed_left(2.0 * shot.radius, shot.density, choice);
    let loss = 1.0 - left / choice.speed;
    let advice = if loss > MATTERS {
        "; N* falls by as much, unless the speed is measured at the target"
    } else {
        ""
    };
    Note {
        name: "drag",
        value: loss,
        text: format!(
            "drag is left out: in air at rest a shot loses {:.2} % of its speed before the target{advice}",
            loss * 100.0
        ),
    }
}

/// Speed at the end of the flight, m/s: dv/dx = -decay(v) v, each step with the decay of its middle.
fn speed_left(diameter: f64, density: f64, choice: &Choice) -> f64 {
    let step = choice.standoff / STEPS as f64;
    let after = |speed: f64, at: f64, way: f64| speed * exp(-decay(diameter, density, at) * way);
    let mut speed = choice.speed;
    for _ in 0..STEPS {
        let middle = after(speed, speed, 0.5 * step);
        speed = after(speed, middle, step);
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
