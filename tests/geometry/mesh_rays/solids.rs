//! Closed surfaces made here.

use std::collections::HashMap;
use std::f64::consts::TAU;
use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use crate::mesh_rays::random::Random;

/// Vertices, and triangles between them.
#[derive(Default)]
pub struct Solid {
    pub vertices: Vec<Point3<f64>>,
    pub triangles: Vec<[usize; 3]>,
}

impl Solid {
    fn quad(&mut self, [a, b, c, d]: [usize; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// As a file holds it, to the last digit, with the fronts inwards.
    pub fn obj(&self) -> String {
        let mut text = String::new();
        for Point3 { coords } in &self.vertices {
            writeln!(text, "v {:?} {:?} {:?}", coords.x, coords.y, coords.z).unwrap();
        }
        for [a, b, c] in &self.triangles {
            writeln!(text, "f {} {} {}", c + 1, b + 1, a + 1).unwrap();
        }
        text
    }
}

pub fn tetrahedron() -> Solid {
    let corners = [
        [1.0, 1.0, 1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
    ];
    Solid {
        vertices: corners.map(Point3::from).to_vec(),
        triangles: vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
    }
}

/// A tetrahedron whose sides are halved again and again, blown up to a sphere.
pub fn sphere(halvings: usize) -> Solid {
    let mut sphere = tetrahedron();
    for _ in 0..halvings {
        let mut middles = HashMap::new();
        let Solid {
            vertices,
            triangles,
        } = &mut sphere;
        let mut middle = |a: usize, b: usize| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                vertices.push(nalgebra::center(&vertices[a], &vertices[b]));
                vertices.len() - 1
            })
        };
        let quarters = triangles.iter().flat_map(|&[a, b, c]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        *triangles = quarters.collect();
    }
    for vertex in &mut sphere.vertices {
        *vertex = Point3::from(vertex.coords.normalize());
    }
    sphere
}

/// A ball with a spike or a dent at every vertex.
pub fn spikes() -> Solid {
    let mut random = Random(5);
    let mut ball = sphere(4);
    for vertex in &mut ball.vertices {
        vertex.coords *= 0.2 + 0.8 * random.uniform().powi(3);
    }
    ball
}

/// A rod of radius 1 whose sides are strips from end to end, and whose ends are fans round one of
/// their corners: needles, most of them.
pub fn rod(sides: usize, length: f64) -> Solid {
    let mut rod = Solid::default();
    for side in 0..sides {
        let (sin, cos) = (TAU * side as f64 / sides as f64).sin_cos();
        rod.vertices.push(Point3::new(cos, sin, 0.0));
        rod.vertices.push(Point3::new(cos, sin, length));
    }
    for side in 0..sides {
        let (here, next) = (2 * side, 2 * ((side + 1) % sides));
        rod.quad([here, next, next + 1, here + 1]);
        if (1..sides - 1).contains(&side) {
            rod.triangles.push([0, next, here]);
            rod.triangles.push([1, here + 1, next + 1]);
        }
    }
    rod
}

/// A tube of some radius round a closed curve that stays clear of the z axis.
pub fn tube(curve: impl Fn(f64) -> Point3<f64>, radius: f64, [along, around]: [usize; 2]) -> Solid {
    let mut tube = Solid::default();
    for ring in 0..along {
        let at = |step: f64| curve((ring as f64 + step) / along as f64);
        let tangent = (at(0.01) - at(-0.01)).normalize();
        let across = tangent.cross(&Vector3::z()).normalize();
        let up = across.cross(&tangent);
        for step in 0..around {
            let (sin, cos) = (TAU * step as f64 / around as f64).sin_cos();
            tube.vertices
                .push(at(0.0) + (across * cos + up * sin) * radius);
        }
    }
    let at = |ring: usize, step: usize| (ring % along) * around + step % around;
    for ring in 0..along {
        for step in 0..around {
            let (next_ring, next_step) = (ring + 1, step + 1);
            tube.quad([
                at(ring, step),
                at(next_ring, step),
                at(next_ring, next_step),
                at(ring, next_step),
            ]);
        }
    }
    tube
}

pub fn circle(turn: f64) -> Point3<f64> {
    let (sin, cos) = (TAU * turn).sin_cos();
    Point3::new(cos, sin, 0.0)
}

/// Three times round the axis and twice through the middle.
pub fn knot(turn: f64) -> Point3<f64> {
    let (sin, cos) = (3.0 * TAU * turn).sin_cos();
    let away = 2.0 + cos;
    let (y, x) = (2.0 * TAU * turn).sin_cos();
    Point3::new(away * x, away * y, sin)
}

/// A corner filled with cubes as stairs: many faces in few planes, all at whole numbers.
pub fn stairs(height: i32) -> Solid {
    let mut stairs = Solid::default();
    let mut known = HashMap::new();
    let filled = |cell: [i32; 3]| cell.iter().all(|&x| x >= 0) && cell.iter().sum::<i32>() < height;
    let range = move || 0..height;
    let cells = range().flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])));
    for cell in cells.filter(|&cell| filled(cell)) {
        for axis in 0..3 {
            for outwards in [0, 1] {
                let mut beside = cell;
                beside[axis] += 2 * outwards - 1;
                if filled(beside) {
                    continue;
                }
                let corner = |u: i32, v: i32| {
                    let mut at = cell;
                    at[axis] += outwards;
                    at[(axis + 1) % 3] += u;
                    at[(axis + 2) % 3] += v;
                    at
                };
                let mut corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                if outwards == 0 {
                    corners.reverse();
                }
                let corners = corners.map(|at| {
                    *known.entry(at).or_insert_with(|| {
                        stairs.vertices.push(Point3::from(at.map(f64::from)));
                        stairs.vertices.len() - 1
                    })
                });
                stairs.quad(corners);
            }
        }
    }
    stairs
}

/// A closed gap of 2 by 2 and a thickness between two plates that are cut into uneven cells.
pub fn gap(cells: usize, thickness: f64) -> Solid {
    let mut random = Random(6);
    let mut cuts = || {
        let mut inner: Vec<f64> = (1..cells).map(|_| 2.0 * random.uniform() - 1.0).collect();
        inner.extend([-1.0, 1.0]);
        inner.sort_by(f64::total_cmp);
        inner
    };
    let (at_x, at_y) = (cuts(), cuts());
    let mut gap = Solid::default();
    for z in [0.0, thickness] {
        for x in &at_x {
            gap.vertices
                .extend(at_y.iter().map(|y| Point3::new(*x, *y, z)));
        }
    }
    let row = cells + 1;
    let above = row * row;
    for (x, y) in (0..cells).flat_map(|x| (0..cells).map(move |y| (x, y))) {
        let [a, b, c, d] = [
            x * row + y,
            (x + 1) * row + y,
            (x + 1) * row + y + 1,
            x * row + y + 1,
        ];
        gap.quad([a, d, c, b]);
        gap.quad([a, b, c, d].map(|corner| corner + above));
    }
    for k in 0..cells {
        let far = cells * row;
        for [from, to] in [
            [k * row, (k + 1) * row],
            [(k + 1) * row + cells, k * row + cells],
            [k + 1, k],
            [far + k, far + k + 1],
        ] {
            gap.quad([from, to, to + above, from + above]);
        }
    }
    gap
}
