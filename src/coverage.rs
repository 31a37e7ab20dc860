//! How densely first hits fall on the target, and how long it takes until it is dented all over.
//!
//! The target is cut into the cells of a cubic grid whose middle lies in the aim point and whose
//! axes are those of the target's frame; a cell's density is the number of first hits in it over
//! the area of the target in it. What the target's border leaves of a cell counts with the cell beside
//! it when it is less than a quarter. Dents fall at random with the density of their cell (Avrami): n
//! hits per area, each with a dent of diameter d, cover the share 1 - exp(-n pi d^2 / 4).

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use crate::elementary::{ln_1p, square};
use crate::jet::{Replicate, Replicates, purpose};
use crate::problem::equipment::CoverageWish;
use crate::problem::setting::Choice;
use crate::scene::patch::{Frame, Triangle};
use crate::setup::Setup;
use crate::trace::Tracer;

/// Shots behind the densities.
const SHOTS: usize = 1 << 18;
/// Cells into which a flat square target is cut.
const CELLS: f64 = 64.0;
/// Less than this share of a cell is too little to count hits on.
const WHOLE_ENOUGH: f64 = 0.25;
/// Triangles are cut until their sides are this share of a cell's, so that each lies in one.
const FINE: f64 = 0.25;
/// Share of the area that may be hit less than what counts as the lowest density.
const LOWEST: f64 = 0.05;

/// How densely first hits fall on the target while the nozzle stands still.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// Share of the area that lies in cells without a hit.
    pub share_not_hit: f64,
    /// Number of shots in a kilogram.
    pub shots_per_kilogram: f64,
    /// Mass of shot per time, kg/s, where it is known.
    pub mass_flow: Option<f64>,
}

/// First hits per shot and area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Density {
    /// 1/m2.
    pub value: f64,
    /// Standard error, from the scatter between independent samples, 1/m2.
    pub standard_error: f64,
}

/// A piece of the target.
#[derive(Clone)]
struct Cell {
    /// m2.
    area: f64,
    /// First hits of each sample.
    hits: Vec<usize>,
}

impl Coverage {
    /// What a choice of settings does; `None` when the problem does not ask for it.
    pub fn of(setup: &Setup, choice: &Choice) -> Option<Self> {
        let wish = setup.problem.coverage?;
        let fresh = Replicates::without_rim(&setup.problem, purpose::COVERAGE, SHOTS);
        let samples = fresh.sets.len();
        let (target, _) = setup.target.cut_out(&setup.scene);
        let grid = Grid::of(setup, &target);
        let areas = grid.areas(&target);
        let area: f64 = areas.values().sum();
        let (cell_at, mut cells) = grid.cells(&areas, samples);
        let hits = hits(setup, choice, &fresh.sets);
        for (sample, points) in hits.iter().enumerate() {
            for point in points {
                // A hit on an arc may lie in a cell beside that of the chord, where there is none.
                if let Some(&cell) = cell_at.get(&grid.place(point)) {
                    cells[cell].hits[sample] += 1;
                }
            }
        }
        let whole = Cell {
            area,
            hits: hits.iter().map(Vec::len).collect(),
        };
        let shots = fresh.shots();
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
        let is_bare = |cell: &&&Cell| cell.hits.iter().all(|&hits| hits == 0);
        let bare: f64 = by_density.iter().filter(is_bare).map(|c| c.area).sum();
        let deviates = fresh.sets.iter().flat_map(|set| &set.jet.deviates);
        let relative_mass = deviates.map(|deviate| deviate.mass()).sum::<f64>() / shots as f64;
        Some(Self {
            wish,
            shots,
            area,
            cells: cells.len(),
            side: grid.side,
            mean,
            lowest: lowest.map_or(mean, |cell| cell.density(shots)),
            variation: if mean.value > 0.0 {
                spread / mean.value
            } else {
                0.0
            },
            share_not_hit: bare / area,
            shots_per_kilogram: 1.0 / (setup.problem.shot.mass() * relative_mass),
            mass_flow: setup.problem.jet.mass_flow,
        })
    }

    /// Mass of shot, kg, until the wanted share of a place with some density is dented; `None`
    /// where nothing hits.
    pub fn mass_until_wanted(&self, density: Density) -> Option<f64> {
        let dent = std::f64::consts::PI * square(self.wish.dent_diameter) / 4.0;
        let hits_per_area = -ln_1p(-self.wish.wanted) / dent;
        let per_kilogram = density.value * self.shots_per_kilogram;
        (per_kilogram > 0.0).then(|| hits_per_area / per_kilogram)
    }

    /// The time that takes, s; `None` also where the mass flow is not known.
    pub fn time_until_wanted(&self, density: Density) -> Option<f64> {
        Some(self.mass_until_wanted(density)? / self.mass_flow?)
    }
}

impl Cell {
    fn density(&self, shots: usize) -> Density {
        let samples = self.hits.len() as f64;
        let mean = self.hits.iter().sum::<usize>() as f64 / samples;
        let squares: f64 = self.hits.iter().map(|&n| square(n as f64 - mean)).sum();
        // Of the sum over all samples; one sample of the only shot there is has no error.
        let error = (squares * samples / (samples - 1.0).max(1.0)).sqrt();
        let per_hit = 1.0 / (shots as f64 * self.area);
        Density {
            value: mean * samples * per_hit,
            standard_error: error * per_hit,
        }
    }
}

/// Where the first hits of each sample are on the target.
fn hits(setup: &Setup, choice: &Choice, samples: &[Replicate]) -> Vec<Vec<Point3<f64>>> {
    let mut setup = setup.clone();
    setup.problem.paths.impacts = 1;
    let tracer = Tracer::new(&setup, choice, choice.speed);
    let points = |sample: &Replicate| {
        let mut points = Vec::new();
        for deviate in &sample.jet.deviates {
            tracer.follow(deviate, |first| {
                if first.on_target {
                    points.push(first.point);
                }
            });
        }
        points
    };
    samples.par_iter().map(points).collect()
}

/// A cubic grid.
struct Grid {
    middle: Point3<f64>,
    axes: [Vector3<f64>; 3],
    side: f64,
}

type Place = [i64; 3];

impl Grid {
    fn of(setup: &Setup, target: &[Triangle]) -> Self {
        let Frame {
            aim,
            normal,
            along,
            across,
        } = setup.target.frame;
        let corners = target.iter().flatten();
        let farthest = corners.map(|corner| (corner - aim).norm());
        // However narrow the target is, there are not many more cells than in a square one.
        let least_side = farthest.fold(0.0, f64::max) / CELLS;
        Self {
            middle: aim,
            axes: [along, across, normal],
            side: (setup.target.area / CELLS).sqrt().max(least_side),
        }
    }

    /// The cell of a point. The target's plane runs through the middle of cells, so that no
    /// rounding error takes a point of it into the next one.
    fn place(&self, point: &Point3<f64>) -> Place {
        let from_middle = point - self.middle;
        let [along, across, above] = self.axes.map(|axis| from_middle.dot(&axis) / self.side);
        [along, across, above + 0.5].map(|steps| steps.floor() as i64)
    }

    /// The area of the target in each cell, m2.
    fn areas(&self, target: &[Triangle]) -> BTreeMap<Place, f64> {
        let mut areas = BTreeMap::new();
        let mut pieces: Vec<Triangle> = target.to_vec();
        while let Some([a, b, c]) = pieces.pop() {
            let sides = [(a, b, c), (b, c, a), (c, a, b)];
            let longest = sides.map(|(p, q, opposite)| ((q - p).norm(), p, q, opposite));
            let longer = |x: &(f64, _, _, _), y: &(f64, _, _, _)| x.0.total_cmp(&y.0);
            let Some((length, p, q, opposite)) = longest.into_iter().max_by(longer) else {
                continue;
            };
            if length > FINE * self.side {
                let middle = nalgebra::center(&p, &q);
                pieces.extend([[p, middle, opposite], [middle, q, opposite]]);
                continue;
            }
            let centre = Point3::from((a.coords + b.coords + c.coords) / 3.0);
            let area = (b - a).cross(&(c - a)).norm() / 2.0;
            *areas.entry(self.place(&centre)).or_insert(0.0) += area;
        }
        areas
    }

    /// The cells, without hits, and which of them counts at each place.
    fn cells(
        &self,
        areas: &BTreeMap<Place, f64>,
        samples: usize,
    ) -> (BTreeMap<Place, usize>, Vec<Cell>) {
        let enough = WHOLE_ENOUGH * self.side * self.side;
        let whole = |place: &Place| areas.get(place).is_some_and(|&area| area >= enough);
        let mut cells: Vec<Cell> = Vec::new();
        let mut cell_at = BTreeMap::new();
        let hits = || vec![0; samples];
        // First the whole ones, and what has no whole one beside it.
        for (&place, &area) in areas {
            if whole(&place) || !beside(&place).any(|place| whole(&place)) {
                cell_at.insert(place, cells.len());
                cells.push(Cell { area, hits: hits() });
            }
        }
        for (&place, &area) in areas {
            let neighbour = beside(&place)
                .filter(&whole)
                .max_by(|a, b| areas[a].total_cmp(&areas[b]));
            if !cell_at.contains_key(&place)
                && let Some(neighbour) = neighbour
            {
                let cell = cell_at[&neighbour];
                cells[cell].area += area;
                cell_at.insert(place, cell);
            }
        }
        (cell_at, cells)
    }
}

/// The places round a place.
fn beside(place: &Place) -> impl Iterator<Item = Place> {
    let [x, y, z] = *place;
    let steps = (0..27).filter(|&step| step != 13);
    steps.map(move |step| [x + step / 9 - 1, y + step / 3 % 3 - 1, z + step % 3 - 1])
}
