//! Square cells over the hits.

use std::ops::Range;

use super::{MAP_HEIGHT, ROOM, WIDTH, extent, in_millimetres};
use crate::record::HitsRecord;

/// Cells along the longer side of a map.
const FEWEST_CELLS: f64 = 8.0;
const MOST_CELLS: f64 = 36.0;

/// Square cells over the hits.
pub struct Grid {
    /// Ends of its sides, mm.
    pub x: Range<f64>,
    pub y: Range<f64>,
    /// Whether all hits lie at one place, so that the scale means nothing.
    pub is_one_place: bool,
    /// Side of a cell, mm.
    pub side: f64,
    pub columns: usize,
    /// Which hits lie in each cell.
    cells: Vec<Vec<usize>>,
}

impl Grid {
    /// A grid with the proportions of a map.
    pub fn new(hits: &HitsRecord) -> Self {
        let [x, y] = extent(&mut in_millimetres(hits));
        let (width, height) = (x.end - x.start, y.end - y.start);
        let room =
            (2.0 * ROOM + 1.0) * width.max(height * f64::from(WIDTH) / f64::from(MAP_HEIGHT));
        // Where all hits are the same, any scale does.
        let is_one_place = room == 0.0;
        let room = if is_one_place { 1.0 } else { room };
        let half = [
            room / 2.0,
            room / 2.0 * f64::from(MAP_HEIGHT) / f64::from(WIDTH),
        ];
        let middle = [f64::midpoint(x.start, x.end), f64::midpoint(y.start, y.end)];
        let [x, y] = [0, 1].map(|axis| middle[axis] - half[axis]..middle[axis] + half[axis]);
        let fine = (hits.plane_m.len() as f64).sqrt() / 3.5;
        let side = 2.0 * half[1] / fine.clamp(FEWEST_CELLS, MOST_CELLS).round();
        let cells = |range: &Range<f64>| ((range.end - range.start) / side).ceil() as usize;
        let (columns, rows) = (cells(&x), cells(&y));
        let mut grid = Self {
            x,
            y,
            is_one_place,
            side,
            columns,
            cells: vec![Vec::new(); columns * rows],
        };
        for (index, at) in in_millimetres(hits).enumerate() {
            let column = ((at[0] - grid.x.start) / side) as usize;
            let row = ((at[1] - grid.y.start) / side) as usize;
            grid.cells[row.min(rows - 1) * columns + column.min(columns - 1)].push(index);
        }
        grid
    }

    /// A value for each cell that was hit.
    pub fn values(&self, of: impl Fn(&[usize]) -> f64) -> Vec<Option<f64>> {
        let value = |cell: &Vec<usize>| (!cell.is_empty()).then(|| of(cell));
        self.cells.iter().map(value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hits(places: &[[f32; 2]]) -> HitsRecord {
        HitsRecord {
            shots: places.len(),
            plane_m: places.to_vec(),
            ..HitsRecord::default()
        }
    }

    #[test]
    fn every_hit_lies_in_the_cell_round_it() {
        let places = [
            [-1e-3, 2e-3],
            [1e-3, -2e-3],
            [0.5e-3, 0.1e-3],
            [0.5e-3, 0.1e-3],
        ];
        let grid = Grid::new(&hits(&places));
        let mut found = 0;
        for (index, cell) in grid.cells.iter().enumerate() {
            let (column, row) = (index % grid.columns, index / grid.columns);
            for &hit in cell {
                let from_corner = |axis: usize, low: f64, number: usize| {
                    f64::from(places[hit][axis]) * 1e3 - low - number as f64 * grid.side
                };
                let [x, y] = [
                    from_corner(0, grid.x.start, column),
                    from_corner(1, grid.y.start, row),
                ];
                assert!((-1e-6..=grid.side).contains(&x) && (-1e-6..=grid.side).contains(&y));
                found += 1;
            }
        }
        assert_eq!(found, places.len());
    }

    #[test]
    fn hits_at_one_place_have_a_map_too() {
        let grid = Grid::new(&hits(&[[1e-3, 1e-3]; 5]));
        assert!(grid.side > 0.0);
        assert_eq!(
            grid.values(|cell| cell.len() as f64)
                .iter()
                .flatten()
                .sum::<f64>(),
            5.0
        );
        assert!(grid.is_one_place);
    }
}
