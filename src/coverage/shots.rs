//! The shots that coverage is counted from, fired from all along a stroke.

use crate::jet::{Draw, ShotSample};
use crate::problem::stroke::{WHOLE, place_in};
use crate::scenario::Scenario;

/// Shots of the jet, drawn set by set, as all of them would take too much room.
pub(super) struct Shots<'a> {
    draw: Draw<'a>,
    /// The places between which they are fired.
    ends: [f64; 2],
    /// How often each is fired, from places evenly apart.
    repeats: usize,
}

/// Drawing a shot takes longer than tracing it to its first hit. What it hits from places far apart are different cells,
/// so that the density in each is as certain as with shots of their own.
const REPEATS: usize = 8;

impl<'a> Shots<'a> {
    /// So many of the shots for a [`purpose`](crate::jet::purpose), fired from one place to another; from where it
    /// stands, for a nozzle that does not travel.
    pub fn new(scenario: &'a Scenario, purpose: u32, shots: usize, ends: [f64; 2]) -> Self {
        let repeats = match scenario.traverse {
            Some(_) => REPEATS,
            None => 1,
        };
        let drawn = shots.div_ceil(repeats);
        Self {
            draw: Draw::new(&scenario.problem, purpose, drawn).without_boundary(),
            ends,
            repeats,
        }
    }

    /// Number of replicates.
    pub fn sets(&self) -> u32 {
        self.draw.sets()
    }

    /// Fires the shots of one replicate, some at a time; how many there are.
    pub fn fire(&self, number: u32, mut at: impl FnMut(&[ShotSample])) -> usize {
        let mut shots = self.draw.set(number).jet.shots;
        let drawn: Vec<f64> = shots.iter().map(|shot| shot.place).collect();
        for repeat in 0..self.repeats {
            let further = repeat as f64 / self.repeats as f64;
            for (shot, place) in shots.iter_mut().zip(&drawn) {
                shot.place = place_in(self.ends, onwards(*place, further));
            }
            at(&shots);
        }
        shots.len() * self.repeats
    }
}

/// A place farther along the whole of a stroke, which begins anew at its end.
fn onwards(place: f64, further: f64) -> f64 {
    let moved = place + further;
    match moved < WHOLE[1] {
        true => moved,
        false => moved - 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_begin_anew_at_the_end() {
        assert_eq!(onwards(0.25, 0.0), 0.25);
        assert_eq!(onwards(0.25, 0.125), 0.375);
        assert_eq!(onwards(0.25, 0.25), -0.5);
        assert_eq!(onwards(0.375, 0.875), 0.25);
    }
}
