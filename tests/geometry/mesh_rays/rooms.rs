//! Closed meshes with room inside.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use nalgebra::{Point3, UnitQuaternion, Vector3};
use peenpose::problem::LengthUnit;
use peenpose::problem::part::{Part, Place, Shape, Target};
use peenpose::scene::patch::Patch;
use peenpose::scene::ray::{HitId, Ray};
use peenpose::scene::{Scene, Walls};

use crate::mesh_rays::solids::{self, Solid};

type Triangle = [Point3<f64>; 3];

/// A closed mesh round free space, a place there and a shot that fits.
pub struct Room {
    pub name: &'static str,
    pub scene: Scene,
    pub triangles: Vec<Triangle>,
    /// Whether it is the inside of a single body, whose fronts look outwards.
    pub is_hollow: bool,
    /// The triangles round each vertex.
    round_vertices: HashMap<[u64; 3], Vec<usize>>,
    pub inside: Point3<f64>,
    /// Of the shot, m.
    pub radius: f64,
    /// Share of the casts, against 1 of the other rooms: less where they take long.
    pub share: f64,
}

impl Room {
    /// Whether a hit is on a side that shots inside can see: fronts of a part in a box, and backs of what
    /// is round them, be it the box or a hollow.
    pub fn shows(&self, hit_id: &HitId) -> bool {
        hit_id.front == (hit_id.part == 0 && !self.is_hollow)
    }

    /// The triangles round a corner of a triangle.
    pub fn round(&self, corner: &Point3<f64>) -> &[usize] {
        &self.round_vertices[&bits(corner)]
    }
}

fn bits(point: &Point3<f64>) -> [u64; 3] {
    point.coords.map(f64::to_bits).into()
}

/// What a room is made of, before it is turned and moved: in lengths of `unit`, m.
struct Plan {
    name: &'static str,
    unit: f64,
    inside: [f64; 3],
    radius: f64,
    share: f64,
    place: Place,
}

impl Plan {
    fn new(name: &'static str, unit: f64, inside: [f64; 3], radius: f64) -> Self {
        let place = Place {
            rotation: turned(),
            shift: Vector3::zeros(),
        };
        Self {
            name,
            unit,
            inside,
            radius,
            share: 1.0,
            place,
        }
    }

    fn at(self, place: Place) -> Self {
        Self { place, ..self }
    }

    fn slow(self) -> Self {
        Self { share: 0.1, ..self }
    }

    fn part(&self, name: &str, shape: Shape) -> Part {
        Part {
            name: name.into(),
            shape,
            place: self.place,
            on_nozzle: false,
            cut: Vec::new(),
        }
    }

    fn mesh(&self, path: PathBuf) -> Part {
        let shape = Shape::Mesh {
            file: path.into(),
            metres_per_unit: self.unit,
            regions: Vec::new(),
        };
        self.part("mesh", shape)
    }

    fn build(&self, parts: &[Part]) -> Room {
        let mut scene =
            Scene::build(parts, Walls::Exact).unwrap_or_else(|faults| panic!("{faults:?}"));
        let inside =
            self.place.rotation * (Point3::from(self.inside) * self.unit) + self.place.shift;
        if parts.len() == 1 {
            settle_inside(&mut scene, inside);
        }
        let mut odd = scene.warnings().iter();
        // Those of hollows look inwards.
        let odd = odd.find(|warning| !warning.contains("point into the material"));
        assert_eq!(odd, None, "{}", self.name);
        let surfaces = 0..scene.surfaces().len() as u32;
        let triangles: Vec<Triangle> = surfaces
            .flat_map(|surface| scene.surface_triangles(surface))
            .collect();
        let mut round_vertices = HashMap::<_, Vec<_>>::new();
        for (index, corners) in triangles.iter().enumerate() {
            for corner in corners {
                round_vertices.entry(bits(corner)).or_default().push(index);
            }
        }
        Room {
            is_hollow: parts.len() == 1,
            name: self.name,
            triangles,
            round_vertices,
            inside,
            radius: self.radius * self.unit,
            share: self.share,
            scene,
        }
    }

    /// The inside of a solid.
    fn hollow(&self, solid: &Solid) -> Room {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("room.obj");
        std::fs::write(&path, solid.obj()).unwrap();
        self.build(&[self.mesh(path)])
    }

    /// The inside of a box, with a part from a file of the repository in it.
    fn round(&self, path: &str, [min, max]: [[f64; 3]; 2]) -> Room {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        let [min, max] = [min, max].map(|corner| Point3::from(corner) * self.unit);
        let shape = Shape::Box { min, max };
        self.build(&[self.mesh(path), self.part("box", shape)])
    }
}

/// Tells a scene of one body that a nozzle is in it: some place of its wall is the target, seen from there.
fn settle_inside(scene: &mut Scene, inside: Point3<f64>) {
    let look = Ray {
        origin: inside,
        direction: Vector3::new(0.6, 0.48, 0.64),
    };
    let hit = scene.first_hit(&look, None).expect("a wall all round");
    let target = Target {
        lengths_in: LengthUnit::default(),
        surface: scene.surfaces()[hit.surface as usize].clone(),
        within: None,
        aim: Some(hit.point),
        aim_key: "target.aim",
        along: None,
        facing: Some(hit.normal),
    };
    let patch = Patch::find(scene, &target).unwrap_or_else(|faults| panic!("{faults:?}"));
    scene.settle(&patch);
}

/// So that nothing lies along an axis.
fn turned() -> UnitQuaternion<f64> {
    UnitQuaternion::from_euler_angles(0.7, -0.4, 2.1)
}

/// Coarse and fine ones, needles and spikes, parts from a CAD kernel, far away, tiny and huge ones.
pub fn rooms() -> Vec<Room> {
    let straight = Place::default();
    let far_away = Place {
        rotation: turned(),
        shift: Vector3::new(990.0, -700.0, 300.0),
    };
    let keyway = "problems/hub-blind-keyway.obj";
    let in_keyway = [1.0, 16.0, 30.0];
    let round_keyway = [[-30.0, -30.0, -5.0], [30.0, 30.0, 65.0]];
    let round_flange = [[-50.0, -50.0, -5.0], [50.0, 50.0, 40.0]];
    let on_circle = solids::circle(0.1).into();
    let on_knot = solids::knot(0.1).into();
    vec![
        Plan::new("tetrahedron", 10e-3, [0.0; 3], 0.1).hollow(&solids::tetrahedron()),
        Plan::new("fine sphere", 20e-3, [0.0; 3], 0.05).hollow(&solids::sphere(7)),
        Plan::new("rod of needles", 5e-3, [0.0, 0.0, 5.0], 0.2)
            .slow()
            .hollow(&solids::rod(600, 20.0)),
        Plan::new("spikes and dents", 30e-3, [0.0; 3], 0.02).hollow(&solids::spikes()),
        Plan::new("stairs", 1.0 / 1024.0, [2.3, 2.2, 2.1], 0.25)
            .at(straight)
            .hollow(&solids::stairs(12)),
        Plan::new("gap of a micrometre", 50e-3, [0.1, 0.2, 1e-5], 4e-6)
            .hollow(&solids::gap(40, 2e-5)),
        Plan::new("CAD: blind keyway", 1e-3, in_keyway, 0.5)
            .at(straight)
            .round(keyway, round_keyway),
        Plan::new("CAD: flange, binary STL", 1e-3, [2.0, 1.0, 15.0], 0.4)
            .at(straight)
            .round("tests/data/flange.stl", round_flange),
        Plan::new("the keyway 1.2 km away", 1e-3, in_keyway, 0.5)
            .at(far_away)
            .round(keyway, round_keyway),
        Plan::new("ring of two micrometres", 1e-6, on_circle, 0.1).hollow(&solids::tube(
            solids::circle,
            0.3,
            [300, 60],
        )),
        Plan::new("knot of 300 km", 50e3, on_knot, 0.1).hollow(&solids::tube(
            solids::knot,
            0.4,
            [1000, 60],
        )),
    ]
}
