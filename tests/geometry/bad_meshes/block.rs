//! A block of triangles, 40 mm wide and 10 mm high, its top at z = 0.

use std::fmt::Write as _;

use nalgebra::Point3;

/// Along each side of its top and its bottom.
pub const CELLS: usize = 8;

const WIDTH: f64 = 40.0;

pub struct Block {
    vertices: Vec<Point3<f64>>,
    /// Those of the top, then those of the bottom, then those of the sides.
    pub triangles: Vec<[usize; 3]>,
    on_top: usize,
}

impl Block {
    pub fn new() -> Self {
        let at = |k: usize| WIDTH * (k as f64 / CELLS as f64 - 0.5);
        let row = CELLS + 1;
        let cells = || (0..CELLS).flat_map(|x| (0..CELLS).map(move |y| (x, y)));
        let mut block = Self {
            vertices: Vec::new(),
            triangles: Vec::new(),
            on_top: 2 * CELLS * CELLS,
        };
        for z in [0.0, -10.0] {
            for (x, y) in (0..row).flat_map(|x| (0..row).map(move |y| (x, y))) {
                block.vertices.push(Point3::new(at(x), at(y), z));
            }
        }
        let top = |x: usize, y: usize| x * row + y;
        let bottom = |x: usize, y: usize| row * row + top(x, y);
        for (x, y) in cells() {
            block.quad([top(x, y), top(x + 1, y), top(x + 1, y + 1), top(x, y + 1)]);
        }
        for (x, y) in cells() {
            block.quad([
                bottom(x, y),
                bottom(x, y + 1),
                bottom(x + 1, y + 1),
                bottom(x + 1, y),
            ]);
        }
        let mut side = |[from, to]: [(usize, usize); 2]| {
            let ([a, b], [c, d]) = (
                [top(from.0, from.1), top(to.0, to.1)],
                [bottom(to.0, to.1), bottom(from.0, from.1)],
            );
            block.quad([b, a, d, c]);
        };
        for k in 0..CELLS {
            side([(k, 0), (k + 1, 0)]);
            side([(k + 1, CELLS), (k, CELLS)]);
            side([(0, k + 1), (0, k)]);
            side([(CELLS, k), (CELLS, k + 1)]);
        }
        block
    }

    fn quad(&mut self, [a, b, c, d]: [usize; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// Another vertex.
    pub fn add(&mut self, corner: [f64; 3]) -> usize {
        self.vertices.push(Point3::from(corner));
        self.vertices.len() - 1
    }

    /// Puts a vertex on the first edge of a triangle of the top, which its neighbour does not share.
    pub fn split_on_one_side(&mut self, number: usize) {
        let [a, b, c] = self.triangles[number];
        let middle = self.vertices[a] + (self.vertices[b] - self.vertices[a]) * 0.3;
        let middle = self.add(middle.coords.into());
        self.triangles[number] = [a, middle, c];
        self.triangles.insert(number + 1, [middle, b, c]);
        self.on_top += 1;
    }

    /// Makes a small triangular hole in the first triangle, which is in a corner of the top.
    pub fn pierce_first(&mut self) {
        let corners = self.triangles[0];
        let points = corners.map(|corner| self.vertices[corner].coords);
        let centre = (points[0] + points[1] + points[2]) / 3.0;
        let inner = points.map(|point| {
            let near = centre + (point - centre) * 0.02;
            self.add(near.into())
        });
        let around = (0..3).flat_map(|from| {
            let to = (from + 1) % 3;
            [
                [corners[from], corners[to], inner[to]],
                [corners[from], inner[to], inner[from]],
            ]
        });
        self.triangles.splice(..1, around);
        self.on_top += 5;
    }

    /// As a file, with the surfaces `top` and `rest`.
    pub fn obj(&self) -> String {
        let mut text = String::new();
        for Point3 { coords } in &self.vertices {
            writeln!(text, "v {:?} {:?} {:?}", coords.x, coords.y, coords.z).unwrap();
        }
        for (number, [a, b, c]) in self.triangles.iter().enumerate() {
            let group = if number < self.on_top { "top" } else { "rest" };
            writeln!(text, "g {group}\nf {} {} {}", a + 1, b + 1, c + 1).unwrap();
        }
        text
    }
}
