//! Meshes of every kind that people have: sound, damaged, inside out, open, nested.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::{Point3, Vector3};
use peenpose::problem::fault_code::FaultCode;
use peenpose::scenario::Scenario;

/// A mesh in mm, each triangle with the name of its surface.
#[derive(Clone, Default)]
pub struct Body {
    pub name: &'static str,
    vertices: Vec<Point3<f64>>,
    triangles: Vec<([usize; 3], &'static str)>,
}

/// What is to be decided about a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Free {
    Outside,
    Refused,
}

/// A mesh with a target on it.
pub struct Kind {
    pub name: &'static str,
    body: Body,
    surface: &'static str,
    aim: Point3<f64>,
    pub outward: Vector3<f64>,
    pub free: Free,
}

impl Body {
    fn vertex(&mut self, point: Point3<f64>) -> usize {
        let known = self.vertices.iter().position(|it| *it == point);
        known.unwrap_or_else(|| {
            self.vertices.push(point);
            self.vertices.len() - 1
        })
    }

    fn face(&mut self, corners: &[Point3<f64>], surface: &'static str) {
        let corners: Vec<usize> = corners.iter().map(|&it| self.vertex(it)).collect();
        for side in corners.windows(2).skip(1) {
            self.triangles
                .push(([corners[0], side[0], side[1]], surface));
        }
    }

    fn turned(mut self) -> Self {
        self.triangles.iter_mut().for_each(|(it, _)| it.swap(1, 2));
        self
    }

    fn moved(mut self, scale: f64, shift: [f64; 3]) -> Self {
        for vertex in &mut self.vertices {
            *vertex = *vertex * scale + Vector3::from(shift);
        }
        self
    }

    fn named(mut self, surface: &'static str) -> Self {
        self.triangles.iter_mut().for_each(|(_, it)| *it = surface);
        self
    }

    fn with(mut self, other: Self) -> Self {
        for (corners, surface) in &other.triangles {
            let corners = corners.map(|it| self.vertex(other.vertices[it]));
            self.triangles.push((corners, surface));
        }
        self
    }

    fn without(mut self, surface: &str, count: usize) -> Self {
        for _ in 0..count {
            let first = self.triangles.iter().position(|(_, it)| *it == surface);
            self.triangles.remove(first.expect("it is there"));
        }
        self
    }

    pub fn text(&self) -> String {
        let mut text = String::new();
        for vertex in &self.vertices {
            writeln!(text, "v {} {} {}", vertex.x, vertex.y, vertex.z).expect("a string has room");
        }
        for ([a, b, c], surface) in &self.triangles {
            writeln!(text, "g {surface}\nf {} {} {}", a + 1, b + 1, c + 1)
                .expect("a string has room");
        }
        text
    }

    pub fn bounds(&self) -> (Point3<f64>, Point3<f64>) {
        let first = self.vertices[0];
        let each = self.vertices.iter();
        each.fold((first, first), |(low, high), it| {
            (low.inf(it), high.sup(it))
        })
    }

    /// Whether most of three rays from a point cross an odd number of triangles.
    pub fn holds(&self, point: &Point3<f64>) -> bool {
        let directions = [[0.31, 0.77, 0.55], [-0.62, 0.21, 0.75], [0.17, -0.83, 0.53]];
        let odd = directions.iter().filter(|&&direction| {
            let direction = Vector3::from(direction);
            let met = self.triangles.iter().filter(|(corners, _)| {
                let [a, b, c] = corners.map(|it| self.vertices[it]);
                let (u, v) = (b - a, c - a);
                let across = direction.cross(&v);
                let determinant = u.dot(&across);
                let from = point - a;
                let first = from.dot(&across) / determinant;
                let over = from.cross(&u);
                let second = direction.dot(&over) / determinant;
                let distance = v.dot(&over) / determinant;
                first >= 0.0 && second >= 0.0 && first + second <= 1.0 && distance > 0.0
            });
            met.count() % 2 == 1
        });
        odd.count() >= 2
    }
}

/// A block along z with a slot of 8 mm by 10 mm in its top; the slot's floor is at y = 10.
fn slot() -> Body {
    let outline = [
        (-20.0, 0.0),
        (20.0, 0.0),
        (20.0, 20.0),
        (4.0, 20.0),
        (4.0, 10.0),
        (-4.0, 10.0),
        (-4.0, 20.0),
        (-20.0, 20.0),
    ];
    let names = [
        "bottom", "right", "top", "wall", "floor", "wall", "top", "left",
    ];
    let at = |index: usize, z: f64| Point3::new(outline[index % 8].0, outline[index % 8].1, z);
    let mut body = Body::default();
    for (index, name) in names.into_iter().enumerate() {
        let corners = [
            at(index, 0.0),
            at(index + 1, 0.0),
            at(index + 1, 40.0),
            at(index, 40.0),
        ];
        body.face(&corners, name);
    }
    for quad in [[0, 1, 4, 5], [1, 2, 3, 4], [0, 5, 6, 7]] {
        body.face(&quad.map(|it| at(it, 40.0)), "far");
        let [a, b, c, d] = quad;
        body.face(&[d, c, b, a].map(|it| at(it, 0.0)), "near");
    }
    body
}

fn block(low: [f64; 3], high: [f64; 3]) -> Body {
    let (l, h) = (low, high);
    let at = |x: bool, y: bool, z: bool| {
        let pick = |axis: usize, is_high: bool| if is_high { h[axis] } else { l[axis] };
        Point3::new(pick(0, x), pick(1, y), pick(2, z))
    };
    let (o, i) = (false, true);
    let mut body = Body::default();
    body.face(
        &[at(o, o, o), at(i, o, o), at(i, o, i), at(o, o, i)],
        "y_min",
    );
    body.face(
        &[at(o, i, o), at(o, i, i), at(i, i, i), at(i, i, o)],
        "y_max",
    );
    body.face(
        &[at(o, o, o), at(o, o, i), at(o, i, i), at(o, i, o)],
        "x_min",
    );
    body.face(
        &[at(i, o, o), at(i, i, o), at(i, i, i), at(i, o, i)],
        "x_max",
    );
    body.face(
        &[at(o, o, o), at(o, i, o), at(i, i, o), at(i, o, o)],
        "z_min",
    );
    body.face(
        &[at(o, o, i), at(i, o, i), at(i, i, i), at(o, i, i)],
        "z_max",
    );
    body
}

/// A closed surface over a grid that is periodic in `v`, and ends in single points or is periodic in `u`.
fn grid(rows: usize, columns: usize, ring: bool, at: impl Fn(f64, f64) -> [f64; 3]) -> Body {
    let mut body = Body::default();
    let point = |row: usize, column: usize| {
        let row = if ring { row % rows } else { row };
        let v = (column % columns) as f64 / columns as f64;
        let v = if !ring && (row == 0 || row == rows) {
            0.0
        } else {
            v
        };
        Point3::from(at(row as f64 / rows as f64, v))
    };
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [point(row, column), point(row, column + 1)];
            let [c, d] = [point(row + 1, column), point(row + 1, column + 1)];
            for corners in [[a, c, b], [b, c, d]] {
                if corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]
                {
                    body.face(&corners, "all");
                }
            }
        }
    }
    body
}

fn revolved(profile: impl Fn(f64) -> (f64, f64)) -> Body {
    grid(12, 24, false, |u, v| {
        let (radius, height) = profile(u);
        let (sin, cos) = (std::f64::consts::TAU * v).sin_cos();
        [radius * cos, radius * sin, height]
    })
}

fn ball(radius: f64) -> Body {
    revolved(|u| {
        let (sin, cos) = (std::f64::consts::PI * u).sin_cos();
        (radius * sin.max(0.0), radius * cos)
    })
}

/// Eleven closed meshes, nested and inverted ones among them.
pub fn bodies() -> Vec<Body> {
    let turn = |v: f64| (std::f64::consts::TAU * v).sin_cos();
    let named = |name, body: Body| Body { name, ..body };
    let spiked = grid(16, 24, false, |u, v| {
        let (sin, cos) = (std::f64::consts::PI * u).sin_cos();
        let (s, c) = turn(v);
        let radius = 10.0 + 6.0 * (12.0 * u).sin() * (std::f64::consts::TAU * 6.0 * v).cos();
        [
            radius * sin.max(0.0) * c,
            radius * sin.max(0.0) * s,
            radius * cos,
        ]
    });
    let torus = grid(24, 16, true, |u, v| {
        let ((su, cu), (sv, cv)) = (turn(u), turn(v));
        let radius = 10.0 + 4.0 * cv;
        [radius * cu, radius * su, -4.0 * sv]
    });
    let knot = grid(60, 8, true, |u, v| {
        let ((s2, c2), (s3, c3)) = (turn(2.0 * u), turn(3.0 * u));
        let (sv, cv) = turn(v);
        let radius = 10.0 + 3.0 * c3 + cv;
        [radius * c2, radius * s2, 3.0 * s3 - sv]
    });
    vec![
        named("slot", slot()),
        named("ball", ball(10.0)),
        named("torus", torus),
        named("knot", knot),
        named(
            "spindle",
            revolved(|u| (20.0 * u * (1.0 - u), 30.0 * u)).turned(),
        ),
        named(
            "cone",
            revolved(|u| {
                if u < 0.5 {
                    (20.0 * u, 20.0 * u)
                } else {
                    (20.0 * (1.0 - u), 10.0)
                }
            })
            .turned(),
        ),
        named("spiked ball", spiked),
        named("hollow ball", ball(10.0).with(ball(6.0).turned())),
        named(
            "hollow ball, inside out",
            ball(10.0).turned().with(ball(6.0)),
        ),
        named(
            "two balls, one inside out",
            ball(10.0)
                .turned()
                .with(ball(5.0).moved(1.0, [20.0, 0.0, 0.0])),
        ),
        named("thin plate", block([0.0; 3], [40.0, 0.5, 40.0])),
    ]
}

impl Kind {
    /// A problem with one setting, its exit 5 mm from the target.
    pub fn scenario(
        &self,
        folder: &Path,
        facing: Option<Vector3<f64>>,
    ) -> Result<Scenario, Vec<FaultCode>> {
        std::fs::write(folder.join("body.obj"), self.body.text()).expect("there is space");
        let [x, y, z] = self.aim.into();
        let facing = facing.map_or(String::new(), |it| {
            format!(", facing: [{}, {}, {}]", it.x, it.y, it.z)
        });
        let text = format!(
            "format: 1\nlengths_in: mm\nscene: {{ b: {{ mesh: body.obj }} }}\n\
             target: {{ surface: b.{}, aim: [{x}, {y}, {z}]{facing} }}\n\
             shot: {{ radius: 0.3 mm, density: 7800 kg/m3 }}\n\
             jet: {{ exit_diameter: 1 mm, divergence: 3 deg }}\n\
             contacts: {{ dry: {{ mu_s: 0.3, mu_d: 0.27, restitution: 0.4 }} }}\n\
             settings: {{ incidence: 90 deg, azimuth: 0 deg, standoff: 5 mm, speed: 20 m/s }}\n\
             goals: {{ normal_impulse: {{ target: 20 uN.s }} }}\n",
            self.surface
        );
        let path = folder.join("kind.yaml");
        std::fs::write(&path, text).expect("there is space");
        match Scenario::load(&path) {
            Ok((scenario, _)) => Ok(scenario),
            Err(rejection) => Err(rejection.faults.iter().map(|fault| fault.rule).collect()),
        }
    }
}

/// Every kind of mesh, and what is decided about it.
pub fn all() -> Vec<Kind> {
    let floor = |name, body, free| Kind {
        name,
        body,
        surface: "floor",
        aim: Point3::new(0.0, 10.0, 20.0),
        outward: Vector3::y(),
        free,
    };
    let lug = block([20.0, 20.0, 0.0], [30.0, 30.0, 40.0]).named("lug");
    let cavity = block([-15.0, 2.0, 5.0], [-10.0, 5.0, 35.0]).named("cavity");
    let larger = slot().named("other").moved(2.0, [200.0, 0.0, 0.0]);
    let beside = block([10.0, -5.0, 10.0], [30.0, 5.0, 30.0]).named("beside");
    let pocket = |depth: f64| {
        let room = block([-20.0, 10.0, 0.0], [20.0, 10.0 + depth, 40.0]).turned();
        let mut room = room.without("y_max", 2);
        for (_, surface) in &mut room.triangles {
            *surface = if *surface == "y_min" { "floor" } else { "wall" };
        }
        room
    };
    let mut flipped = slot();
    for index in [0, 5, 11] {
        flipped.triangles[index].0.swap(1, 2);
    }
    let mut sheet = Body::default();
    let corners = [(-20.0, 0.0), (-20.0, 40.0), (20.0, 40.0), (20.0, 0.0)];
    sheet.face(&corners.map(|(x, z)| Point3::new(x, 10.0, z)), "floor");
    let thin = block([-20.0, 9.999, 0.0], [20.0, 10.0, 40.0]);
    let thin = Kind {
        surface: "y_max",
        ..floor("a skin of a micrometre", thin, Free::Outside)
    };
    let top = |name, body, free| Kind {
        surface: "top",
        aim: Point3::new(12.0, 20.0, 20.0),
        ..floor(name, body, free)
    };
    let mut twisted = Body::default();
    let edge = |k: usize| {
        let turn = std::f64::consts::TAU * k as f64 / 16.0;
        let half = Vector3::new(0.0, (turn / 2.0).cos(), (turn / 2.0).sin()) * 4.0;
        let half = nalgebra::Rotation3::from_axis_angle(&Vector3::y_axis(), turn) * half;
        let centre = Point3::new(20.0 * turn.sin(), 10.0, 20.0 * turn.cos());
        [centre - half, centre + half]
    };
    for k in 0..16 {
        let [a, b] = edge(k);
        let [c, d] = if k == 15 {
            let [c, d] = edge(0);
            [d, c]
        } else {
            edge(k + 1)
        };
        twisted.face(&[a, b, d, c], "floor");
    }
    let ([a, b], [_, d]) = (edge(0), edge(1));
    let twisted = Kind {
        aim: Point3::from((a.coords + b.coords + d.coords) / 3.0),
        outward: (b - a).cross(&(d - a)).normalize(),
        ..floor("a band with one side", twisted, Free::Refused)
    };
    let far = Kind {
        aim: Point3::new(2000.0, 1510.0, -780.0),
        ..floor(
            "2 m from the origin",
            slot().moved(1.0, [2000.0, 1500.0, -800.0]),
            Free::Outside,
        )
    };
    use Free::{Outside, Refused};
    vec![
        floor("sound", slot(), Outside),
        floor("inside out", slot().turned(), Outside),
        floor("some triangles flipped", flipped, Outside),
        floor("a triangle missing", slot().without("bottom", 1), Outside),
        floor(
            "a triangle missing, inside out",
            slot().without("bottom", 1).turned(),
            Outside,
        ),
        floor("a lug at an edge", slot().with(lug.clone()), Outside),
        floor(
            "a lug at an edge, inside out",
            slot().turned().with(lug),
            Outside,
        ),
        floor(
            "a cavity inside",
            slot().with(cavity.clone().turned()),
            Outside,
        ),
        floor(
            "a cavity inside, all inside out",
            slot().turned().with(cavity),
            Outside,
        ),
        floor(
            "one of two bodies inside out",
            slot().turned().with(larger),
            Outside,
        ),
        floor("two bodies that overlap", slot().with(beside), Outside),
        far,
        thin,
        floor("an open pocket", pocket(40.0), Outside),
        floor("an open pocket, turned", pocket(40.0).turned(), Refused),
        floor("an open tray", pocket(8.0), Outside),
        floor("an open tray, turned", pocket(8.0).turned(), Refused),
        floor("a flat sheet", sheet, Refused),
        top("a side missing", slot().without("bottom", 2), Refused),
        twisted,
    ]
}
