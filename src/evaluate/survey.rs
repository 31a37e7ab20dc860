//! What the shots of one pose do, kept so that verdicts can be given at any launch speed.

use super::Counts;
use crate::jet::Deviate;
use crate::objective::{Score, Tally, Terms};
use crate::problem::setting::Choice;
use crate::scene::lanes::LANES;
use crate::setup::Setup;
use crate::trace::{End, Tracer, Volley, Witness};

/// The impacts of some shots, per unit of launch speed.
pub(crate) struct Survey {
    tally: Tally,
    /// First hits on target that stick.
    sticking: usize,
    /// For each surface the largest N* of every shot that hits it off target, N s per m/s.
    largest: Vec<Vec<f64>>,
}

impl Survey {
    /// Traces the shots of a choice of settings.
    pub fn of(setup: &Setup, choice: &Choice, shots: &[Deviate]) -> Self {
        let surfaces = setup.surfaces.len();
        let mut surveyor = Surveyor {
            score: Score::new(setup, choice.contact, choice.speed, shots.len()),
            sticking: 0,
            per_speed: 1.0 / choice.speed,
            largest: vec![Vec::new(); surfaces],
            in_volley: vec![0.0; surfaces * LANES],
            touched: Vec::new(),
        };
        let tracer = Tracer::new(setup, choice, choice.speed);
        tracer.fire(shots, &mut surveyor, |surveyor, shots, rays| {
            surveyor.score.end_volley(shots, rays);
            surveyor.end_volley();
        });
        Self {
            tally: surveyor.score.finish(),
            sticking: surveyor.sticking,
            largest: surveyor.largest,
        }
    }

    /// Rays cast for each shot.
    pub fn rays_per_shot(&self) -> f64 {
        self.tally.rays as f64 / self.tally.shots.max(1) as f64
    }

    /// Share of the first hits on target that stick; `None` without any hit.
    pub fn share_sticking(&self) -> Option<f64> {
        let hits = self.tally.hits.len();
        (hits > 0).then(|| self.sticking as f64 / hits as f64)
    }

    /// The terms of the objective at a launch speed, m/s.
    pub fn terms(&self, setup: &Setup, speed: f64) -> Terms {
        self.tally.terms(&setup.problem.goals, speed)
    }

    /// How many of them break what at a launch speed, m/s.
    pub fn counts(&self, setup: &Setup, speed: f64) -> Counts {
        let goals = &setup.problem.goals;
        let hits = &self.tally.hits;
        let mut over = vec![0; setup.surfaces.len()];
        for ((over, limits), largest) in over.iter_mut().zip(&setup.surfaces).zip(&self.largest) {
            if let Some(allow) = limits.allow {
                *over = largest.iter().filter(|n| **n * speed > allow).count();
            }
        }
        Counts {
            shots: self.tally.shots,
            is_exact: setup.problem.has_one_ray(),
            hits: hits.len(),
            off_target: hits.off_target(goals, speed),
            over_limit: hits.over_limit(goals, speed),
            over,
        }
    }
}

/// Makes a survey.
struct Surveyor {
    score: Score<f64>,
    sticking: usize,
    per_speed: f64,
    largest: Vec<Vec<f64>>,
    /// The largest N* per launch speed of each shot of the volley on each surface.
    in_volley: Vec<f64>,
    /// Where that is not 0.
    touched: Vec<usize>,
}

impl Surveyor {
    fn end_volley(&mut self) {
        let surfaces = self.largest.len();
        for place in self.touched.drain(..) {
            self.largest[place % surfaces].push(self.in_volley[place]);
            self.in_volley[place] = 0.0;
        }
    }
}

impl Witness<f64> for Surveyor {
    fn impacts(&mut self, volley: &Volley<f64>) {
        self.score.impacts(volley);
        for i in (0..volley.rays.count).filter(|&i| volley.impacts.counts[i] != 0.0) {
            if self.score.is_on_target(i) {
                let is_first = volley.number[i] == 1.0;
                self.sticking += usize::from(is_first && volley.impacts.sticks[i] != 0.0);
                continue;
            }
            let surface = volley.hits.surface[i] as usize;
            let place = volley.shot[i] as usize * self.largest.len() + surface;
            let normal = volley.impacts.normal[i] * self.per_speed;
            if self.in_volley[place] == 0.0 && normal > 0.0 {
                self.touched.push(place);
            }
            self.in_volley[place] = self.in_volley[place].max(normal);
        }
    }

    fn ends(&mut self, _: usize, _: End, _: usize) {}
}
