//! How densely first hits fall on the target, and how long it takes until it is dented all over.
//!
//! The target is cut into the cells of a cubic grid whose middle lies in the aim point and whose
//! axes are those of the target's frame; a cell's density is the number of first hits in it over
//! the area of the target in it. What the target's border leaves of a cell counts with the cell beside
//! it when it is less than a quarter. Dents fall at random with the density of their cell (Avrami): n
//! hits per area, each with a dent of diameter d, cover the share 1 - exp(-n pi d^2 / 4). What is dented of
//! the target is the mean of that over its cells.

mod dented;
mod grid;

use nalgebra::Point3;
use rayon::prelude::*;

use crate::elementary::{exp_m1, ln_1p, square};
use crate::jet::{Replicate, Replicates, ShotSample, purpose};
use crate::problem::equipment::CoverageWish;
use crate::problem::setting::Settings;
use crate::problem::stroke::Leg;
use crate::scenario::Scenario;
use crate::trace::Tracer;
use dented::Question;
pub use dented::{Dented, Estimate};
use grid::{Cell, Cells};

/// Shots behind the densities.
const SHOTS: usize = 1 << 18;
/// Cells into which a flat square target is cut.
const CELLS: f64 = 64.0;
/// Into how many cells it is cut at most for the mean of what is dented, whose error falls with their size.
const MOST_CELLS: f64 = 16_384.0;
/// Cells that are hit have this many hits on average.
const HITS_IN_A_CELL: f64 = 32.0;
/// Share of the area that may be hit less than what counts as the lowest density.
const LOWEST: f64 = 0.05;

/// How densely first hits fall on the target while the nozzle stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// What is wanted.
    pub wish: CoverageWish,
    /// Shots behind it.
    pub shots: usize,
    /// Area of the target, m2.
    pub area: f64,
    /// Cells into which the target is cut.
    pub cells: usize,
    /// Side of a cell, m.
    pub side: f64,
    /// Mean over the target.
    pub mean: Density,
    /// The least density, but for 5 % of the area where it is lower.
    pub lowest: Density,
    /// Standard deviation of the density over the area relative to its mean; 0 where nothing hits.
    pub variation: f64,
    /// Share of the area that is not reached: that of the small cells without a hit.
    pub share_not_hit: f64,
    /// What is dented on the mean over small cells.
    pub dented: Dented,
    /// Number of shots in a kilogram.
    pub shots_per_kilogram: f64,
    /// Mass of shot per time, kg/s, where it is known.
    pub mass_flow: Option<f64>,
    /// Area, m2, and first hits per shot and area, 1/m2, of each cell.
    density_of_cells: Vec<(f64, f64)>,
}

/// First hits per shot and area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Density {
    /// 1/m2.
    pub value: f64,
    /// Standard error, from the scatter between independent samples, 1/m2.
    pub standard_error: f64,
}

impl Coverage {
    /// The coverage of some settings while the nozzle stands still; `None` when the problem does not ask for it.
    pub fn of(scenario: &Scenario, settings: &Settings) -> Option<Self> {
        Self::of_stroke(scenario, &[Leg::whole(settings)], 0.0)
    }

    /// The same over a stroke, whose run-out goes on by so many places beyond both ends.
    pub fn of_stroke(scenario: &Scenario, legs: &[Leg], beyond: f64) -> Option<Self> {
        let wish = scenario.problem.coverage?;
        let mut validation =
            Replicates::without_boundary(&scenario.problem, purpose::COVERAGE, SHOTS);
        let samples = validation.sets.iter_mut();
        for sample in samples.flat_map(|set| &mut set.jet.shots) {
            sample.place *= 1.0 + 2.0 * beyond;
        }
        let samples = validation.sets.len();
        let (target, _) = scenario.target.cut_out(&scenario.scene);
        let hits = hits(scenario, legs, &validation.sets);
        let Cells { side, cells } = Cells::new(scenario, &target, CELLS, &hits);
        let area: f64 = cells.iter().map(|cell| cell.area).sum();
        let whole = Cell {
            area,
            hits: hits.iter().map(|hits| hits.len() as u32).collect(),
        };
        let shots = validation.shots();
        let mean = whole.density(shots);
        let mut by_density: Vec<&Cell> = cells.iter().collect();
        by_density.sort_by(|a, b| a.density(shots).value.total_cmp(&b.density(shots).value));
        let mut below = 0.0;
        let lowest = by_density.iter().find(|cell| {
            below += cell.area;
            below >= LOWEST * area
        });
        let squares = by_density.iter().map(|cell| {
            let off = cell.density(shots).value - mean.value;
            off * off * cell.area / area
        });
        let spread = squares.sum::<f64>().sqrt();
        let fired = validation.sets.iter().flat_map(|set| &set.jet.shots);
        let relative_mass = fired.map(|sample| sample.mass()).sum::<f64>() / shots as f64;
        let shots_per_kilogram = 1.0 / (scenario.problem.shot.mass() * relative_mass);
        let question = Question {
            wanted: wish.wanted,
            dent_diameter: wish.dent_diameter,
            shots,
            shots_per_kilogram,
            even_mass: mass_until(&wish, mean, shots_per_kilogram),
        };
        let hit: f64 = cells
            .iter()
            .filter(|it| it.all_hits() > 0)
            .map(|it| it.area)
            .sum();
        let hit_share = (hit / area).max(1.0 / CELLS);
        let count = match samples {
            1 => MOST_CELLS,
            _ => (f64::from(whole.all_hits()) / HITS_IN_A_CELL / hit_share).clamp(1.0, MOST_CELLS),
        };
        let [fine, coarse] =
            [count, count / 4.0].map(|count| Cells::new(scenario, &target, count, &hits));
        let dented = Dented::of(&question, &fine, &coarse);
        Some(Self {
            wish,
            shots,
            area,
            cells: cells.len(),
            side,
            mean,
            lowest: lowest.map_or(mean, |cell| cell.density(shots)),
            variation: if mean.value > 0.0 {
                spread / mean.value
            } else {
                0.0
            },
            share_not_hit: dented.share_not_reached,
            dented,
            shots_per_kilogram,
            mass_flow: scenario.problem.jet.mass_flow,
            density_of_cells: cells
                .iter()
                .map(|cell| (cell.area, cell.density(shots).value))
                .collect(),
        })
    }

    /// Mass of shot, kg, until the wanted share of a place with some density is dented; `None`
    /// where nothing hits.
    pub fn mass_until_wanted(&self, density: Density) -> Option<f64> {
        mass_until(&self.wish, density, self.shots_per_kilogram)
    }

    /// The share of the area that so much shot dents, kg: mean, least and most over the cells of the target.
    pub fn dented_by(&self, mass: f64) -> [f64; 3] {
        let dent = std::f64::consts::PI * square(self.wish.dent_diameter) / 4.0;
        let share = |density: f64| -exp_m1(-dent * density * mass * self.shots_per_kilogram);
        let cells = self.density_of_cells.iter();
        let mean = cells
            .clone()
            .map(|(area, density)| area * share(*density))
            .sum::<f64>()
            / self.area;
        let shares = || cells.clone().map(|(_, density)| share(*density));
        [
            mean,
            shares().fold(1.0, f64::min),
            shares().fold(0.0, f64::max),
        ]
    }

    /// The time that takes, s; `None` also where the mass flow is not known.
    pub fn time_until_wanted(&self, density: Density) -> Option<f64> {
        Some(self.mass_until_wanted(density)? / self.mass_flow?)
    }
}

fn mass_until(wish: &CoverageWish, density: Density, shots_per_kilogram: f64) -> Option<f64> {
    let dent = std::f64::consts::PI * square(wish.dent_diameter) / 4.0;
    let hits_per_area = -ln_1p(-wish.wanted) / dent;
    let per_kilogram = density.value * shots_per_kilogram;
    (per_kilogram > 0.0).then(|| hits_per_area / per_kilogram)
}

/// Where the first hits of each sample are on the target.
fn hits(scenario: &Scenario, legs: &[Leg], samples: &[Replicate]) -> Vec<Vec<Point3<f64>>> {
    let mut scenario = scenario.clone();
    scenario.problem.paths.impacts = 1;
    let points = |sample: &Replicate| {
        let of_leg = |leg: &Leg| -> Vec<Point3<f64>> {
            let shots = sample
                .jet
                .shots
                .iter()
                .filter(|shot| legs.len() == 1 || std::ptr::eq(Leg::at(legs, shot.place), leg));
            let shots: Vec<ShotSample> = shots.copied().collect();
            let tracer = Tracer::new(&scenario, &leg.settings, leg.settings.speed);
            let paths = tracer.paths(&shots);
            let counted = paths.iter().flat_map(|path| &path.impacts);
            let first = counted.filter(|impact| impact.number == 1 && impact.on_target);
            first.map(|impact| impact.point).collect()
        };
        legs.iter().flat_map(of_leg).collect()
    };
    samples.par_iter().map(points).collect()
}
