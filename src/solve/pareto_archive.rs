//! Archive of all evaluations on the way to a Pareto front.

use std::cmp::Ordering;
use std::sync::Mutex;

use super::objectives::{Objectives, objectives};
use crate::elementary::ln;
use crate::objective::Terms;
use crate::problem::setting::{Setting, Settings};

/// A pose with its risks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Evaluated {
    pub settings: Settings,
    pub objectives: Objectives,
}

/// Evaluations of all threads.
#[derive(Debug, Default)]
pub(super) struct ParetoArchive(Mutex<Vec<Evaluated>>);

impl ParetoArchive {
    /// Adds a pose that was evaluated with these factors on the weights.
    pub fn add(&self, settings: Settings, terms: &Terms, factors: &Objectives) {
        let weighted = objectives(terms);
        let evaluated = Evaluated {
            settings,
            objectives: [0, 1, 2].map(|risk| weighted[risk] / factors[risk]),
        };
        // A thread that panicked has left the list whole.
        let mut list = self.0.lock().unwrap_or_else(|poison| poison.into_inner());
        list.push(evaluated);
    }

    /// All evaluations, in an order that does not depend on the threads.
    pub fn into_sorted(self) -> Vec<Evaluated> {
        let mut all = self
            .0
            .into_inner()
            .unwrap_or_else(|poison| poison.into_inner());
        all.sort_by(|a, b| {
            by_numbers(&a.objectives, &b.objectives).then_with(|| by_settings(a, b))
        });
        all.dedup();
        all
    }
}

fn by_numbers(a: &[f64], b: &[f64]) -> Ordering {
    let pairs = a.iter().zip(b);
    pairs.fold(Ordering::Equal, |order, (a, b)| order.then(a.total_cmp(b)))
}

fn by_settings(a: &Evaluated, b: &Evaluated) -> Ordering {
    let ranges = |evaluated: &Evaluated| {
        let of_the_nozzle = Setting::OF_THE_NOZZLE.map(|setting| setting.of(&evaluated.settings));
        (of_the_nozzle, evaluated.settings.static_friction)
    };
    let ((a_nozzle, a_friction), (b_nozzle, b_friction)) = (ranges(a), ranges(b));
    a.settings
        .contact
        .cmp(&b.settings.contact)
        .then_with(|| by_numbers(&a_nozzle, &b_nozzle))
        .then_with(|| a_friction.total_cmp(&b_friction))
}

/// Whether the first is nowhere worse and somewhere better.
pub(super) fn dominates(a: &Objectives, b: &Objectives) -> bool {
    let nowhere_worse = a.iter().zip(b).all(|(a, b)| a <= b);
    nowhere_worse && a != b
}

/// Those that no other one dominates, each risk combination once; in the order of `sorted`.
pub(super) fn not_dominated(sorted: Vec<Evaluated>) -> Vec<Evaluated> {
    let mut front: Vec<Evaluated> = Vec::new();
    // What comes later has a larger first risk, or one as large and a larger second: it dominates
    // nothing that came before.
    for evaluated in sorted {
        let is_covered = |other: &Evaluated| {
            other.objectives == evaluated.objectives
                || dominates(&other.objectives, &evaluated.objectives)
        };
        if !front.iter().any(is_covered) {
            front.push(evaluated);
        }
    }
    front
}

/// A spread of at most `most`: the least of each risk, then always the one that is farthest from those
/// already taken.
pub(super) fn spread_out(front: Vec<Evaluated>, most: usize) -> Vec<Evaluated> {
    let largest = |risk: usize| {
        front
            .iter()
            .map(|it| it.objectives[risk])
            .fold(0.0, f64::max)
    };
    let scales = [0, 1, 2].map(largest);
    // Logarithmic, but not down to nothing.
    let place = |evaluated: &Evaluated| -> Objectives {
        [0, 1, 2].map(|risk| match scales[risk] {
            scale if scale > 0.0 => ln(evaluated.objectives[risk] / scale + NEGLIGIBLE),
            _ => 0.0,
        })
    };
    let places: Vec<Objectives> = front.iter().map(place).collect();
    let gap = |a: usize, b: usize| {
        let between = places[a].iter().zip(&places[b]).map(|(a, b)| (a - b).abs());
        between.fold(0.0, f64::max)
    };
    let end = |risk: usize| {
        let least = |a: &usize, b: &usize| {
            let order = front[*a].objectives[risk].total_cmp(&front[*b].objectives[risk]);
            let sum = |index: usize| places[index].iter().sum::<f64>();
            order.then_with(|| sum(*a).total_cmp(&sum(*b)))
        };
        (0..front.len()).min_by(least)
    };
    let mut taken: Vec<usize> = Vec::new();
    for index in (0..3).filter_map(end) {
        if !taken.contains(&index) {
            taken.push(index);
        }
    }
    while taken.len() < most.min(front.len()) {
        let distance = |index: usize| {
            let gaps = taken.iter().map(|&other| gap(index, other));
            gaps.fold(f64::INFINITY, f64::min)
        };
        let distances = (0..front.len()).map(|index| (index, distance(index)));
        let farthest = distances.max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        match farthest {
            Some((index, distance)) if distance > 0.0 => taken.push(index),
            _ => break,
        }
    }
    taken
        .into_iter()
        .map(|index| front[index].clone())
        .collect()
}

/// Share of the largest risk below which differences do not matter.
const NEGLIGIBLE: f64 = 1e-4;

#[cfg(test)]
mod tests {
    use super::*;

    fn evaluated(objectives: Objectives) -> Evaluated {
        let settings = Settings {
            incidence: 1.0,
            azimuth: 0.0,
            standoff: 1.0,
            speed: 1.0,
            aim_along: 0.0,
            aim_across: 0.0,
            aim_above: 0.0,
            contact: 0,
            static_friction: 0.0,
        };
        Evaluated {
            settings,
            objectives,
        }
    }

    fn sorted(objectives: &[Objectives]) -> Vec<Evaluated> {
        let archive = ParetoArchive::default();
        let mut list = archive.0.lock().unwrap();
        list.extend(objectives.iter().copied().map(evaluated));
        drop(list);
        archive.into_sorted()
    }

    #[test]
    fn what_is_dominated_goes() {
        let all = [
            [2.0, 2.0, 0.0],
            [1.0, 3.0, 0.0],
            [1.0, 3.0, 1.0],
            [3.0, 1.0, 0.0],
            [3.0, 3.0, 0.0],
            [2.0, 2.0, 0.0],
        ];
        let front = not_dominated(sorted(&all));
        let objectives: Vec<Objectives> = front.iter().map(|it| it.objectives).collect();
        assert_eq!(
            objectives,
            [[1.0, 3.0, 0.0], [2.0, 2.0, 0.0], [3.0, 1.0, 0.0]]
        );
    }

    #[test]
    fn few_of_many_hold_the_ends() {
        let arc: Vec<Objectives> = (0..=100)
            .map(|step| f64::from(step) / 100.0)
            .map(|x| [x, 0.0, (1.0 - x).powi(2)])
            .collect();
        let few = spread_out(not_dominated(sorted(&arc)), 7);
        assert_eq!(few.len(), 7);
        assert!(few.iter().any(|it| it.objectives[0] == 0.0));
        assert!(few.iter().any(|it| it.objectives[2] == 0.0));
        let all = spread_out(not_dominated(sorted(&arc)), 1000);
        assert_eq!(all.len(), 101);
    }
}
