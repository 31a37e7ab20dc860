//! Where effects are measured: the leading candidates, with and without them, on the same shots.

use std::borrow::Cow;

use rayon::prelude::*;

use super::{Ablation, SHOTS};
use crate::control::Control;
use crate::evaluate::evaluate;
use crate::jet::{ImportanceDensity, Replicates, Samples, ShotSample, Stream, purpose};
use crate::objective::Tally;
use crate::problem::model::Effect;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::solve::evaluator::{Effort, Evaluator};
use crate::solve::polish::{Candidate, polish};
use crate::solve::search::Search;
use crate::solve::space::Space;
use crate::solve::stopping_rule::{is_in_reach, least_objective, rounding_of_objective};
use crate::verdict::{Subject, Verdict};

/// Shots of a reduced scenario with the weights of those of the whole one: they differ in the model
/// alone.
fn reduced_shots<'a>(
    scenario: &Scenario,
    reduced: &Scenario,
    whole: &'a [ShotSample],
    importance: Option<&ImportanceDensity>,
) -> Cow<'a, [ShotSample]> {
    if draw_alike(scenario, reduced) {
        return whole.into();
    }
    let samples =
        Samples::with_importance(&reduced.problem, Stream::Search, whole.len(), importance);
    let mut shots = samples.shots;
    if shots.len() == whole.len() {
        for (shot, with) in shots.iter_mut().zip(whole) {
            shot.weight = with.weight;
        }
    }
    shots.into()
}

/// Whether the shots of two scenarios are the same.
fn draw_alike(one: &Scenario, other: &Scenario) -> bool {
    let (one, other) = (&one.problem, &other.problem);
    one.jet == other.jet
        && one.shot == other.shot
        && one.paths.exit_width == other.paths.exit_width
        && Effect::Roughness.is_in(one) == Effect::Roughness.is_in(other)
        && one.has_one_ray() == other.has_one_ray()
}

/// J at some settings.
fn objective(scenario: &Scenario, settings: &Settings, shots: &[ShotSample]) -> f64 {
    let tally = Tally::trace(scenario, settings, settings.speed, shots);
    tally.terms(&scenario.problem.goals, settings.speed).total()
}

/// Where effects are measured.
pub(super) struct Bench<'a> {
    scenario: &'a Scenario,
    /// Where a part of the shots come from.
    importance: Option<&'a ImportanceDensity>,
    /// The best settings of each contact that could win, the best ones first.
    leading: Vec<Settings>,
    /// Shots of the whole model.
    shots: Vec<ShotSample>,
    /// J of the whole model there.
    whole: Vec<f64>,
    effort: &'a Effort,
    control: &'a Control,
}

impl<'a> Bench<'a> {
    /// `None` where the nozzle has fitted nowhere.
    pub(super) fn new(
        scenario: &'a Scenario,
        importance: Option<&'a ImportanceDensity>,
        searches: &[Search],
        effort: &'a Effort,
        control: &'a Control,
    ) -> Option<Self> {
        let least = least_objective(searches);
        let mut leading: Vec<&Candidate> = searches
            .iter()
            .filter(|search| is_in_reach(search, least))
            .map(Search::best)
            .filter(|best| best.fitness.objective().is_some())
            .collect();
        leading.sort_by(|a, b| a.fitness.rank().total_cmp(&b.fitness.rank()));
        let leading: Vec<Settings> = leading.into_iter().map(|best| best.settings).collect();
        leading.first()?;
        let shots =
            Samples::with_importance(&scenario.problem, Stream::Search, SHOTS, importance).shots;
        let whole = leading
            .par_iter()
            .map(|settings| objective(scenario, settings, &shots))
            .collect();
        Some(Self {
            shots,
            scenario,
            importance,
            leading,
            whole,
            effort,
            control,
        })
    }

    /// Changes of J, relative, at all leading settings, with the shots of a reduced scenario.
    fn changes(&self, reduced: &Scenario, shots: &[ShotSample]) -> Vec<f64> {
        let pairs = self.leading.par_iter().zip(&self.whole);
        let change = |(settings, whole): (&Settings, &f64)| {
            self.relative(objective(reduced, settings, shots) - whole, *whole)
        };
        pairs.map(change).collect()
    }

    /// The best settings of a scenario near the first leading ones.
    fn descend(&self, scenario: &Scenario, shots: &[ShotSample]) -> Settings {
        let settings = &self.leading[0];
        let evaluator = Evaluator::new(scenario, shots, self.effort, self.control);
        let search_speed = !scenario.speed_scales_out(settings.contact);
        let space = Space::new(&scenario.problem, settings.contact, search_speed);
        let start = Candidate::at(&space, &evaluator, &space.point(settings));
        let settled = DESCENT_SETTLED * scenario.problem.accuracy;
        polish(&space, &evaluator, start, DESCENT_SIZE, settled).settings
    }

    /// A difference of J relative to J; none where it is within rounding. Where J is 0 it is beyond
    /// every number, and as JSON has no infinity, the largest there is.
    fn relative(&self, difference: f64, objective: f64) -> f64 {
        let rounding = rounding_of_objective(&self.scenario.problem.goals);
        if difference.abs() <= rounding {
            0.0
        } else {
            (difference / objective.max(rounding)).clamp(-f64::MAX, f64::MAX)
        }
    }

    /// The whole model at the first leading settings.
    pub(super) fn start(&self) -> Start {
        let validation = draw_validation(self.scenario);
        let verdicts = passes(self.scenario, &self.leading[0], &validation).into_iter();
        Start {
            passes: verdicts.map(|(_, pass)| pass).collect(),
            validation,
            best: self.descend(self.scenario, few(&self.shots)),
        }
    }

    pub(super) fn ablation(&self, effect: Effect, start: &Start, left_out: bool) -> Ablation {
        let reduced = self.scenario.without(&[effect], &self.leading[0]);
        let shots = reduced_shots(self.scenario, &reduced, &self.shots, self.importance);
        let changes = self.changes(&reduced, &shots);
        let (whole, fewer) = (few(&self.shots), few(&shots));
        let best_with = start.best;
        // An effect that does nothing here may be the cliff that the best settings keep away from.
        let best_without = self.descend(&reduced, fewer);
        let [without, with] =
            [&best_without, &best_with].map(|settings| objective(self.scenario, settings, whole));
        let before = start.passes.iter();
        let redrawn = (!draw_alike(self.scenario, &reduced)).then(|| draw_validation(&reduced));
        let validation = redrawn.as_ref().unwrap_or(&start.validation);
        let turned = passes(&reduced, &self.leading[0], validation)
            .into_iter()
            .zip(before)
            .filter(|((_, without), with)| without != *with)
            .map(|((subject, _), _)| subject);
        Ablation {
            effect,
            change: changes[0],
            largest_change: largest(&changes),
            turned: turned.collect(),
            best_without,
            best_with,
            regret: self.relative(without - with, with).max(0.0),
            relative_rays: self.relative_rays(&reduced, fewer),
            left_out,
        }
    }

    /// Rays of a pose of a reduced scenario over those of the whole one. Unlike times they are the same on every
    /// machine.
    fn relative_rays(&self, reduced: &Scenario, fewer: &[ShotSample]) -> f64 {
        let settings = &self.leading[0];
        let rays = |scenario: &Scenario, shots: &[ShotSample]| {
            Tally::trace(scenario, settings, settings.speed, shots).rays as f64
        };
        rays(reduced, fewer) / rays(self.scenario, few(&self.shots)).max(1.0)
    }
}

/// The largest size; what is not a number is above all that are.
fn largest(changes: &[f64]) -> f64 {
    let sizes = changes.iter().map(|change| change.abs());
    sizes.max_by(f64::total_cmp).unwrap_or(0.0)
}

/// What the whole model says where effects are measured.
pub(super) struct Start {
    /// Whether each verdict passes.
    passes: Vec<bool>,
    /// The shots that tell.
    validation: Replicates,
    /// The best settings nearby.
    best: Settings,
}

/// Those of some shots that descents take: of each stream the first ones.
fn few(shots: &[ShotSample]) -> &[ShotSample] {
    &shots[..DESCENT_SHOTS.min(shots.len())]
}

const DESCENT_SHOTS: usize = 128;
/// Longest edge of the first simplex of a descent, as a share of each range.
const DESCENT_SIZE: f64 = 0.1;
/// A descent ends when J differs by less than this share of the accuracy.
const DESCENT_SETTLED: f64 = 0.3;

/// Shots that tell whether verdicts pass.
fn draw_validation(scenario: &Scenario) -> Replicates {
    Replicates::without_boundary(&scenario.problem, purpose::EFFECTS, SHOTS)
}

/// Whether each verdict on some settings passes.
fn passes(
    scenario: &Scenario,
    settings: &Settings,
    validation: &Replicates,
) -> Vec<(Subject, bool)> {
    let verdicts = Verdict::all(scenario, &evaluate(scenario, settings, validation));
    let verdict = |verdict: &Verdict| (verdict.subject, verdict.passes());
    verdicts.iter().map(verdict).collect()
}
