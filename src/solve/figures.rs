//! Validates the answers on as many validation shots as they need.

use super::answer::Answer;
use super::evaluator::Effort;
use super::polish::Candidate;
use super::search::Search;
use super::stopping_rule::is_noisy;
use super::tie::recommended;
use crate::control::Control;
use crate::evaluate::evaluate_adaptively;
use crate::jet::{ValidationSample, purpose};
use crate::problem::Problem;
use crate::scenario::Scenario;

/// Evaluates the candidates of searches on validation shots.
pub(super) struct Figures<'a> {
    scenario: &'a Scenario,
    effort: &'a Effort,
    control: &'a Control,
    validation: ValidationSample,
}

impl<'a> Figures<'a> {
    /// Draws a part of the shots.
    pub fn new(scenario: &'a Scenario, control: &'a Control, effort: &'a Effort) -> Self {
        let first = control.first_validation_shots();
        Self {
            scenario,
            effort,
            control,
            validation: ValidationSample::new(&scenario.problem, purpose::ANSWERS, first),
        }
    }

    /// The answers that the searches have found.
    pub fn all(&mut self, searches: &[Search]) -> Vec<Answer> {
        let answers = self.of(searches);
        self.sharpened(answers, searches)
    }

    /// The answers again, where searches have gone on. What a stage has found counts only if it is better on validation
    /// shots, too: else the search goes back, and the stage has shown how good the answer was.
    pub fn renewed(&mut self, answers: Vec<Answer>, searches: &mut [Search]) -> Vec<Answer> {
        let has_moved =
            |answer: &Answer, search: &Search| answer.settings != search.best().settings;
        let pairs = answers.iter().zip(&*searches);
        let moved = pairs.filter(|(answer, search)| has_moved(answer, search));
        let moved: Vec<&Candidate> = moved.map(|(_, search)| search.best()).collect();
        let mut new =
            Answer::of_all(self.scenario, &moved, &self.validation, self.effort).into_iter();
        let pairs = answers.into_iter().zip(&mut *searches);
        let renewed = pairs.filter_map(|(answer, search)| {
            if !has_moved(&answer, search) {
                return Some(answer);
            }
            let found = new.next()?;
            if search.began_with(&answer.settings) && answer.order() < found.order() {
                search.go_back();
                return Some(answer);
            }
            Some(found)
        });
        let renewed = renewed.collect();
        self.sharpened(renewed, searches)
    }

    /// Evaluates answers again on all shots that may be drawn, where those so far say too little: about
    /// J of a contact that could win, or about a verdict on the best one.
    fn sharpened(&mut self, answers: Vec<Answer>, searches: &[Search]) -> Vec<Answer> {
        let problem = &self.scenario.problem;
        let say_little = is_noisy(&answers, problem) || is_open(&answers, problem);
        if say_little && self.draw_all() {
            return self.of(searches);
        }
        answers
    }

    /// Draws all shots that may be drawn, unless they are there already or the search is to stop. Whether it did.
    fn draw_all(&mut self) -> bool {
        let problem = &self.scenario.problem;
        let most = self.control.validation_shots;
        if problem.has_one_ray() || self.validation.shots() >= most || self.control.is_stopped() {
            return false;
        }
        self.validation = ValidationSample::new(problem, purpose::ANSWERS, most);
        true
    }

    /// Evaluates answers again on all shots that may be drawn, as all others from then on.
    pub fn sharpen<'b>(&mut self, answers: impl Iterator<Item = &'b mut Answer>) {
        if !self.draw_all() {
            return;
        }
        for answer in answers.filter(|it| it.evaluation.is_some()) {
            let evaluation = evaluate_adaptively(self.scenario, &answer.settings, &self.validation);
            *answer = Answer {
                least_objective: answer.least_objective,
                ..Answer::feasible(self.scenario, &answer.settings, evaluation, self.effort)
            };
        }
    }

    /// The answers of any searches, on the same shots.
    pub fn of(&self, searches: &[Search]) -> Vec<Answer> {
        let candidates: Vec<&Candidate> = searches.iter().map(Search::best).collect();
        let on = |validation: &ValidationSample| {
            Answer::of_all(self.scenario, &candidates, validation, self.effort)
        };
        if self.control.is_stopped() {
            let few = ValidationSample::new(&self.scenario.problem, purpose::ANSWERS, FEW);
            let began = self.control.clock.seconds();
            let roughly = on(&few);
            let times = self.validation.shots() as f64 / few.shots() as f64;
            if (self.control.clock.seconds() - began) * times > PATIENCE {
                return roughly;
            }
        }
        on(&self.validation)
    }
}

/// Validation shots after a request to stop.
const FEW: usize = 1024;
/// Longest time of the validation after a request to stop, s.
const PATIENCE: f64 = 0.2;

/// Whether it is uncertain if the answer that would be recommended passes.
fn is_open(answers: &[Answer], problem: &Problem) -> bool {
    let best = recommended(answers, problem);
    best.is_some_and(|best| !best.is_certain())
}
