//! One component of an importance density: a product over dimensions of histograms.

use super::{CELLS, Cells, Event, NO_CELL, TURNS, effective_count};
use crate::elementary::square;
use crate::jet::qmc_point::{DIMENSIONS, Dimension};

/// A product over dimensions of histograms with a few cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Component {
    /// Share of the points that are drawn with it.
    pub share: f64,
    pub(super) density: [[f64; CELLS]; DIMENSIONS],
    /// A bit for each dimension whose histogram is not flat.
    varied: u32,
}

impl Component {
    /// The boundary proposal itself.
    pub const FLAT: Self = Self {
        share: 1.0,
        density: [[1.0; CELLS]; DIMENSIONS],
        varied: 0,
    };

    /// Adapts each dimension's histogram to where events came from that weigh as much, shrunk towards the histogram before
    /// by least squares: differences within chance change little.
    pub fn adapt(&mut self, events: &[Event], weights: &[f64]) {
        let total: f64 = weights.iter().sum();
        if total <= 0.0 {
            return;
        }
        let mut sums = [[0.0; CELLS]; DIMENSIONS];
        for (event, weight) in events.iter().zip(weights) {
            for (sums, &cell) in sums.iter_mut().zip(event.cells) {
                if let Some(sum) = sums.get_mut(usize::from(cell)) {
                    *sum += weight;
                }
            }
        }
        let count = effective_count(weights.iter().copied());
        for (dimension, (density, sums)) in self.density.iter_mut().zip(&sums).enumerate() {
            if events[0].cells[dimension] == NO_CELL {
                continue;
            }
            let found = smooth(sums, TURNS.contains(&dimension));
            let found = found.map(|sum| CELLS as f64 * sum / total);
            let apart: f64 = found.iter().zip(&*density).map(apart).sum();
            let by_chance = SMOOTHED * (CELLS - 1) as f64 / count;
            let share = (1.0 - by_chance / (apart / CELLS as f64)).clamp(0.0, 1.0);
            let share = share.min(count / (count + DOUBT));
            for (density, found) in density.iter_mut().zip(found) {
                *density += share * (found - *density);
            }
        }
        let is_varied = |cells: &[f64; CELLS]| u32::from(*cells != [1.0; CELLS]);
        let bits = self.density.iter().enumerate();
        self.varied = bits
            .map(|(dimension, cells)| is_varied(cells) << dimension)
            .sum();
    }

    /// A coordinate with this density, from one that is uniform in 0 to 1.
    pub fn drawn(&self, dimension: Dimension, uniform: f64) -> f64 {
        // What the search below gives for a flat histogram.
        if self.varied & (1 << dimension as u32) == 0 {
            return uniform;
        }
        let density = &self.density[dimension as usize];
        let mut left = uniform * CELLS as f64;
        let mut cell = 0;
        while cell < CELLS - 1 && left >= density[cell] {
            left -= density[cell];
            cell += 1;
        }
        // Rounding must not carry it into the next cell.
        let within = (left / density[cell]).min(1.0 - f64::EPSILON);
        (cell as f64 + within) / CELLS as f64
    }

    /// The density at a point relative to that of the boundary proposal.
    pub fn density(&self, cells: &Cells) -> f64 {
        let (mut product, mut varied) = (1.0, self.varied);
        while varied != 0 {
            let dimension = varied.trailing_zeros() as usize;
            let density = self.density[dimension].get(usize::from(cells[dimension]));
            product *= density.copied().unwrap_or(1.0);
            varied &= varied - 1;
        }
        product
    }
}

/// The histogram before weighs at least as much as this number of events.
const DOUBT: f64 = 4.0;

/// Variance of a smoothed cell relative to a raw one: the squares of 1/4, 1/2 and 1/4.
const SMOOTHED: f64 = 0.375;

/// Contribution of a cell to chi squared, per event.
fn apart((found, expected): (&f64, &f64)) -> f64 {
    square(found - expected) / expected
}

/// A quarter of each sum goes to either neighbour, or stays where there is none.
fn smooth(sums: &[f64; CELLS], is_turn: bool) -> [f64; CELLS] {
    std::array::from_fn(|cell| {
        let (before, after) = if is_turn {
            ((cell + CELLS - 1) % CELLS, (cell + 1) % CELLS)
        } else {
            (cell.saturating_sub(1), (cell + 1).min(CELLS - 1))
        };
        0.25 * (sums[before] + 2.0 * sums[cell] + sums[after])
    })
}
