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
use super::mesh::{Mesh, Shells, Triangle};
use super::part::{FreeSide, Geometry};
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::Part;
use solid::Solid;

/// Volumes below this share of the smaller body are rounding.
const NOTHING: f64 = 1e-9;

/// The geometry of a part that others are cut out of, with full names of surfaces.
///
/// # Errors
/// Every part that encloses no volume or cannot be read, every one that does not reach the other, and a cut that leaves nothing.
pub(super) fn geometry(part: &Part, tools: &[&Part], walls: Walls) -> Result<Geometry, Vec<Fault>> {
    let mut labels = Labels::default();
    let ready = |labels: &mut Labels, part: &Part| {
        let solid = Solid::of(part, walls)?;
        Ok((labels.manifold(&solid, part)?, solid))
    };
    let (mut found, body) = ready(&mut labels, part).map_err(|fault: Box<Fault>| vec![*fault])?;
    let is_hollow = body.is_hollow;
    let (mut warnings, mut files) = (body.warnings, Vec::from_iter(body.file));
    let mut faults = Vec::new();
    for (index, tool) in tools.iter().enumerate() {
        let taken = match ready(&mut labels, tool) {
            Ok((taken, solid)) => {
                warnings.extend(solid.warnings);
                files.extend(solid.file);
                taken
            }
            Err(fault) => {
                faults.push(*fault);
                continue;
            }
        };
        let opened = Opened {
            body: &found,
            taken: &taken,
            is_hollow,
            // Only meshes from files may run through themselves, which takes a hundred times as long to sort out.
            engine: match files.is_empty() {
                true => BooleanEngine::Exact,
                false => BooleanEngine::Auto,
            },
        };
        match opened.cut() {
            Ok(left) => found = left,
            Err(failure) => {
                let key = format!("scene.{}.cut[{index}]", part.name);
                faults.push(failure.fault(key, part, tool));
            }
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let mesh = labels.mesh(&found, is_hollow);
    // A hollow is no body, whatever wraps round it.
    let shells = (!is_hollow && mesh.is_closed()).then(|| Shells::of(&mesh));
    Ok(Geometry {
        mesh,
        warnings,
        files,
        free: FreeSide::Front,
        shells,
        prism: None,
        by_parry: matches!(walls, Walls::Parry { .. }),
        has_full_names: true,
    })
}

/// Names of surfaces by the numbers that their triangles carry through a cut; none for lids.
#[derive(Default)]
struct Labels(Vec<Option<String>>);

impl Labels {
    /// A body whose triangles carry numbers, which from then on stand for its surfaces.
    fn manifold(&mut self, solid: &Solid, part: &Part) -> Result<Manifold, Box<Fault>> {
        let first = self.0.len() as u64;
        let names = solid.mesh.surfaces.iter();
        self.0.extend(names.map(|name| {
            let is_lid = name == solid::LID;
            (!is_lid).then(|| format!("{}.{name}", part.name))
        }));
        let coordinates = solid.mesh.vertices.iter();
        let triangles = &solid.mesh.triangles;
        let made = Manifold::from_mesh_gl64(&MeshGL64 {
            num_prop: 3,
            vert_properties: coordinates
                .flat_map(|corner| [corner.x, corner.y, corner.z])
                .collect(),
            tri_verts: triangles
                .iter()
                .flat_map(|it| it.corners.map(u64::from))
                .collect(),
            face_id: triangles
                .iter()
                .map(|it| first + u64::from(it.surface))
                .collect(),
            ..MeshGL64::default()
        });
        match made.status() {
            Error::NoError => Ok(made),
            _ => Err(Box::new(solid::without_volume(
                part,
                "does not close: some of its triangles meet in more than pairs",
            ))),
        }
    }

    /// The triangles of a body that are not lids; fronts look into it where it is hollow.
    fn mesh(&self, body: &Manifold, is_hollow: bool) -> Mesh {
        let found = body.get_mesh_gl64(-1);
        let stride = found.num_prop as usize;
        let corners = found.vert_properties.chunks_exact(stride);
        let mut mesh = Mesh {
            vertices: corners.map(|it| Point3::new(it[0], it[1], it[2])).collect(),
            ..Mesh::default()
        };
        for (corners, &label) in found.tri_verts.chunks_exact(3).zip(&found.face_id) {
            let Some(Some(name)) = self.0.get(label as usize) else {
                continue;
            };
            let [a, b, c] = [corners[0], corners[1], corners[2]].map(|corner| corner as u32);
            let surface = mesh.surface_index(name);
            mesh.triangles.push(Triangle {
                corners: if is_hollow { [a, c, b] } else { [a, b, c] },
                surface,
            });
        }
        mesh
    }
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
        let (code, message, expected) = match self {
            Self::Apart => (
                FaultCode::CutMisses,
                format!("`{tool}` does not reach `{part}`, and cuts nothing out of it"),
                format!("`{tool}` through the surface of `{part}`: see its `place` and its length"),
            ),
            Self::Within => (
                FaultCode::CutMisses,
                format!("`{tool}` lies in the free space of `{part}`, and cuts nothing out of it"),
                format!("`{tool}` through the surface of `{part}`: see its `place` and its length"),
            ),
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
