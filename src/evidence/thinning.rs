//! Fewer triangles for a picture: corners that lie in the same cell of a grid become one (Rossignac
//! and Borrel, 1993). Near the target every triangle is kept.

use std::collections::{HashMap, HashSet};

use nalgebra::Point3;

use super::Shape;
use crate::scene::patch::Patch;

/// More triangles than this are too many for a report.
const MOST_TRIANGLES: usize = 30_000;
/// Cells in the longest side of the scene: at first, and at least.
const FINEST: f64 = 512.0;
const COARSEST: f64 = 32.0;
/// From one try to the next.
const COARSER: f64 = 1.25;
/// Radius round the aim point within which every triangle is kept, in units of the square root of
/// the target's area.
const NEAR: f64 = 2.0;

/// The shapes with at most [`MOST_TRIANGLES`] triangles.
pub(super) fn thinned(shapes: Vec<Shape>, target: &Patch) -> Vec<Shape> {
    if count(&shapes) <= MOST_TRIANGLES {
        return shapes;
    }
    let mut near = NEAR * target.area.sqrt();
    loop {
        let mut cells = FINEST;
        // No grid helps as long as too many are kept on purpose.
        let is_worth_a_try = count_near(&shapes, &target.frame.aim, near) <= MOST_TRIANGLES;
        while is_worth_a_try && cells >= COARSEST {
            let fewer = gathered(&shapes, &target.frame.aim, near, cells);
            // With nothing kept on purpose the coarsest grid is the end of it.
            if count(&fewer) <= MOST_TRIANGLES || (near == 0.0 && cells / COARSER < COARSEST) {
                return fewer;
            }
            cells /= COARSER;
        }
        near = if near > 0.1 * target.area.sqrt() {
            near / 2.0
        } else {
            0.0
        };
    }
}

fn count(shapes: &[Shape]) -> usize {
    shapes.iter().map(|shape| shape.triangles.len()).sum()
}

/// How many triangles lie near the aim point with all corners.
fn count_near(shapes: &[Shape], aim: &Point3<f64>, near: f64) -> usize {
    let count_in = |shape: &Shape| {
        let is_near = |corner: &u32| (shape.points[*corner as usize] - aim).norm() < near;
        let triangles = shape.triangles.iter();
        triangles
            .filter(|corners| corners.iter().all(is_near))
            .count()
    };
    shapes.iter().map(count_in).sum()
}

/// With the corners of each cell gathered at the first of them, but for those near the aim point.
fn gathered(shapes: &[Shape], aim: &Point3<f64>, near: f64, cells: f64) -> Vec<Shape> {
    let points = || shapes.iter().flat_map(|shape| &shape.points);
    let start = *aim;
    let low = points().fold(start, |low, p| low.inf(p));
    let high = points().fold(start, |high, p| high.sup(p));
    let side = (high - low).max() / cells;
    let mut first_in: HashMap<[i64; 3], Point3<f64>> = HashMap::new();
    let mut place = |point: &Point3<f64>| {
        if (point - aim).norm() < near {
            return *point;
        }
        let cell = [0, 1, 2].map(|axis| ((point[axis] - low[axis]) / side) as i64);
        *first_in.entry(cell).or_insert(*point)
    };
    shapes
        .iter()
        .map(|shape| {
            let places: Vec<Point3<f64>> = shape.points.iter().map(&mut place).collect();
            let mut seen = HashSet::new();
            let kept: Vec<[Point3<f64>; 3]> = shape
                .triangles
                .iter()
                .map(|corners| corners.map(|corner| places[corner as usize]))
                .filter(|[a, b, c]| a != b && b != c && c != a)
                .filter(|corners| {
                    let mut bits = corners.map(|p| [p.x, p.y, p.z].map(f64::to_bits));
                    bits.sort_unstable();
                    seen.insert(bits)
                })
                .collect();
            let fewer = Shape::of(&kept);
            Shape {
                surface: shape.surface,
                is_target: shape.is_target,
                share_drawn: fewer.triangles.len() as f64 / shape.triangles.len().max(1) as f64,
                ..fewer
            }
        })
        .collect()
}
