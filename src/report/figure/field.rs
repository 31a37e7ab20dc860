//! A quantity over a grid: its contours, and the regions that they enclose.

use std::collections::VecDeque;

use contour::ContourBuilder;

use super::sheet::Place;

/// Values at the nodes of a grid, and where these lie.
pub struct Field {
    /// Row by row from below; within a row from the left.
    values: Vec<f64>,
    columns: usize,
    rows: usize,
    /// Where the first node lies, px.
    corner: (f64, f64),
    /// From node to node, px.
    step: (f64, f64),
}

/// A line, or the outline of a region, px.
pub type Outline = Vec<Place>;

impl Field {
    /// A field between two corners, px. Where a node has no value it gets that of the nearest one
    /// that has; `None` when no node has one, there are fewer than two each way, or the last row is
    /// not whole.
    pub fn new(
        values: &[Option<f64>],
        columns: usize,
        corner: Place,
        opposite: Place,
    ) -> Option<Self> {
        let rows = values.len().checked_div(columns)?;
        if columns < 2 || rows < 2 || values.len() != rows * columns {
            return None;
        }
        let step = |from: i32, to: i32, count: usize| f64::from(to - from) / (count - 1) as f64;
        Some(Self {
            values: filled(values, columns)?,
            columns,
            rows,
            corner: (f64::from(corner.0), f64::from(corner.1)),
            step: (
                step(corner.0, opposite.0, columns),
                step(corner.1, opposite.1, rows),
            ),
        })
    }

    /// The regions where the value is at least `level`. Holes are joined to the outline round them
    /// by a line that goes there and back.
    pub fn regions(&self, level: f64) -> Vec<Outline> {
        let builder = ContourBuilder::new(self.columns, self.rows, true);
        // The only error there is: a grid of another size.
        let found = builder.contours(&self.values, &[level]).unwrap_or_default();
        let polygons = found.into_iter().flat_map(|contour| contour.into_inner().0);
        polygons
            .map(|polygon| {
                let (exterior, holes) = polygon.into_inner();
                let placed = |ring| self.placed(&points(ring));
                let mut outline = placed(exterior);
                let start = outline.first().copied();
                for hole in holes {
                    outline.extend(placed(hole));
                    outline.extend(start);
                }
                outline
            })
            .collect()
    }

    /// The lines along which the value is `level`, without what runs along the edge of the grid.
    pub fn lines(&self, level: f64) -> Vec<Outline> {
        let builder = ContourBuilder::new(self.columns, self.rows, true);
        let found = builder.lines(&self.values, &[level]).unwrap_or_default();
        let rings = found.into_iter().flat_map(|line| line.into_inner().0);
        rings
            .flat_map(|ring| self.inner_parts(&points(ring)))
            .collect()
    }

    /// Whether the value at a place is at least `level`, between the nodes in proportion.
    pub fn reaches(&self, level: f64, (x, y): Place) -> bool {
        let along = |at: i32, from: f64, step: f64, count: usize| {
            let place = ((f64::from(at) - from) / step).clamp(0.0, (count - 1) as f64);
            let node = (place as usize).min(count - 2);
            (node, place - node as f64)
        };
        let (column, u) = along(x, self.corner.0, self.step.0, self.columns);
        let (row, v) = along(y, self.corner.1, self.step.1, self.rows);
        let value = |dx: usize, dy: usize| self.values[(row + dy) * self.columns + column + dx];
        let below = value(0, 0) * (1.0 - u) + value(1, 0) * u;
        let above = value(0, 1) * (1.0 - u) + value(1, 1) * u;
        below * (1.0 - v) + above * v >= level
    }

    /// A point of the crate's in pixels: it puts nodes at halves, and outlines run half a step
    /// outside of the outermost ones.
    fn place(&self, point: &Point) -> Place {
        let inside = |at: f64, count: usize| (at - 0.5).clamp(0.0, (count - 1) as f64);
        let (u, v) = (inside(point.0, self.columns), inside(point.1, self.rows));
        (
            (self.corner.0 + u * self.step.0).round() as i32,
            (self.corner.1 + v * self.step.1).round() as i32,
        )
    }

    fn placed(&self, ring: &[Point]) -> Outline {
        let mut outline: Outline = ring.iter().map(|point| self.place(point)).collect();
        outline.dedup();
        outline
    }

    fn is_on_edge(&self, point: &Point) -> bool {
        let outside = |at: f64, count: usize| at <= 0.5 || at >= count as f64 - 0.5;
        outside(point.0, self.columns) || outside(point.1, self.rows)
    }

    /// The parts of a closed line that do not run along the edge of the grid.
    fn inner_parts(&self, ring: &[Point]) -> Vec<Outline> {
        let mut parts = Vec::new();
        let mut part: Vec<Point> = Vec::new();
        for pair in ring.windows(2) {
            if self.is_on_edge(&pair[0]) && self.is_on_edge(&pair[1]) {
                parts.push(std::mem::take(&mut part));
            } else {
                if part.is_empty() {
                    part.push(pair[0]);
                }
                part.push(pair[1]);
            }
        }
        // Where the ring begins within a part, that part comes in two.
        if let Some(first) = parts
            .first_mut()
            .filter(|first| first.first() == part.last())
        {
            part.append(first);
        }
        parts.push(part);
        let placed = parts.iter().map(|part| self.placed(part));
        placed.filter(|part| part.len() > 1).collect()
    }
}

/// A point as the contour crate counts: in nodes, the first one at 0.5.
type Point = (f64, f64);

fn points(ring: impl IntoIterator<Item: Into<Point>>) -> Vec<Point> {
    ring.into_iter().map(Into::into).collect()
}

/// Values everywhere: where there is none, that of the nearest node that has one.
fn filled(values: &[Option<f64>], columns: usize) -> Option<Vec<f64>> {
    let mut filled = values.to_vec();
    let known = (0..values.len()).filter(|&index| values[index].is_some());
    let mut queue: VecDeque<usize> = known.collect();
    while let Some(index) = queue.pop_front() {
        let column = index % columns;
        let neighbours = [
            (column > 0).then(|| index - 1),
            (column + 1 < columns).then(|| index + 1),
            index.checked_sub(columns),
            Some(index + columns).filter(|above| *above < values.len()),
        ];
        for neighbour in neighbours.into_iter().flatten() {
            if filled[neighbour].is_none() {
                filled[neighbour] = filled[index];
                queue.push_back(neighbour);
            }
        }
    }
    filled.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance from the middle of an 11 x 11 grid over 1000 px, y upwards.
    fn cone(hole: impl Fn(usize, usize) -> bool) -> Field {
        let node = |index: usize| {
            let (column, row) = (index % 11, index / 11);
            let (x, y) = (column as f64 - 5.0, row as f64 - 5.0);
            (!hole(column, row)).then(|| x.hypot(y))
        };
        let values: Vec<Option<f64>> = (0..121).map(node).collect();
        Field::new(&values, 11, (0, 1000), (1000, 0)).unwrap()
    }

    #[test]
    fn rows_are_whole_and_at_least_two() {
        let is_field = |count: usize, columns| {
            Field::new(&vec![Some(1.0); count], columns, (0, 100), (100, 0)).is_some()
        };
        assert!(is_field(6, 3) && is_field(6, 2));
        assert!(![0, 1, 5, 6].into_iter().any(|columns| is_field(6, columns)));
        let first_only = [Some(1.0), None, None, None, None, None, None];
        assert!(Field::new(&first_only, 3, (0, 100), (100, 0)).is_none());
    }

    #[test]
    fn contours_lie_where_the_value_is() {
        let field = cone(|_, _| false);
        let lines = field.lines(3.0);
        assert_eq!(lines.len(), 1);
        for (x, y) in &lines[0] {
            let radius = f64::from(x - 500).hypot(f64::from(y - 500));
            assert!((radius - 300.0).abs() < 10.0, "{radius}");
        }
        // A circle that leaves the grid comes in four parts.
        assert_eq!(field.lines(6.0).len(), 4);
        assert!(field.reaches(3.0, (830, 500)) && !field.reaches(3.0, (770, 500)));
    }

    #[test]
    fn regions_have_the_area_between_their_outlines() {
        let area = |outline: &Outline| {
            let next = outline.iter().cycle().skip(1);
            let pieces = outline.iter().zip(next);
            let twice: i64 = pieces
                .map(|(a, b)| i64::from(a.0) * i64::from(b.1) - i64::from(b.0) * i64::from(a.1))
                .sum();
            twice.abs() as f64 / 2.0
        };
        let outside = cone(|_, _| false).regions(3.0);
        assert_eq!(outside.len(), 1);
        let expected = 1e6 - std::f64::consts::PI * 300.0 * 300.0;
        assert!((area(&outside[0]) / expected - 1.0).abs() < 0.02);
    }

    #[test]
    fn what_has_no_value_takes_that_of_its_neighbour() {
        let field = cone(|column, _| column > 8);
        assert!(field.reaches(2.9, (1000, 500)) && !field.reaches(3.1, (1000, 500)));
        assert!(Field::new(&[None; 4], 2, (0, 0), (9, 9)).is_none());
        assert!(Field::new(&[Some(1.0); 4], 4, (0, 0), (9, 9)).is_none());
    }
}
