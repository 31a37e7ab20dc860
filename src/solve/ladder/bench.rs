//! Where effects are measured: the leading candidates, with and without them, on the same shots.

use std::borrow::Cow;

use rayon::prelude::*;

use super::{Rung, SHOTS};
use crate::evaluate::evaluate;
use crate::jet::{Deviate, Focus, Replicates, Samples, Stream, purpose};
use crate::objective::Tally;
use crate::precision::Precision;
use crate::problem::model::Effect;
use crate::problem::setting::Choice;
use crate::setup::Setup;
use crate::solve::accuracy::{is_in_reach, least_objective, rounding_of_objective};
use crate::solve::control::Control;
use crate::solve::judge::{Effort, Judge};
use crate::solve::polish::{Candidate, polish};
use crate::solve::search::Search;
use crate::solve::space::Space;
use crate::verdict::{Subject, Verdict};

/// Shots of a reduced setup with the weights of those of the whole one: what they differ in is the
/// model alone.
pub(in crate::solve) fn fewer<'a>(
    setup: &Setup,
    reduced: &Setup,
    whole: &'a [Deviate],
    focus: Option<&Focus>,
) -> Cow<'a, [Deviate]> {
    if draw_alike(setup, reduced) {
        return whole.into();
    }
    let samples = Samples::focused(&reduced.problem, Stream::Search, whole.len(), focus);
    let mut shots = samples.deviates;
    if shots.len() == whole.len() {
        for (shot, with) in shots.iter_mut().zip(whole) {
            shot.weight = with.weight;
        }
    }
    shots.into()
}

/// Whether the shots of two setups are the same.
fn draw_alike(one: &Setup, other: &Setup) -> bool {
    let (one, other) = (&one.problem, &other.problem);
    one.jet == other.jet
        && one.shot == other.shot
        && Effect::Roughness.is_in(one) == Effect::Roughness.is_in(other)
        && one.has_one_ray() == other.has_one_ray()
}

/// J at a choice.
pub(in crate::solve) fn objective(setup: &Setup, choice: &Choice, shots: &[Deviate]) -> f64 {
    objective_in(Precision::F64, setup, choice, shots)
}

/// The same with paths in one of the precisions.
pub(in crate::solve) fn objective_in(
    precision: Precision,
    setup: &Setup,
    choice: &Choice,
    shots: &[Deviate],
) -> f64 {
    let tally = Tally::trace_as(precision, setup, choice, choice.speed, shots);
    tally.terms(&setup.problem.goals, choice.speed).total()
}

/// Where effects are measured.
pub(in crate::solve) struct Bench<'a> {
    pub(super) setup: &'a Setup,
    /// Where a part of the shots come from.
    focus: Option<&'a Focus>,
    /// The best choice of every contact that could win, the best one first.
    leading: Vec<Choice>,
    /// Shots of the whole model.
    shots: Vec<Deviate>,
    /// J of the whole model there.
    whole: Vec<f64>,
    effort: &'a Effort,
    control: &'a Control<'a>,
}

impl<'a> Bench<'a> {
    /// `None` where the nozzle has fitted nowhere.
    pub(in crate::solve) fn new(
        setup: &'a Setup,
        focus: Option<&'a Focus>,
        searches: &[Search],
        effort: &'a Effort,
        control: &'a Control,
    ) -> Option<Self> {
        let least = least_objective(searches);
        let mut leading: Vec<&Candidate> = searches
            .iter()
            .filter(|search| is_in_reach(search, least))
            .map(Search::best)
            .filter(|best| best.standing.objective().is_some())
            .collect();
        leading.sort_by(|a, b| a.standing.rank().total_cmp(&b.standing.rank()));
        let leading: Vec<Choice> = leading.into_iter().map(|best| best.choice).collect();
        leading.first()?;
        let shots = Samples::focused(&setup.problem, Stream::Search, SHOTS, focus).deviates;
        let whole = leading
            .par_iter()
            .map(|choice| objective(setup, choice, &shots))
            .collect();
        Some(Self {
            shots,
            setup,
            focus,
            leading,
            whole,
            effort,
            control,
        })
    }

    fn reduced(&self, left_out: &[Effect]) -> Setup {
        self.setup.without(left_out, &self.leading[0])
    }

    /// Changes of J, relative, at every leading choice.
    fn changes(&self, reduced: &Setup) -> Vec<f64> {
        let shots = fewer(self.setup, reduced, &self.shots, self.focus);
        let pairs = self.leading.par_iter().zip(&self.whole);
        let change = |(choice, whole): (&Choice, &f64)| {
            self.relative(objective(reduced, choice, &shots) - whole, *whole)
        };
        pairs.map(change).collect()
    }

    pub(super) fn largest_change(&self, left_out: &[Effect]) -> f64 {
        largest(&self.changes(&self.reduced(left_out)))
    }

    /// The largest change of J, relative, when paths are traced in another precision.
    pub(super) fn largest_change_in(&self, precision: Precision) -> f64 {
        let change = |(choice, whole): (&Choice, &f64)| {
            let coarse = objective_in(precision, self.setup, choice, &self.shots);
            self.relative(coarse - whole, *whole)
        };
        let pairs = self.leading.par_iter().zip(&self.whole);
        let changes: Vec<f64> = pairs.map(change).collect();
        largest(&changes)
    }

    /// The best settings of a setup near the first leading choice.
    fn descend(&self, setup: &Setup, shots: &[Deviate]) -> Choice {
        let choice = &self.leading[0];
        let judge = Judge::new(setup, Precision::F64, shots, self.effort, self.control);
        let search_speed = !setup.speed_scales_out(choice.contact);
        let space = Space::new(&setup.problem, choice.contact, search_speed);
        let start = Candidate::at(&space, &judge, &space.point(choice));
        let settled = DESCENT_SETTLED * setup.problem.accuracy;
        polish(&space, &judge, start, DESCENT_SIZE, settled).choice
    }

    /// A difference of J relative to J; none where it is within rounding. Where J is 0 it is beyond
    /// every number, and as JSON has no infinity, the largest there is.
    fn relative(&self, difference: f64, objective: f64) -> f64 {
        let rounding = rounding_of_objective(&self.setup.problem.goals);
        if difference.abs() <= rounding {
            0.0
        } else {
            (difference / objective.max(rounding)).clamp(-f64::MAX, f64::MAX)
        }
    }

    /// Shots for descents.
    fn few_shots(&self) -> &[Deviate] {
        &self.shots[..DESCENT_SHOTS.min(self.shots.len())]
    }

    /// The whole model at the first leading choice.
    pub(super) fn start(&self) -> Start {
        let fresh = draw_fresh(self.setup);
        let verdicts = passes(self.setup, &self.leading[0], &fresh).into_iter();
        Start {
            passes: verdicts.map(|(_, pass)| pass).collect(),
            fresh,
            best: self.descend(self.setup, self.few_shots()),
        }
    }

    pub(super) fn rung(&self, effect: Effect, start: &Start) -> Rung {
        let reduced = self.reduced(&[effect]);
        let changes = self.changes(&reduced);
        let whole = self.few_shots();
        let fewer = fewer(self.setup, &reduced, whole, self.focus);
        let best_with = start.best;
        // An effect that does nothing here may be the cliff that the best settings keep away from.
        let best_without = self.descend(&reduced, &fewer);
        let [without, with] =
            [&best_without, &best_with].map(|choice| objective(self.setup, choice, whole));
        let before = start.passes.iter();
        let redrawn = (!draw_alike(self.setup, &reduced)).then(|| draw_fresh(&reduced));
        let fresh = redrawn.as_ref().unwrap_or(&start.fresh);
        let turned = passes(&reduced, &self.leading[0], fresh)
            .into_iter()
            .zip(before)
            .filter(|((_, without), with)| without != *with)
            .map(|((subject, _), _)| subject);
        Rung {
            effect,
            change: changes[0],
            largest_change: largest(&changes),
            turned: turned.collect(),
            best_without,
            best_with,
            regret: self.relative(without - with, with).max(0.0),
            relative_rays: self.relative_rays(&reduced, &fewer),
            left_out: false,
        }
    }

    /// Rays of a pose of a reduced setup over those of the whole one. Unlike times they are the same on every
    /// machine.
    fn relative_rays(&self, reduced: &Setup, fewer: &[Deviate]) -> f64 {
        let choice = &self.leading[0];
        let rays = |setup: &Setup, shots: &[Deviate]| {
            Tally::trace(setup, choice, choice.speed, shots).rays as f64
        };
        rays(reduced, fewer) / rays(self.setup, self.few_shots()).max(1.0)
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
    fresh: Replicates,
    /// The best settings nearby.
    best: Choice,
}

const DESCENT_SHOTS: usize = 128;
/// Longest edge of the first simplex of a descent, as a share of each range.
const DESCENT_SIZE: f64 = 0.1;
/// A descent ends when J differs by less than this share of the accuracy.
const DESCENT_SETTLED: f64 = 0.3;

/// Shots that tell whether verdicts pass.
fn draw_fresh(setup: &Setup) -> Replicates {
    Replicates::without_rim(&setup.problem, purpose::EFFECTS, SHOTS)
}

/// Whether each verdict on a choice passes.
fn passes(setup: &Setup, choice: &Choice, fresh: &Replicates) -> Vec<(Subject, bool)> {
    let verdicts = Verdict::all(setup, &evaluate(setup, choice, fresh));
    let verdict = |verdict: &Verdict| (verdict.subject, verdict.passes());
    verdicts.iter().map(verdict).collect()
}
