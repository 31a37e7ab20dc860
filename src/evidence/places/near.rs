//! The hits in a small disc round each hit.

use std::collections::HashMap;

use nalgebra::Point3;

/// Hits that a disc holds, typically.
const TYPICAL: usize = 64;
/// Hits from which the typical disc is found.
const SAMPLED: usize = 64;

/// Discs of one radius round points on a surface.
pub(super) struct Neighbourhoods<'a> {
    points: &'a [Point3<f64>],
    /// Of the discs, m.
    pub radius: f64,
    /// Points that a disc must hold for its mean to be looked at.
    pub least: usize,
    /// By cells as wide as the radius.
    cells: HashMap<[i64; 3], Vec<usize>>,
}

impl<'a> Neighbourhoods<'a> {
    /// The radius is the median distance from a hit to the 64th nearest one; a disc counts when it
    /// holds half as many. With less than 64 points it holds one, and those that coincide with it.
    pub fn new(points: &'a [Point3<f64>]) -> Self {
        let (radius, least) = if points.len() < TYPICAL {
            (0.0, 1)
        } else {
            (typical_distance(points), TYPICAL / 2)
        };
        let mut all = Self {
            points,
            radius,
            least,
            cells: HashMap::new(),
        };
        for (index, point) in points.iter().enumerate() {
            all.cells.entry(all.cell(point)).or_default().push(index);
        }
        all
    }

    /// The points in the disc round a point, itself among them.
    pub fn of(&self, index: usize) -> Vec<usize> {
        let centre = &self.points[index];
        let cell = self.cell(centre);
        let mut found = Vec::with_capacity(2 * TYPICAL);
        for step in 0..27 {
            let offset = [step / 9 - 1, step / 3 % 3 - 1, step % 3 - 1];
            let beside = [0, 1, 2].map(|axis| cell[axis] + offset[axis]);
            let others = self.cells.get(&beside).into_iter().flatten();
            found.extend(others.filter(|&&other| {
                (self.points[other] - centre).norm_squared() <= self.radius * self.radius
            }));
        }
        found
    }

    fn cell(&self, point: &Point3<f64>) -> [i64; 3] {
        // Points that coincide have no cells but the one that all share.
        let width = if self.radius > 0.0 {
            self.radius
        } else {
            f64::INFINITY
        };
        [point.x, point.y, point.z].map(|x| (x / width).floor() as i64)
    }
}

/// Median distance from some of the points to their nearest neighbours, m.
fn typical_distance(points: &[Point3<f64>]) -> f64 {
    let mut reaches: Vec<f64> = (0..SAMPLED)
        .map(|number| {
            let centre = &points[number * points.len() / SAMPLED];
            let mut distances: Vec<f64> = points.iter().map(|p| (p - centre).norm()).collect();
            *distances
                .select_nth_unstable_by(TYPICAL - 1, f64::total_cmp)
                .1
        })
        .collect();
    *reaches
        .select_nth_unstable_by(SAMPLED / 2, f64::total_cmp)
        .1
}
