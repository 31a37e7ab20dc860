//! The search for one contact, stage by stage.

use rayon::prelude::*;

use super::evaluator::Evaluator;
use super::polish::{Candidate, polish};
use super::space::Space;
use crate::scenario::Scenario;

/// A stage of the search.
#[derive(Clone, Copy)]
pub(super) struct Stage {
    pub shots: usize,
    /// Candidates that go on, for each contact.
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
pub(super) const STAGES: [Stage; 3] = [
    Stage {
        shots: 256,
        candidates: 6,
        size: 0.4,
        settled: 0.1,
        descents: 1,
    },
    Stage {
        shots: 1024,
        candidates: 2,
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
pub(super) const STAGES_SET_EXACTLY: [Stage; 3] = [
    Stage {
        settled: 0.5,
        ..STAGES[0]
    },
    Stage {
        settled: 0.1,
        ..STAGES[1]
    },
    STAGES[2],
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
    /// Best first.
    candidates: Vec<Candidate>,
}

impl Search {
    /// Evaluates a low-discrepancy set of points all over the space.
    pub fn screen(scenario: &Scenario, contact: usize, evaluator: &Evaluator) -> Self {
        let space = Space::new(
            &scenario.problem,
            contact,
            !scenario.speed_scales_out(contact),
        );
        let dimensions = space.dimensions();
        let points = match dimensions {
            0 => 1,
            1 => 32,
            2 => 96,
            3 => 192,
            _ => 128 * dimensions,
        };
        let seed = scenario.problem.seed as u32;
        // When it is asked to stop, one is enough to answer with.
        let candidates: Vec<Candidate> = (0..points as u32)
            .into_par_iter()
            .filter(|&index| index == 0 || !evaluator.is_stopped())
            .map(|index| Candidate::at(&space, evaluator, &space.spread(index, seed)))
            .collect();
        let mut search = Self { space, candidates };
        search.sort();
        search
    }

    /// The best candidate so far.
    pub fn best(&self) -> &Candidate {
        &self.candidates[0]
    }

    fn sort(&mut self) {
        self.candidates
            .sort_by(|a, b| a.fitness.rank().total_cmp(&b.fitness.rank()));
    }

    /// Goes on from the best few candidates with more shots.
    pub fn refine(&mut self, evaluator: &Evaluator, stage: &Stage) {
        let space = &self.space;
        let mut starts: Vec<Candidate> = Vec::new();
        for candidate in &self.candidates {
            let is_new = |other: &Candidate| {
                space.distance(&candidate.point, &other.point) > 0.2 * stage.size
            };
            if starts.len() < stage.candidates && starts.iter().all(is_new) {
                starts.push(candidate.clone());
            }
        }
        self.candidates = starts
            .into_par_iter()
            .map(|start| {
                let start = Candidate::at(space, evaluator, &start.point);
                stage.descent(space, evaluator, start)
            })
            .collect();
        self.sort();
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
        self.candidates = vec![found.unwrap_or_else(own)];
    }

    /// Goes on from the incumbent of another contact, if that is better here than this contact's own.
    pub fn follow(&mut self, leader: &Candidate, evaluator: &Evaluator, stage: &Stage) {
        let here = Candidate::at(&self.space, evaluator, &self.best().point);
        if let Some(found) = self.beside(&here, leader, evaluator, stage) {
            self.candidates = vec![found];
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
    const STAGE: &Stage = &STAGES[2];

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
            let candidates = vec![Candidate::at(&space, &evaluator, &space.point(&settings))];
            Search { space, candidates }
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
        let candidates = vec![Candidate::at(&space, &evaluator, &point)];
        let mut search = Search { space, candidates };
        // J falls by 3 % from the bound to the cliff at 33.3 deg, and is higher again beyond.
        let on_bound = rank(&search);
        search.refine(&evaluator, &STAGES_SET_EXACTLY[1]);
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
