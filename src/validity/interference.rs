//! Whether rebounding shots meet incoming ones.

use nalgebra::Vector3;

use super::Note;
use crate::elementary::tan;
use crate::evaluate::Evaluation;
use crate::jet::{Pose, ShotSample};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::trace::{End, Tracer};

/// Mean number of encounters from which they show in the figures.
const SHOWS: f64 = 0.1;
/// From here on every third rebound is another than was computed.
const SPOILS: f64 = 0.3;
/// The name of the note then.
pub const STRONG: &str = "interference_strong";
/// A scene that fewer than this share of the shots leave is nearly closed.
const NEARLY_CLOSED: f64 = 0.5;
/// Shots that stay in the jet meet others without end; a record holds finite numbers only.
const MOST: f64 = 1e6;

/// The jet where it meets the target.
struct Stream {
    /// Its velocity, m/s.
    velocity: Vector3<f64>,
    /// Its radius at the target, m.
    radius: f64,
    /// Its length, m.
    length: f64,
    /// Shots per volume, 1/m3.
    density: f64,
}

/// How many incoming shots a rebounding one meets on its way out of the jet.
pub(super) fn note(
    scenario: &Scenario,
    settings: &Settings,
    evaluation: Option<&Evaluation>,
) -> Option<Note> {
    let flow = scenario.problem.jet.mass_flow?;
    if scenario.surfaces.iter().any(|surface| surface.deflector) {
        return Some(unknown_behind_a_deflector());
    }
    let stream = Stream::new(scenario, settings, flow);
    let rebound = mean_rebound(scenario, settings)?;
    let passes = passes(evaluation);
    let diameter = 2.0 * scenario.problem.shot.radius;
    let encounters = (stream.encounters(&rebound, diameter) * passes).min(MOST);
    let (name, verdict) = if encounters >= SPOILS {
        (
            STRONG,
            "as many incoming shots are turned as rebounds, so shots cannot be called independent: N*, misses, \
             rebounds and coverage of this sheet are not to be relied on",
        )
    } else if encounters >= SHOWS {
        (
            "interference",
            "that many rebounds are deflected on their way and as many incoming shots are turned, which N*, \
             misses, rebounds and coverage leave out",
        )
    } else {
        ("interference", "too few to matter")
    };
    Some(Note {
        name,
        value: encounters,
        text: format!(
            "at {:.3} kg/min a rebounding shot meets {encounters:.3} incoming ones on average: {verdict}",
            flow * 60.0
        ),
    })
}

/// The estimate is for a jet that meets the target along its axis.
fn unknown_behind_a_deflector() -> Note {
    Note {
        name: "interference_unknown",
        value: 0.0,
        text: "whether rebounding shots meet incoming ones is not estimated for a jet that a deflector turns"
            .into(),
    }
}

impl Stream {
    fn new(scenario: &Scenario, settings: &Settings, mass_flow: f64) -> Self {
        let (jet, shot) = (&scenario.problem.jet, &scenario.problem.shot);
        let spread = settings.standoff * tan(jet.divergence);
        // A jet of no width is as wide as its shots.
        let radius = (jet.exit_diameter / 2.0 + spread).max(shot.radius);
        let area = std::f64::consts::PI * radius * radius;
        Self {
            velocity: Pose::new(&scenario.target.frame, settings).direction * settings.speed,
            radius,
            length: settings.standoff,
            density: mass_flow / (shot.mass() * settings.speed * area),
        }
    }

    /// Lambda = n pi d^2 |v_in - v_out| t, with t the time for which the shot, starting on the axis
    /// at the target, stays in the jet: until it is out of its side or back at the exit.
    fn encounters(&self, rebound: &Vector3<f64>, diameter: f64) -> f64 {
        let axis = self.velocity.normalize();
        let back = -rebound.dot(&axis);
        let sideways = (rebound + axis * back).norm();
        let until = |way: f64, speed: f64| {
            if speed > 0.0 {
                way / speed
            } else {
                f64::INFINITY
            }
        };
        let time = until(self.length, back).min(until(self.radius, sideways));
        let cross_section = std::f64::consts::PI * diameter * diameter;
        self.density * cross_section * (self.velocity - rebound).norm() * time
    }
}

/// Velocity after its first hit of the mean shot, on the axis, m/s; `None` when it hits nothing.
fn mean_rebound(scenario: &Scenario, settings: &Settings) -> Option<Vector3<f64>> {
    let mut rebound = None;
    Tracer::new(scenario, settings, settings.speed).follow(&ShotSample::NONE, |impact| {
        rebound = rebound.or(Some(impact.velocity));
    });
    rebound
}

/// How often a shot is on its way out: once, or in a nearly closed scene after each of its impacts.
fn passes(evaluation: Option<&Evaluation>) -> f64 {
    evaluation.map_or(1.0, |evaluation| {
        let left = evaluation.ends.get(&End::Left).copied().unwrap_or(0.0);
        if left < NEARLY_CLOSED {
            evaluation.impacts_per_shot.max(1.0)
        } else {
            1.0
        }
    })
}
