//! Repair of infeasible poses: the nearest ones at which the nozzle fits.
//!
//! Often the best pose is where the nozzle just fits, and where a lance nearly fills its bore those where it fits
//! are a thin band that no sample of poses meets. A descent that is told no more than "blocked" collapses there. So
//! the feasible pose next to an infeasible one is evaluated in its place, at a cost that grows with the distance between both
//! (an exact penalty).

use super::space::Space;
use crate::feasibility::{closeness, infeasibility};
use crate::scenario::Scenario;

/// A feasible point near an infeasible one, if steps straight down the violation lead to one.
///
/// Each step goes to where the violation would end if it fell on as steeply as it falls here (Polyak's step with the
/// known least value 0; B. T. Polyak, USSR Computational Mathematics and Mathematical Physics 9, 1969). The slope is
/// measured where that is cheap, without the tolerance, and corrected by what each step finds (Broyden's update).
pub(super) fn repaired(scenario: &Scenario, space: &Space, point: &[f64]) -> Option<Vec<f64>> {
    let violation = |point: &[f64]| {
        let infeasible = infeasibility(scenario, &space.settings(point));
        infeasible.map_or(0.0, |it| it.violation)
    };
    let mut point = space.within(point);
    let mut here = violation(&point);
    let (mut slope, mut measured) = (Vec::new(), here);
    for step in 0..MOST_STEPS {
        if here <= 0.0 {
            return Some(point);
        }
        if step == 0 {
            slope = slope_of(space, &point, |point| {
                closeness(scenario, &space.settings(point))
            });
        } else if step % PATIENCE == 0 {
            if here > 0.5 * measured {
                slope = slope_of(space, &point, violation);
            }
            measured = here;
        }
        let square: f64 = slope.iter().map(|it| it * it).sum();
        if square <= 0.0 {
            return None;
        }
        let length = (here * OVERSHOOT + LEAST_ROOM) / square;
        let next: Vec<f64> = point
            .iter()
            .zip(&slope)
            .map(|(x, s)| x - length * s)
            .collect();
        let next = space.within(&next);
        let there = violation(&next);
        let moved: Vec<f64> = next.iter().zip(&point).map(|(a, b)| a - b).collect();
        correct(&mut slope, &moved, there - here);
        (point, here) = (next, there);
    }
    (here <= 0.0).then_some(point)
}

/// How a function rises along every axis on which the nozzle moves.
fn slope_of(space: &Space, point: &[f64], function: impl Fn(&[f64]) -> f64) -> Vec<f64> {
    let here = function(point);
    let along = |axis: usize| {
        if !space.moves_nozzle(axis) {
            return 0.0;
        }
        let step = if point[axis] < 0.5 { PROBE } else { -PROBE };
        let mut beside = point.to_vec();
        beside[axis] += step;
        (function(&beside) - here) / step
    };
    (0..point.len()).map(along).collect()
}

/// Corrects a slope by how much a function rose along a step.
fn correct(slope: &mut [f64], moved: &[f64], rise: f64) {
    let square: f64 = moved.iter().map(|it| it * it).sum();
    if square <= 0.0 {
        return;
    }
    let expected: f64 = slope.iter().zip(moved).map(|(s, m)| s * m).sum();
    for (slope, moved) in slope.iter_mut().zip(moved) {
        *slope += (rise - expected) * moved / square;
    }
}

/// Steps until it is given up.
const MOST_STEPS: usize = 16;
/// After so many steps the slope is measured anew, unless the violation has halved.
const PATIENCE: usize = 2;
/// Share of each range over which slopes are measured.
const PROBE: f64 = 1e-5;
/// Steps are longer by this factor, as they would end just before the bound otherwise,
const OVERSHOOT: f64 = 1.01;
/// and by this, m.
const LEAST_ROOM: f64 = 1e-8;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::setting::Settings;
    use crate::study::Study;

    #[test]
    fn poses_of_a_lance_that_nearly_fills_its_bore_are_repaired() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite");
        let study = Study::open(&folder.join("lance-fills-bore.yaml")).expect("it is sound");
        let scenario = study.scenario();
        let space = Space::new(&scenario.problem, 0, false);
        let fits = |settings: &Settings| infeasibility(scenario, settings).is_none();
        // The exit on the axis of the bore.
        let fitting = space.point(&Settings {
            incidence: 0.676,
            azimuth: 0.0,
            standoff: 29.1e-3,
            aim_along: -1.4e-3,
            ..space.settings(&space.spread(0, 0))
        });
        let beside = |index: u32| {
            let offsets = space.spread(index, 7).into_iter();
            let pairs = fitting.iter().zip(offsets);
            pairs.map(|(x, offset)| x + 0.04 * (offset - 0.5)).collect()
        };
        let points: Vec<Vec<f64>> = (0..200).map(beside).collect();
        // Hardly any pose fits by chance, and most of them are next to one that does.
        let by_chance = points.iter().filter(|it| fits(&space.settings(it))).count();
        let repaired: Vec<Vec<f64>> = points
            .iter()
            .filter_map(|point| repaired(scenario, &space, point))
            .collect();
        assert!(
            by_chance <= 10 && repaired.len() >= 100,
            "{by_chance} {}",
            repaired.len()
        );
        for point in &repaired {
            assert!(fits(&space.settings(point)));
            assert!(point.iter().all(|x| (0.0..=1.0).contains(x)), "{point:?}");
        }
    }

    #[test]
    fn what_fits_is_left_where_it_is() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
        let study = Study::open(&folder.join("keyway.yaml")).expect("it is sound");
        let space = Space::new(study.problem(), 0, false);
        let point = vec![0.6, 0.5, 0.5];
        assert_eq!(repaired(study.scenario(), &space, &point), Some(point));
    }
}
