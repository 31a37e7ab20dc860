//! Corrects the shares on the few shots of a search by those on many.
//!
//! A share on few shots is off, and a search that goes where it is least finds where it is off most. On common random
//! numbers it is off by much the same factor at all settings nearby: measured at one of them with many shots, the
//! factor corrects it at the others, as a model of low fidelity is corrected by one of high fidelity (N. M. Alexandrov
//! and others, Journal of Aircraft 38, 2001).

use super::super::answer::Answer;
use super::super::evaluator::Effort;
use super::super::sampler::Sampler;
use super::super::search::Search;
use super::super::stage::Stage;
use super::penalty::Penalty;
use crate::control::Control;
use crate::evaluate::LargestImpulses;
use crate::jet::Samples;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::verdict::{ShareEstimate, Subject, allowed_shares};

/// Measures corrections of shares.
pub(super) struct Corrector<'a> {
    scenario: &'a Scenario,
    effort: &'a Effort,
    control: &'a Control,
    penalty: Penalty,
    stage: Stage,
    few: Samples,
    many: Samples,
    /// The shares where they were measured last, of the whole, then of each watched station.
    shares: Vec<Vec<Share>>,
    /// By how much validation shots have said more than the many, where they did.
    excess: Vec<(Subject, f64)>,
}

/// A share on few shots and on many.
struct Share {
    subject: Subject,
    few: ShareEstimate,
    many: ShareEstimate,
}

impl<'a> Corrector<'a> {
    /// For a stage on few shots of a sampler that penalises, with many others of it.
    pub fn new(
        scenario: &'a Scenario,
        effort: &'a Effort,
        control: &'a Control,
        sampler: &Sampler,
        stage: Stage,
        many: usize,
    ) -> Option<Self> {
        Some(Self {
            scenario,
            effort,
            control,
            penalty: sampler.penalty()?.clone(),
            stage,
            few: sampler.draw(stage.shots),
            many: sampler.draw_anew(0, many.max(stage.shots)),
            shares: Vec::new(),
            excess: Vec::new(),
        })
    }

    /// Takes a search through the stage, with shares corrected by what was measured last.
    pub fn refine(&self, search: &mut Search) {
        let sampler = Sampler::penalised(self.scenario, self.penalty());
        let evaluator = sampler.evaluator(self.scenario, &self.few, self.effort, self.control);
        search.refine_together(&evaluator, &self.stage);
    }

    /// Measures the shares at some settings.
    pub fn measure(&mut self, settings: &Settings) {
        let scenarios = self.penalty.scenarios(self.scenario);
        self.shares = scenarios.map(|it| self.shares_in(it, settings)).collect();
    }

    fn shares_in(&self, scenario: &Scenario, settings: &Settings) -> Vec<Share> {
        let [few, many] = [&self.few, &self.many].map(|samples| {
            let impulses = LargestImpulses::of(scenario, settings, &samples.shots);
            self.effort.add(0, impulses.rays());
            let shares = impulses.shares(scenario, settings.speed);
            shares.collect::<Vec<ShareEstimate>>()
        });
        let pairs = few.into_iter().zip(many);
        let subjects = allowed_shares(scenario).map(|(subject, _)| subject);
        let share = |(subject, (few, many))| Share { subject, few, many };
        subjects.zip(pairs).map(share).collect()
    }

    /// The penalty with what shares are corrected by where they were measured last.
    fn penalty(&self) -> Penalty {
        let correction = |share: &Share| {
            let correction = share.few.correction(&share.many)?;
            Some(correction * self.excess_of(share.subject))
        };
        let corrections = |shares: &Vec<Share>| shares.iter().map(correction).collect();
        Penalty {
            corrections: self.shares.iter().map(corrections).collect(),
            ..self.penalty.clone()
        }
    }

    fn excess_of(&self, subject: Subject) -> f64 {
        let mut excesses = self.excess.iter();
        excesses
            .find(|(of, _)| *of == subject)
            .map_or(1.0, |(_, excess)| *excess)
    }

    /// How much of what is allowed is used up at most where shares were measured last, by the many shots.
    pub fn utilisation(&self) -> f64 {
        let shares = self.shares.iter().flatten();
        let used = shares.map(|share| share.many.utilisation());
        used.fold(0.0, f64::max)
    }

    /// Corrects by more in what an answer fails whose shares were measured last.
    pub fn learn(&mut self, failing: &Answer) {
        let is_watched = |place: f64| self.penalty.watched.iter().any(|it| it.place == place);
        for verdict in failing.verdicts.iter().filter(|it| !it.passes()) {
            let shares = self.shares.iter().flatten();
            let of_subject = shares.filter(|share| share.subject == verdict.subject);
            let used = of_subject
                .map(|share| share.many.utilisation())
                .fold(0.0, f64::max);
            if used > 0.0 && verdict.place.is_none_or(is_watched) {
                let excess =
                    (ROOM * verdict.violation() / used).max(self.excess_of(verdict.subject));
                self.excess
                    .retain(|(subject, _)| *subject != verdict.subject);
                self.excess.push((verdict.subject, excess));
            }
        }
    }
}

/// What is corrected by more than validation shots have said leaves as much room.
const ROOM: f64 = 1.02;
