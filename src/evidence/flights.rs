//! Shots on their way, with every impact.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use super::Shape;
use crate::control::Cancel;
use crate::elementary::asin;
use crate::jet::{Samples, ShotSample};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::trace::{End, Path, PathImpact, Tracer};
use crate::verdict::Subject;

/// One shot on its way.
#[derive(Clone, Debug)]
pub struct Flight {
    /// Where it leaves the nozzle, m.
    pub start: Point3<f64>,
    /// Its impacts; those on deflectors have the number 0.
    pub impacts: Vec<PathImpact>,
    /// Why its path ends.
    pub end: End,
    /// For one that leaves: where, a little outside the box round scene and path, m.
    pub gone: Option<Point3<f64>>,
}

/// Room round the scene in which leaving shots are still seen, as a share of its diagonal.
const MARGIN: f64 = 0.05;

/// Shots that are fired before it is asked whether there is time for more.
const BATCH: usize = 1024;
/// Shots that one thread traces at a time.
const PART: usize = 128;

/// The flights of some shots, in their order, or of the first ones after a request to end.
pub(super) fn fire(
    scenario: &Scenario,
    settings: &Settings,
    jet: &Samples,
    shapes: &[Shape],
    cancel: &Cancel,
) -> Vec<Flight> {
    let tracer = Tracer::new(scenario, settings, settings.speed);
    let scene = Limits::of(shapes);
    let flight = |(sample, path): (&ShotSample, Path)| {
        let ray = tracer.launch(sample);
        let Path { impacts, end, .. } = path;
        let (last, heading) = match impacts.last() {
            Some(impact) => (impact.centre, impact.velocity.normalize()),
            None => (ray.origin, ray.direction),
        };
        let gone = (end == End::Left).then(|| {
            let shown = scene.with(&ray.origin).with(&last).wider();
            last + heading * shown.way_out(&last, &heading)
        });
        Flight {
            start: ray.origin,
            impacts,
            end,
            gone,
        }
    };
    let packets = jet.shots.chunks(BATCH).enumerate();
    let packets = packets.take_while(|(number, _)| *number == 0 || !cancel.is_set());
    let mut flights = Vec::with_capacity(jet.shots.len());
    for (_, packet) in packets {
        let parts = packet.par_chunks(PART);
        flights.par_extend(
            parts.flat_map_iter(|part| part.iter().zip(tracer.paths(part)).map(flight)),
        );
    }
    flights
}

impl Flight {
    /// The first hit, if it is on the target.
    pub fn hit_on_target(&self) -> Option<&PathImpact> {
        let first = self.impacts.iter().find(|impact| impact.number == 1)?;
        first.on_target.then_some(first)
    }

    /// Where its centre is: at the exit, at every impact, and last where it leaves, m.
    pub fn corners(&self) -> impl Iterator<Item = Point3<f64>> + '_ {
        let impacts = self.impacts.iter().map(|impact| impact.centre);
        std::iter::once(self.start).chain(impacts).chain(self.gone)
    }

    /// Angle between flight and surface at the first hit, rad; a right angle is perpendicular.
    pub fn angle_of_first_hit(&self) -> Option<f64> {
        let index = self.impacts.iter().position(|impact| impact.number == 1)?;
        let from = match index {
            0 => self.start,
            _ => self.impacts[index - 1].centre,
        };
        let first = &self.impacts[index];
        let heading = (first.centre - from).try_normalize(0.0)?;
        Some(asin(heading.dot(&first.normal).abs().min(1.0)))
    }

    /// The goals and limits that it breaks, each once.
    pub fn broken(&self, scenario: &Scenario) -> Vec<Subject> {
        let mut broken = Vec::new();
        if self.hit_on_target().is_none() {
            broken.push(Subject::Miss);
        }
        broken.extend(
            self.impacts
                .iter()
                .flat_map(|impact| broken_by(impact, scenario)),
        );
        broken.sort_unstable();
        broken.dedup();
        broken
    }
}

/// The goals and limits that an impact breaks.
pub fn broken_by(impact: &PathImpact, scenario: &Scenario) -> Vec<Subject> {
    let goals = &scenario.problem.goals;
    let mut broken = Vec::new();
    let mut note = |is_broken: bool, subject| {
        if is_broken {
            broken.push(subject);
        }
    };
    match (impact.number, impact.on_target) {
        (0, _) => {}
        (1, true) => {
            let goal = goals.normal_impulse;
            let off = goal.is_off(impact.normal_impulse);
            let limit = goals.tangential_impulse.map(|goal| goal.limit);
            note(off, Subject::NormalImpulse);
            let over = limit.is_some_and(|limit| impact.tangential_impulse > limit);
            note(over, Subject::TangentialImpulse);
        }
        (_, true) => {}
        (number, false) => {
            let allow = scenario.surfaces[impact.surface as usize].allow;
            let over = allow.is_some_and(|allow| impact.normal_impulse > allow);
            note(number == 1, Subject::Miss);
            note(over, Subject::Surface(impact.surface));
        }
    }
    broken
}

/// A box along the axes.
#[derive(Clone, Copy)]
struct Limits {
    low: Point3<f64>,
    high: Point3<f64>,
}

impl Limits {
    fn of(shapes: &[Shape]) -> Self {
        let nothing = Self {
            low: Point3::from(Vector3::repeat(f64::INFINITY)),
            high: Point3::from(Vector3::repeat(f64::NEG_INFINITY)),
        };
        let points = shapes.iter().flat_map(|shape| &shape.points);
        points.fold(nothing, |limits, point| limits.with(point))
    }

    fn with(&self, point: &Point3<f64>) -> Self {
        Self {
            low: self.low.inf(point),
            high: self.high.sup(point),
        }
    }

    fn wider(&self) -> Self {
        let margin = Vector3::repeat(MARGIN * (self.high - self.low).norm());
        Self {
            low: self.low - margin,
            high: self.high + margin,
        }
    }

    /// How far it is from a point inside to the outside, m.
    fn way_out(&self, from: &Point3<f64>, heading: &Vector3<f64>) -> f64 {
        let ways = (0..3).filter(|&axis| heading[axis] != 0.0).map(|axis| {
            let face = if heading[axis] > 0.0 {
                self.high[axis]
            } else {
                self.low[axis]
            };
            (face - from[axis]) / heading[axis]
        });
        ways.fold(f64::INFINITY, f64::min)
    }
}
