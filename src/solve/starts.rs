//! Which candidates descents start from.

use super::polish::Candidate;
use super::space::Space;
use super::stage::Stage;

/// Candidates of a group to go on with: first those that are better than all their neighbours, as each of them may be
/// in a basin of its own (topographical global optimisation: Toern and Viitanen, 1992), then the best of the others.
pub(super) fn starts(space: &Space, group: &[Candidate], stage: &Stage) -> Vec<Candidate> {
    let mut starts: Vec<Candidate> = Vec::new();
    let (minima, others): (Vec<usize>, Vec<usize>) =
        (0..group.len()).partition(|&index| is_minimum(space, group, index));
    for index in minima.into_iter().chain(others) {
        let candidate = &group[index];
        let is_new =
            |other: &Candidate| space.distance(&candidate.point, &other.point) > 0.2 * stage.size;
        if starts.len() < stage.candidates && starts.iter().all(is_new) {
            starts.push(candidate.clone());
        }
    }
    starts
}

/// Whether a candidate is better than its nearest neighbours in its group, which is in order.
fn is_minimum(space: &Space, group: &[Candidate], index: usize) -> bool {
    let here = &group[index].point;
    let others = group
        .iter()
        .enumerate()
        .filter(|&(other, _)| other != index);
    let mut distances: Vec<(f64, usize)> = others
        .map(|(other, it)| (space.distance(here, &it.point), other))
        .collect();
    let count = NEIGHBOURS_PER_DIMENSION * space.dimensions();
    if distances.len() > count {
        distances.select_nth_unstable_by(count, |a, b| a.0.total_cmp(&b.0));
        distances.truncate(count);
    }
    distances.iter().all(|&(_, other)| other > index)
}

/// Neighbours that a candidate is compared with, for each setting that is searched.
const NEIGHBOURS_PER_DIMENSION: usize = 2;
