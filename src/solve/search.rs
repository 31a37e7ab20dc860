//! The search for one contact.

use std::cmp::Ordering;

use rayon::prelude::*;

use super::evaluator::Evaluator;
use super::polish::{Candidate, recombined};
use super::screening::screened;
use super::space::Space;
use super::stage::Stage;
use super::starts::starts;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// The search for one contact.
#[derive(Clone)]
pub(super) struct Search {
    space: Space,
    /// Groups of candidates, each best first. They start from points of their own and know nothing of each other, so
    /// that their best candidates, the finalists, tell whether a search ends where it does by chance.
    groups: Vec<Vec<Candidate>>,
    /// The best candidate that the last stage began with, on the shots of that stage.
    before: Option<Candidate>,
    /// See [`Search::optimality_gap`].
    optimality_gap: f64,
}

/// Groups that a search begins with.
pub(super) const GROUPS: u32 = 2;

impl Search {
    /// Evaluates poses all over the space.
    pub fn screen(scenario: &Scenario, contact: usize, evaluator: &Evaluator) -> Self {
        let space = Space::new(
            &scenario.problem,
            contact,
            !scenario.speed_scales_out(contact),
        );
        let groups = if space.dimensions() == 0 { 1 } else { GROUPS };
        let numbers = (0..groups).into_par_iter();
        let groups = numbers.map(|number| screened(&space, scenario, evaluator, number));
        let groups = groups.collect();
        Self::of(space, groups)
    }

    /// A search with these groups, on which no stage was yet.
    fn of(space: Space, groups: Vec<Vec<Candidate>>) -> Self {
        Self {
            space,
            groups,
            before: None,
            optimality_gap: f64::INFINITY,
        }
    }

    /// A search of the same contact that begins with another group.
    pub fn another_group(&self, number: u32, scenario: &Scenario, evaluator: &Evaluator) -> Self {
        let space = self.space.clone();
        let groups = vec![screened(&space, scenario, evaluator, number)];
        Self::of(space, groups)
    }

    /// The best candidate so far.
    pub fn best(&self) -> &Candidate {
        let better = |best, other| match Candidate::by_rank(other, best) {
            Ordering::Less => other,
            _ => best,
        };
        self.finalists().fold(&self.groups[0][0], better)
    }

    /// The best candidate of each group.
    pub fn finalists(&self) -> impl Iterator<Item = &Candidate> {
        self.groups.iter().filter_map(|group| group.first())
    }

    /// How many settings are searched.
    pub fn dimensions(&self) -> usize {
        self.space.dimensions()
    }

    /// Adds the finalists of another search of the same contact.
    pub fn join(&mut self, other: Self) {
        self.groups.extend(other.groups);
    }

    /// Adds what is found from settings, as a finalist of its own.
    pub fn add(&mut self, settings: &Settings, evaluator: &Evaluator, stage: &Stage) {
        let point = self.space.point(settings);
        let start = Candidate::at(&self.space, evaluator, &point);
        let found = stage.descent(&self.space, evaluator, start);
        self.groups.push(vec![found]);
    }

    /// Goes on from all finalists together, which have not agreed; what is better than each of them joins them.
    pub fn recombine(&mut self, evaluator: &Evaluator, stage: &Stage) {
        let mut found: Vec<Candidate> = self.finalists().cloned().collect();
        found.sort_by(Candidate::by_rank);
        let settled = stage.settled * evaluator.accuracy();
        let start = recombined(&self.space, evaluator, &found, stage.size, settled);
        let end = stage.descent(&self.space, evaluator, start);
        if end.fitness.rank() < found[0].fitness.rank() {
            self.groups.push(vec![end]);
        }
    }

    /// Goes on with more shots from all finalists together, of which another one may be the best there.
    pub fn refine_together(&mut self, evaluator: &Evaluator, stage: &Stage) {
        let finalists: Vec<&Candidate> = self.finalists().collect();
        let anew = |it: &Candidate| vec![Candidate::at(&self.space, evaluator, &it.point)];
        self.groups = finalists.into_par_iter().map(anew).collect();
        let before = self.best().clone();
        self.recombine(evaluator, stage);
        let best = self.best().clone();
        self.end_stage(Some(before), vec![vec![best]]);
    }

    /// Leaves out all candidates but the best one.
    pub fn keep_best(&mut self) {
        self.groups = vec![vec![self.best().clone()]];
        self.before = None;
        self.optimality_gap = f64::INFINITY;
    }

    /// Whether the last stage began with these settings; the speed follows from the shots unless it is searched.
    pub fn began_with(&self, settings: &Settings) -> bool {
        let before = self.before.as_ref();
        before.is_some_and(|before| {
            let speed = before.settings.speed;
            before.settings == Settings { speed, ..*settings }
        })
    }

    /// Goes back to what the last stage began with, where there was one: what that has found may be better on its own
    /// shots alone.
    pub fn go_back(&mut self) {
        if let Some(before) = self.before.take() {
            self.groups = vec![vec![before]];
        }
    }

    /// By how much J of the settings that the last stage began with is above the least that it found, both on the
    /// shots of that stage; infinite where no stage was for this search.
    ///
    /// Where these shots are independent of those on which the settings were found, that is on average no less than
    /// how far J of these settings is above the least one (W.-K. Mak, D. P. Morton, R. K. Wood, Operations Research
    /// Letters 24, 1999); on common random numbers both errors are nearly the same, and cancel.
    pub fn optimality_gap(&self) -> f64 {
        self.optimality_gap
    }

    /// By how much the last stage has lowered J on its shots; 0 where the search went back.
    pub fn gain(&self) -> f64 {
        let before = self.before.as_ref();
        before.map_or(0.0, |before| {
            before.fitness.rank() - self.best().fitness.rank()
        })
    }

    /// Goes on from the best few candidates of each group with more shots.
    pub fn refine(&mut self, evaluator: &Evaluator, stage: &Stage) {
        let space = &self.space;
        let stage = stage.shared_by(self.groups.len());
        let refined = |group: &Vec<Candidate>| {
            let starts = starts(space, group, &stage).into_par_iter();
            let descents = starts.map(|start| {
                let start = Candidate::at(space, evaluator, &start.point);
                (start.clone(), stage.descent(space, evaluator, start))
            });
            let (before, mut ends): (Vec<Candidate>, Vec<Candidate>) = descents.unzip();
            ends.sort_by(Candidate::by_rank);
            (before, ends)
        };
        let (before, groups): (Vec<_>, _) = self.groups.par_iter().map(refined).unzip();
        let before = before.into_iter().flatten().min_by(Candidate::by_rank);
        self.end_stage(before, groups);
    }

    /// Takes what a stage has found that began with this candidate.
    fn end_stage(&mut self, before: Option<Candidate>, groups: Vec<Vec<Candidate>>) {
        self.groups = groups;
        self.before = before;
        self.optimality_gap = self.gain();
    }

    /// Goes on from the best candidate with more shots, or warm from the incumbent of another contact.
    pub fn refine_from_incumbent(
        &mut self,
        leader: &Candidate,
        evaluator: &Evaluator,
        stage: &Stage,
    ) {
        let here = Candidate::at(&self.space, evaluator, &self.best().point);
        let found = self.beside(&here, leader, evaluator, stage);
        let own = || stage.descent(&self.space, evaluator, here.clone());
        let found = found.unwrap_or_else(own);
        self.end_stage(Some(here), vec![vec![found]]);
    }

    /// Goes on from the incumbent of another contact, if that is better here than this contact's own.
    pub fn follow(&mut self, leader: &Candidate, evaluator: &Evaluator, stage: &Stage) {
        let here = Candidate::at(&self.space, evaluator, &self.best().point);
        let found = self.beside(&here, leader, evaluator, &stage.catching_up());
        // On the shots of the others even where it stays: what is compared is compared on common ones.
        let best = found.unwrap_or_else(|| here.clone());
        self.end_stage(Some(here), vec![vec![best]]);
        // What has not been searched on shows nothing of how good it is.
        self.optimality_gap = f64::INFINITY;
    }

    /// Warm start: what is found from the incumbent of another contact, if that is better than here.
    ///
    /// Often friction makes little difference: what is within half the accuracy of J of that
    /// contact is taken as it is, unless something on the way back is better by as much: with other
    /// friction the cliff may stand elsewhere.
    fn beside(
        &self,
        here: &Candidate,
        leader: &Candidate,
        evaluator: &Evaluator,
        stage: &Stage,
    ) -> Option<Candidate> {
        if leader.point.len() != self.space.dimensions() {
            return None;
        }
        let below = |cut: f64, point: &[f64]| Candidate::below(cut, &self.space, evaluator, point);
        let there = below(here.fitness.rank(), &leader.point);
        if here.fitness.rank() <= there.fitness.rank() {
            return None;
        }
        let back = |best: Candidate, share: f64| {
            let point = between(&there.point, &here.point, share);
            let other = below(best.fitness.rank(), &point);
            best.or_better(other)
        };
        let start = WAY_BACK.into_iter().fold(there.clone(), back);
        let little = 0.5 * evaluator.accuracy();
        let is_close = there.fitness.rank() <= leader.fitness.rank() * (1.0 + little);
        let gains = start.fitness.rank() < there.fitness.rank() * (1.0 - little);
        Some(if is_close && !gains {
            start
        } else {
            stage.descent(&self.space, evaluator, start)
        })
    }
}

/// Where to look between the best place of another contact and one's own, as shares of the way.
const WAY_BACK: [f64; 3] = [0.5, 0.25, 0.125];

fn between(from: &[f64], to: &[f64], share: f64) -> Vec<f64> {
    let pairs = from.iter().zip(to);
    pairs.map(|(from, to)| from + share * (to - from)).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::jet::{Samples, Stream};
    use crate::problem::model::Effect;
    use crate::solve::stage::{STAGES, STAGES_SET_EXACTLY};
    use crate::solve::{Control, Effort};

    const DRY: usize = 0;
    const DAMP: usize = 1;
    const OILED: usize = 2;
    const STAGE: &Stage = &STAGES[3];

    fn scenario() -> Scenario {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems/keyway-long.yaml");
        let (mut scenario, _) = Scenario::load(&file).expect("it is sound");
        scenario.problem.paths.shot_size = false;
        scenario
    }

    /// Runs with an evaluator and with searches that start at an incidence, deg.
    fn on_common_shots(check: impl Fn(&Evaluator, &dyn Fn(usize, f64) -> Search)) {
        let scenario = scenario();
        let shots = Samples::with_boundary(&scenario.problem, Stream::Search, 1024).shots;
        let (effort, control) = (Effort::default(), Control::default());
        let evaluator = Evaluator::new(&scenario, &shots, &effort, &control);
        let search = |contact: usize, degrees: f64| {
            let space = Space::new(&scenario.problem, contact, false);
            let settings = Settings {
                incidence: degrees.to_radians(),
                azimuth: 0.0,
                standoff: 6e-3,
                ..space.settings(&space.spread(0, 0))
            };
            let groups = vec![vec![Candidate::at(
                &space,
                &evaluator,
                &space.point(&settings),
            )]];
            Search::of(space, groups)
        };
        check(&evaluator, &search);
    }

    fn rank(search: &Search) -> f64 {
        search.best().fitness.rank()
    }

    #[test]
    fn a_contact_beyond_its_cliff_does_not_stop_at_that_of_another() {
        on_common_shots(|evaluator, search| {
            // J of both is the same at 42.6 deg, but oiled walls allow 44.3 deg.
            let (damp, mut oiled) = (search(DAMP, 42.6), search(OILED, 45.8));
            assert!(rank(&oiled) > 1.02 * rank(&damp));
            oiled.follow(damp.best(), evaluator, STAGE);
            assert!(rank(&oiled) < 0.97 * rank(&damp), "{}", rank(&oiled));
        });
    }

    #[test]
    fn a_descent_that_begins_on_a_bound_finds_what_is_better_inside() {
        let scenario = scenario();
        let space = Space::new(&scenario.problem, DRY, false);
        let point = [0.0, 0.5020436366399129, 0.5086951096852622];
        let effects = [Effect::ExitWidth, Effect::LaterRebounds, Effect::Spin];
        let scenario = scenario.without(&effects, &space.settings(&point));
        let shots = Samples::with_boundary(&scenario.problem, Stream::Search, 1024).shots;
        let (effort, control) = (Effort::default(), Control::default());
        let evaluator = Evaluator::new(&scenario, &shots, &effort, &control);
        let groups = vec![vec![Candidate::at(&space, &evaluator, &point)]];
        let mut search = Search::of(space, groups);
        // J falls by 3 % from the bound to the cliff at 33.3 deg, and is higher again beyond.
        let on_bound = rank(&search);
        search.refine(&evaluator, &STAGES_SET_EXACTLY[2]);
        assert!(rank(&search) < 0.98 * on_bound, "{}", rank(&search));
    }

    #[test]
    fn finalists_that_do_not_agree_go_on_together() {
        on_common_shots(|evaluator, search| {
            let mut dry = search(DRY, 58.0);
            for degrees in [60.0, 62.0, 64.0] {
                dry.join(search(DRY, degrees));
            }
            let before = rank(&dry);
            dry.recombine(evaluator, STAGE);
            assert!(rank(&dry) < 0.9 * before, "{before} {}", rank(&dry));
            assert_eq!(dry.finalists().count(), 5);
            // More shots begin with the best of them, and leave one.
            let best = dry.best().settings;
            dry.refine_together(evaluator, STAGE);
            assert!(dry.began_with(&best) && dry.finalists().count() == 1);
        });
    }

    #[test]
    fn a_search_goes_back_to_what_a_stage_began_with() {
        on_common_shots(|evaluator, search| {
            let mut dry = search(DRY, 60.0);
            let before = dry.best().settings;
            dry.refine(evaluator, STAGE);
            assert!(dry.gain() > 0.1 * rank(&dry) && dry.began_with(&before));
            let (gain, gap) = (dry.gain(), dry.optimality_gap());
            dry.go_back();
            assert_eq!(dry.best().settings, before);
            // What the stage has shown of it stays.
            assert_eq!((dry.gain(), dry.optimality_gap()), (0.0, gap));
            assert_eq!(gain, gap);
        });
    }

    #[test]
    fn a_contact_that_is_better_where_it_is_stays_there() {
        on_common_shots(|evaluator, search| {
            let (damp, mut oiled) = (search(DAMP, 42.6), search(OILED, 44.2));
            let before = oiled.best().settings;
            oiled.follow(damp.best(), evaluator, STAGE);
            assert_eq!(oiled.best().settings, before);
            assert_eq!((oiled.gain(), oiled.optimality_gap()), (0.0, f64::INFINITY));
        });
    }
}
