//! Screening: where descents start.

use rayon::prelude::*;

use super::evaluator::Evaluator;
use super::polish::Candidate;
use super::space::Space;
use crate::feasibility::infeasibility;
use crate::jet::Pose;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::ray::Ray;

/// Evaluates poses that are spread all over the space, the best one first.
///
/// Where many poses are blocked or aimed at something else, more of them are drawn, as whether the axis of the jet
/// meets the target and whether the nozzle fits costs far less than tracing shots. A window that one pose in a
/// thousand can see through is found like that; a band in which a lance just fits is found by repair.
///
/// Groups of different numbers have points of their own.
pub(super) fn screened(
    space: &Space,
    scenario: &Scenario,
    evaluator: &Evaluator,
    group: u32,
) -> Vec<Candidate> {
    let wanted = match space.dimensions() {
        0 => 1,
        1 => 32,
        2 => 96,
        3 => 192,
        dimensions => 128 * dimensions,
    };
    let seed = (scenario.problem.seed as u32).wrapping_add(group.wrapping_mul(GROUP_SEED));
    let pool = Pool::drawn(space, scenario, evaluator, (wanted, seed));
    let candidates = pool.points(space, evaluator, wanted).into_par_iter();
    let mut candidates: Vec<Candidate> = candidates
        .enumerate()
        // When it is asked to stop, one is enough to answer with.
        .filter(|(index, _)| *index == 0 || !evaluator.is_stopped())
        .map(|(_, point)| Candidate::at(space, evaluator, &point))
        .collect();
    candidates.sort_by(Candidate::by_rank);
    candidates
}

/// Points by what is known of them without a shot, each list in the order in which they were drawn.
#[derive(Default)]
struct Pool {
    /// The nozzle fits, and the axis of the jet meets the target.
    promising: Vec<Vec<f64>>,
    /// The nozzle fits.
    feasible: Vec<Vec<f64>>,
    /// The axis would meet the target, but the nozzle does not fit; with by how much.
    blocked: Vec<(f64, Vec<f64>)>,
    /// Neither.
    others: Vec<Vec<f64>>,
}

/// A point as far as it was looked at.
enum Outlook {
    Promising,
    Feasible,
    Blocked(f64),
    Other,
}

impl Pool {
    fn drawn(
        space: &Space,
        scenario: &Scenario,
        evaluator: &Evaluator,
        (wanted, seed): (usize, u32),
    ) -> Self {
        let mut pool = Self::default();
        for round in 0..MOST_ROUNDS {
            let is_first = round == 0;
            let first = (round * wanted) as u32;
            let outlooks: Vec<(Vec<f64>, Outlook)> = (first..first + wanted as u32)
                .into_par_iter()
                .map(|index| {
                    let point = space.spread(index, seed);
                    let outlook = outlook(scenario, &space.settings(&point), is_first);
                    (point, outlook)
                })
                .collect();
            for (point, outlook) in outlooks {
                match outlook {
                    Outlook::Promising => pool.promising.push(point),
                    Outlook::Feasible => pool.feasible.push(point),
                    Outlook::Blocked(violation) => pool.blocked.push((violation, point)),
                    Outlook::Other if is_first => pool.others.push(point),
                    Outlook::Other => {}
                }
            }
            let is_enough = pool.promising.len() >= wanted || space.dimensions() == 0;
            if is_enough || pool.asked() >= MOST_ASKED * wanted || evaluator.is_stopped() {
                break;
            }
        }
        pool
    }

    /// Of how many points it was asked whether the nozzle fits: all that are kept.
    fn asked(&self) -> usize {
        self.promising.len() + self.feasible.len() + self.blocked.len() + self.others.len()
    }

    /// The points to evaluate.
    fn points(mut self, space: &Space, evaluator: &Evaluator, wanted: usize) -> Vec<Vec<f64>> {
        let mut points = self.promising;
        points.truncate(wanted);
        self.blocked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let nearest: Vec<Vec<f64>> = self.blocked.into_iter().map(|(_, it)| it).collect();
        let missing = (wanted / FEWEST).saturating_sub(points.len());
        let repaired: Vec<Vec<f64>> = nearest
            .par_iter()
            .take(missing)
            .filter(|_| !evaluator.is_stopped())
            .filter_map(|point| evaluator.repaired(space, point))
            .collect();
        points.extend(repaired);
        let missing = wanted - points.len().min(wanted);
        points.extend(self.feasible.into_iter().take(missing));
        if points.is_empty() {
            // Nothing fits: what is nearest to fitting is the best there is.
            points = nearest;
            points.extend(self.others);
            points.truncate(wanted);
        }
        points
    }
}

/// What is known of some settings without a shot. Whether the nozzle fits where its axis meets something else
/// is asked in the first round alone.
fn outlook(scenario: &Scenario, settings: &Settings, is_first: bool) -> Outlook {
    let is_aimed = meets_target(scenario, settings);
    if !is_aimed && !is_first {
        return Outlook::Other;
    }
    match (is_aimed, infeasibility(scenario, settings)) {
        (true, None) => Outlook::Promising,
        (false, None) => Outlook::Feasible,
        (true, Some(infeasible)) => Outlook::Blocked(infeasible.violation),
        (false, Some(_)) => Outlook::Other,
    }
}

/// Whether the axis of the jet meets the target first. Where a deflector turns the jet nobody knows.
fn meets_target(scenario: &Scenario, settings: &Settings) -> bool {
    if scenario.scene.moves_with_nozzle() {
        return true;
    }
    let pose = Pose::new(&scenario.target.frame, settings);
    let axis = Ray {
        origin: pose.exit,
        direction: pose.direction,
    };
    let hit = scenario.scene.first_hit(&axis, None);
    hit.is_some_and(|hit| scenario.target.holds(&hit))
}

/// The seeds of groups are apart by this: a number without a pattern.
const GROUP_SEED: u32 = 0x9E37_79B9;
/// Rounds of as many points as are wanted, at most.
const MOST_ROUNDS: usize = 32;
/// Times as many as are wanted, of which it is asked whether the nozzle fits.
const MOST_ASKED: usize = 4;
/// With less than this part of what is wanted, blocked points are repaired.
const FEWEST: usize = 8;
