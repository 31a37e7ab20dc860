//! What each effect of the model does in the scene at hand, and which ones a search can do without.
//!
//! The leading candidates are judged with every effect and with each one left out, on the same
//! shots. What changes neither J nor the best settings by more than a part of the accuracy asked
//! for is left out of the search; figures are always those of the whole model.

use std::hint::black_box;
use std::time::Instant;

use rayon::prelude::*;

use super::accuracy::{is_in_reach, least_objective};
use super::control::Control;
use super::judge::{Effort, Judge, speed_scales_out};
use super::polish::{Candidate, polish};
use super::search::Search;
use super::space::Space;
use crate::evaluate::evaluate;
use crate::jet::{Replicates, Samples, Stream};
use crate::objective::Tally;
use crate::problem::model::{Effect, Model};
use crate::problem::setting::Choice;
use crate::setup::Setup;
use crate::verdict::{Subject, Verdict};

/// What one effect does: the model without it against the whole model.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// The effect.
    pub effect: Effect,
    /// By how much J changes without it at the leading settings, relative.
    pub change: f64,
    /// The largest such change, either way, over the leading settings of all contacts.
    pub largest_change: f64,
    /// The verdicts that turn without it.
    pub turned: Vec<Subject>,
    /// The best settings near the leading ones without it, and with it.
    pub best_without: Choice,
    /// See `best_without`.
    pub best_with: Choice,
    /// By how much J of the whole model is higher at the former, relative.
    pub regret: f64,
    /// Time for a pose without it over time with it.
    pub relative_time: f64,
    /// Whether the search did without it.
    pub left_out: bool,
}

/// The model that a search used, and why.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Ladder {
    /// What was asked for.
    pub model: Model,
    /// What each effect does, as far as it was measured.
    pub rungs: Vec<Rung>,
    /// How often an effect was put back because the whole model disagreed.
    pub put_back: usize,
}

/// Shots behind changes of J and of verdicts, and behind best settings.
const SHOTS: usize = 1024;
const DESCENT_SHOTS: usize = 256;
/// Longest edge of the first simplex of a descent, as a share of each range.
const DESCENT_SIZE: f64 = 0.1;
/// A descent ends when J differs by less than this share of the accuracy.
const DESCENT_SETTLED: f64 = 0.3;
/// Share of the accuracy by which leaving out effects may change J or worsen the best settings.
const TOLERABLE: f64 = 0.5;
/// What shots for verdicts are drawn for.
const VERDICTS: u32 = 2;

impl Ladder {
    /// The effects that the search does without.
    pub fn left_out(&self) -> Vec<Effect> {
        let left_out = self.rungs.iter().filter(|rung| rung.left_out);
        left_out.map(|rung| rung.effect).collect()
    }

    /// Measures what each effect does at the best candidates, and leaves out what does not matter.
    pub(super) fn climb(
        &mut self,
        setup: &Setup,
        searches: &[Search],
        effort: &Effort,
        control: &Control,
    ) {
        let Some(bench) = Bench::new(setup, searches, effort, control) else {
            return;
        };
        let effects = setup.problem.effects();
        self.rungs = effects
            .par_iter()
            .map(|&effect| bench.rung(effect))
            .collect();
        for rung in &mut self.rungs {
            rung.relative_time = bench.relative_time(&[rung.effect]);
        }
        if self.model == Model::Auto {
            self.leave_out(&bench);
        }
    }

    /// Leaves out one effect after the other as long as all of them together do not matter.
    fn leave_out(&mut self, bench: &Bench) {
        let tolerable = TOLERABLE * bench.setup.problem.accuracy;
        let mut left_out = Vec::new();
        for rung in &mut self.rungs {
            if rung.largest_change > tolerable || rung.regret > tolerable {
                continue;
            }
            left_out.push(rung.effect);
            rung.left_out = bench.largest_change(&left_out) <= tolerable;
            if !rung.left_out {
                left_out.pop();
            }
        }
    }

    /// Marks what the problem file itself leaves out.
    pub(super) fn mark(&mut self, left_out: &[Effect]) {
        self.rungs.retain(|rung| left_out.contains(&rung.effect));
        for rung in &mut self.rungs {
            rung.left_out = true;
        }
    }

    /// Puts back the effect that matters most of those that were left out.
    pub(super) fn put_back(&mut self) {
        let left_out = self.rungs.iter_mut().filter(|rung| rung.left_out);
        let most = left_out.max_by(|a, b| a.largest_change.total_cmp(&b.largest_change));
        if let Some(rung) = most {
            rung.left_out = false;
            self.put_back += 1;
        }
    }
}

/// The shots of a setup and of a reduced one, with the same weights: what they differ in is the
/// model alone.
pub(super) fn common_shots(setup: &Setup, reduced: &Setup, count: usize) -> [Samples; 2] {
    let of = |setup: &Setup| Samples::with_rim(&setup.problem, Stream::Search, count);
    let (whole, mut fewer) = (of(setup), of(reduced));
    if fewer.deviates.len() == whole.deviates.len() {
        for (deviate, with) in fewer.deviates.iter_mut().zip(&whole.deviates) {
            deviate.weight = with.weight;
        }
    }
    [whole, fewer]
}

/// J at a choice.
pub(super) fn objective(setup: &Setup, choice: &Choice, samples: &Samples) -> f64 {
    let tally = Tally::trace(setup, choice, choice.speed, &samples.deviates);
    tally.terms(&setup.problem.goals, choice.speed).total()
}

/// Where effects are measured.
struct Bench<'a> {
    setup: &'a Setup,
    /// The best choice of every contact that could win, the best one first.
    leading: Vec<Choice>,
    /// J of the whole model there.
    whole: Vec<f64>,
    /// What the verdicts are there.
    passes: Vec<bool>,
    /// The best settings near the first of them with the whole model.
    best: Choice,
    effort: &'a Effort,
    control: &'a Control<'a>,
}

impl<'a> Bench<'a> {
    /// `None` where the nozzle has fitted nowhere.
    fn new(
        setup: &'a Setup,
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
        let first = *leading.first()?;
        let samples = Samples::with_rim(&setup.problem, Stream::Search, SHOTS);
        let whole = leading
            .iter()
            .map(|choice| objective(setup, choice, &samples))
            .collect();
        let verdicts = passes(setup, &first).into_iter();
        Some(Self {
            setup,
            leading,
            whole,
            passes: verdicts.map(|(_, pass)| pass).collect(),
            best: descend(setup, &first, &samples, effort, control),
            effort,
            control,
        })
    }

    fn reduced(&self, left_out: &[Effect]) -> Setup {
        self.setup.without(left_out, &self.leading[0])
    }

    /// Changes of J, relative, at every leading choice.
    fn changes(&self, reduced: &Setup) -> Vec<f64> {
        let [_, samples] = common_shots(self.setup, reduced, SHOTS);
        let pairs = self.leading.iter().zip(&self.whole);
        let change = |(choice, whole): (&Choice, &f64)| {
            relative(objective(reduced, choice, &samples) - whole, *whole)
        };
        pairs.map(change).collect()
    }

    fn largest_change(&self, left_out: &[Effect]) -> f64 {
        let changes = self.changes(&self.reduced(left_out));
        changes
            .iter()
            .fold(0.0, |most, change| most.max(change.abs()))
    }

    fn rung(&self, effect: Effect) -> Rung {
        let reduced = self.reduced(&[effect]);
        let changes = self.changes(&reduced);
        let [whole, fewer] = common_shots(self.setup, &reduced, DESCENT_SHOTS);
        let best_with = self.best;
        let is_idle = changes.iter().all(|change| *change == 0.0);
        let best_without = if is_idle {
            best_with
        } else {
            let Self {
                effort, control, ..
            } = self;
            descend(&reduced, &self.leading[0], &fewer, effort, control)
        };
        let [without, with] =
            [&best_without, &best_with].map(|choice| objective(self.setup, choice, &whole));
        let before = self.passes.iter();
        let turned = passes(&reduced, &self.leading[0])
            .into_iter()
            .zip(before)
            .filter(|((_, without), with)| without != *with)
            .map(|((subject, _), _)| subject);
        Rung {
            effect,
            change: changes[0],
            largest_change: changes.iter().fold(0.0, |most, c| most.max(c.abs())),
            turned: turned.collect(),
            best_without,
            best_with,
            regret: relative(without - with, with).max(0.0),
            relative_time: 1.0,
            left_out: false,
        }
    }

    /// Time for a pose without some effects over time with all.
    fn relative_time(&self, left_out: &[Effect]) -> f64 {
        let reduced = self.reduced(left_out);
        let [whole, fewer] = common_shots(self.setup, &reduced, DESCENT_SHOTS);
        let time = |setup: &Setup, samples: &Samples| {
            let started = Instant::now();
            black_box(objective(setup, &self.leading[0], samples));
            started.elapsed().as_secs_f64()
        };
        let mut least = [f64::INFINITY; 2];
        for _ in 0..TIMED_TURNS {
            least[0] = time(&reduced, &fewer).min(least[0]);
            least[1] = time(self.setup, &whole).min(least[1]);
        }
        least[0] / least[1]
    }
}

/// The best settings of a setup near a choice.
fn descend(
    setup: &Setup,
    choice: &Choice,
    samples: &Samples,
    effort: &Effort,
    control: &Control,
) -> Choice {
    let few = samples.deviates.len().min(DESCENT_SHOTS);
    let judge = Judge::new(setup, &samples.deviates[..few], effort, control.stop);
    let search_speed = !speed_scales_out(setup, choice.contact);
    let space = Space::new(&setup.problem, choice.contact, search_speed);
    let start = Candidate::at(&space, &judge, &space.point(choice));
    let settled = DESCENT_SETTLED * setup.problem.accuracy;
    polish(&space, &judge, start, DESCENT_SIZE, settled).choice
}

const TIMED_TURNS: usize = 5;

/// Whether each verdict on a choice passes.
fn passes(setup: &Setup, choice: &Choice) -> Vec<(Subject, bool)> {
    let fresh = Replicates::without_rim(&setup.problem, VERDICTS, SHOTS);
    let verdicts = Verdict::all(setup, &evaluate(setup, choice, &fresh));
    let verdict = |verdict: &Verdict| (verdict.subject, verdict.passes());
    verdicts.iter().map(verdict).collect()
}

/// A difference relative to a value, 0 for none.
fn relative(difference: f64, value: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        difference / value.max(f64::MIN_POSITIVE)
    }
}
