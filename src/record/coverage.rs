//! Coverage in a record.

use serde::{Deserialize, Serialize};

use crate::coverage::{Coverage, Density, Dented, Estimate};
use crate::problem::equipment::Dent;

/// How densely first hits fall on the target, and how much it takes until it is dented; the nozzle
/// stands still.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoverageRecord {
    /// Diameter of the dent that one hit leaves, m; of the one with the mean area where hits leave different ones.
    pub dent_diameter_m: f64,
    /// Where the dents come from, where they are not the same for every hit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dents_from: Option<DentsFromRecord>,
    /// Share of the area that is to be dented.
    pub wanted: f64,
    /// How many times the shot until then is to be fired: masses and times are those of so many.
    #[serde(default = "once", skip_serializing_if = "is_once")]
    pub wanted_times: f64,
    /// Shots behind it.
    pub shots: usize,
    /// Area of the target, m2.
    pub area_m2: f64,
    /// Cells into which the target is cut.
    pub cells: usize,
    /// Side of a cell, m.
    pub cell_side_m: f64,
    /// Mean over the target; mass and time are those until the wanted share of the whole target is dented.
    pub mean: DensityRecord,
    /// The least density, but for 5 % of the area where it is lower.
    pub lowest_5: DensityRecord,
    /// Standard deviation of the density over the area relative to its mean.
    pub variation: f64,
    /// Share of the area that lies in cells without a hit, of those that are small.
    pub share_not_hit: f64,
    /// What is dented of the target, on the mean over small cells; absent in older records.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dented: Option<DentedRecord>,
    /// Number of shots in a kilogram.
    pub shots_per_kg: f64,
    /// Mass of shot per time, kg/s; absent where it is not known.
    pub mass_flow_kg_s: Option<f64>,
}

fn once() -> f64 {
    1.0
}

// Where addresses have 64 bits a reference is no smaller than the number.
#[cfg_attr(
    target_pointer_width = "64",
    expect(
        clippy::trivially_copy_pass_by_ref,
        reason = "serde asks for a reference"
    )
)]
fn is_once(times: &f64) -> bool {
    *times == 1.0
}

/// Where dents of different sizes come from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DentsFromRecord {
    /// From one that was measured.
    Measured {
        /// Its diameter, m.
        diameter_m: f64,
        /// Normal speed of the hit that left it, m/s.
        normal_speed_m_s: f64,
    },
    /// From the target's hardness.
    Hardness {
        /// Dynamic hardness, Pa.
        #[serde(rename = "hardness_Pa")]
        hardness: f64,
    },
}

impl DentsFromRecord {
    fn new(dent: &Dent) -> Option<Self> {
        match *dent {
            Dent::Diameter(_) => None,
            Dent::Measured {
                diameter,
                normal_speed,
            } => Some(Self::Measured {
                diameter_m: diameter,
                normal_speed_m_s: normal_speed,
            }),
            Dent::Hardness(hardness) => Some(Self::Hardness { hardness }),
        }
    }
}

/// What is dented of the target: the mean over its cells, not what the mean density would dent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DentedRecord {
    /// Cells into which the target is cut for it.
    pub cells: usize,
    /// Side of a cell, m.
    pub cell_side_m: f64,
    /// Mass of shot that would dent the wanted share if hits fell evenly, kg; absent where nothing hits.
    pub even_mass_kg: Option<f64>,
    /// Share that it dents.
    pub by_even_mass: Option<EstimateRecord>,
    /// Mass of shot until the wanted share is dented, kg; absent where it never is.
    pub mass_kg: Option<EstimateRecord>,
    /// Bound of how much larger the share that is not hit may be with smaller cells.
    pub not_hit_resolution: f64,
}

/// A number and its errors, in the unit of the number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EstimateRecord {
    /// The number.
    pub value: f64,
    /// Standard error.
    pub standard_error: f64,
    /// Bound of the error by the size of cells.
    pub resolution: f64,
}

impl EstimateRecord {
    fn new(it: Estimate) -> Self {
        Self {
            value: it.value,
            standard_error: it.standard_error,
            resolution: it.resolution,
        }
    }
}

/// First hits per area, and what it takes until the wanted share is dented with this many.
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
        let mass_kg = coverage.dented.mass.map(|mass| mass.value);
        Self {
            dent_diameter_m: coverage.dent_diameter,
            dents_from: DentsFromRecord::new(&coverage.wish.dent),
            wanted: coverage.wish.wanted,
            wanted_times: coverage.wish.times,
            shots: coverage.shots,
            area_m2: coverage.area,
            cells: coverage.cells,
            cell_side_m: coverage.side,
            mean: DensityRecord {
                mass_kg,
                time_s: mass_kg
                    .zip(coverage.mass_flow)
                    .map(|(mass, flow)| mass / flow),
                ..density(coverage.mean)
            },
            lowest_5: density(coverage.lowest),
            variation: coverage.variation,
            share_not_hit: coverage.share_not_hit,
            dented: Some(DentedRecord::new(
                &coverage.dented,
                coverage.mass_until_wanted(coverage.mean),
            )),
            shots_per_kg: coverage.shots_per_kilogram,
            mass_flow_kg_s: coverage.mass_flow,
        }
    }
}

impl DentedRecord {
    fn new(dented: &Dented, even_mass_kg: Option<f64>) -> Self {
        Self {
            cells: dented.cells,
            cell_side_m: dented.side,
            even_mass_kg,
            by_even_mass: dented.by_even_mass.map(EstimateRecord::new),
            mass_kg: dented.mass.map(EstimateRecord::new),
            not_hit_resolution: dented.not_reached_resolution,
        }
    }
}
