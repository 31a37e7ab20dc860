//! Where the shots that do harm come from.

use crate::elementary::square;
use crate::jet::{Deviate, Focus, Replicates, Scouts, purpose};
use crate::objective::Score;
use crate::problem::goal::TangentialImpulse;
use crate::problem::setting::Choice;
use crate::scene::lanes::LANES;
use crate::setup::{Setup, SurfaceLimits};
use crate::trace::{End, Tracer, Volley, Witness};

/// Where the shots of a choice of settings come from that do harm, and how many rays it took to find out.
/// Harm is a miss, a tangential impulse over its limit, an impact on a secondary surface, each as
/// much as it costs.
///
/// Rare harm comes from a corner of what exit, cone and tolerance allow. The shots of a wider jet
/// reach beyond it; what they find is where those of the next, narrower one look more closely (the
/// cross-entropy method for rare events: Rubinstein, European Journal of Operational Research 99, 1997).
pub fn focus_on_harm(setup: &Setup, choice: &Choice) -> (Focus, usize) {
    let (mut focus, mut rays) = (Focus::NONE, 0);
    if setup.problem.has_one_ray() {
        return (focus, rays);
    }
    for (number, stretch) in STRETCHES.into_iter().enumerate() {
        let stream = Replicates::stream(purpose::HARM, number as u32);
        let scouts = Scouts::new(&setup.problem, stretch, stream, SHOTS, &focus);
        let inspector = Inspector::of(setup, choice, &scouts.deviates);
        focus = scouts.focus(&focus, &rare(&inspector.harm, &scouts.deviates));
        rays += inspector.rays;
    }
    (focus, rays)
}

/// How many times as wide as it is the jet is made, one after the other.
const STRETCHES: [f64; 4] = [2.0, 1.5, 1.2, 1.0];
/// Shots of each.
const SHOTS: usize = 768;

/// What shots do harm that is rare, with what they stand for: what others do alike is averaged well enough
/// without more of them.
fn rare(harm: &[f64], shots: &[Deviate]) -> Vec<f64> {
    let pairs = || harm.iter().zip(shots);
    let weight: f64 = shots.iter().map(|shot| shot.weight).sum();
    let mean = pairs().map(|(harm, shot)| harm * shot.weight).sum::<f64>() / weight;
    let counted = pairs().map(|(&harm, shot)| {
        if harm > RARE * mean {
            harm * shot.weight
        } else {
            0.0
        }
    });
    counted.collect()
}

/// Rare is harm of more than so many times the mean.
const RARE: f64 = 10.0;

/// Finds out what harm shots do.
struct Inspector {
    score: Score<f64>,
    /// What (N*)^2 costs on each surface.
    costs: Vec<f64>,
    tangential: Option<TangentialImpulse>,
    miss: f64,
    /// Of each shot of the volley.
    in_volley: [f64; LANES],
    /// Whether it has hit the target first.
    on_target: [bool; LANES],
    /// Of each shot.
    harm: Vec<f64>,
    rays: usize,
}

impl Inspector {
    fn of(setup: &Setup, choice: &Choice, shots: &[Deviate]) -> Self {
        let goals = &setup.problem.goals;
        let cost = |limits: &SurfaceLimits| {
            let allow = limits.allow?;
            Some(limits.weight / (allow * allow))
        };
        let costs = setup.surfaces.iter().map(|it| cost(it).unwrap_or(0.0));
        let mut inspector = Self {
            score: Score::new(setup, choice.contact, choice.speed, shots.len()),
            costs: costs.collect(),
            tangential: goals.tangential_impulse,
            miss: goals.miss.weight,
            in_volley: [0.0; LANES],
            on_target: [false; LANES],
            harm: Vec::with_capacity(shots.len()),
            rays: 0,
        };
        let tracer = Tracer::new(setup, choice, choice.speed);
        tracer.fire(shots, &mut inspector, Self::end_volley);
        inspector
    }

    fn end_volley(&mut self, shots: &[Deviate], rays: usize) {
        self.rays += rays;
        for i in 0..shots.len() {
            let miss = if self.on_target[i] { 0.0 } else { self.miss };
            self.harm.push(self.in_volley[i] + miss);
        }
        self.in_volley = [0.0; LANES];
        self.on_target = [false; LANES];
    }
}

impl Witness<f64> for Inspector {
    fn impacts(&mut self, volley: &Volley<f64>) {
        self.score.impacts(volley);
        for i in (0..volley.rays.count).filter(|&i| volley.impacts.counts[i] != 0.0) {
            let shot = volley.shot[i] as usize;
            if !self.score.is_on_target(i) {
                let cost = self.costs[volley.hits.surface[i] as usize];
                self.in_volley[shot] += cost * square(volley.impacts.normal[i]);
            } else if volley.number[i] == 1.0 {
                self.on_target[shot] = true;
                let excess = |goal: TangentialImpulse| {
                    let excess = (volley.impacts.tangential[i] / goal.limit - 1.0).max(0.0);
                    goal.weight * excess * excess
                };
                self.in_volley[shot] += self.tangential.map_or(0.0, excess);
            }
        }
    }

    fn ends(&mut self, _: usize, _: End, _: usize) {}
}
