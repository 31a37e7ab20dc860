//! The target cut into the cells of a cubic grid.

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use super::Density;
use super::hits::FirstHit;
use crate::elementary::{extremes, square};
use crate::scenario::Scenario;
use crate::scene::patch::{Frame, Triangle};

/// Less than this share of a cell is too little to count hits on.
const WHOLE_ENOUGH: f64 = 0.25;
/// A corner within this part of a cell's side of the next cell lies in neither.
const ROUNDING: f64 = 1e-9;

/// The target in cells, and the hits in them.
pub(super) struct Cells {
    /// Side of a cell, m.
    pub side: f64,
    pub cells: Vec<Cell>,
}

/// A piece of the target.
#[derive(Clone)]
pub(super) struct Cell {
    /// m2.
    pub area: f64,
    /// First hits of each sample, each by the area of its dent over the mean.
    pub hits: Vec<f64>,
}

impl Cells {
    /// Cuts the target so that one that is flat and square has `count` cells, and counts the hits of each
    /// sample in them.
    pub fn new(
        scenario: &Scenario,
        target: &[Triangle],
        count: f64,
        hits: &[Vec<FirstHit>],
    ) -> Self {
        let grid = Grid::of(scenario, target, count);
        let areas = grid.areas(target);
        let (cell_at, mut cells) = grid.cells(&areas);
        let counted = hits.par_iter().map(|hits| {
            let mut counts = vec![0.0; cells.len()];
            for hit in hits {
                if let Some(cell) = grid.cell_of(&hit.point, &cell_at, &areas) {
                    counts[cell] += hit.weight;
                }
            }
            counts
        });
        let counted: Vec<Vec<f64>> = counted.collect();
        for (index, cell) in cells.iter_mut().enumerate() {
            cell.hits = counted.iter().map(|counts| counts[index]).collect();
        }
        Self {
            side: grid.side,
            cells,
        }
    }
}

impl Cell {
    pub fn all_hits(&self) -> f64 {
        self.hits.iter().sum()
    }

    pub fn density(&self, shots: usize) -> Density {
        let samples = self.hits.len() as f64;
        let mean = self.all_hits() / samples;
        let squares: f64 = self.hits.iter().map(|&n| square(n - mean)).sum();
        // Of the sum over all samples; one sample of the only shot there is has no error.
        let error = (squares * samples / (samples - 1.0).max(1.0)).sqrt();
        let per_hit = 1.0 / (shots as f64 * self.area);
        Density {
            value: mean * samples * per_hit,
            standard_error: error * per_hit,
        }
    }
}

/// A cubic grid.
struct Grid {
    middle: Point3<f64>,
    axes: [Vector3<f64>; 3],
    side: f64,
}

pub(super) type Place = [i64; 3];

/// A convex polygon in units of the grid.
pub(super) type Polygon = Vec<[f64; 3]>;

impl Grid {
    fn of(scenario: &Scenario, target: &[Triangle], count: f64) -> Self {
        let Frame {
            aim,
            normal,
            along,
            across,
        } = scenario.target.frame;
        let corners = target.iter().flatten();
        let farthest = corners.map(|corner| (corner - aim).norm());
        // However narrow the target is, there are not many more cells than in a square one.
        let least_side = farthest.fold(0.0, f64::max) / count;
        Self {
            middle: aim,
            axes: [along, across, normal],
            side: (scenario.target.area / count).sqrt().max(least_side),
        }
    }

    /// Where a point is in units of the grid. The target's plane runs through the middle of cells, so
    /// that no rounding error takes a point of it into the next one.
    fn steps(&self, point: &Point3<f64>) -> [f64; 3] {
        let from_middle = point - self.middle;
        let [along, across, above] = self.axes.map(|axis| from_middle.dot(&axis) / self.side);
        [along, across, above + 0.5]
    }

    /// The area of the target in each cell, m2: triangles are cut along the faces of cells.
    fn areas(&self, target: &[Triangle]) -> BTreeMap<Place, f64> {
        let mut areas = BTreeMap::new();
        for corners in target {
            let polygon = corners.iter().map(|corner| self.steps(corner)).collect();
            for (place, area) in self::areas(polygon) {
                *areas.entry(place).or_insert(0.0) += area * self.side * self.side;
            }
        }
        areas
    }

    /// The cells, without hits, and which of them counts at each place.
    fn cells(&self, areas: &BTreeMap<Place, f64>) -> (BTreeMap<Place, usize>, Vec<Cell>) {
        let enough = WHOLE_ENOUGH * self.side * self.side;
        let whole = |place: &Place| areas.get(place).is_some_and(|&area| area >= enough);
        let mut cells: Vec<Cell> = Vec::new();
        let mut cell_at = BTreeMap::new();
        // First the whole ones, and what has no whole one beside it.
        for (&place, &area) in areas {
            if whole(&place) || !beside(&place).any(|place| whole(&place)) {
                cell_at.insert(place, cells.len());
                cells.push(Cell {
                    area,
                    hits: Vec::new(),
                });
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

    /// The cell in which a hit counts. One on an arc or on a rim may lie in a cell beside that of the
    /// triangles there, which holds none of them.
    fn cell_of(
        &self,
        hit: &Point3<f64>,
        cell_at: &BTreeMap<Place, usize>,
        areas: &BTreeMap<Place, f64>,
    ) -> Option<usize> {
        let place = place(&self.steps(hit));
        let own = cell_at.get(&place);
        let largest = || {
            let known = beside(&place).filter(|place| areas.contains_key(place));
            let largest = known.max_by(|a, b| areas[a].total_cmp(&areas[b]))?;
            cell_at.get(&largest)
        };
        own.or_else(largest).copied()
    }
}

/// The parts of a polygon in cells of side 1: where each is, and its area.
pub(super) fn areas(polygon: Polygon) -> Vec<(Place, f64)> {
    let (mut found, mut pieces) = (Vec::new(), vec![polygon]);
    while let Some(piece) = pieces.pop() {
        if let Some((axis, at)) = face_through(&piece) {
            pieces.extend([1.0, -1.0].map(|side| half(&piece, axis, at, side)));
        } else if piece.len() > 2 {
            found.push((place(&centre(&piece)), area(&piece)));
        }
    }
    found
}

/// A face between cells that runs through a polygon, by its axis and its place there.
fn face_through(polygon: &Polygon) -> Option<(usize, f64)> {
    (0..3).find_map(|axis| {
        let (lowest, highest) = extremes(polygon.iter().map(|corner| corner[axis]));
        let low = (lowest + ROUNDING).floor();
        let high = (highest - ROUNDING).ceil();
        // The middle one, so that what is cut off is cut less often.
        (high - low > 1.0).then(|| (axis, (0.5 * (low + high)).floor()))
    })
}

/// The part of a convex polygon on one side of a face.
fn half(polygon: &Polygon, axis: usize, at: f64, side: f64) -> Polygon {
    let depth = |corner: &[f64; 3]| (corner[axis] - at) * side;
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (depth(p), depth(q));
        if here >= 0.0 {
            kept.push(*p);
        }
        if (here < 0.0) != (there < 0.0) {
            let share = here / (here - there);
            let mut cut = [0, 1, 2].map(|k| p[k] + (q[k] - p[k]) * share);
            cut[axis] = at;
            kept.push(cut);
        }
    }
    kept
}

fn area(polygon: &Polygon) -> f64 {
    let vector = |from: &[f64; 3], to: &[f64; 3]| Vector3::from([0, 1, 2].map(|k| to[k] - from[k]));
    let sides = polygon.windows(2).skip(1);
    let twice: Vector3<f64> = sides
        .map(|side| vector(&polygon[0], &side[0]).cross(&vector(&polygon[0], &side[1])))
        .sum();
    twice.norm() / 2.0
}

fn centre(polygon: &Polygon) -> [f64; 3] {
    let count = polygon.len() as f64;
    [0, 1, 2].map(|k| polygon.iter().map(|corner| corner[k]).sum::<f64>() / count)
}

fn place(steps: &[f64; 3]) -> Place {
    steps.map(|steps| steps.floor() as i64)
}

/// The places round a place.
fn beside(place: &Place) -> impl Iterator<Item = Place> {
    let [x, y, z] = *place;
    let steps = (0..27).filter(|&step| step != 13);
    steps.map(move |step| [x + step / 9 - 1, y + step / 3 % 3 - 1, z + step % 3 - 1])
}

#[cfg(test)]
mod tests;
