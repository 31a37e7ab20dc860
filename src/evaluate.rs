//! Evaluation of settings on shots that nothing was tuned on.

mod adaptive;
mod impulses;
mod largest_impulses;
mod replicate_stats;
mod violation_counts;
mod violations;

pub use adaptive::{evaluate_adaptively, evaluate_each_adaptively, evaluate_streamed};
pub(crate) use largest_impulses::LargestImpulses;
pub use violation_counts::ViolationCounts;
pub use violations::importance_of;

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::elementary::{hypot, square};
use crate::jet::Replicates;
use crate::objective::{Hits, Sums, Terms};
use crate::problem::goal::Goals;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::trace::End;
use impulses::Impulses;
use replicate_stats::{ReplicateStats, SurfaceSums};

/// What some settings do, with standard errors.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// Number of shots of the jet.
    pub shots: usize,
    /// Whether all shots of the jet are the same: then the figures of one have no error.
    pub is_exact: bool,
    /// Number of boundary samples, which only the terms of the objective count.
    pub boundary_shots: usize,
    /// Number of rays cast for them.
    pub rays: usize,
    /// The terms of the objective.
    pub terms: Terms,
    /// Standard error of each term.
    pub term_errors: Terms,
    /// Standard error of J.
    pub standard_error: f64,
    /// What the target receives.
    pub target: TargetReceipt,
    /// What every secondary surface receives; indices are the scene's.
    pub surfaces: Vec<SurfaceReceipt>,
    /// Mean number of impacts of a path, those on the target included.
    pub impacts_per_shot: f64,
    /// How the paths ended: share of all shots.
    pub ends: BTreeMap<End, f64>,
}

/// What the target receives by first hits.
#[derive(Clone, Debug)]
pub struct TargetReceipt {
    /// First hits on target.
    pub hits: usize,
    /// Normal impulse, N s.
    pub normal_impulse: Spread,
    /// Tangential impulse, N s.
    pub tangential_impulse: Spread,
    /// First hits off the wanted normal impulse by more than the tolerance.
    pub off_target: usize,
    /// First hits over the tangential limit.
    pub over_limit: usize,
    /// First hits that stick.
    pub sticking: usize,
}

/// What a secondary surface receives, by first hits off target and by rebounds.
#[derive(Clone, Debug, Default)]
pub struct SurfaceReceipt {
    /// Shots that hit it at least once.
    pub shots: usize,
    /// Shots with an impact on it over what it may take.
    pub over: usize,
    /// Number of impacts by their place in the path: direct hits first.
    pub impacts_by_number: Vec<usize>,
    /// The same for impacts over what it may take.
    pub over_by_number: Vec<usize>,
    /// Normal impulses, N s.
    pub normal_impulse: Spread,
}

/// Mean and range of a quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// 5 % of the values are below.
    pub low: f64,
    /// 95 % of the values are below.
    pub high: f64,
    /// Largest value.
    pub largest: f64,
}

/// Evaluates `settings` on shots as they are.
pub fn evaluate(scenario: &Scenario, settings: &Settings, shots: &Replicates) -> Evaluation {
    let sets = shots.sets.par_iter();
    let stats = sets
        .map(|set| ReplicateStats::of(scenario, settings, set))
        .collect();
    summed_up(scenario, settings, stats)
}

fn summed_up(
    scenario: &Scenario,
    settings: &Settings,
    replicates: Vec<ReplicateStats>,
) -> Evaluation {
    let shots: usize = replicates.iter().map(|r| r.tally.shots).sum();
    let boundary_shots = replicates.iter().map(|r| r.boundary.shots).sum();
    let is_exact = replicates.len() == 1;
    let goals = &scenario.problem.goals;
    let sums: Vec<Sums> = replicates
        .iter()
        .map(|replicate| {
            let of_jet = replicate.tally.sums(goals, settings.speed);
            of_jet.plus(&replicate.boundary.sums(goals, settings.speed))
        })
        .collect();
    let (terms, term_errors, standard_error) = if is_exact {
        (sums[0].terms(goals), Terms::default(), 0.0)
    } else {
        let limited = scenario.surfaces.iter().filter(|it| it.allow.is_some());
        let unseen = Unseen {
            cost: limited.fold(0.0, |most, it| it.weight.max(most)) * UNSEEN_LOAD * UNSEEN_LOAD,
            shots: (shots + boundary_shots) as f64,
        };
        jackknife(&sums, goals, &unseen)
    };
    let rays = replicates
        .iter()
        .map(|r| r.tally.rays + r.boundary.rays)
        .sum();
    let mut ends = BTreeMap::new();
    for (&end, &count) in replicates.iter().flat_map(|replicate| &replicate.ends) {
        *ends.entry(end).or_insert(0.0) += count as f64 / shots as f64;
    }
    let surfaces = (0..scenario.surfaces.len())
        .map(|index| receipt(replicates.iter().map(|r| &r.surfaces[index])))
        .collect();
    let impacts: usize = replicates.iter().map(|r| r.impacts).sum();
    Evaluation {
        shots,
        is_exact,
        boundary_shots,
        rays,
        terms,
        term_errors,
        standard_error,
        target: target_receipt(goals, settings.speed, &replicates),
        surfaces,
        impacts_per_shot: impacts as f64 / shots as f64,
        ends,
    }
}

/// The terms of pooled sums and their standard errors, by the jackknife: leaving out one replicate at a
/// time.
///
/// Rare violations may have been seen too seldom to show their variance. So a few more of the worst events are
/// added to the variances, as two are added to the counts behind a 95 % interval of a share; and there is a prior
/// for events that were not observed at all.
fn jackknife(sums: &[Sums], goals: &Goals, unseen: &Unseen) -> (Terms, Terms, f64) {
    let pooled = |skip: Option<usize>| {
        let kept = sums.iter().enumerate().filter(|(i, _)| skip != Some(*i));
        kept.fold(Sums::default(), |total, (_, one)| total.plus(one))
    };
    let left_out: Vec<Terms> = (0..sums.len())
        .map(|index| pooled(Some(index)).terms(goals))
        .collect();
    let all = pooled(None);
    let terms = all.terms(goals);
    let mut more = all.one_more_of_the_worst(goals);
    more.rebound = more.rebound.max(unseen.part_in(terms.total()));
    let count = sums.len() as f64;
    let error = |part: fn(&Terms) -> f64| {
        let mean = left_out.iter().map(part).sum::<f64>() / count;
        let squares: f64 = left_out.iter().map(|t| square(part(t) - mean)).sum();
        let spread = ((count - 1.0) / count * squares).sqrt();
        hypot(spread, MORE.sqrt() * part(&more))
    };
    let errors = Terms {
        normal_impulse: error(|t| t.normal_impulse),
        tangential_impulse: error(|t| t.tangential_impulse),
        rebound: error(|t| t.rebound),
        miss: error(|t| t.miss),
    };
    (terms, errors, error(Terms::total))
}

/// Number of worst events that are added.
const MORE: f64 = 4.0;

/// Prior for unobserved events: the least cost of the worst impact on a secondary surface.
struct Unseen {
    /// Cost of an impact on a surface that has a limit; 0 where none has.
    cost: f64,
    /// Shots that were fired.
    shots: f64,
}

impl Unseen {
    /// Its part in J.
    fn part_in(&self, objective: f64) -> f64 {
        self.cost.min(MOST_UNSEEN * objective) / self.shots
    }
}

/// Its impulse, as a share of the surface's limit,
const UNSEEN_LOAD: f64 = 1.0 / 3.0;
/// unless it costs more than this many average shots.
const MOST_UNSEEN: f64 = 16.0;

fn add_counts(into: &mut Vec<usize>, counts: &[usize]) {
    into.resize(into.len().max(counts.len()), 0);
    for (total, count) in into.iter_mut().zip(counts) {
        *total += count;
    }
}

fn receipt<'a>(parts: impl Iterator<Item = &'a SurfaceSums>) -> SurfaceReceipt {
    let mut receipt = SurfaceReceipt::default();
    let mut values = Impulses::default();
    for part in parts {
        receipt.shots += part.shots;
        receipt.over += part.over;
        add_counts(&mut receipt.impacts_by_number, &part.impacts_by_number);
        add_counts(&mut receipt.over_by_number, &part.over_by_number);
        values.append(&part.normal_impulses);
    }
    receipt.normal_impulse = values.spread();
    receipt
}

fn target_receipt(goals: &Goals, speed: f64, replicates: &[ReplicateStats]) -> TargetReceipt {
    let all_hits = || replicates.iter().map(|stats| &stats.tally.hits);
    let at_speed = |of: fn(&Hits) -> &Vec<f64>| -> Vec<f64> {
        let all = all_hits().flat_map(of);
        all.map(|impulse| impulse * speed).collect()
    };
    TargetReceipt {
        hits: all_hits().map(Hits::len).sum(),
        off_target: all_hits()
            .map(|hits| hits.off_target(goals, speed).count())
            .sum(),
        over_limit: all_hits()
            .map(|hits| hits.over_limit(goals, speed).count())
            .sum(),
        sticking: replicates.iter().map(|r| r.sticking).sum(),
        normal_impulse: Spread::of(at_speed(|hits| &hits.normal)),
        tangential_impulse: Spread::of(at_speed(|hits| &hits.tangential)),
    }
}

impl Spread {
    /// Mean and range of some values; zeros when there are none.
    fn of(mut values: Vec<f64>) -> Self {
        if values.is_empty() {
            return Self::default();
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mut quantile = |share: f64| {
            let place = ((values.len() - 1) as f64 * share).round() as usize;
            *values.select_nth_unstable_by(place, f64::total_cmp).1
        };
        Self {
            // The sum's rounding must not put the mean above every value.
            mean: mean.min(largest),
            low: quantile(0.05),
            high: quantile(0.95),
            largest,
        }
    }
}
