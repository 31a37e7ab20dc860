//! Local search: argmin's Nelder-Mead method inside the unit cube.

use std::cell::RefCell;
use std::cmp::Ordering;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;

use super::evaluator::{Evaluator, Fitness};
use super::point::Point;
use super::race::Race;
use super::space::Space;
use super::tilt::Coordinates;
use crate::problem::setting::Settings;

/// A point of the search with its fitness.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Coordinates in the unit cube; any number on a periodic axis.
    pub point: Vec<f64>,
    /// The settings there, with the best speed.
    pub settings: Settings,
    /// Their fitness on the shots they were evaluated on.
    pub fitness: Fitness,
    /// J of the first shots at each look of a race.
    pub partial: Vec<f64>,
}

impl Candidate {
    /// Evaluates a point.
    pub fn at(space: &Space, evaluator: &Evaluator, point: &[f64]) -> Self {
        Self::in_race(&Race::none(), space, evaluator, point)
    }

    /// Evaluates a point, exactly where its rank is not above `cut`.
    pub fn below(cut: f64, space: &Space, evaluator: &Evaluator, point: &[f64]) -> Self {
        Self::in_race(&Race::above(cut), space, evaluator, point)
    }

    /// Evaluates a point, exactly where it does not lose a race.
    fn in_race(race: &Race, space: &Space, evaluator: &Evaluator, point: &[f64]) -> Self {
        let (settings, fitness, partial) = evaluator.evaluate(&space.settings(point), race);
        Self {
            point: space.within(point),
            settings,
            fitness,
            partial,
        }
    }

    /// The order of two candidates, the better one first.
    pub fn by_rank(a: &Self, b: &Self) -> Ordering {
        a.fitness.rank().total_cmp(&b.fitness.rank())
    }

    /// This one, or another that is better.
    pub fn or_better(self, other: Self) -> Self {
        if other.fitness.rank() < self.fitness.rank() {
            other
        } else {
            self
        }
    }
}

/// Where a descent moves.
#[derive(Clone, Copy)]
struct Local<'a> {
    space: &'a Space,
    evaluator: &'a Evaluator<'a>,
    coordinates: &'a Coordinates,
}

/// A point that a descent has asked for, and the feasible one that is evaluated in its place.
#[derive(Clone)]
struct Probe {
    /// In the coordinates of the descent.
    at: Vec<f64>,
    candidate: Candidate,
    /// The rank of that one, and more the farther away it is: were it as flat beyond a bound as it is on it, a simplex
    /// would fall over to the outside and never see that it is better inside.
    cost: f64,
}

impl Probe {
    fn at(local: Local, race: &Race, at: Vec<f64>) -> Self {
        let Local {
            space, evaluator, ..
        } = local;
        let point = local.coordinates.point(&at);
        let mut candidate = Candidate::in_race(race, space, evaluator, &point);
        if candidate.fitness.objective().is_none()
            && let Some(feasible) = evaluator.repaired(space, &point)
        {
            candidate = Candidate::in_race(race, space, evaluator, &feasible);
        }
        Self::of(local.coordinates, at, candidate)
    }

    fn of(coordinates: &Coordinates, at: Vec<f64>, candidate: Candidate) -> Self {
        let feasible = coordinates.of(&candidate.point);
        let pairs = at.iter().zip(&feasible);
        let distance: f64 = pairs.map(|(x, feasible)| (x - feasible).abs()).sum();
        let cost = candidate.fitness.rank() * (1.0 + distance);
        Self {
            at,
            candidate,
            cost,
        }
    }
}

/// The cost function that argmin sees. It keeps the best points itself: argmin loses them when a run
/// ends early.
struct Descent<'a> {
    local: Local<'a>,
    /// The first simplex: argmin asks for its corners again.
    corners: &'a [Probe],
    /// As many points as a simplex has, the best one first.
    leading: RefCell<Vec<Candidate>>,
}

impl CostFunction for &Descent<'_> {
    type Param = Point;
    type Output = f64;

    fn cost(&self, Point(at): &Point) -> Result<f64, Error> {
        if self.local.evaluator.is_stopped() {
            // A flat cost ends the run at once.
            return Ok(f64::MAX);
        }
        if let Some(corner) = self.corners.iter().find(|corner| corner.at == *at) {
            return Ok(corner.cost);
        }
        let mut leading = self.leading.borrow_mut();
        // What is above all corners of the simplex is rejected, however far above.
        let race = Race::against_worst(&leading);
        let probe = Probe::at(self.local, &race, at.clone());
        let rank = probe.candidate.fitness.rank();
        let place = leading.partition_point(|other| other.fitness.rank() <= rank);
        leading.insert(place, probe.candidate);
        leading.truncate(self.corners.len());
        Ok(probe.cost)
    }
}

/// The best point found downhill from `start`, until the values at the corners of the simplex
/// differ by less than `accuracy`, relative to the best, and it is no better in their middle: round a
/// valley the values may be alike on both sides.
pub fn polish(
    space: &Space,
    evaluator: &Evaluator,
    start: Candidate,
    size: f64,
    accuracy: f64,
) -> Candidate {
    if space.dimensions() == 0 || evaluator.is_stopped() {
        return start;
    }
    let start = best_bound(space, evaluator, start);
    let local = Local {
        space,
        evaluator,
        coordinates: &Coordinates::near(space, &start.point),
    };
    let mut leading = descend(local, start, size, accuracy);
    for _ in 0..MOST_DESCENTS {
        if evaluator.is_stopped() {
            break;
        }
        let best = &leading[0];
        let (middle, extent) = middle_and_extent(local.coordinates, &leading);
        let middle = Candidate::below(best.fitness.rank(), space, evaluator, &middle);
        if middle.fitness.rank() >= best.fitness.rank() * (1.0 - accuracy) {
            return best.clone().or_better(middle);
        }
        leading = descend(local, middle, 0.5 * extent, accuracy);
    }
    leading.swap_remove(0)
}

/// The best point found downhill from a simplex of candidates that were found apart, best first: where all of them have
/// stopped in the same long valley, its length is that of the simplex.
pub fn recombined(
    space: &Space,
    evaluator: &Evaluator,
    found: &[Candidate],
    size: f64,
    accuracy: f64,
) -> Candidate {
    let best = &found[0];
    if space.dimensions() == 0 || evaluator.is_stopped() {
        return best.clone();
    }
    let local = Local {
        space,
        evaluator,
        coordinates: &Coordinates::near(space, &best.point),
    };
    let corner = |candidate: &Candidate| {
        let point = space.near(&best.point, &candidate.point);
        let at = local.coordinates.of(&point);
        let candidate = Candidate {
            point,
            ..candidate.clone()
        };
        Probe::of(local.coordinates, at, candidate)
    };
    let count = space.dimensions() + 1;
    let mut corners: Vec<Probe> = found.iter().take(count).map(corner).collect();
    let missing = count - corners.len();
    corners.extend(first_edges(local, best, size).take(missing));
    let scale = best.fitness.rank().max(f64::MIN_POSITIVE);
    descend_from(local, corners, accuracy * scale).swap_remove(0)
}

/// The best points found downhill from `start`, the very best one first.
fn descend(local: Local, start: Candidate, size: f64, accuracy: f64) -> Vec<Candidate> {
    let scale = start.fitness.rank().max(f64::MIN_POSITIVE);
    let corners = first_simplex(local, &start, size);
    descend_from(local, corners, accuracy * scale)
}

/// The same from a simplex, until J at its corners differs by less than `least`.
fn descend_from(local: Local, corners: Vec<Probe>, least: f64) -> Vec<Candidate> {
    let mut leading: Vec<Candidate> = corners.iter().map(|it| it.candidate.clone()).collect();
    leading.sort_by(Candidate::by_rank);
    let descent = Descent {
        local,
        corners: &corners,
        leading: RefCell::new(leading),
    };
    let simplex = corners.iter().map(|corner| Point(corner.at.clone()));
    if let Ok(solver) = NelderMead::new(simplex.collect()).with_sd_tolerance(least) {
        let most = ITERATIONS_PER_DIMENSION * local.space.dimensions() as u64;
        let executor = Executor::new(&descent, solver).configure(|state| state.max_iters(most));
        // The best points are kept by the cost function; how the run ended does not matter.
        drop(executor.run());
    }
    descent.leading.into_inner()
}

/// The point in the middle of candidates, and the longest edge of the box round them.
fn middle_and_extent(coordinates: &Coordinates, candidates: &[Candidate]) -> (Vec<f64>, f64) {
    let places = candidates.iter().map(|it| coordinates.of(&it.point));
    let places: Vec<Vec<f64>> = places.collect();
    let along = |axis: usize| places.iter().map(move |at| at[axis]);
    let axes = 0..places[0].len();
    let mean = |axis| along(axis).sum::<f64>() / places.len() as f64;
    let extent = |axis| {
        let least = along(axis).fold(f64::INFINITY, f64::min);
        along(axis).fold(f64::NEG_INFINITY, f64::max) - least
    };
    let middle: Vec<f64> = axes.clone().map(mean).collect();
    (
        coordinates.point(&middle),
        axes.map(extent).fold(0.0, f64::max),
    )
}

const ITERATIONS_PER_DIMENSION: u64 = 40;
/// Descents after the first one, each from the middle of where the one before ended.
const MOST_DESCENTS: usize = 3;

/// The start, or a better point where one coordinate is on a bound: that is where the best value of
/// a setting often is, and from afar a descent creeps towards it.
fn best_bound(space: &Space, evaluator: &Evaluator, start: Candidate) -> Candidate {
    let mut best = start;
    for axis in 0..space.dimensions() {
        for bound in [0.0, 1.0] {
            if best.point[axis] == bound || evaluator.is_stopped() {
                continue;
            }
            let mut point = best.point.clone();
            point[axis] = bound;
            let rank = best.fitness.rank();
            best = best.or_better(Candidate::below(rank, space, evaluator, &point));
        }
    }
    best
}

/// A simplex whose edges are so short that J rises by no more than a moderate share along them:
/// settings differ a hundredfold in how far they may be turned, and a simplex that has to shrink
/// into a narrow valley loses sight of the valley's length.
fn first_simplex(local: Local, start: &Candidate, size: f64) -> Vec<Probe> {
    let from = local.coordinates.of(&start.point);
    let first = Probe::of(local.coordinates, from, start.clone());
    let others = first_edges(local, start, size);
    [first].into_iter().chain(others).collect()
}

/// The other ends of its edges from where it starts, one along each axis; evaluated as they are asked for.
fn first_edges<'a>(
    local: Local<'a>,
    start: &Candidate,
    size: f64,
) -> impl Iterator<Item = Probe> + use<'a> {
    let from = local.coordinates.of(&start.point);
    let middle = local.coordinates.of(&vec![0.5; from.len()]);
    let rank = start.fitness.rank();
    (0..from.len()).map(move |axis| {
        // Inwards, so that a start on a bound does not make a flat simplex.
        let towards_middle = if from[axis] > middle[axis] { -1.0 } else { 1.0 };
        let mut edge = size;
        loop {
            let mut at = from.clone();
            at[axis] += towards_middle * edge;
            let race = Race::above(rank * (1.0 + FAR_TOO_STEEP));
            let corner = Probe::at(local, &race, at);
            let rise = corner.cost / rank - 1.0;
            let is_short = edge <= SHORTEST_EDGE * size;
            if is_short || rise <= STEEPEST_EDGE || local.evaluator.is_stopped() {
                return corner;
            }
            edge *= if rise > FAR_TOO_STEEP { 0.25 } else { 0.5 };
        }
    })
}

/// By what share J may rise along an edge of a first simplex.
const STEEPEST_EDGE: f64 = 0.3;
/// Where it rises by more than this share, an edge is quartered instead of halved.
const FAR_TOO_STEEP: f64 = 3.0;
/// No edge is shortened to less than this share.
const SHORTEST_EDGE: f64 = 1.0 / 64.0;
