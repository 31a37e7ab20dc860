//! What each effect of the model does in the scene at hand, and which ones a search can do without.
//!
//! The leading candidates are judged with every effect and with each one left out, on the same
//! shots. What changes neither J nor the best settings by more than a part of the accuracy asked
//! for is left out of the search; figures are always those of the whole model.

mod bench;

pub(super) use bench::{Bench, fewer, objective, objective_in};

use rayon::prelude::*;

use crate::precision::Precision;
use crate::problem::model::{Effect, Model};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::verdict::Subject;

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
    pub best_without: Settings,
    /// See `best_without`.
    pub best_with: Settings,
    /// By how much J of the whole model is higher at the former, relative.
    pub regret: f64,
    /// Rays of a pose without it over rays with it.
    pub relative_rays: f64,
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
    /// In which precision the search traced paths; figures are always f64.
    pub precision: Precision,
}

/// Shots behind changes of J and of verdicts, and behind best settings.
const SHOTS: usize = 1024;
/// Share of the accuracy by which leaving out effects may change J or worsen the best settings.
const TOLERABLE: f64 = 0.5;
/// The same for effects that may move a cliff: J is least where harm has hardly begun, and so an effect that
/// changes harm a lot changes J little there.
const TOLERABLE_AT_CLIFFS: f64 = 0.1;

impl Rung {
    fn matters(&self, tolerable: f64) -> bool {
        self.largest_change > tolerable || self.regret > tolerable
    }
}

impl Ladder {
    /// Nothing was measured yet.
    pub fn of(scenario: &Scenario) -> Self {
        Self {
            model: scenario.problem.model.clone(),
            ..Self::default()
        }
    }

    /// The effects that the search does without.
    pub fn left_out(&self) -> Vec<Effect> {
        let left_out = self.rungs.iter().filter(|rung| rung.left_out);
        left_out.map(|rung| rung.effect).collect()
    }

    /// Lets the search trace in single precision, if that changes next to nothing at the best candidates.
    pub(super) fn choose_precision(&mut self, bench: &Bench) {
        let tolerable = Precision::LITTLE * bench.scenario.problem.accuracy;
        if bench.largest_change_in(Precision::F32) <= tolerable {
            self.precision = Precision::F32;
        }
    }

    /// Measures what some effects do at the best candidates.
    pub(super) fn climb(&mut self, bench: &Bench, effects: &[Effect]) {
        let start = bench.start();
        self.rungs = effects
            .par_iter()
            .map(|&effect| bench.rung(effect, &start))
            .collect();
    }

    /// Leaves out what does not matter. Where shots hit first decides where cliffs are, if there are any,
    /// and from afar nobody sees one move.
    pub(super) fn leave_out_from_afar(&mut self, bench: &Bench, has_cliffs: bool) {
        self.leave_out(bench, TOLERABLE, |it| {
            !(has_cliffs && it.decides_first_hits())
        });
    }

    /// Whether the size of the shots might be left out where more shots are fired. Of what decides where
    /// shots hit first nothing else takes time at every pose.
    pub(super) fn asks_about_size(&self, accuracy: f64) -> bool {
        let tolerable = TOLERABLE_AT_CLIFFS * accuracy;
        let mut open = self.rungs.iter().filter(|rung| !rung.left_out);
        open.any(|rung| rung.effect == Effect::ShotSize && !rung.matters(tolerable))
    }

    /// Leaves out the size of the shots, if it does not matter at the best candidates.
    pub(super) fn leave_out_size(&mut self, bench: &Bench) {
        self.leave_out(bench, TOLERABLE_AT_CLIFFS, |it| it == Effect::ShotSize);
    }

    /// Leaves out one effect of a kind after the other as long as all of them together do not matter.
    fn leave_out(&mut self, bench: &Bench, share: f64, is_of_kind: impl Fn(Effect) -> bool) {
        let tolerable = share * bench.scenario.problem.accuracy;
        let mut left_out = self.left_out();
        for rung in &mut self.rungs {
            if rung.left_out || rung.matters(tolerable) || !is_of_kind(rung.effect) {
                continue;
            }
            left_out.push(rung.effect);
            rung.left_out = bench.largest_change(&left_out) <= tolerable;
            if !rung.left_out {
                left_out.pop();
            }
        }
    }

    /// Marks all that was measured as left out.
    pub(super) fn leave_out_all(&mut self) {
        for rung in &mut self.rungs {
            rung.left_out = true;
        }
    }

    /// Puts back the effects that matter at the best candidates by now, or the one that matters most
    /// where none does alone.
    pub(super) fn put_back(&mut self, bench: &Bench) {
        let tolerable = TOLERABLE * bench.scenario.problem.accuracy;
        let mut left_out: Vec<&mut Rung> =
            self.rungs.iter_mut().filter(|rung| rung.left_out).collect();
        for rung in &mut left_out {
            let by_now = bench.largest_change(&[rung.effect]);
            rung.largest_change = rung.largest_change.max(by_now);
        }
        left_out.sort_by(|a, b| b.largest_change.total_cmp(&a.largest_change));
        for (place, rung) in left_out.into_iter().enumerate() {
            if place == 0 || rung.largest_change > tolerable {
                rung.left_out = false;
                self.put_back += 1;
            }
        }
    }
}
