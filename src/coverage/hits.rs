//! First hits on the target, and how much each dents.

use std::borrow::Cow;

use nalgebra::Point3;
use rayon::prelude::*;

use super::shots::Shots;
use crate::elementary::{power, square};
use crate::jet::ShotSample;
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

/// The first hits of some shots.
pub(super) struct FirstHits {
    /// Those of each replicate.
    pub hits: Vec<Vec<FirstHit>>,
    /// Diameter of the dent that has the mean area, m.
    pub dent_diameter: f64,
    /// Shots that were fired.
    pub shots: usize,
    /// Mean of their masses over that of the mean shot.
    pub relative_mass: f64,
}

impl FirstHits {
    /// Those of shots that are fired with the settings of some legs.
    pub fn of(scenario: &Scenario, legs: &[Leg], dent: &Dent, fired: &Shots) -> Self {
        let mut scenario = scenario.clone();
        scenario.problem.paths.impacts = 1;
        let of_set = |number: u32| {
            let (mut hits, mut masses) = (Vec::new(), 0.0);
            let shots = fired.fire(number, |shots| {
                masses += shots.iter().map(ShotSample::mass).sum::<f64>();
                for leg in legs {
                    let own = shots_of(leg, legs, shots);
                    hits.extend(hits_of(&scenario, leg, &own, dent));
                }
            });
            (hits, shots, masses)
        };
        let sets: Vec<(Vec<FirstHit>, usize, f64)> =
            (0..fired.sets()).into_par_iter().map(of_set).collect();
        let shots = sets.iter().map(|(_, shots, _)| shots).sum();
        let masses: f64 = sets.iter().map(|(.., masses)| masses).sum();
        let mut hits: Vec<Vec<FirstHit>> = sets.into_iter().map(|(hits, ..)| hits).collect();
        let dent_diameter = match *dent {
            Dent::Diameter(diameter) => diameter,
            Dent::Measured { .. } | Dent::Hardness(_) => {
                let count: usize = hits.iter().map(Vec::len).sum();
                let squares: f64 = hits.iter().flatten().map(|hit| hit.weight).sum();
                let mean = squares / count.max(1) as f64;
                for hit in hits.iter_mut().flatten().filter(|_| mean > 0.0) {
                    hit.weight /= mean;
                }
                mean.sqrt()
            }
        };
        Self {
            hits,
            dent_diameter,
            shots,
            relative_mass: masses / shots as f64,
        }
    }
}

/// Those that are fired with the settings of a leg.
pub(super) fn shots_of<'a>(
    leg: &Leg,
    legs: &[Leg],
    shots: &'a [ShotSample],
) -> Cow<'a, [ShotSample]> {
    let is_own = |shot: &&ShotSample| std::ptr::eq(Leg::at(legs, shot.place), leg);
    match legs {
        [_] => shots.into(),
        _ => shots.iter().filter(is_own).copied().collect(),
    }
}

/// The hits of a leg's shots, each with the square of its dent's diameter, or with 1 where all dents are the same.
fn hits_of(scenario: &Scenario, leg: &Leg, shots: &[ShotSample], dent: &Dent) -> Vec<FirstHit> {
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
    let hits = tracer.first_hits(shots);
    let pairs = shots.iter().zip(hits);
    let first = pairs.filter_map(|(shot, hit)| {
        let impact = hit.filter(|impact| impact.on_target)?;
        Some(FirstHit {
            point: impact.point,
            weight: weight(shot.mass(), impact.normal_impulse),
        })
    });
    first.collect()
}
