//! Meshes made in code, and what they look like in each format.

use std::fmt::Write as _;

/// Corners and triangles, as a file would list them.
#[derive(Clone)]
pub struct Sample {
    pub vertices: Vec<[f64; 3]>,
    pub triangles: Vec<[usize; 3]>,
}

/// A cube from 0 to 1, fronts outwards.
pub fn cube() -> Sample {
    let vertices = (0..8)
        .map(|corner| [corner & 1, corner >> 1 & 1, corner >> 2].map(f64::from))
        .collect();
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]])
        .collect();
    Sample {
        vertices,
        triangles,
    }
}

/// A torus of 2 x `around` x `across` triangles, fronts outwards.
pub fn torus(around: usize, across: usize) -> Sample {
    let turn = |step: usize, steps: usize| step as f64 / steps as f64 * std::f64::consts::TAU;
    let vertices = (0..around * across)
        .map(|number| {
            let (u, v) = (turn(number / across, around), turn(number % across, across));
            let reach = 20.0 + 5.0 * v.cos();
            [reach * u.cos(), reach * u.sin(), 5.0 * v.sin()]
        })
        .collect();
    let at = |i: usize, j: usize| i % around * across + j % across;
    let triangles = (0..around * across)
        .flat_map(|number| {
            let (i, j) = (number / across, number % across);
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    Sample {
        vertices,
        triangles,
    }
}

impl Sample {
    fn corners(&self) -> impl Iterator<Item = [[f64; 3]; 3]> {
        self.triangles
            .iter()
            .map(|triangle| triangle.map(|corner| self.vertices[corner]))
    }

    pub fn obj(&self) -> Vec<u8> {
        let mut text = String::new();
        for [x, y, z] in &self.vertices {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|corner| corner + 1);
            writeln!(text, "f {a} {b} {c}").unwrap();
        }
        text.into_bytes()
    }

    pub fn text_stl(&self, name: &str) -> Vec<u8> {
        let mut text = format!("solid {name}\n");
        for corners in self.corners() {
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for [x, y, z] in corners {
                writeln!(text, "vertex {x:e} {y:e} {z:e}").unwrap();
            }
            text.push_str("endloop\nendfacet\n");
        }
        text.push_str("endsolid\n");
        text.into_bytes()
    }

    pub fn binary_stl(&self, comment: &str) -> Vec<u8> {
        let mut bytes = comment.as_bytes().to_vec();
        bytes.resize(80, 0);
        bytes.extend((self.triangles.len() as u32).to_le_bytes());
        for corners in self.corners() {
            bytes.extend([0; 12]);
            for coordinate in corners.as_flattened() {
                bytes.extend((*coordinate as f32).to_le_bytes());
            }
            bytes.extend([0; 2]);
        }
        bytes
    }

    pub fn ply(&self, format: &str) -> Vec<u8> {
        let mut bytes = format!(
            "ply\nformat {format} 1.0\nelement vertex {}\nproperty double x\nproperty double y\n\
             property double z\nelement face {}\nproperty list uchar uint vertex_indices\n\
             end_header\n",
            self.vertices.len(),
            self.triangles.len()
        )
        .into_bytes();
        for vertex in &self.vertices {
            match format {
                "ascii" => {
                    bytes.extend(format!("{} {} {}\n", vertex[0], vertex[1], vertex[2]).bytes())
                }
                "binary_big_endian" => bytes.extend(vertex.iter().flat_map(|c| c.to_be_bytes())),
                _ => bytes.extend(vertex.iter().flat_map(|c| c.to_le_bytes())),
            }
        }
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|corner| corner as u32);
            if format == "ascii" {
                bytes.extend(format!("3 {a} {b} {c}\n").bytes());
                continue;
            }
            bytes.push(3);
            bytes.extend([a, b, c].iter().flat_map(|corner| match format {
                "binary_big_endian" => corner.to_be_bytes(),
                _ => corner.to_le_bytes(),
            }));
        }
        bytes
    }

    /// The sample in every format, with the ending of each.
    pub fn everywhere(&self) -> Vec<(&'static str, Vec<u8>)> {
        vec![
            ("obj", self.obj()),
            ("stl", self.text_stl("part")),
            ("stl", self.binary_stl("solid in name only")),
            ("ply", self.ply("ascii")),
            ("ply", self.ply("binary_little_endian")),
            ("ply", self.ply("binary_big_endian")),
        ]
    }
}
