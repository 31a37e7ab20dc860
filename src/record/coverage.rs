//! Coverage in a record.

use serde::{Deserialize, Serialize};

use crate::coverage::{Coverage, Density};

/// How densely first hits fall on the target, and how much it takes until it is dented; the nozzle
/// stands still.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoverageRecord {
    /// Diameter of the dent that one hit leaves, m.
    pub dent_diameter_m: f64,
    /// Share of the area that is to be dented.
    pub wanted: f64,
    /// Shots behind it.
    pub shots: usize,
    /// Area of the target, m2.
    pub area_m2: f64,
    /// Cells into which the target is cut.
    pub cells: usize,
    /// Side of a cell, m.
    pub cell_side_m: f64,
    /// Mean over the target.
    pub mean: DensityRecord,
    /// The least density, but for 5 % of the area where it is lower.
    pub lowest_5: DensityRecord,
    /// Standard deviation of the density over the area relative to its mean.
    pub variation: f64,
    /// Share of the area that lies in cells without a hit.
    pub share_not_hit: f64,
    /// Number of shots in a kilogram.
    pub shots_per_kg: f64,
    /// Mass of shot per time, kg/s; absent where it is not known.
    pub mass_flow_kg_s: Option<f64>,
}

/// First hits per area, and what it takes until the wanted share is dented with so many.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DensityRecord {
    /// First hits per shot and area, 1/m2.
    pub hits_per_shot_m2: f64,
    /// Standard error of that, 1/m2.
    pub standard_error_m2: f64,
    /// Mass of shot, kg; absent where nothing hits.
    pub mass_kg: Option<f64>,
    /// Time, s; absent where nothing hits or the mass flow is not known.
    pub time_s: Option<f64>,
}

impl CoverageRecord {
    pub(super) fn new(coverage: &Coverage) -> Self {
        let density = |density: Density| DensityRecord {
            hits_per_shot_m2: density.value,
            standard_error_m2: density.standard_error,
            mass_kg: coverage.mass_until_wanted(density),
            time_s: coverage.time_until_wanted(density),
        };
        Self {
            dent_diameter_m: coverage.wish.dent_diameter,
            wanted: coverage.wish.wanted,
            shots: coverage.shots,
            area_m2: coverage.area,
            cells: coverage.cells,
            cell_side_m: coverage.side,
            mean: density(coverage.mean),
            lowest_5: density(coverage.lowest),
            variation: coverage.variation,
            share_not_hit: coverage.share_not_hit,
            shots_per_kg: coverage.shots_per_kilogram,
            mass_flow_kg_s: coverage.mass_flow,
        }
    }
}
