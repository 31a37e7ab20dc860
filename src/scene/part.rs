//! One part of the scene, ready for rays and distances.

use std::path::PathBuf;
use std::sync::OnceLock;

use nalgebra::{Point3, Vector3};

use super::Walls;
use super::mesh::{Mesh, Shell, Shells};
use super::mesh_file;
use super::parry_rays::ParryMesh;
use super::prism::Prism;
use super::profile::Profile;
use super::ray::{Crossing, HitId, Ray};
use super::rays::{Hits, Rays};
use super::tessellate;
use super::triangle_mesh::{self, TriangleMesh};
use super::winding::Winding;
use crate::printable;
use crate::problem::fault::Fault;
use crate::problem::part::{Ends, Part, Place, RoundSide, Shape};

/// A part whose surfaces have their indices in the scene.
#[derive(Clone)]
pub(super) struct BuiltPart {
    /// Its triangles: for distances, for the target patch, and for rays where there is no prism.
    pub facets: TriangleMesh,
    /// Which side of its surfaces is free.
    pub free: FreeSide,
    /// Its shells, where it is a mesh from a file.
    shells: Option<Shells>,
    /// The triangles of shells that wrap round a volume; made when first asked for.
    solid: OnceLock<Option<Winding>>,
    /// A point in front of the target, m, and whether its material holds that, once the target is known.
    anchor: Option<(Point3<f64>, bool)>,
    /// Whether its frame is the nozzle's.
    pub on_nozzle: bool,
    prism: Option<Prism>,
    /// What parry casts rays at, where it is to.
    parry: Option<ParryMesh>,
    /// Whether it is a block, all of whose sides belong to one volume.
    is_block: bool,
    /// The cylinder of a bore.
    round: Option<Round>,
}

/// A cylinder along z from 0 to a length, in its place.
#[derive(Clone, Copy, Debug)]
struct Round {
    place: Place,
    radius: f64,
    length: f64,
}

/// Which side of a part's surfaces is free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FreeSide {
    /// The one in front: outside of a solid, inside of a bore.
    Front,
    /// The one behind: a target that faces there says so, or a bore that is a pin.
    Back,
    /// A bore that may as well be a pin: the target decides.
    Round,
    /// Either: a thin wall, or an open mesh whose winding tells nothing.
    Either,
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
    /// The mesh of a part that is one.
    ///
    /// # Errors
    /// What is wrong with the file, or with a region of it.
    pub fn of(part: &Part) -> Result<Self, Box<Fault>> {
        let Shape::Mesh {
            file,
            metres_per_unit,
            regions,
        } = &part.shape
        else {
            unreachable!("asked of meshes alone");
        };
        let loaded = mesh_file::load(file, *metres_per_unit, regions).map_err(|fault| {
            let key = match fault.defect.region() {
                Some(region) => format!("scene.{}.regions.{region}", part.name),
                None => format!("scene.{}.mesh", part.name),
            };
            Fault::at_key(fault.defect.rule(), key, fault.to_string())
        })?;
        let named = |warning| {
            let text = format!("part `{}`: {warning}", part.name);
            printable::line(&text).into_owned()
        };
        Ok(Self {
            mesh: loaded.mesh,
            shells: loaded.shells,
            warnings: loaded.warnings.iter().map(named).collect(),
            file: MeshSource {
                path: file.path.clone(),
                sha256: loaded.sha256,
            },
        })
    }
}

/// Facets of revolved and of cut parts turn by this angle: shots meet them, as these walls have no exact form.
pub(super) const REVOLVED_CHORD_ANGLE: f64 = std::f64::consts::PI / 360.0;

/// Chords that stand in for arcs where distances are measured turn by at most this angle.
const CHORD_ANGLE: f64 = std::f64::consts::PI / 180.0;

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
                let chord_angle = match walls {
                    Walls::Exact => REVOLVED_CHORD_ANGLE,
                    Walls::TriangleMesh { chord_angle } | Walls::Parry { chord_angle } => {
                        chord_angle
                    }
                };
                let mesh = tessellate::revolved(&Profile::outline(profile), chord_angle);
                // A body of its own tells what is inside it.
                shells = mesh.is_closed().then(|| Shells::of(&mesh));
                (mesh, None)
            }
            Shape::Box { min, max } => (tessellate::block(*min, *max), None),
            Shape::Mesh { .. } => {
                let loaded = LoadedMesh::of(part)?;
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

    /// Makes it ready for rays.
    pub fn build(self, part: &Part, surface_base: u32, slack: f64) -> BuiltPart {
        let facets = TriangleMesh::new(self.mesh, surface_base, slack);
        // A part without a triangle is refused before.
        let parry = self
            .by_parry
            .then(|| ParryMesh::new(&facets).ok())
            .flatten();
        BuiltPart {
            facets,
            parry,
            free: self.free,
            shells: self.shells,
            solid: OnceLock::new(),
            anchor: None,
            on_nozzle: part.on_nozzle,
            is_block: matches!(part.shape, Shape::Box { .. }) && part.cut.is_empty(),
            round: match part.shape {
                Shape::Bore {
                    diameter, length, ..
                } => Some(Round {
                    place: part.place,
                    radius: diameter / 2.0,
                    length,
                }),
                _ => None,
            },
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
        Walls::TriangleMesh { chord_angle } | Walls::Parry { chord_angle } => {
            let mesh = tessellate::prism(&profile, length, ends, chord_angle);
            (mesh, None)
        }
    }
}

impl BuiltPart {
    /// Whether a point is inside its material, where its shape tells: a block, or the solid bodies of a
    /// mesh. A cavity is what a target inside makes of them.
    pub fn holds(&self, point: &Point3<f64>) -> bool {
        let corners = |index: u32| self.facets.corners(index);
        let solid = self.solid.get_or_init(|| {
            let all = 0..self.facets.count() as u32;
            let wraps = |&index: &u32| match &self.shells {
                Some(shells) => shells.list[shells.of[index as usize] as usize].is_solid,
                None => self.prism.is_none() && self.is_block,
            };
            let solid: Vec<u32> = all.filter(wraps).collect();
            (!solid.is_empty()).then(|| Winding::new(&solid, corners))
        });
        let Some(solid) = solid else {
            return false;
        };
        let is_inside = solid.number(point, corners) > 0.5;
        is_inside != (self.free == FreeSide::Back)
    }

    /// Keeps whether its material holds a point in front of the target.
    pub fn settle_anchor(&mut self, anchor: &Point3<f64>) {
        self.anchor = Some((*anchor, self.holds(anchor)));
    }

    /// The same as [`holds`](Self::holds), which is asked only where a wall is between the point and the target:
    /// on a way that crosses none, nothing changes, and a ray takes a thousandth of the time.
    pub fn holds_on_its_way(&self, point: &Point3<f64>) -> bool {
        if let Some((anchor, held)) = self.anchor
            && self.shells.is_some()
        {
            let way = anchor - point;
            let length = way.norm();
            let ray = Ray {
                origin: *point,
                direction: way / length,
            };
            if length > 0.0 && self.first_crossing(&ray, None, false, length).is_none() {
                return held;
            }
        }
        self.holds(point)
    }

    /// Whether it is a wall of unknown thickness: it holds no point, but bounds free space on one side.
    pub fn is_skin(&self) -> bool {
        let is_open = |shells: &Shells| shells.list.iter().all(|shell| !shell.is_solid);
        self.shells.as_ref().map_or(!self.is_block, is_open)
    }

    /// Which side of a bore is free if a point is: a hole round it, a pin beside it.
    pub fn side_of_axis(&self, point: &Point3<f64>) -> FreeSide {
        let Some(round) = self.round else {
            return FreeSide::Front;
        };
        let there = round.place.rotation.inverse() * (point - round.place.shift);
        let is_beside = (0.0..=round.length).contains(&there.z);
        match (is_beside, there.coords.xy().norm() < round.radius) {
            (true, true) => FreeSide::Front,
            (true, false) => FreeSide::Back,
            (false, _) => FreeSide::Either,
        }
    }

    /// The shell that a triangle of a mesh from a file belongs to.
    pub fn shell(&self, triangle: u32) -> Option<&Shell> {
        let shells = self.shells.as_ref()?;
        shells.list.get(shells.of[triangle as usize] as usize)
    }

    /// Winding numbers of the shell of a triangle at some points.
    pub fn winding_of_shell(&self, triangle: u32, at: [&Point3<f64>; 2]) -> [f64; 2] {
        let corners = |index: u32| self.facets.corners(index);
        let all = 0..self.facets.count() as u32;
        let own: Vec<u32> = match &self.shells {
            Some(shells) => all
                .filter(|&index| shells.of[index as usize] == shells.of[triangle as usize])
                .collect(),
            None => all.collect(),
        };
        let tree = Winding::new(&own, corners);
        at.map(|point| tree.number(point, corners))
    }

    /// The first contact of a shot of some radius, or of a point where that is 0, nearer than
    /// `limit`, and the unit normal on the front there.
    #[inline]
    pub fn first_contact(
        &self,
        ray: &Ray,
        radius: f64,
        leaving: Option<HitId>,
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

    /// Whether parry casts its rays.
    pub fn has_parry_rays(&self) -> bool {
        self.parry.is_some()
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
        leaving: Option<HitId>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        match (&self.prism, &self.parry) {
            (Some(prism), _) => prism.first_crossing(ray, leaving, on_this_part, limit),
            (None, Some(parry)) => parry.first_crossing(&self.facets, ray, limit),
            (None, None) => self
                .facets
                .first_crossing(ray, leaving, on_this_part, limit),
        }
    }

    /// Takes the first crossings that are nearer than what the rays have hit so far; `index` is
    /// that of this part. Normals are those on the fronts.
    #[inline(always)]
    pub fn cross(&self, index: u32, rays: &Rays, hits: &mut Hits) {
        match (&self.prism, &self.parry) {
            (Some(prism), _) => prism.cross(index, rays, hits),
            (None, Some(parry)) if !rays.are_spheres => {
                parry.cross(&self.facets, index, rays, hits);
            }
            (None, _) if rays.are_spheres => {
                triangle_mesh::touch(&self.facets, index, rays, hits);
            }
            (None, _) => triangle_mesh::cross(&self.facets, index, rays, hits),
        }
    }
}
