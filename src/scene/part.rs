//! One part of the scene, ready for rays and distances.

use std::sync::OnceLock;

use nalgebra::{Point3, Vector3};

use super::carried::Pieces;
use super::geometry::Geometry;
use super::lanes::LANES;
use super::mesh::{Shell, Shells};
use super::parry_rays::ParryMesh;
use super::prism::Prism;
use super::ray::{Crossing, HitId, Ray};
use super::rays::{Hits, Rays};
use super::triangle_mesh::{self, TriangleMesh};
use super::winding::Winding;
use crate::problem::part::{Part, Place, Shape};

/// A part whose surfaces have their indices in the scene.
#[derive(Clone)]
pub(super) struct BuiltPart {
    /// Its triangles: for distances, for the target patch, and for rays where there is no prism.
    pub facets: TriangleMesh,
    /// Which side of its surfaces is free.
    pub free: FreeSide,
    /// Its shells, where it is a mesh from a file, or a body of facets.
    shells: Option<Shells>,
    /// The triangles of shells that wrap round a volume; made when first asked for.
    solid: OnceLock<Option<Winding>>,
    /// A point in front of the target, m, and whether its material holds that, once the target is known.
    anchor: Option<(Point3<f64>, bool)>,
    /// Whether its frame is the nozzle's.
    pub on_nozzle: bool,
    /// The convex pieces that cover it; made when first asked for.
    pieces: OnceLock<Pieces>,
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

impl BuiltPart {
    /// Makes a geometry ready for rays; `surface_base` is what is added to the surfaces of its triangles.
    pub fn new(geometry: Geometry, part: &Part, surface_base: u32, slack: f64) -> Self {
        let facets = TriangleMesh::new(geometry.mesh, surface_base, slack);
        // A part without a triangle is refused before.
        let parry = geometry
            .by_parry
            .then(|| ParryMesh::new(&facets).ok())
            .flatten();
        Self {
            facets,
            parry,
            free: geometry.free,
            shells: geometry.shells,
            solid: OnceLock::new(),
            anchor: None,
            on_nozzle: part.on_nozzle,
            pieces: OnceLock::new(),
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
            prism: geometry.prism.map(|(profile, length, ends)| {
                Prism::new(&profile, length, ends, &part.place, surface_base, slack)
            }),
        }
    }

    /// The convex pieces that cover it, in its own frame.
    pub fn pieces(&self) -> &Pieces {
        self.pieces.get_or_init(|| Pieces::of(&self.facets))
    }

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

    /// Of each ray whether it comes to the box round the part before it meets what it has hit so far.
    #[inline(always)]
    pub fn reached(&self, rays: &Rays, hits: &Hits) -> [bool; LANES] {
        // Cylinders stand out over their chords.
        let bulge = if self.prism.is_some() { BULGE } else { 0.0 };
        self.facets.reached(bulge, rays, hits)
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

/// Chords turn by a degree at most: by less than this share of their length arcs stand out over them.
const BULGE: f64 = 0.01;
