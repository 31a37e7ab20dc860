//! Importance density: where violating shots come from, so that more of them are drawn there.

use super::qmc_point::{DIMENSIONS, Dimension};
use crate::elementary::square;

/// Density relative to the boundary proposal: a product over dimensions of histograms with a few cells.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportanceDensity {
    density: [[f64; CELLS]; DIMENSIONS],
    /// A bit for each dimension whose histogram is not flat.
    varied: u32,
}

/// Cells of a dimension.
const CELLS: usize = 16;

/// The cell of a point in each dimension.
pub(super) type Cells = [u8; DIMENSIONS];

/// In place of a cell in dimensions that are not drawn from.
pub(super) const NO_CELL: u8 = u8::MAX;

impl ImportanceDensity {
    /// The boundary proposal itself.
    pub const NONE: Self = Self {
        density: [[1.0; CELLS]; DIMENSIONS],
        varied: 0,
    };

    /// Adapts each dimension's histogram to where violations were found, shrunk towards the histogram before
    /// by least squares: differences within chance change little.
    pub(super) fn on(&self, cells: &[Cells], violation: &[f64]) -> Self {
        let most = violation.iter().copied().fold(0.0, f64::max);
        if !(most > 0.0 && most.is_finite()) {
            return self.clone();
        }
        let mut sums = [[0.0; CELLS]; DIMENSIONS];
        let (mut total, mut squares) = (0.0, 0.0);
        for (cells, violation) in cells.iter().zip(violation) {
            let violation = violation / most;
            total += violation;
            squares += violation * violation;
            for (sums, &cell) in sums.iter_mut().zip(cells) {
                if let Some(sum) = sums.get_mut(usize::from(cell)) {
                    *sum += violation;
                }
            }
        }
        // As many equal events would scatter as much.
        let events = total * total / squares;
        let mut density = self.density;
        for (dimension, (density, sums)) in density.iter_mut().zip(&sums).enumerate() {
            if cells[0][dimension] == NO_CELL {
                continue;
            }
            let found = smooth(sums, TURNS.contains(&dimension));
            let found = found.map(|sum| CELLS as f64 * sum / total);
            let apart: f64 = found.iter().zip(&*density).map(apart).sum();
            let by_chance = SMOOTHED * (CELLS - 1) as f64 / events;
            let share = (1.0 - by_chance / (apart / CELLS as f64)).clamp(0.0, 1.0);
            let share = share.min(events / (events + DOUBT));
            for (density, found) in density.iter_mut().zip(found) {
                *density += share * (found - *density);
            }
        }
        let is_varied = |cells: &[f64; CELLS]| u32::from(*cells != [1.0; CELLS]);
        let bits = density.iter().enumerate();
        let varied = bits
            .map(|(dimension, cells)| is_varied(cells) << dimension)
            .sum();
        Self { density, varied }
    }

    /// The cell of a coordinate in 0 to 1.
    pub(super) fn cell(coordinate: f64) -> u8 {
        ((coordinate * CELLS as f64) as usize).min(CELLS - 1) as u8
    }

    /// A coordinate with this density, from one that is uniform in 0 to 1.
    pub(super) fn drawn(&self, dimension: Dimension, uniform: f64) -> f64 {
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
    pub(super) fn density(&self, cells: &Cells) -> f64 {
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

/// Periodic dimensions: their last cell is a neighbour of the first.
const TURNS: [usize; 2] = [Dimension::ConeTurn as usize, Dimension::ExitTurn as usize];

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

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of uniform points, of which those low in one dimension and on both sides of the seam of another violate.
    fn violated(count: usize) -> (Vec<Cells>, Vec<f64>) {
        let coordinate = |index: usize, step: f64| (index as f64 * step).fract();
        let point = |index: usize| {
            let mut cells = [NO_CELL; DIMENSIONS];
            cells[Dimension::ConeAngle as usize] =
                ImportanceDensity::cell(coordinate(index, 0.618_034));
            cells[Dimension::ConeTurn as usize] =
                ImportanceDensity::cell(coordinate(index, 0.754_878));
            cells[Dimension::Azimuth as usize] =
                ImportanceDensity::cell(coordinate(index, 0.569_840));
            cells
        };
        let cells: Vec<Cells> = (0..count).map(point).collect();
        let violation = cells.iter().map(|cells| {
            let [angle, turn] = [cells[0], cells[1]];
            f64::from(u8::from(angle < 4 && !(2..14).contains(&turn)))
        });
        let violation = violation.collect();
        (cells, violation)
    }

    #[test]
    fn it_is_denser_where_violations_come_from_and_nowhere_empty() {
        let (cells, violation) = violated(4096);
        let importance = ImportanceDensity::NONE.on(&cells, &violation);
        for density in &importance.density {
            let sum: f64 = density.iter().sum();
            assert!((sum - CELLS as f64).abs() < 1e-9, "{density:?}");
            assert!(density.iter().all(|&density| density > 0.0), "{density:?}");
        }
        let of = |dimension: Dimension| &importance.density[dimension as usize];
        let angle = of(Dimension::ConeAngle);
        assert!(angle[..3].iter().all(|&density| density > 3.0));
        assert!(angle[6..].iter().all(|&density| density < 0.1));
        let turn = of(Dimension::ConeTurn);
        assert!(turn[0] > 3.0 && turn[15] > 3.0, "{turn:?}");
        assert!(turn[4..12].iter().all(|&density| density < 0.1));
        // What tells nothing is left as it is, and what is not drawn from.
        assert!(of(Dimension::Azimuth).iter().all(|d| (d - 1.0).abs() < 0.1));
        assert_eq!(of(Dimension::Size), &[1.0; CELLS]);
    }

    #[test]
    fn chance_and_absurd_violations_change_little_or_nothing() {
        let (cells, _) = violated(4096);
        let none = vec![0.0; cells.len()];
        assert_eq!(
            ImportanceDensity::NONE.on(&cells, &none),
            ImportanceDensity::NONE
        );
        let mut one = none.clone();
        one[7] = 1e200;
        let importance = ImportanceDensity::NONE.on(&cells, &one);
        let all = importance.density.iter().flatten();
        assert!(all.into_iter().all(|density| (0.79..3.3).contains(density)));
        one[7] = f64::INFINITY;
        assert_eq!(
            ImportanceDensity::NONE.on(&cells, &one),
            ImportanceDensity::NONE
        );
    }

    #[test]
    fn coordinates_are_drawn_by_the_density() {
        let (cells, violation) = violated(4096);
        let importance = ImportanceDensity::NONE.on(&cells, &violation);
        let dimension = Dimension::ConeTurn;
        let mut counts = [0; CELLS];
        let draws = 160_000;
        for draw in 0..draws {
            let uniform = (f64::from(draw) + 0.5) / f64::from(draws);
            let drawn = importance.drawn(dimension, uniform);
            assert!((0.0..1.0).contains(&drawn));
            counts[usize::from(ImportanceDensity::cell(drawn))] += 1;
        }
        for (count, density) in counts.iter().zip(&importance.density[dimension as usize]) {
            let expected = density * f64::from(draws) / CELLS as f64;
            assert!(
                (f64::from(*count) - expected).abs() < 2.0,
                "{count} {expected}"
            );
        }
        let last = importance.drawn(dimension, 1.0 - f64::EPSILON);
        assert_eq!(ImportanceDensity::cell(last), 15);
        assert_eq!(importance.density(&[NO_CELL; DIMENSIONS]), 1.0);
    }
}
