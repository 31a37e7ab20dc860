//! How densely first hits fall on the target, and how long it takes until it is dented all over.
//!
//! The target is cut into the cells of a cubic grid whose middle lies in the aim point and whose
//! axes are those of the target's frame; a cell's density is the number of first hits in it over
//! the area of the target in it. What the target's border leaves of a cell counts with the cell beside
//! it when it is less than a quarter. Dents fall at random with the density of their cell (Avrami): n
//! hits per area, each with a dent of diameter d, cover the share 1 - exp(-n pi d^2 / 4). What is dented of
//! the target is the mean of that over its cells.

mod dented;
mod dose;
mod grid;
mod hits;
mod map;
mod shots;

use crate::elementary::{exp_m1, ln_1p, square};
use crate::jet::purpose;
use crate::problem::equipment::CoverageWish;
use crate::problem::setting::Settings;
use crate::problem::stroke::{Leg, WHOLE};
use crate::scenario::Scenario;
pub use dented::{Dented, Estimate};
use dented::{DentedCells, Question};
pub use dose::Dose;
use grid::{Cell, Cells};
use hits::FirstHits;
pub use map::CoverageMap;
use map::Unrolled;
use shots::Shots;

/// Shots behind the densities.
const SHOTS: usize = 1 << 18;
/// The same for a stroke.
const SHOTS_OF_STROKE: usize = 1 << 20;
/// Cells into which a flat square target is cut.
const CELLS: f64 = 64.0;
/// The same for the target of a stroke, which is much larger than the spot.
const CELLS_OF_STROKE: f64 = 640.0;
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
    /// Diameter of the dent that has the mean area of all, m.
    pub dent_diameter: f64,
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
    /// The same on a map, for a stroke.
    pub map: Option<CoverageMap>,
    /// First hits per shot and area of each cell.
    density_of_cells: Vec<Density>,
    by_mass: DentedCells,
}

/// The share of the target that some mass of shot dents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DentedBy {
    /// The mass, kg.
    pub mass: f64,
    /// The mean over the target.
    pub mean: Estimate,
    /// Of the cell that is dented least; its resolution is not known.
    pub least: f64,
    /// Its standard error.
    pub least_error: f64,
    /// Of the cell that is dented most.
    pub most: f64,
}

/// First hits per shot and area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Density {
    /// 1/m2.
    pub value: f64,
    /// Standard error, from the scatter between independent samples, 1/m2.
    pub standard_error: f64,
}

impl Density {
    /// The standard error over the value; 0 where nothing hits.
    pub fn relative_error(&self) -> f64 {
        match self.value > 0.0 {
            true => self.standard_error / self.value,
            false => 0.0,
        }
    }
}

impl Coverage {
    /// The coverage of some settings while the nozzle stands still; `None` when the problem does not ask for it.
    pub fn of(scenario: &Scenario, settings: &Settings) -> Option<Self> {
        Self::of_stroke(scenario, &[Leg::whole(settings)], WHOLE)
    }

    /// The same over a stroke with its run-out, from one place to another.
    pub fn of_stroke(scenario: &Scenario, legs: &[Leg], ends: [f64; 2]) -> Option<Self> {
        let wish = scenario.problem.coverage?;
        let shots = match scenario.traverse {
            Some(_) => SHOTS_OF_STROKE,
            None => SHOTS,
        };
        let fired = Shots::new(scenario, purpose::COVERAGE, shots, ends);
        let (target, _) = scenario.target.cut_out(&scenario.scene);
        let FirstHits {
            hits,
            dent_diameter,
            shots,
            relative_mass,
        } = FirstHits::of(scenario, legs, &wish.dent, &fired);
        let layout = scenario.traverse.as_ref().map(|traverse| {
            let unrolled = Unrolled::new(traverse, &target, &hits);
            let numbers = unrolled.numbers(CELLS_OF_STROKE);
            (unrolled, numbers)
        });
        let (looked_at, places) = match &layout {
            Some((unrolled, numbers)) => unrolled.cells(*numbers),
            None => (Cells::new(scenario, &target, CELLS, &hits), Vec::new()),
        };
        let (side, cells) = (looked_at.side, &looked_at.cells);
        let area: f64 = cells.iter().map(|cell| cell.area).sum();
        let whole = Cell {
            area,
            hits: hits
                .iter()
                .map(|hits| hits.iter().map(|hit| hit.weight).sum())
                .collect(),
        };
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
        let shots_per_kilogram = 1.0 / (scenario.problem.shot.mass() * relative_mass);
        let question = Question {
            wanted: wish.wanted,
            times: wish.times,
            dent_diameter,
            shots,
            shots_per_kilogram,
            even_mass: mass_until(&wish, dent_diameter, mean, shots_per_kilogram),
        };
        let hit: f64 = cells
            .iter()
            .filter(|it| it.all_hits() > 0.0)
            .map(|it| it.area)
            .sum();
        let hit_share = (hit / area).max(1.0 / CELLS);
        let count = match hits.len() {
            1 => MOST_CELLS,
            _ => (whole.all_hits() / HITS_IN_A_CELL / hit_share).clamp(1.0, MOST_CELLS),
        };
        let [fine, coarse] = [count, count / 4.0].map(|count| match &layout {
            Some((unrolled, _)) => unrolled.cells(unrolled.numbers(count)).0,
            None => Cells::new(scenario, &target, count, &hits),
        });
        let by_mass = DentedCells::new(&question, &fine, &coarse);
        let dented = by_mass.dented(&question, &fine);
        let map = layout
            .as_ref()
            .map(|(unrolled, numbers)| unrolled.map(*numbers, &looked_at, &places, shots));
        Some(Self {
            map,
            wish,
            dent_diameter,
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
            density_of_cells: cells.iter().map(|cell| cell.density(shots)).collect(),
            by_mass,
        })
    }

    /// Mass of shot, kg, until the wanted share of a place with some density is dented; `None`
    /// where nothing hits.
    pub fn mass_until_wanted(&self, density: Density) -> Option<f64> {
        mass_until(
            &self.wish,
            self.dent_diameter,
            density,
            self.shots_per_kilogram,
        )
    }

    /// The share of an area with some density of first hits that a mass of shot dents, kg.
    pub fn share_dented(&self, density: f64, mass: f64) -> f64 {
        -exp_m1(-density * self.dents(mass))
    }

    /// The area of the dents of all shots of a mass, m2: what it dents goes with it times the density of hits.
    fn dents(&self, mass: f64) -> f64 {
        dent_area(self.dent_diameter) * mass * self.shots_per_kilogram
    }

    /// The share of the target that a mass of shot dents, kg.
    pub fn dented_by(&self, mass: f64) -> DentedBy {
        let cells = || self.density_of_cells.iter();
        let by_density = |a: &&Density, b: &&Density| a.value.total_cmp(&b.value);
        let share = |density: &Density| self.share_dented(density.value, mass);
        let least = cells().min_by(by_density);
        DentedBy {
            mass,
            mean: self.by_mass.by(mass),
            least: least.map_or(0.0, share),
            least_error: least.map_or(0.0, |it| {
                (1.0 - share(it)) * self.dents(mass) * it.standard_error
            }),
            most: cells().max_by(by_density).map_or(0.0, share),
        }
    }

    /// The time that takes, s; `None` also where the mass flow is not known.
    pub fn time_until_wanted(&self, density: Density) -> Option<f64> {
        Some(self.mass_until_wanted(density)? / self.mass_flow?)
    }
}

/// m2.
fn dent_area(diameter: f64) -> f64 {
    std::f64::consts::PI * square(diameter) / 4.0
}

fn mass_until(
    wish: &CoverageWish,
    dent_diameter: f64,
    density: Density,
    shots_per_kilogram: f64,
) -> Option<f64> {
    let hits_per_area = -ln_1p(-wish.wanted) / dent_area(dent_diameter) * wish.times;
    let per_kilogram = density.value * shots_per_kilogram;
    (per_kilogram > 0.0).then(|| hits_per_area / per_kilogram)
}
