//! First hits on the target, and how much each dents.

use nalgebra::Point3;
use rayon::prelude::*;

use crate::elementary::{power, square};
use crate::jet::{Replicate, ShotSample};
use crate::problem::equipment::Dent;
use crate::problem::stroke::Leg;
use crate::scenario::Scenario;
use crate::trace::Tracer;

/// A first hit on the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct FirstHit {
    pub point: Point3<f64>,
    /// The area of its dent over the mean of all.
    pub weight: f64,
}

/// The first hits of each sample, and the diameter of the dent that has the mean area, m.
pub(super) fn fire(
    scenario: &Scenario,
    legs: &[Leg],
    samples: &[Replicate],
    dent: &Dent,
) -> (Vec<Vec<FirstHit>>, f64) {
    let mut scenario = scenario.clone();
    scenario.problem.paths.impacts = 1;
    let of_sample = |sample: &Replicate| {
        let of_leg = |leg: &Leg| hits_of(&scenario, leg, legs, sample, dent);
        legs.iter().flat_map(of_leg).collect()
    };
    let mut hits: Vec<Vec<FirstHit>> = samples.par_iter().map(of_sample).collect();
    if let Dent::Diameter(diameter) = *dent {
        return (hits, diameter);
    }
    let count: usize = hits.iter().map(Vec::len).sum();
    let squares: f64 = hits.iter().flatten().map(|hit| hit.weight).sum();
    let mean = squares / count.max(1) as f64;
    for hit in hits.iter_mut().flatten().filter(|_| mean > 0.0) {
        hit.weight /= mean;
    }
    (hits, mean.sqrt())
}

/// The hits of a leg's shots, each with the square of its dent's diameter, or with 1 where all dents are the same.
fn hits_of(
    scenario: &Scenario,
    leg: &Leg,
    legs: &[Leg],
    sample: &Replicate,
    dent: &Dent,
) -> Vec<FirstHit> {
    let all = sample.jet.shots.iter();
    let shots: Vec<ShotSample> = all
        .filter(|shot| legs.len() == 1 || std::ptr::eq(Leg::at(legs, shot.place), leg))
        .copied()
        .collect();
    let tracer = Tracer::new(scenario, &leg.settings, leg.settings.speed);
    let shot = &scenario.problem.shot;
    let restitution = scenario
        .contact_on(scenario.target.surface, &leg.settings)
        .restitution;
    let weight = |relative_mass: f64, normal_impulse: f64| {
        if matches!(dent, Dent::Diameter(_)) {
            return 1.0;
        }
        let per_mass = normal_impulse / (shot.mass() * relative_mass);
        let speed = restitution.approach_speed(per_mass);
        let size = power(relative_mass, 1.0 / 3.0);
        square(dent.diameter(shot, size, restitution.at(speed), speed))
    };
    let paths = tracer.paths(&shots);
    let pairs = shots.iter().zip(&paths);
    let first = pairs.flat_map(|(shot, path)| {
        let counted = path.impacts.iter();
        let first = counted.filter(|impact| impact.number == 1 && impact.on_target);
        first.map(|impact| FirstHit {
            point: impact.point,
            weight: weight(shot.mass(), impact.normal_impulse),
        })
    });
    first.collect()
}
