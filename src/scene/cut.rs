//! Parts that others are cut out of: holes that are drilled into them.
//!
//! What encloses free space, such as a bore, and what is cut out of it make one hollow together; out of a body they are taken away.
//! Both are done on triangles, each of which keeps the name of the surface that it comes from. This file is the only one that knows
//! the crate for that.

mod solid;

use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, Error, MeshGL64, OpType};
use nalgebra::Point3;

use super::Walls;
use super::geometry::{Geometry, MeshSource};
use super::mesh::{Mesh, Shells, Triangle};
use super::part::FreeSide;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::Part;
use solid::Solid;

/// Volumes below this share of the smaller body are rounding.
const NOTHING: f64 = 1e-9;

/// A part as a body whose triangles carry the numbers of their surfaces.
pub(super) struct Body<'a> {
    part: &'a Part,
    manifold: Manifold,
    /// By which its triangles are known after a cut.
    id: u32,
    /// Names of its surfaces.
    surfaces: Vec<String>,
    /// Whether free space is inside.
    is_hollow: bool,
    /// What the reader of a mesh file noticed.
    pub warnings: Vec<String>,
    pub file: Option<MeshSource>,
}

impl<'a> Body<'a> {
    /// # Errors
    /// A part that encloses no volume, and a mesh that cannot be read.
    pub fn of(part: &'a Part, walls: Walls) -> Result<Self, Box<Fault>> {
        let solid = Solid::of(part, walls)?;
        let coordinates = solid.mesh.vertices.iter();
        let triangles = solid.mesh.triangles.iter();
        let corners = triangles.clone().flat_map(|it| it.corners);
        let id = Manifold::reserve_ids(1);
        let manifold = Manifold::from_mesh_gl64(&MeshGL64 {
            num_prop: 3,
            vert_properties: coordinates.flat_map(|it| [it.x, it.y, it.z]).collect(),
            tri_verts: corners.map(u64::from).collect(),
            face_id: triangles.map(|it| u64::from(it.surface)).collect(),
            run_original_id: vec![id],
            ..MeshGL64::default()
        });
        if manifold.status() != Error::NoError {
            let why = "does not close: some of its triangles meet in more than pairs";
            return Err(Box::new(solid::without_volume(part, why)));
        }
        Ok(Self {
            part,
            manifold,
            id,
            surfaces: solid.mesh.surfaces,
            is_hollow: solid.is_hollow,
            warnings: solid.warnings,
            file: solid.file,
        })
    }
}

/// The geometry of a part that some of the tools are cut out of, with full names of surfaces.
///
/// # Errors
/// A part that encloses no volume or cannot be read, every tool that does not reach it, and a cut that leaves nothing.
pub(super) fn geometry(part: &Part, tools: &[Body], walls: Walls) -> Result<Geometry, Vec<Fault>> {
    let body = Body::of(part, walls).map_err(|fault| vec![*fault])?;
    let is_hollow = body.is_hollow;
    let mut found = body.manifold.clone();
    let mut taken: Vec<&Body> = Vec::new();
    let mut has_file = body.file.is_some();
    let mut faults = Vec::new();
    for (index, name) in part.cut.iter().enumerate() {
        // One that cannot be read has a fault of its own.
        let Some(tool) = tools.iter().find(|tool| tool.part.name == *name) else {
            continue;
        };
        has_file |= tool.file.is_some();
        let opened = Opened {
            body: &found,
            taken: &tool.manifold,
            is_hollow,
            // Only meshes from files may run through themselves, which takes a hundred times as long to sort out.
            engine: match has_file {
                true => BooleanEngine::Auto,
                false => BooleanEngine::Exact,
            },
        };
        match opened.cut() {
            Ok(left) => {
                found = left;
                taken.push(tool);
            }
            Err(failure) => {
                let key = format!("scene.{}.cut[{index}]", part.name);
                faults.push(failure.fault(key, part, tool.part));
            }
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let mesh = named(&found, std::iter::once(&body).chain(taken), is_hollow);
    // A hollow is no body, whatever wraps round it.
    let shells = (!is_hollow && mesh.is_closed()).then(|| Shells::of(&mesh));
    Ok(Geometry {
        mesh,
        warnings: body.warnings,
        files: Vec::from_iter(body.file),
        free: FreeSide::Front,
        shells,
        prism: None,
        by_parry: matches!(walls, Walls::Parry { .. }),
        has_full_names: true,
    })
}

/// The triangles of what is left of some bodies but for lids, with full names, body by body; fronts look into it where it is hollow.
fn named<'a>(left: &Manifold, bodies: impl Iterator<Item = &'a Body<'a>>, is_hollow: bool) -> Mesh {
    let left = left.get_mesh_gl64(-1);
    let corners = left.vert_properties.chunks_exact(left.num_prop as usize);
    let mut mesh = Mesh {
        vertices: corners.map(|it| Point3::new(it[0], it[1], it[2])).collect(),
        ..Mesh::default()
    };
    // Runs of triangles, each from one body.
    let runs = || left.run_index.windows(2).zip(&left.run_original_id);
    for body in bodies {
        let own = runs().filter(|(_, id)| **id == body.id);
        for triangle in own.flat_map(|(run, _)| run[0] / 3..run[1] / 3) {
            let triangle = triangle as usize;
            let name = &body.surfaces[left.face_id[triangle] as usize];
            if name == solid::LID {
                continue;
            }
            let corners = &left.tri_verts[3 * triangle..3 * triangle + 3];
            let [a, b, c] = [corners[0], corners[1], corners[2]].map(|corner| corner as u32);
            let surface = mesh.surface_index(&format!("{}.{name}", body.part.name));
            mesh.triangles.push(Triangle {
                corners: if is_hollow { [a, c, b] } else { [a, b, c] },
                surface,
            });
        }
    }
    mesh
}

/// A body and what is cut out of it.
struct Opened<'a> {
    body: &'a Manifold,
    taken: &'a Manifold,
    /// Whether the body is free space.
    is_hollow: bool,
    engine: BooleanEngine,
}

/// Why there is nothing to cut.
enum Failure {
    /// The two have nothing in common.
    Apart,
    /// One hollow lies in the other one.
    Within,
    /// A body lies in what is cut out of it.
    Nothing,
}

impl Opened<'_> {
    fn cut(&self) -> Result<Manifold, Failure> {
        let operation = |operation| {
            self.body
                .boolean_with_engine(self.taken, operation, self.engine)
        };
        let common = operation(OpType::Intersect).volume();
        let [body, taken] = [self.body, self.taken].map(|it| it.volume());
        let rounding = NOTHING * body.min(taken);
        if common <= rounding {
            return Err(Failure::Apart);
        }
        if self.is_hollow && taken - common <= rounding {
            return Err(Failure::Within);
        }
        if !self.is_hollow && body - common <= rounding {
            return Err(Failure::Nothing);
        }
        Ok(operation(match self.is_hollow {
            true => OpType::Add,
            false => OpType::Subtract,
        }))
    }
}

impl Failure {
    fn fault(&self, key: String, part: &Part, tool: &Part) -> Fault {
        let (part, tool) = (&part.name, &tool.name);
        let misses = |how: &str| {
            (
                FaultCode::CutMisses,
                format!("`{tool}` {how} `{part}`, and cuts nothing out of it"),
                format!("`{tool}` through the surface of `{part}`: see its `place` and its length"),
            )
        };
        let (code, message, expected) = match self {
            Self::Apart => misses("does not reach"),
            Self::Within => misses("lies in the free space of"),
            Self::Nothing => (
                FaultCode::CutLeavesNothing,
                format!("`{tool}` holds all of `{part}`, and leaves nothing of it"),
                "a part of which something is left".to_owned(),
            ),
        };
        Fault::at_key(code, key, message).expecting(expected)
    }
}

#[cfg(test)]
mod tests;
