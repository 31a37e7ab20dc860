//! The slot and the pin of a world as triangles: walls with bumps, and a closed solid with more of them.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

/// Corners in mm, and triangles with the names of their surfaces.
pub struct Mesh {
    pub vertices: Vec<Point3<f64>>,
    pub triangles: Vec<([usize; 3], &'static str)>,
}

/// A number between -1 and 1 that the seed and its own number decide.
fn noise(seed: u32, number: usize) -> f64 {
    2.0 * f64::from(sobol_burley::sample(number as u32, 0, seed)) - 1.0
}

impl Mesh {
    /// Rows of corners, each joined with the next one by triangles whose diagonals run either way.
    /// `names` are those of the strips between columns; with as many names as columns the last column is
    /// joined with the first.
    fn of_rows(vertices: Vec<Point3<f64>>, columns: usize, names: &[&'static str]) -> Self {
        let mut triangles = Vec::new();
        for row in 0..vertices.len() / columns - 1 {
            for (column, &name) in names.iter().enumerate() {
                let at = |row: usize, column: usize| row * columns + column % columns;
                let (a, b) = (at(row, column), at(row + 1, column));
                let (c, d) = (at(row + 1, column + 1), at(row, column + 1));
                let halves = if (row + column) % 3 == 0 {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                };
                triangles.extend(halves.map(|corners| (corners, name)));
            }
        }
        Self {
            vertices,
            triangles,
        }
    }

    /// Walls along z over the corners of a cross-section, which are moved at random by up to `bump`.
    pub fn walls(
        section: &[([f64; 2], &'static str)],
        end: [f64; 2],
        bump: f64,
        seed: u32,
    ) -> Self {
        const ROWS: usize = 9;
        let corners: Vec<[f64; 2]> = section.iter().map(|(at, _)| *at).chain([end]).collect();
        let names: Vec<&'static str> = section.iter().map(|(_, name)| *name).collect();
        let corner = |index: usize| {
            let [x, y] = corners[index % corners.len()];
            let z = 30.0 * (index / corners.len()) as f64 / (ROWS - 1) as f64 - 15.0;
            let move_by = [0, 1, 2].map(|axis| bump * noise(seed, 3 * index + axis));
            Point3::new(x, y, z) + Vector3::from(move_by)
        };
        let vertices = (0..ROWS * corners.len()).map(corner).collect();
        let mut walls = Self::of_rows(vertices, corners.len(), &names);
        // Surfaces meet at ridges, too.
        let floor = walls.triangles.iter_mut();
        let floor = floor.filter(|(_, name)| *name == "floor");
        floor.step_by(5).for_each(|(_, name)| *name = "patch");
        walls
    }

    /// A closed rod along z with bumps as large as a share of its radius, and a point at either end.
    pub fn rod([x, y]: [f64; 2], radius: f64, length: f64, bump: f64, seed: u32) -> Self {
        const SIDES: usize = 7;
        const ROWS: usize = 6;
        let corner = |index: usize| {
            let radius = radius * (1.0 + bump * noise(seed, index));
            let turn = (index / SIDES) as f64 * 0.3 + (index % SIDES) as f64;
            let (sin, cos) = (TAU * turn / SIDES as f64).sin_cos();
            let z = length * ((index / SIDES) as f64 / (ROWS - 1) as f64 - 0.5);
            Point3::new(x + radius * cos, y + radius * sin, z)
        };
        let vertices: Vec<_> = (0..ROWS * SIDES).map(corner).collect();
        let mut rod = Self::of_rows(vertices, SIDES, &["wall"; SIDES]);
        for (row, sign) in [(0, -1.0), (ROWS - 1, 1.0)] {
            let tip = rod.vertices.len();
            let z = sign * (0.5 * length + radius);
            rod.vertices.push(Point3::new(x, y, z));
            for side in 0..SIDES {
                let [here, next] = [side, (side + 1) % SIDES].map(|side| row * SIDES + side);
                let corners = if row == 0 {
                    [here, next, tip]
                } else {
                    [next, here, tip]
                };
                rod.triangles.push((corners, "wall"));
            }
        }
        rod.turned_over()
    }

    /// With the fronts on the other side: those of walls are inside.
    fn turned_over(mut self) -> Self {
        for (corners, _) in &mut self.triangles {
            corners.swap(1, 2);
        }
        self
    }

    /// In a mirror in the plane x = 0, with the names of both sides exchanged.
    pub fn mirrored(mut self) -> Self {
        for vertex in &mut self.vertices {
            vertex.x = -vertex.x;
        }
        for (_, name) in &mut self.triangles {
            *name = match *name {
                "left" => "right",
                "right" => "left",
                other => other,
            };
        }
        self.turned_over()
    }

    /// The centre of the triangle of a surface that is nearest to a point.
    pub fn nearest_centre(&self, surface: &str, to: &Point3<f64>) -> Point3<f64> {
        let of_surface = self.triangles.iter().filter(|(_, name)| *name == surface);
        let centres = of_surface.map(|(corners, _)| {
            let sum = corners.iter().map(|&corner| self.vertices[corner].coords);
            Point3::from(sum.sum::<Vector3<f64>>() / 3.0)
        });
        let distance = |centre: &Point3<f64>| (centre - to).norm();
        let nearest = centres.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.expect("the surface has triangles")
    }

    /// As an OBJ file has it, given what a corner is there and what a surface is called.
    pub fn obj(
        &self,
        there: impl Fn(&Point3<f64>) -> [f64; 3],
        named: impl Fn(&str) -> String,
        backwards: bool,
    ) -> String {
        let mut text = String::new();
        for vertex in &self.vertices {
            let [x, y, z] = there(vertex);
            writeln!(text, "v {x:?} {y:?} {z:?}").unwrap();
        }
        let mut triangles = self.triangles.clone();
        if backwards {
            triangles.reverse();
        }
        for ([a, b, c], name) in triangles {
            let name = named(name);
            writeln!(text, "g {name}\nf {} {} {}", a + 1, b + 1, c + 1).unwrap();
        }
        text
    }
}
