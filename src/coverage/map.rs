//! The target of a stroke laid out flat, along the stroke and across it, in cells that end where it ends.

use nalgebra::Point2;
use rayon::prelude::*;

use super::grid::{Cell, Cells, Polygon, areas};
use super::hits::FirstHit;
use crate::elementary::extremes;
use crate::scene::patch::Triangle;
use crate::scene::traverse::Traverse;

/// First hits per shot and area over the target of a stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverageMap {
    /// Where its first cell begins: along the stroke from its beginning, and across it, m.
    pub corner: [f64; 2],
    /// Sides of a cell, m.
    pub sides: [f64; 2],
    /// Cells along the stroke.
    pub columns: usize,
    /// In dents of the mean area, 1/m2, row by row from the lowest place across; absent beside the target.
    pub density: Vec<Option<f64>>,
}

/// The target of a stroke and the hits on it, laid out flat.
pub(super) struct Unrolled {
    corner: [f64; 2],
    extent: [f64; 2],
    /// Whether it goes all the way round, so that its last column lies beside the first.
    is_closed: bool,
    /// Triangles, m, and what their area is over that which they have here.
    triangles: Vec<([[f64; 2]; 3], f64)>,
    /// Of each sample, with their weights.
    hits: Vec<Vec<([f64; 2], f64)>>,
}

/// A target that leaves less than this of a turn free goes all the way round.
const CLOSED: f64 = 1e-6;
/// A cell of which less is target is left out: too little to count hits on.
const LEAST_SHARE: f64 = 0.05;

impl Unrolled {
    pub fn new(traverse: &Traverse, target: &[Triangle], hits: &[Vec<FirstHit>]) -> Self {
        let turn = traverse.circumference();
        let triangles: Vec<([[f64; 2]; 3], f64)> = target
            .iter()
            .filter_map(|triangle| flat(traverse, turn, triangle))
            .collect();
        let ends = |axis: usize| {
            let corners = triangles.iter().flat_map(|(corners, _)| corners);
            let (low, high) = extremes(corners.map(|corner| corner[axis]));
            [low, high - low]
        };
        let [mut x, y] = [ends(0), ends(1)];
        let is_closed = turn.is_some_and(|turn| x[1] >= turn * (1.0 - CLOSED));
        if let Some(turn) = turn.filter(|_| is_closed) {
            x = [-0.5 * turn, turn];
        }
        let at = |hit: &FirstHit| (traverse.unrolled(&hit.point), hit.weight);
        Self {
            corner: [x[0], y[0]],
            extent: [x[1], y[1]],
            is_closed,
            triangles,
            hits: hits
                .par_iter()
                .map(|hits| hits.iter().map(at).collect())
                .collect(),
        }
    }

    /// How many cells along and across come to about so many that are about square.
    pub fn numbers(&self, count: f64) -> [usize; 2] {
        let [width, height] = self.extent;
        let side = (width * height / count)
            .sqrt()
            .max(width.max(height) / count);
        self.extent.map(|it| (it / side).round().max(1.0) as usize)
    }

    /// Cells, and which of them lies in each place of the map, row by row.
    pub fn cells(&self, [columns, rows]: [usize; 2]) -> (Cells, Vec<Option<usize>>) {
        let sides = self.sides([columns, rows]);
        let steps = |at: &[f64; 2]| [0, 1].map(|axis| (at[axis] - self.corner[axis]) / sides[axis]);
        let place = |[x, y]: [f64; 2]| {
            let column = match self.is_closed {
                true => (x.floor() as i64).rem_euclid(columns as i64) as usize,
                false => (x.max(0.0) as usize).min(columns - 1),
            };
            (y.max(0.0) as usize).min(rows - 1) * columns + column
        };
        let mut area = vec![0.0; columns * rows];
        for (corners, factor) in &self.triangles {
            let polygon: Polygon = corners
                .iter()
                .map(|corner| {
                    let [x, y] = steps(corner);
                    [x, y, 0.5]
                })
                .collect();
            for ([x, y, _], part) in areas(polygon) {
                let middle = [x as f64 + 0.5, y as f64 + 0.5];
                area[place(middle)] += part * factor * sides[0] * sides[1];
            }
        }
        let counted = self.hits.par_iter().map(|hits| {
            let mut counts = vec![0.0; columns * rows];
            for (at, weight) in hits {
                counts[place(steps(at))] += weight;
            }
            counts
        });
        let counted: Vec<Vec<f64>> = counted.collect();
        let mut cells = Vec::new();
        let indices = area.iter().enumerate().map(|(place, &area)| {
            (area >= LEAST_SHARE * sides[0] * sides[1]).then(|| {
                cells.push(Cell {
                    area,
                    hits: counted.iter().map(|counts| counts[place]).collect(),
                });
                cells.len() - 1
            })
        });
        let indices = indices.collect();
        let side = (sides[0] * sides[1]).sqrt();
        (Cells { side, cells }, indices)
    }

    fn sides(&self, [columns, rows]: [usize; 2]) -> [f64; 2] {
        [
            self.extent[0] / columns as f64,
            self.extent[1] / rows as f64,
        ]
    }

    /// The densities of cells as a map.
    pub fn map(
        &self,
        numbers: [usize; 2],
        cells: &Cells,
        indices: &[Option<usize>],
        shots: usize,
    ) -> CoverageMap {
        let density = |index: &Option<usize>| {
            let cell = &cells.cells[(*index)?];
            Some(cell.density(shots).value)
        };
        CoverageMap {
            corner: self.corner,
            sides: self.sides(numbers),
            columns: numbers[0],
            density: indices.iter().map(density).collect(),
        }
    }
}

/// A triangle laid out flat in one piece, and its area over the one that it has there; `None` where it has none there,
/// as one that is seen from its edge.
fn flat(
    traverse: &Traverse,
    turn: Option<f64>,
    triangle: &Triangle,
) -> Option<([[f64; 2]; 3], f64)> {
    let mut corners = triangle.map(|corner| traverse.unrolled(&corner));
    if let Some(turn) = turn {
        let first = corners[0][0];
        for corner in &mut corners[1..] {
            corner[0] -= turn * ((corner[0] - first) / turn).round();
        }
    }
    let [a, b, c] = corners.map(Point2::from);
    let here = (b - a).perp(&(c - a)).abs() / 2.0;
    let own = (triangle[1] - triangle[0])
        .cross(&(triangle[2] - triangle[0]))
        .norm()
        / 2.0;
    (here > 1e-9 * own).then(|| (corners, own / here))
}
