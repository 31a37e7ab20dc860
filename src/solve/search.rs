//! The search for one contact, stage by stage.

use rayon::prelude::*;

use super::evaluator::{Effort, Evaluator};
use super::polish::{Candidate, polish};
use super::sampler::Sampler;
use super::screening::screened;
use super::space::Space;
use crate::control::Control;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// A stage of the search.
#[derive(Clone, Copy)]
pub(super) struct Stage {
    pub shots: usize,
    /// Candidates that go on, of each group.
    pub candidates: usize,
    /// Longest edge of the first simplex, as a share of each range.
    pub size: f64,
    /// A descent ends when J differs by less than this share of the accuracy over its simplex.
    pub settled: f64,
    /// Descents at most, each from where the one before ended: a new simplex leaves hollows in which
    /// an old one has shrunk.
    pub descents: usize,
}

/// Successive halving: more shots for fewer candidates.
pub(super) const STAGES: [Stage; 4] = [
    Stage {
        shots: 128,
        candidates: 6,
        size: 0.4,
        settled: 1.0,
        descents: 1,
    },
    Stage {
        shots: 256,
        candidates: 2,
        size: 0.4,
        settled: 0.1,
        descents: 1,
    },
    Stage {
        shots: 1024,
        candidates: 1,
        size: 0.3,
        settled: 0.05,
        descents: 1,
    },
    Stage {
        shots: 4096,
        candidates: 1,
        size: 0.15,
        settled: 0.1,
        descents: 2,
    },
];

/// The same for nozzles that are set exactly: a descent that looks more closely finds hollows of the few
/// shots, which makes more of them necessary than J does.
pub(super) const STAGES_SET_EXACTLY: [Stage; 4] = [
    STAGES[0],
    Stage {
        settled: 0.5,
        ..STAGES[1]
    },
    Stage {
        settled: 0.1,
        ..STAGES[2]
    },
    STAGES[3],
];

impl Stage {
    /// The stage after the last one, while the answer is not accurate enough.
    pub fn beyond(shots: usize) -> Self {
        Self {
            shots,
            candidates: 1,
            size: 0.06,
            settled: 0.1,
            descents: 1,
        }
    }

    /// The same with its descents shared out among groups.
    fn shared_by(&self, groups: usize) -> Self {
        Self {
            descents: self.descents.div_ceil(groups),
            ..*self
        }
    }

    /// Where the descents from a candidate end.
    fn descent(&self, space: &Space, evaluator: &Evaluator, start: Candidate) -> Candidate {
        let descents = 0..self.descents;
        descents.fold(start, |best, _| {
            let next = polish(
                space,
                evaluator,
                best.clone(),
                self.size,
                self.settled * evaluator.accuracy(),
            );
            best.or_better(next)
        })
    }
}

/// The search for one contact.
#[derive(Clone)]
pub(super) struct Search {
    space: Space,
    /// Groups of candidates, each best first. They start from points of their own and know nothing of each other, so
    /// that their best candidates, the finalists, tell whether a search ends where it does by chance.
    groups: Vec<Vec<Candidate>>,
}

/// Groups that a search begins with.
const GROUPS: u32 = 2;

impl Search {
    /// Evaluates poses all over the space.
    pub fn screen(scenario: &Scenario, contact: usize, evaluator: &Evaluator) -> Self {
        let space = Space::new(
            &scenario.problem,
            contact,
            !scenario.speed_scales_out(contact),
        );
        let groups = if space.dimensions() == 0 { 1 } else { GROUPS };
        let mut search = Self {
            space,
            groups: Vec::new(),
        };
        search.groups = (0..groups)
            .into_par_iter()
            .map(|number| screened(&search.space, scenario, evaluator, number))
            .collect();
        search
    }

    /// A search of the same contact that begins with another group.
    pub fn another_group(&self, number: u32, scenario: &Scenario, evaluator: &Evaluator) -> Self {
        let space = self.space.clone();
        let groups = vec![screened(&space, scenario, evaluator, number)];
        Self { space, groups }
    }

    /// The best candidate so far.
    pub fn best(&self) -> &Candidate {
        let finalists = self.finalists();
        finalists
            .min_by(|a, b| a.fitness.rank().total_cmp(&b.fitness.rank()))
            .expect("a search has a candidate")
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

    /// Adds what is found from settings on the shots of the last stage.
    pub fn add(
        &mut self,
        settings: &Settings,
        sampler: &Sampler,
        shots: usize,
        effort: &Effort,
        control: &Control,
    ) {
        let samples = sampler.draw(shots);
        let evaluator = sampler.evaluator(sampler.scenario(), &samples, effort, control);
        let point = self.space.point(settings);
        let start = Candidate::at(&self.space, &evaluator, &point);
        let found = Stage::beyond(shots).descent(&self.space, &evaluator, start);
        self.groups.push(vec![found]);
    }

    /// Leaves out all candidates but the best one.
    pub fn keep_best(&mut self) {
        self.groups = vec![vec![self.best().clone()]];
    }

    /// Goes on from the best few candidates of each group with more shots.
    pub fn refine(&mut self, evaluator: &Evaluator, stage: &Stage) {
        let space = &self.space;
        let stage = stage.shared_by(self.groups.len());
        let refined = |group: &Vec<Candidate>| {
            let starts = starts(space, group, &stage).into_par_iter();
            let mut ends: Vec<Candidate> = starts
                .map(|start| {
                    let start = Candidate::at(space, evaluator, &start.point);
                    stage.descent(space, evaluator, start)
                })
                .collect();
            ends.sort_by(|a, b| a.fitness.rank().total_cmp(&b.fitness.rank()));
            ends
        };
        self.groups = self.groups.par_iter().map(refined).collect();
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
        let own = || stage.descent(&self.space, evaluator, here);
        self.groups = vec![vec![found.unwrap_or_else(own)]];
    }

    /// Goes on from the incumbent of another contact, if that is better here than this contact's own.
    pub fn follow(&mut self, leader: &Candidate, evaluator: &Evaluator, stage: &Stage) {
        let here = Candidate::at(&self.space, evaluator, &self.best().point);
        if let Some(found) = self.beside(&here, leader, evaluator, stage) {
            self.groups = vec![vec![found]];
        }
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

/// Candidates of a group to go on with: first those that are better than all their neighbours, as each of them may be
/// in a basin of its own (topographical global optimisation: Toern and Viitanen, 1992), then the best of the others.
fn starts(space: &Space, group: &[Candidate], stage: &Stage) -> Vec<Candidate> {
    let mut starts: Vec<Candidate> = Vec::new();
    let (minima, others): (Vec<usize>, Vec<usize>) =
        (0..group.len()).partition(|&index| is_minimum(space, group, index));
    for index in minima.into_iter().chain(others) {
        let candidate = &group[index];
        let is_new =
            |other: &Candidate| space.distance(&candidate.point, &other.point) > 0.2 * stage.size;
        if starts.len() < stage.candidates && starts.iter().all(is_new) {
            starts.push(candidate.clone());
        }
    }
    starts
}

/// Whether a candidate is better than its nearest neighbours in its group, which is in order.
fn is_minimum(space: &Space, group: &[Candidate], index: usize) -> bool {
    let here = &group[index].point;
    let others = group
        .iter()
        .enumerate()
        .filter(|&(other, _)| other != index);
    let mut distances: Vec<(f64, usize)> = others
        .map(|(other, it)| (space.distance(here, &it.point), other))
        .collect();
    let count = NEIGHBOURS_PER_DIMENSION * space.dimensions();
    if distances.len() > count {
        distances.select_nth_unstable_by(count, |a, b| a.0.total_cmp(&b.0));
        distances.truncate(count);
    }
    distances.iter().all(|&(_, other)| other > index)
}

/// Neighbours that a candidate is compared with, for each setting that is searched.
const NEIGHBOURS_PER_DIMENSION: usize = 2;
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
    use crate::problem::setting::Settings;
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
            Search { space, groups }
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
        let mut search = Search { space, groups };
        // J falls by 3 % from the bound to the cliff at 33.3 deg, and is higher again beyond.
        let on_bound = rank(&search);
        search.refine(&evaluator, &STAGES_SET_EXACTLY[2]);
        assert!(rank(&search) < 0.98 * on_bound, "{}", rank(&search));
    }

    #[test]
    fn a_contact_that_is_better_where_it_is_stays_there() {
        on_common_shots(|evaluator, search| {
            let (damp, mut oiled) = (search(DAMP, 42.6), search(OILED, 44.2));
            let before = oiled.best().settings;
            oiled.follow(damp.best(), evaluator, STAGE);
            assert_eq!(oiled.best().settings, before);
        });
    }
}
