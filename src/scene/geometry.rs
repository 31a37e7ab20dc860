//! The geometry of one part: triangles and, where rays meet exact walls, a cross-section.

use std::path::PathBuf;

use super::mesh::{Mesh, Shells};
use super::part::FreeSide;
use super::profile::Profile;
use super::{Walls, mesh_file, tessellate};
use crate::printable;
use crate::problem::fault::Fault;
use crate::problem::part::{Ends, MeshFile, Part, Region, RoundSide, Shape};

/// A mesh file as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSource {
    /// Where it was read from.
    pub path: PathBuf,
    /// SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
    /// How far its triangles may be from the surface that they approximate, m, where the file says so.
    pub deflection: Option<f64>,
}

/// The geometry of a part before its surfaces are numbered.
pub(super) struct Geometry {
    /// Its triangles in their place.
    pub mesh: Mesh,
    /// What the reader of a mesh file noticed.
    pub warnings: Vec<String>,
    /// The files that it was read from.
    pub files: Vec<MeshSource>,
    pub free: FreeSide,
    pub shells: Option<Shells>,
    pub prism: Option<(Profile, f64, Ends)>,
    /// Whether parry casts the rays.
    pub by_parry: bool,
    /// Whether its surfaces have the names of their parts before their own.
    pub has_full_names: bool,
}

/// A mesh from a file, where the file has it.
pub(super) struct LoadedMesh {
    pub mesh: Mesh,
    pub shells: Shells,
    pub warnings: Vec<String>,
    pub file: MeshSource,
}

impl LoadedMesh {
    /// The mesh of the part `name`.
    ///
    /// # Errors
    /// What is wrong with the file, or with a region of it.
    pub fn of(
        name: &str,
        file: &MeshFile,
        metres_per_unit: f64,
        regions: &[Region],
    ) -> Result<Self, Box<Fault>> {
        let loaded = mesh_file::load(file, metres_per_unit, regions).map_err(|fault| {
            let key = match fault.defect.region() {
                Some(region) => format!("scene.{name}.regions.{region}"),
                None => format!("scene.{name}.mesh"),
            };
            Fault::at_key(fault.defect.rule(), key, fault.to_string())
        })?;
        let named = |warning| {
            let text = format!("part `{name}`: {warning}");
            printable::line(&text).into_owned()
        };
        Ok(Self {
            mesh: loaded.mesh,
            shells: loaded.shells,
            warnings: loaded.warnings.iter().map(named).collect(),
            file: MeshSource {
                path: file.path.clone(),
                sha256: loaded.sha256,
                deflection: loaded.deflection,
            },
        })
    }
}

/// Facets of revolved and of cut parts turn by this angle: shots meet them, as these walls have no exact form.
const REVOLVED_CHORD_ANGLE: f64 = std::f64::consts::PI / 360.0;

/// Chords that stand in for arcs where distances are measured turn by at most this angle.
const CHORD_ANGLE: f64 = std::f64::consts::PI / 180.0;

impl Walls {
    /// By how much facets turn where shots meet them instead of exact walls, rad.
    pub(super) fn facet_angle(self) -> f64 {
        match self {
            Self::Exact => REVOLVED_CHORD_ANGLE,
            Self::TriangleMesh { chord_angle } | Self::Parry { chord_angle } => chord_angle,
        }
    }
}

impl Geometry {
    /// The geometry of a part in its place.
    pub fn of(part: &Part, walls: Walls) -> Result<Self, Box<Fault>> {
        let mut warnings = Vec::new();
        let mut files = Vec::new();
        let mut shells = None;
        let free = match &part.shape {
            Shape::Bore { free, .. } => match free {
                None => FreeSide::Round,
                Some(RoundSide::Inside) => FreeSide::Front,
                Some(RoundSide::Outside) => FreeSide::Back,
            },
            _ => FreeSide::Front,
        };
        let (mesh, prism) = match &part.shape {
            Shape::Keyway(keyway) => prismatic(
                Profile::keyway(keyway),
                keyway.length,
                Ends::default(),
                walls,
            ),
            Shape::Bore {
                diameter,
                length,
                ends,
                ..
            } => prismatic(Profile::circle(*diameter), *length, *ends, walls),
            Shape::Extrude {
                profile,
                length,
                ends,
            } => prismatic(Profile::outline(profile), *length, *ends, walls),
            Shape::Revolve { profile } => {
                let mesh = tessellate::revolved(&Profile::outline(profile), walls.facet_angle());
                // A body of its own tells what is inside it.
                shells = mesh.is_closed().then(|| Shells::of(&mesh));
                (mesh, None)
            }
            Shape::Box { min, max } => (tessellate::block(*min, *max), None),
            Shape::Mesh {
                file,
                metres_per_unit,
                regions,
            } => {
                let loaded = LoadedMesh::of(&part.name, file, *metres_per_unit, regions)?;
                warnings = loaded.warnings;
                shells = Some(loaded.shells);
                files.push(loaded.file);
                (loaded.mesh, None)
            }
        };
        let is_open = |shells: &Shells| shells.list.iter().all(|shell| !shell.is_solid);
        let free = if shells.as_ref().is_some_and(is_open) {
            FreeSide::Either
        } else {
            free
        };
        Ok(Self {
            mesh: tessellate::placed(mesh, &part.place),
            free,
            shells,
            warnings,
            files,
            prism,
            by_parry: matches!(walls, Walls::Parry { .. }),
            has_full_names: false,
        })
    }
}

type Built = (Mesh, Option<(Profile, f64, Ends)>);

fn prismatic(profile: Profile, length: f64, ends: Ends, walls: Walls) -> Built {
    let is_exact = walls == Walls::Exact;
    let chord_angle = match is_exact {
        true => CHORD_ANGLE,
        false => walls.facet_angle(),
    };
    let mesh = tessellate::prism(&profile, length, ends, chord_angle);
    (mesh, is_exact.then_some((profile, length, ends)))
}
