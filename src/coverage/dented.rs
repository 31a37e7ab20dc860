//! How much of the target is dented, on the mean over its cells, and how long it takes.
//!
//! The mean of what is dented is less than what the mean density of hits would dent: places that are hit
//! often do not make up for those that are hit seldom.

use rayon::prelude::*;

use super::dent_area;
use super::grid::{Cell, Cells};
use crate::elementary::{exp, exp_m1, ln, square};

/// How much of the target is dented.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dented {
    /// Cells into which the target is cut for it.
    pub cells: usize,
    /// Side of a cell, m.
    pub side: f64,
    /// What is dented by as much shot as would dent the wanted share if hits fell evenly; absent where
    /// nothing hits.
    pub by_even_mass: Option<Estimate>,
    /// Mass of shot until the wanted share is dented, kg; absent where it never is.
    pub mass: Option<Estimate>,
    /// Share of the area that lies in cells without a hit: it stays as it is.
    pub share_not_reached: f64,
    /// Bound of how much more it may be with cells as small as can be: twice what twice the side changes.
    pub not_reached_resolution: f64,
}

/// A number and its errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Standard error, from leaving out one of the independent samples at a time.
    pub standard_error: f64,
    /// Bound of the error by the size of cells: twice what twice their side changes.
    pub resolution: f64,
}

/// What is asked for.
pub(super) struct Question {
    /// Share of the area that is to be dented.
    pub wanted: f64,
    /// How many times the mass until then is wanted.
    pub times: f64,
    /// Diameter of a dent, m.
    pub dent_diameter: f64,
    /// Shots behind the hits.
    pub shots: usize,
    /// Shots in a kilogram.
    pub shots_per_kilogram: f64,
    /// What dents the wanted share if hits fall evenly, kg.
    pub even_mass: Option<f64>,
}

/// Newton's steps towards a mass; of what then is not dented nobody sees the end.
const STEPS: usize = 100;
/// A relative step that is too small for another one.
const CLOSE: f64 = 1e-12;
/// How often a mass is mended for what few hits in a cell make of it.
const MENDINGS: usize = 3;
/// The error of cells falls with their side or faster, so that it is about what twice the side changes; this many
/// times that is a bound.
const OFF_BY_CELLS: f64 = 2.0;
/// Half the step in the logarithm of a mass over which coverage is differentiated.
const STEP: f64 = 0.01;

/// Hits in small cells, and in some of twice their side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DentedCells {
    small: Sums,
    large: Sums,
}

impl DentedCells {
    pub fn new(question: &Question, fine: &Cells, coarse: &Cells) -> Self {
        let [small, large] = [fine, coarse].map(|cells| Sums::new(question, cells));
        Self { small, large }
    }

    /// What a mass of shot dents, kg.
    pub fn by(&self, mass: f64) -> Estimate {
        self.small.dented(mass, &self.large)
    }

    pub fn dented(&self, question: &Question, fine: &Cells) -> Dented {
        let Self { small, large } = self;
        let many_times = |it: Estimate| Estimate {
            value: it.value * question.times,
            standard_error: it.standard_error * question.times,
            resolution: it.resolution * question.times,
        };
        Dented {
            cells: fine.cells.len(),
            side: fine.side,
            by_even_mass: question.even_mass.map(|mass| self.by(mass)),
            mass: question
                .even_mass
                .and_then(|mass| small.mass(question.wanted, mass, large))
                .map(many_times),
            share_not_reached: small.not_reached,
            not_reached_resolution: OFF_BY_CELLS * (large.not_reached - small.not_reached).abs(),
        }
    }
}

/// Cells that are hit, ready for coverage at any mass of shot.
#[derive(Clone, Debug, PartialEq)]
struct Sums {
    cells: Vec<Hit>,
    /// Share of the area in cells without a hit.
    not_reached: f64,
    samples: usize,
    /// Dented area per kilogram and hit, as a share of one square metre of a cell, m2/kg.
    per_hit: f64,
}

/// A cell that is hit.
#[derive(Clone, Debug, PartialEq)]
struct Hit {
    /// Share of the target's area.
    share: f64,
    /// m2.
    area: f64,
    /// Of all samples.
    hits: f64,
    /// Of each sample.
    by_sample: Vec<f64>,
}

impl Sums {
    fn new(question: &Question, cells: &Cells) -> Self {
        let area: f64 = cells.cells.iter().map(|cell| cell.area).sum();
        let (hit, bare): (Vec<&Cell>, Vec<&Cell>) =
            cells.cells.iter().partition(|cell| cell.all_hits() > 0.0);
        let samples = cells.cells.first().map_or(1, |cell| cell.hits.len());
        let dent = dent_area(question.dent_diameter);
        let of = |cell: &Cell| Hit {
            share: cell.area / area,
            area: cell.area,
            hits: cell.all_hits(),
            by_sample: cell.hits.clone(),
        };
        Self {
            not_reached: bare.iter().map(|cell| cell.area).sum::<f64>() / area,
            cells: hit.into_iter().map(of).collect(),
            samples,
            per_hit: dent * question.shots_per_kilogram / question.shots as f64,
        }
    }

    /// Share of the area that a mass of shot, kg, dents: 1 - exp(-n pi d^2 / 4) in each cell.
    fn plain(&self, mass: f64) -> f64 {
        let scale = mass * self.per_hit;
        let each = self.cells.iter();
        each.map(|cell| -cell.share * exp_m1(-cell.hits * scale / cell.area))
            .sum()
    }

    /// The same without one sample at a time.
    fn left_out(&self, mass: f64) -> Vec<f64> {
        let samples = self.samples as f64;
        let scale = mass * self.per_hit * samples / (samples - 1.0);
        let without = |sample: usize| {
            let each = self.cells.iter();
            each.map(|cell| {
                let hits = cell.hits - cell.by_sample[sample];
                -cell.share * exp_m1(-hits * scale / cell.area)
            })
            .sum()
        };
        (0..self.samples).into_par_iter().map(without).collect()
    }

    /// By how much few hits in a cell put coverage off, and its standard error (the jackknife).
    fn bias_and_error(&self, mass: f64) -> [f64; 2] {
        if self.samples < 2 {
            return [0.0; 2];
        }
        let left_out = self.left_out(mass);
        let count = self.samples as f64;
        let mean = left_out.iter().sum::<f64>() / count;
        let squares: f64 = left_out.iter().map(|it| square(it - mean)).sum();
        [
            (count - 1.0) * (mean - self.plain(mass)),
            ((count - 1.0) / count * squares).sqrt(),
        ]
    }

    fn dented(&self, mass: f64, coarse: &Self) -> Estimate {
        let [bias, standard_error] = self.bias_and_error(mass);
        let value = (self.plain(mass) - bias).clamp(0.0, 1.0 - self.not_reached);
        Estimate {
            value,
            standard_error,
            resolution: self.off_by_cells(mass, coarse),
        }
    }

    fn off_by_cells(&self, mass: f64, coarse: &Self) -> f64 {
        OFF_BY_CELLS * (coarse.plain(mass) - self.plain(mass)).abs()
    }

    /// What it takes until a share is dented, kg, from a guess of it; `None` where more is not reached.
    fn mass(&self, wanted: f64, guess: f64, coarse: &Self) -> Option<Estimate> {
        let mut mass = self.plain_mass(wanted, guess)?;
        for _ in 0..MENDINGS {
            let [bias, _] = self.bias_and_error(mass);
            mass = self.plain_mass(wanted + bias, mass)?;
        }
        let [_, error] = self.bias_and_error(mass);
        let (less, more) = (mass * (1.0 - STEP), mass * (1.0 + STEP));
        let rate = (self.plain(more) - self.plain(less)) / (more - less);
        Some(Estimate {
            value: mass,
            standard_error: error / rate,
            resolution: self.off_by_cells(mass, coarse) / rate,
        })
    }

    /// The mass that dents a share.
    ///
    /// What is not dented yet is a sum of exponentials of the mass, whose logarithm is convex: Newton's steps on it
    /// never go too far after the first one, and one is exact where all cells are alike.
    fn plain_mass(&self, wanted: f64, guess: f64) -> Option<f64> {
        let left = 1.0 - self.not_reached - wanted;
        if left <= 0.0 {
            return None;
        }
        let mut mass = guess;
        for _ in 0..STEPS {
            let [not_yet, rate] = self.left_and_rate(mass);
            let step = not_yet / rate * ln(not_yet / left);
            mass = (mass + step).max(0.0);
            if step.abs() <= CLOSE * mass {
                return Some(mass);
            }
        }
        None
    }

    /// Share of the area that is reached and not dented yet by a mass of shot, kg, and by how much that falls with
    /// it, 1/kg.
    fn left_and_rate(&self, mass: f64) -> [f64; 2] {
        let each = self.cells.iter();
        each.fold([0.0; 2], |[left, rate], cell| {
            let per_mass = cell.hits * self.per_hit / cell.area;
            let here = cell.share * exp(-per_mass * mass);
            [left + here, rate + per_mass * here]
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    const SAMPLES: usize = 32;

    /// A target of cells of 1 m2, each with this many hits in every sample.
    fn cells(side: f64, each: &[u32]) -> Cells {
        let cell = |&hits: &u32| Cell {
            area: side * side,
            hits: vec![f64::from(hits); SAMPLES],
        };
        Cells {
            side,
            cells: each.iter().map(cell).collect(),
        }
    }

    /// Shots of 1 kg with dents of 1 m2; this many of them behind the hits.
    fn question(wanted: f64, shots: usize, cells: &Cells) -> Question {
        let area: f64 = cells.cells.iter().map(|cell| cell.area).sum();
        let hits: f64 = cells.cells.iter().map(Cell::all_hits).sum();
        Question {
            wanted,
            times: 1.0,
            dent_diameter: (4.0 / PI).sqrt(),
            shots,
            shots_per_kilogram: 1.0,
            even_mass: (hits > 0.0).then(|| -(-wanted).ln_1p() * area * shots as f64 / hits),
        }
    }

    fn found(question: &Question, fine: &Cells, coarse: &Cells) -> Dented {
        DentedCells::new(question, fine, coarse).dented(question, fine)
    }

    #[test]
    fn what_is_dented_is_the_mean_of_its_cells() {
        let uneven = cells(1.0, &[100, 100, 50, 0]);
        let dented = found(&question(0.7, 32_000, &uneven), &uneven, &uneven);
        // A kilogram brings 0.1, 0.1, 0.05 and 0 hits into the cells; evenly 19.26 kg were enough.
        let after = |mass: f64| {
            let parts = [0.1, 0.1, 0.05, 0.0].map(|hits: f64| 1.0 - (-hits * mass).exp());
            parts.iter().sum::<f64>() / 4.0
        };
        let even_mass = -0.3_f64.ln() / 0.0625;
        let by_even_mass = dented.by_even_mass.unwrap();
        assert!(
            (by_even_mass.value - after(even_mass)).abs() < 1e-9,
            "{by_even_mass:?}"
        );
        assert!(by_even_mass.value < 0.59 && by_even_mass.standard_error < 1e-12);
        let mass = dented.mass.unwrap();
        assert!((after(mass.value) - 0.7).abs() < 1e-9 && mass.value > 1.5 * even_mass);
        assert_eq!((dented.share_not_reached, mass.resolution), (0.25, 0.0));
        for (wanted, is_reached) in [(0.74, true), (0.7499, true), (0.7501, false), (0.99, false)] {
            let dented = found(&question(wanted, 32_000, &uneven), &uneven, &uneven);
            assert_eq!(dented.mass.is_some(), is_reached, "{wanted}");
            let mass = dented.mass.map_or(wanted, |mass| after(mass.value));
            assert!((mass - wanted).abs() < 1e-9);
        }
        let bare = cells(1.0, &[0, 0]);
        let dented = found(&question(0.7, 32_000, &bare), &bare, &bare);
        assert_eq!((dented.by_even_mass, dented.mass), (None, None));
        assert_eq!(dented.share_not_reached, 1.0);
    }

    /// Hits that fall at random into cells of one density: what few of them make of it is mended, and the
    /// errors are what they are said to be.
    #[test]
    fn few_hits_in_a_cell_put_nothing_off() {
        let mut state = 7_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let (count, per_cell) = (400, 12);
        let mut offs = Vec::new();
        for _ in 0..40 {
            let mut random_hits = cells(1.0, &vec![0; count]);
            for shot in 0..count * per_cell {
                let cell = (random() * count as f64) as usize;
                random_hits.cells[cell].hits[shot % SAMPLES] += 1.0;
            }
            let question = question(0.95, count * per_cell, &random_hits);
            let dented = found(&question, &random_hits, &random_hits);
            let by_even_mass = dented.by_even_mass.unwrap();
            offs.push([by_even_mass.value - 0.95, by_even_mass.standard_error]);
        }
        let mean = offs.iter().map(|[off, _]| off).sum::<f64>() / 40.0;
        let scatter = (offs.iter().map(|[off, _]| off * off).sum::<f64>() / 40.0).sqrt();
        let said = offs.iter().map(|[_, error]| error).sum::<f64>() / 40.0;
        // Without mending it is 0.022 too little.
        assert!(mean.abs() < 0.004, "{mean}");
        assert!((0.5..2.0).contains(&(scatter / said)), "{scatter}, {said}");
    }
}
