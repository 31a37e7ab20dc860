//! The search for one contact, stage by stage.

use rayon::prelude::*;

use super::judge::Judge;
use super::polish::{Candidate, polish};
use super::space::Space;
use crate::setup::Setup;

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

/// More and more shots for fewer and fewer candidates.
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
    /// What follows the last stage while the answer is not accurate enough.
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
    fn descent(&self, space: &Space, judge: &Judge, start: Candidate, accuracy: f64) -> Candidate {
        let descents = 0..self.descents;
        descents.fold(start, |best, _| {
            let next = polish(
                space,
                judge,
                best.clone(),
                self.size,
                self.settled * accuracy,
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
    /// Whether any place of the screening did harm.
    has_met_harm: bool,
}

impl Search {
    /// Judges a low-discrepancy set of points all over the space.
    pub fn screen(setup: &Setup, contact: usize, judge: &Judge) -> Self {
        let space = Space::new(&setup.problem, contact, !setup.speed_scales_out(contact));
        let dimensions = space.dimensions();
        let points = match dimensions {
            0 => 1,
            1 => 32,
            2 => 96,
            3 => 192,
            _ => 128 * dimensions,
        };
        let seed = setup.problem.seed as u32;
        // When it is told to stop, one is enough to answer with.
        let candidates: Vec<Candidate> = (0..points as u32)
            .into_par_iter()
            .filter(|&index| index == 0 || !judge.is_stopped())
            .map(|index| Candidate::at(&space, judge, &space.spread(index, seed)))
            .collect();
        let mut search = Self {
            space,
            has_met_harm: candidates.iter().any(|it| it.standing.does_harm()),
            candidates,
        };
        search.sort();
        search
    }

    /// The best candidate so far.
    pub fn best(&self) -> &Candidate {
        &self.candidates[0]
    }

    /// Whether shots missed or met secondary surfaces anywhere when it looked all over the settings: then
    /// there are cliffs.
    pub fn has_met_harm(&self) -> bool {
        self.has_met_harm
    }

    /// The same candidates in the space of another model of the same problem.
    pub fn carried_over(&self, setup: &Setup) -> Self {
        let contact = self.best().choice.contact;
        let space = Space::new(&setup.problem, contact, !setup.speed_scales_out(contact));
        let carried = |candidate: &Candidate| Candidate {
            point: space.point(&candidate.choice),
            ..candidate.clone()
        };
        Self {
            candidates: self.candidates.iter().map(carried).collect(),
            space,
            ..*self
        }
    }

    fn sort(&mut self) {
        self.candidates
            .sort_by(|a, b| a.standing.rank().total_cmp(&b.standing.rank()));
    }

    /// Goes on from the best few candidates with more shots.
    pub fn refine(&mut self, judge: &Judge, stage: &Stage, accuracy: f64) {
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
                let start = Candidate::at(space, judge, &start.point);
                stage.descent(space, judge, start, accuracy)
            })
            .collect();
        self.sort();
    }

    /// Goes on from the best candidate with more shots, or from where another contact is best.
    pub fn refine_beside(
        &mut self,
        leader: &Candidate,
        judge: &Judge,
        stage: &Stage,
        accuracy: f64,
    ) {
        let here = Candidate::at(&self.space, judge, &self.best().point);
        let found = self.beside(&here, leader, judge, stage, accuracy);
        let own = || stage.descent(&self.space, judge, here, accuracy);
        self.candidates = vec![found.unwrap_or_else(own)];
    }

    /// Goes on from where another contact is best, if that is better than where this one is.
    pub fn follow(&mut self, leader: &Candidate, judge: &Judge, stage: &Stage, accuracy: f64) {
        let here = Candidate::at(&self.space, judge, &self.best().point);
        if let Some(found) = self.beside(&here, leader, judge, stage, accuracy) {
            self.candidates = vec![found];
        }
    }

    /// What is found from where another contact is best, if that is better than here.
    ///
    /// Often friction makes little difference: what is within half the accuracy of J of that
    /// contact is taken as it is, unless something on the way back is better by as much: with other
    /// friction the cliff may stand elsewhere.
    fn beside(
        &self,
        here: &Candidate,
        leader: &Candidate,
        judge: &Judge,
        stage: &Stage,
        accuracy: f64,
    ) -> Option<Candidate> {
        if leader.point.len() != self.space.dimensions() {
            return None;
        }
        let at = |point: &[f64]| Candidate::at(&self.space, judge, point);
        let there = at(&leader.point);
        if here.standing.rank() <= there.standing.rank() {
            return None;
        }
        let back = |share: f64| at(&between(&there.point, &here.point, share));
        let way_back = WAY_BACK.map(back).into_iter();
        let start = way_back.fold(there.clone(), Candidate::or_better);
        let little = 0.5 * accuracy;
        let is_close = there.standing.rank() <= leader.standing.rank() * (1.0 + little);
        let gains = start.standing.rank() < there.standing.rank() * (1.0 - little);
        Some(if is_close && !gains {
            start
        } else {
            stage.descent(&self.space, judge, start, accuracy)
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
    use crate::precision::Precision;
    use crate::problem::model::Effect;
    use crate::problem::setting::Choice;
    use crate::solve::{Control, Effort};

    const DRY: usize = 0;
    const DAMP: usize = 1;
    const OILED: usize = 2;
    const STAGE: &Stage = &STAGES[2];
    const ACCURACY: f64 = 0.01;

    fn setup() -> Setup {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems/keyway-long.yaml");
        let (mut setup, _) = Setup::load(&file).expect("it is sound");
        setup.problem.paths.shot_size = false;
        setup
    }

    /// Runs with a judge and a search that stands at an incidence, deg.
    fn on_common_shots(check: impl Fn(&Judge, &dyn Fn(usize, f64) -> Search)) {
        let setup = setup();
        let shots = Samples::with_rim(&setup.problem, Stream::Search, 1024).deviates;
        let (effort, control) = (Effort::default(), Control::default());
        let judge = Judge::new(&setup, Precision::F64, &shots, &effort, &control);
        let search = |contact: usize, degrees: f64| {
            let space = Space::new(&setup.problem, contact, false);
            let choice = Choice {
                incidence: degrees.to_radians(),
                azimuth: 0.0,
                standoff: 6e-3,
                ..space.choice(&space.spread(0, 0))
            };
            let candidates = vec![Candidate::at(&space, &judge, &space.point(&choice))];
            Search {
                space,
                candidates,
                has_met_harm: true,
            }
        };
        check(&judge, &search);
    }

    fn rank(search: &Search) -> f64 {
        search.best().standing.rank()
    }

    #[test]
    fn a_contact_beyond_its_cliff_does_not_stop_at_that_of_another() {
        on_common_shots(|judge, search| {
            // J of both is the same at 42.6 deg, but oiled walls allow 44.3 deg.
            let (damp, mut oiled) = (search(DAMP, 42.6), search(OILED, 45.8));
            assert!(rank(&oiled) > 1.02 * rank(&damp));
            oiled.follow(damp.best(), judge, STAGE, ACCURACY);
            assert!(rank(&oiled) < 0.97 * rank(&damp), "{}", rank(&oiled));
        });
    }

    #[test]
    fn a_descent_that_begins_on_a_bound_finds_what_is_better_inside() {
        let setup = setup();
        let space = Space::new(&setup.problem, DRY, false);
        let point = [0.0, 0.5020436366399129, 0.5086951096852622];
        let effects = [Effect::ExitWidth, Effect::LaterRebounds, Effect::Spin];
        let setup = setup.without(&effects, &space.choice(&point));
        let shots = Samples::with_rim(&setup.problem, Stream::Search, 1024).deviates;
        let (effort, control) = (Effort::default(), Control::default());
        let judge = Judge::new(&setup, Precision::F64, &shots, &effort, &control);
        let candidates = vec![Candidate::at(&space, &judge, &point)];
        let mut search = Search {
            space,
            candidates,
            has_met_harm: true,
        };
        // J falls by 3 % from the bound to the cliff at 33.3 deg, and is higher again beyond.
        let on_bound = rank(&search);
        search.refine(&judge, &STAGES_SET_EXACTLY[1], ACCURACY);
        assert!(rank(&search) < 0.98 * on_bound, "{}", rank(&search));
    }

    #[test]
    fn a_contact_that_is_better_where_it_is_stays_there() {
        on_common_shots(|judge, search| {
            let (damp, mut oiled) = (search(DAMP, 42.6), search(OILED, 44.2));
            let before = oiled.best().choice;
            oiled.follow(damp.best(), judge, STAGE, ACCURACY);
            assert_eq!(oiled.best().choice, before);
        });
    }
}
