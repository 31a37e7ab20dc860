//! One part of the scene, ready for rays and distances.

use std::path::PathBuf;

use nalgebra::Vector3;

use super::Walls;
use super::facets::{self, Facets};
use super::mesh::Mesh;
use super::mesh_file::{self, MeshWarning};
use super::prism::Prism;
use super::profile::Profile;
use super::ray::{Crossing, Ray, Spot};
use super::rays::{Hits, Rays};
use super::tessellate;
use crate::precision::Real;
use crate::printable;
use crate::problem::fault::Fault;
use crate::problem::part::{Ends, Part, Shape};

/// A part whose surfaces have their indices in the scene.
#[derive(Clone)]
pub(super) struct BuiltPart {
    /// Its triangles: for distances, for the target patch, and for rays where there is no prism.
    pub facets: Facets,
    /// What the fronts of its surfaces say about where the free space is.
    pub fronts: Fronts,
    /// Whether its frame is the nozzle's.
    pub on_nozzle: bool,
    prism: Option<Prism>,
}

/// What the fronts of a part's surfaces say about where the free space is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fronts {
    /// Free space is in front.
    Free,
    /// A closed mesh that is inside out: free space is behind.
    Solid,
    /// An open mesh, whose winding nobody had to care about, or one whose winding cannot agree. A mesh
    /// with small holes is a closed one with damage.
    Unknown,
}

impl Fronts {
    fn of(warnings: &[MeshWarning]) -> Self {
        let noticed = |is: fn(&MeshWarning) -> bool| warnings.iter().any(is);
        if noticed(|warning| matches!(warning, MeshWarning::InsideOut { .. })) {
            Self::Solid
        } else if noticed(tells_nothing_about_fronts) {
            Self::Unknown
        } else {
            Self::Free
        }
    }
}

fn tells_nothing_about_fronts(warning: &MeshWarning) -> bool {
    matches!(
        warning,
        MeshWarning::OpenEdges { small: false, .. } | MeshWarning::InconsistentWinding { .. }
    )
}

/// A mesh file as it was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshSource {
    /// Where it was read from.
    pub path: PathBuf,
    /// SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
}

/// The geometry of a part before its surfaces are numbered.
pub(super) struct Geometry {
    pub mesh: Mesh,
    /// What the reader of a mesh file noticed.
    pub warnings: Vec<String>,
    /// The file that it was read from.
    pub file: Option<MeshSource>,
    fronts: Fronts,
    prism: Option<(Profile, f64, Ends)>,
}

/// Chords that stand in for arcs where distances are measured turn by at most this angle.
const CHORD_ANGLE: f64 = std::f64::consts::PI / 180.0;

impl Geometry {
    /// The geometry of a part in its place.
    pub fn of(part: &Part, walls: Walls) -> Result<Self, Box<Fault>> {
        let mut warnings = Vec::new();
        let mut file = None;
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
            } => prismatic(Profile::circle(*diameter), *length, *ends, walls),
            Shape::Extrude {
                profile,
                length,
                ends,
            } => prismatic(Profile::outline(profile), *length, *ends, walls),
            Shape::Box { min, max } => (tessellate::block(*min, *max), None),
            Shape::Mesh {
                path,
                metres_per_unit,
                regions,
            } => {
                let read = mesh_file::read_with_checksum(path, *metres_per_unit, regions);
                let (mesh, found, sha256) = read.map_err(|fault| {
                    let key = match fault.defect.region() {
                        Some(region) => format!("scene.{}.regions.{region}", part.name),
                        None => format!("scene.{}.mesh", part.name),
                    };
                    Fault::at_key(fault.defect.rule(), key, fault.to_string())
                })?;
                warnings = found;
                file = Some(MeshSource {
                    path: path.clone(),
                    sha256,
                });
                (mesh, None)
            }
        };
        let named = |warning| {
            let text = format!("part `{}`: {warning}", part.name);
            printable::line(&text).into_owned()
        };
        Ok(Self {
            mesh: tessellate::placed(mesh, &part.place),
            fronts: Fronts::of(&warnings),
            warnings: warnings.iter().map(named).collect(),
            file,
            prism,
        })
    }

    /// Makes it ready for rays.
    pub fn build(self, part: &Part, surface_base: u32, slack: f64) -> BuiltPart {
        BuiltPart {
            facets: Facets::new(self.mesh, surface_base, slack),
            fronts: self.fronts,
            on_nozzle: part.on_nozzle,
            prism: self.prism.map(|(profile, length, ends)| {
                Prism::new(&profile, length, ends, &part.place, surface_base, slack)
            }),
        }
    }
}

type Built = (Mesh, Option<(Profile, f64, Ends)>);

fn prismatic(profile: Profile, length: f64, ends: Ends, walls: Walls) -> Built {
    match walls {
        Walls::Exact => {
            let mesh = tessellate::prism(&profile, length, ends, CHORD_ANGLE);
            (mesh, Some((profile, length, ends)))
        }
        Walls::Facets { chord_angle } => {
            let mesh = tessellate::prism(&profile, length, ends, chord_angle);
            (mesh, None)
        }
    }
}

impl BuiltPart {
    /// The first contact of a shot of some radius, or of a point where that is 0, nearer than
    /// `limit`, and the unit normal on the front there.
    #[inline]
    pub fn first_contact(
        &self,
        ray: &Ray,
        radius: f64,
        leaving: Option<Spot>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        match &self.prism {
            _ if radius <= 0.0 => self.first_crossing(ray, leaving, on_this_part, limit),
            Some(prism) => prism.first_touch(ray, radius, leaving, on_this_part, limit),
            None => self
                .facets
                .first_contact(ray, radius, leaving, on_this_part, limit),
        }
    }

    /// Whether rays meet its planes and cylinders instead of triangles.
    pub fn has_exact_walls(&self) -> bool {
        self.prism.is_some()
    }

    /// The first crossing nearer than `limit` and the unit normal on the front there.
    #[inline]
    pub fn first_crossing(
        &self,
        ray: &Ray,
        leaving: Option<Spot>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        match &self.prism {
            Some(prism) => prism.first_crossing(ray, leaving, on_this_part, limit),
            None => self
                .facets
                .first_crossing(ray, leaving, on_this_part, limit),
        }
    }

    /// Takes the first crossings that are nearer than what the rays have hit so far; `index` is
    /// that of this part. Normals are those on the fronts.
    #[inline(always)]
    pub fn cross<R: Real>(&self, index: u32, rays: &Rays<R>, hits: &mut Hits<R>) {
        match &self.prism {
            Some(prism) => prism.cross(index, rays, hits),
            None if rays.are_spheres => facets::touch(&self.facets, index, rays, hits),
            None => facets::cross(&self.facets, index, rays, hits),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;

    /// Damage that leaves a closed mesh closed does not make anybody doubt its fronts.
    #[test]
    fn only_open_and_contradictory_meshes_leave_their_fronts_in_doubt() {
        let near = Point3::origin();
        let count = 7;
        let duplicates = MeshWarning::DuplicateTriangles { count, near };
        let hole = |small: bool| MeshWarning::OpenEdges { count, near, small };
        let inside_out = MeshWarning::InsideOut {
            signed_volume: -1.0,
        };
        let contradiction = MeshWarning::InconsistentWinding { count, near };
        for (warnings, fronts) in [
            (vec![], Fronts::Free),
            (vec![duplicates.clone()], Fronts::Free),
            (vec![MeshWarning::Seams { count, near }], Fronts::Free),
            (vec![hole(true)], Fronts::Free),
            (vec![hole(true), inside_out.clone()], Fronts::Solid),
            (vec![duplicates.clone(), inside_out], Fronts::Solid),
            (vec![hole(false)], Fronts::Unknown),
            (vec![duplicates, contradiction], Fronts::Unknown),
        ] {
            assert_eq!(Fronts::of(&warnings), fronts, "{warnings:?}");
        }
    }
}
