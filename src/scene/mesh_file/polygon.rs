//! Cuts faces of more than three corners into triangles.

use std::cell::Cell;

use nalgebra::{Point2, Point3, Vector3};

/// Height over base below which a corner counts as lying on a straight line.
const FLAT: f64 = 1e-9;

/// Looks at a corner that all faces of a file may take. Honest faces take about the square of their
/// corners; one that winds or crosses itself as badly as can be takes the cube: with 4096 corners
/// all of these, about a minute.
pub(super) const MOST_LOOKS: u64 = 20_000_000_000;

/// Work space for cutting a face by clipping its ears; keeps every corner, so that faces stay
/// joined to their neighbours even where corners lie on a straight line.
pub(super) struct Polygon {
    /// The corners, laid into the plane of the face so that it runs anticlockwise.
    flat: Vec<Point2<f64>>,
    /// Positions of the corners that are left.
    left: Vec<usize>,
    triangles: Vec<[u32; 3]>,
    /// Looks at a corner that are left for all faces to come.
    looks_left: Cell<u64>,
}

impl Polygon {
    /// Work space for faces that together take at most this many looks at a corner.
    pub fn new(most_looks: u64) -> Self {
        Self {
            flat: Vec::new(),
            left: Vec::new(),
            triangles: Vec::new(),
            looks_left: Cell::new(most_looks),
        }
    }

    /// The triangles of a face, wound as the face is; `None` when the faces so far have taken too
    /// long.
    pub fn triangles(&mut self, corners: &[u32], vertices: &[Point3<f64>]) -> Option<&[[u32; 3]]> {
        self.flatten(corners, vertices);
        self.triangles.clear();
        self.left.clear();
        self.left.extend(0..corners.len());
        let mut start = 0;
        while self.left.len() > 3 {
            if self.looks_left.get() == 0 {
                return None;
            }
            let ear = self.next_ear(start);
            let [before, tip, after] = self.around(ear);
            self.triangles
                .push([corners[before], corners[tip], corners[after]]);
            self.left.remove(ear);
            start = (ear + 1) % self.left.len(); // every other corner: no fan of slivers
        }
        if let [a, b, c] = self.left[..] {
            self.triangles.push([corners[a], corners[b], corners[c]]);
        }
        Some(&self.triangles)
    }

    /// Projects along the coordinate axis nearest to the normal (by Newell's sum).
    fn flatten(&mut self, corners: &[u32], vertices: &[Point3<f64>]) {
        let at = |position: usize| vertices[corners[position % corners.len()] as usize];
        let origin = at(0);
        let normal: Vector3<f64> = (0..corners.len())
            .map(|position| (at(position) - origin).cross(&(at(position + 1) - origin)))
            .sum();
        let axis = normal.iamax();
        let (u, v) = match normal[axis] >= 0.0 {
            true => ((axis + 1) % 3, (axis + 2) % 3),
            false => ((axis + 2) % 3, (axis + 1) % 3),
        };
        self.flat.clear();
        self.flat.extend((0..corners.len()).map(|position| {
            let corner = at(position);
            Point2::new(corner[u], corner[v])
        }));
    }

    /// Where the next ear is, looking from `start` on. A face that crosses itself may have none:
    /// then the flattest corner goes.
    fn next_ear(&self, start: usize) -> usize {
        let count = self.left.len();
        let ear = (0..count)
            .map(|step| (start + step) % count)
            .find(|ear| self.is_ear(*ear));
        ear.unwrap_or_else(|| {
            let flatness = |ear: &usize| self.turn(self.around(*ear)).abs();
            (0..count)
                .min_by(|a, b| flatness(a).total_cmp(&flatness(b)))
                .unwrap_or(0)
        })
    }

    fn is_ear(&self, ear: usize) -> bool {
        let triangle = self.around(ear);
        let [a, b, c] = triangle;
        let base = nalgebra::distance_squared(&self.flat[a], &self.flat[c]);
        let stands_out = self.turn(triangle) > FLAT * base;
        if stands_out {
            let looks = self.left.len() as u64;
            self.looks_left
                .set(self.looks_left.get().saturating_sub(looks));
        }
        stands_out
            && self.left.iter().all(|&other| {
                let point = self.flat[other];
                triangle.iter().any(|&corner| self.flat[corner] == point)
                    || self.turn([a, b, other]) < 0.0
                    || self.turn([b, c, other]) < 0.0
                    || self.turn([c, a, other]) < 0.0
            })
    }

    /// The corner at `ear` between its two neighbours.
    fn around(&self, ear: usize) -> [usize; 3] {
        let count = self.left.len();
        [
            self.left[(ear + count - 1) % count],
            self.left[ear],
            self.left[(ear + 1) % count],
        ]
    }

    /// Twice the area of three corners; positive for a left turn.
    fn turn(&self, [a, b, c]: [usize; 3]) -> f64 {
        let [a, b, c] = [self.flat[a], self.flat[b], self.flat[c]];
        (b - a).perp(&(c - a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A star that crosses itself everywhere.
    fn star(corners: u32) -> Vec<Point3<f64>> {
        let turn = std::f64::consts::TAU * f64::from(corners / 2) / f64::from(corners);
        let corner = |index: u32| {
            let (sin, cos) = (turn * f64::from(index)).sin_cos();
            Point3::new(cos, sin, 0.0)
        };
        (0..corners).map(corner).collect()
    }

    #[test]
    fn faces_that_take_too_long_are_given_up() {
        let vertices = star(201);
        let face: Vec<u32> = (0..201).collect();
        let count = |most_looks| {
            let mut polygon = Polygon::new(most_looks);
            polygon.triangles(&face, &vertices).map(<[_]>::len)
        };
        assert_eq!(count(MOST_LOOKS), Some(199));
        assert_eq!(count(1000), None);
    }

    #[test]
    fn hollow_faces_are_cut_without_overlaps() {
        // An L, a U, a comb and a spiral, anticlockwise, and the area of each.
        let shapes: [(&[[f64; 2]], f64); 4] = [
            (
                &[[0., 0.], [3., 0.], [3., 1.], [1., 1.], [1., 3.], [0., 3.]],
                5.0,
            ),
            (
                &[
                    [0., 0.],
                    [3., 0.],
                    [3., 3.],
                    [2., 3.],
                    [2., 1.],
                    [1., 1.],
                    [1., 3.],
                    [0., 3.],
                ],
                7.0,
            ),
            (
                &[
                    [0., 0.],
                    [5., 0.],
                    [5., 4.],
                    [4., 4.],
                    [4., 1.],
                    [3., 1.],
                    [3., 9.],
                    [2., 9.],
                    [2., 1.],
                    [1., 1.],
                    [1., 2.],
                    [0., 2.],
                ],
                17.0,
            ),
            (
                &[
                    [0., 0.],
                    [7., 0.],
                    [7., 7.],
                    [0., 7.],
                    [0., 2.],
                    [5., 2.],
                    [5., 5.],
                    [2., 5.],
                    [2., 4.],
                    [4., 4.],
                    [4., 3.],
                    [1., 3.],
                    [1., 6.],
                    [6., 6.],
                    [6., 1.],
                    [0., 1.],
                ],
                31.0,
            ),
        ];
        for (corners, area) in shapes {
            for shift in 0..corners.len() {
                for mirrored in [false, true] {
                    let count = corners.len();
                    let turned = (0..count).map(|corner| corners[(corner + shift) % count]);
                    let mut corners: Vec<[f64; 2]> = turned.collect();
                    if mirrored {
                        corners.reverse();
                    }
                    let vertices: Vec<_> = corners
                        .iter()
                        .map(|[x, y]| Point3::new(*x, 7.0, *y))
                        .collect();
                    let face: Vec<u32> = (0..corners.len() as u32).collect();
                    let mut polygon = Polygon::new(MOST_LOOKS);
                    let triangles = polygon.triangles(&face, &vertices).expect("short");
                    assert_eq!(triangles.len(), corners.len() - 2);
                    // Anticlockwise from x to z looks along -y.
                    let side = if mirrored { 1.0 } else { -1.0 };
                    let areas = triangles.iter().map(|corners| {
                        let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
                        side * (b - a).cross(&(c - a)).y / 2.0
                    });
                    let areas: Vec<f64> = areas.collect();
                    assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
                    assert!((areas.iter().sum::<f64>() - area).abs() < 1e-12);
                }
            }
        }
    }

    /// A tip that reaches the opposite side divides a face, which is cut on both sides of it.
    #[test]
    fn faces_that_touch_their_own_sides_are_cut_without_overlaps() {
        let notched = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
        for shift in 0..5 {
            for mirrored in [false, true] {
                let turned = (0..5).map(|corner| notched[(corner + shift) % 5]);
                let mut corners: Vec<[f64; 2]> = turned.collect();
                if mirrored {
                    corners.reverse();
                }
                let vertices: Vec<_> = corners
                    .iter()
                    .map(|[x, y]| Point3::new(*x, *y, 7.0))
                    .collect();
                let mut polygon = Polygon::new(MOST_LOOKS);
                let triangles = polygon.triangles(&[0, 1, 2, 3, 4], &vertices);
                let side = if mirrored { -1.0 } else { 1.0 };
                let areas = triangles.expect("short").iter().map(|corners| {
                    let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
                    side * (b - a).cross(&(c - a)).z / 2.0
                });
                let mut areas: Vec<f64> = areas.collect();
                areas.sort_by(f64::total_cmp);
                assert_eq!(areas, [0.0, 4.0, 4.0], "{shift} {mirrored}");
            }
        }
    }
}
