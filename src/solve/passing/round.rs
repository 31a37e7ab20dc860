//! One search for what passes, with what a violation costs in it.

use super::super::answer::Answer;
use super::super::descent::Descent;
use super::super::figures::Figures;
use super::super::finalists::Agreement;
use super::super::sampler::Sampler;
use super::super::search::Search;
use super::super::stage::Stage;
use super::super::stopping_rule::{least_found, still_gains};
use super::super::{RISE, tie};
use super::correction::Corrector;
use super::{NEAR, Penalty, Sought};
use crate::elementary::ln;
use crate::scenario::Scenario;

/// A search that has ended, for the contacts of some answers.
pub(super) struct Round<'a> {
    sought: &'a Sought<'a>,
    scenario: &'a Scenario,
    /// Indices of the answers.
    which: &'a [usize],
    descent: Descent<'a>,
    /// The search with the best candidate.
    leader: usize,
    /// How far the finalists of that search agree.
    agreement: Agreement,
}

impl<'a> Round<'a> {
    /// Searches all over the space, and from each of the answers.
    pub fn run(
        sought: &'a Sought<'a>,
        scenario: &'a Scenario,
        which: &'a [usize],
        answers: &[Answer],
        penalty: Penalty,
    ) -> Self {
        let (effort, control) = (sought.effort, sought.control);
        let sampler = Sampler::penalised(scenario, penalty);
        let mut descent = Descent::run(scenario, sampler, effort, control);
        let shots = descent.shots;
        let samples = descent.sampler.draw(shots);
        let evaluator = descent
            .sampler
            .evaluator(scenario, &samples, effort, control);
        for (search, &index) in descent.searches.iter_mut().zip(which) {
            search.add(&answers[index].settings, &evaluator, &Stage::beyond(shots));
        }
        let leader = descent.leading();
        let agreement = descent.confirmed(leader);
        Self {
            sought,
            scenario,
            which,
            descent,
            leader,
            agreement,
        }
    }

    /// Whether its best candidate passes on its own shots.
    pub fn passes(&self) -> bool {
        let best = self.descent.searches[self.leader].best();
        best.fitness.penalty() <= 0.0
    }

    /// Replaces the answers that it has something better for. Of the best answer, where it was found here, it is asked
    /// how far the finalists agree. Returns the least violation of what was found and is worth another search;
    /// infinite without any.
    pub fn hand_over(
        mut self,
        answers: &mut [Answer],
        agreements: &mut [Option<Agreement>],
        figures: &mut Figures,
    ) -> f64 {
        let mut searches = self.descent.best();
        let mut new = figures.of(&searches);
        let mut is_settled = true;
        // What a search rejects for what few shots may be off can pass on validation shots, or hardly fails there.
        if self.passes() || is_near(&new[self.leader]) {
            if !new[self.leader].is_certain() {
                figures.sharpen(answers.iter_mut().chain(&mut new));
            }
            let (search, answer) = (&mut searches[self.leader], &mut new[self.leader]);
            is_settled = self.refine(search, answer, figures).unwrap_or(true);
        } else if new[self.leader].evaluation.is_some() {
            let (search, answer) = (&mut searches[self.leader], &mut new[self.leader]);
            is_settled = self.approach(search, answer, figures).unwrap_or(true);
        }
        let worst = self.least_violation(&new, answers);
        let accuracy = self.sought.asked.problem.accuracy;
        // Whether J of what was found here is known.
        let mut known = vec![None; self.which.len()];
        for (place, (answer, search)) in new.into_iter().zip(&searches).enumerate() {
            let old = &mut answers[self.which[place]];
            if tie::is_better(&answer, old) {
                let claimed = search.best().fitness.objective();
                let bound = error_by_bound(old, &answer);
                known[place] = Some(is_known(claimed, &answer, bound, accuracy));
                let least_objective = old.least_objective.or(old.objective());
                *old = Answer {
                    least_objective,
                    ..answer
                };
                agreements[self.which[place]] = None;
            }
        }
        let best = tie::best(answers);
        let place = self.which.iter().position(|&index| index == best);
        if let Some((place, is_known)) = place.and_then(|it| Some((it, known[it]?))) {
            let agreement = match place == self.leader {
                true => self.agreement,
                false => self.descent.confirmed(place),
            };
            let is_settled = is_settled || place != self.leader;
            agreements[best] = Some(Agreement {
                is_reached: agreement.is_reached && is_settled && is_known,
                ..agreement
            });
        }
        worst
    }

    /// Goes on with more shots, on which shares are corrected by those on many: on few a search stays as far from what is
    /// allowed as these may be off, or fails. It ends where nothing comes nearer to passing or, of what passes, J falls no
    /// more. Whether the stage that has found the answer, where one has, gained no more.
    fn refine(&self, search: &mut Search, answer: &mut Answer, figures: &Figures) -> Option<bool> {
        let Sought { asked, control, .. } = *self.sought;
        // As many as one may take, or those of a validation at each station of a stroke.
        let many = match self.descent.sampler.penalty()?.watched.is_empty() {
            true => control.most_shots,
            false => control.validation_shots,
        };
        let mut corrector = self.corrector(search, self.next_stage(), many)?;
        // Validation shots may let pass what the many do not.
        let mut is_doubtful = corrector.utilisation() > 1.0;
        let mut here = self.descent.searches[self.leader].clone();
        let accuracy = asked.problem.accuracy;
        let is_worthwhile =
            |it: &Search| it.gain() > WORTHWHILE * accuracy * it.best().fitness.rank();
        let (mut is_settled, mut least) = (None, corrector.utilisation());
        for _ in 0..MOST_STAGES {
            corrector.refine(&mut here);
            if control.is_stopped() {
                break;
            }
            corrector.measure(&here.best().settings);
            let used = corrector.utilisation();
            if used > 1.0 {
                if here.best().fitness.penalty() > 0.0 && used >= least {
                    break;
                }
                least = least.min(used);
                continue;
            }
            let found = figures.of(std::slice::from_ref(&here)).pop()?;
            let (passes, gains) = (found.passes(), still_gains(&here, &asked.problem));
            corrector.learn(&found);
            let is_better = tie::is_better(&found, answer) || (passes && is_doubtful);
            if is_better {
                (*search, *answer) = (here.clone(), found);
                (is_settled, is_doubtful) = (Some(!gains), false);
            }
            if passes && !(is_better && is_worthwhile(&here)) {
                break;
            }
        }
        is_settled
    }

    /// Goes on with more shots where nothing passes by far: what violates least is told from the rest no better than its
    /// share is known. Whether the last stage gained no more.
    fn approach(
        &self,
        search: &mut Search,
        answer: &mut Answer,
        figures: &Figures,
    ) -> Option<bool> {
        let Sought { asked, control, .. } = *self.sought;
        let stage = Stage {
            settled: SETTLED_FAR,
            ..self.next_stage()
        };
        let mut corrector = self.corrector(search, stage, control.validation_shots)?;
        let mut least = corrector.utilisation();
        let mut here = self.descent.searches[self.leader].clone();
        let (mut nearer, mut is_settled) = (None, false);
        for _ in 0..MOST_STAGES {
            corrector.refine(&mut here);
            if control.is_stopped() {
                break;
            }
            corrector.measure(&here.best().settings);
            let found = corrector.utilisation();
            is_settled = found >= least * (1.0 - WORTHWHILE_FAR * asked.problem.accuracy);
            if found < least {
                nearer = Some(here.clone());
                least = found;
            }
            if is_settled {
                break;
            }
        }
        if let Some(nearer) = nearer {
            *search = nearer;
            *answer = figures.of(std::slice::from_ref(search)).pop()?;
        }
        Some(is_settled)
    }

    /// The stage after those of this search.
    fn next_stage(&self) -> Stage {
        Stage::beyond(self.descent.shots * RISE)
    }

    /// Corrects shares on the shots of a stage by those on many, first at what was found; none where a search may not
    /// have that stage.
    fn corrector(&self, found: &Search, stage: Stage, many: usize) -> Option<Corrector<'_>> {
        let Sought {
            effort, control, ..
        } = *self.sought;
        if stage.shots > control.most_shots || control.is_stopped() {
            return None;
        }
        let sampler = &self.descent.sampler;
        let mut corrector = Corrector::new(self.scenario, effort, control, sampler, stage, many)?;
        corrector.measure(&found.best().settings);
        Some(corrector)
    }

    /// The least violation of new answers, as far as they are better than all that pass by more than the accuracy.
    fn least_violation(&self, new: &[Answer], answers: &[Answer]) -> f64 {
        let all = answers.iter().chain(new);
        let least = least_found(all.filter(|it| it.passes()));
        let worthwhile = least * (1.0 - self.sought.asked.problem.accuracy);
        let is_worthwhile = |it: &&Answer| it.objective().is_none_or(|it| it < worthwhile);
        let violations = new.iter().filter(is_worthwhile);
        violations
            .map(Answer::largest_violation)
            .fold(f64::INFINITY, f64::min)
    }
}

/// Whether the nozzle fits and an answer passes or nearly does.
fn is_near(answer: &Answer) -> bool {
    answer.evaluation.is_some() && answer.largest_violation() <= NEAR
}

/// Whether J on the shots of the search is J on validation shots, within the accuracy, and so is what J owes to the
/// error of the bound that it stays below.
fn is_known(claimed: Option<f64>, answer: &Answer, bound: f64, accuracy: f64) -> bool {
    let (Some(claimed), Some(found)) = (claimed, answer.objective()) else {
        return false;
    };
    bound <= accuracy * found && found - claimed <= accuracy * found + answer.standard_error()
}

/// What J of an answer that passes owes to the error of the share that bounds it: as much as J costs by that share
/// between it and what fails. Shares are tails of distributions, in whose logarithms J is nearly straight.
fn error_by_bound(failing: &Answer, passing: &Answer) -> f64 {
    let (Some(least), Some(found)) = (failing.objective(), passing.objective()) else {
        return 0.0;
    };
    let violations = [failing, passing].map(Answer::largest_violation);
    if failing.passes() || violations[1] <= 0.0 {
        return 0.0;
    }
    let price = (found - least).max(0.0) / ln(violations[0] / violations[1]);
    price * passing.error_of_violation()
}

/// Share of the accuracy by which a stage has to lower J for another one.
const WORTHWHILE: f64 = 0.35;
/// Stages with shares that are corrected where the one before has ended.
const MOST_STAGES: usize = 4;
/// Share of the accuracy by which what violations cost differs at the end of a stage where nothing passes by far.
const SETTLED_FAR: f64 = 1.0;
/// By this many times the accuracy a stage has to lower the largest violation there for another one.
const WORTHWHILE_FAR: f64 = 2.0;
