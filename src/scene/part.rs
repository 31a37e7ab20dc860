//! One part of the scene, ready for rays and distances.

use nalgebra::Vector3;

use super::Walls;
use super::facets::Facets;
use super::mesh::Mesh;
use super::prism::Prism;
use super::profile::Profile;
use super::ray::{Crossing, Ray, Spot};
use super::tessellate;
use crate::problem::fault::Fault;
use crate::problem::part::{Ends, Part, Shape};

/// A part whose surfaces have their indices in the scene.
#[derive(Clone)]
pub(super) struct BuiltPart {
    /// Its triangles: for distances, for the target patch, and for rays where there is no prism.
    pub facets: Facets,
    prism: Option<Prism>,
}

/// The geometry of a part before its surfaces are numbered.
pub(super) struct Geometry {
    pub mesh: Mesh,
    prism: Option<(Profile, f64, Ends)>,
}

/// Chords that stand in for arcs where distances are measured turn by at most this angle.
pub(super) const CHORD_ANGLE: f64 = std::f64::consts::PI / 180.0;

impl Geometry {
    /// The geometry of a part in its place.
    pub fn of(part: &Part, walls: Walls) -> Result<Self, Fault> {
        let chord_angle = match walls {
            Walls::Exact => CHORD_ANGLE,
            Walls::Facets { chord_angle } => chord_angle,
        };
        let prism = Profile::of(&part.shape);
        let mesh = match (&part.shape, &prism) {
            (_, Some((profile, length, ends))) => {
                tessellate::prism(profile, *length, *ends, chord_angle)
            }
            (Shape::Box { min, max }, _) => tessellate::block(*min, *max),
            (Shape::Mesh { path, .. }, _) => {
                return Err(Fault::at_key("scene", format!("{}", path.display())));
            }
            _ => unreachable!(),
        };
        Ok(Self {
            mesh: tessellate::placed(mesh, &part.place),
            prism: prism.filter(|_| walls == Walls::Exact),
        })
    }

    /// Makes it ready for rays.
    pub fn build(&self, part: &Part, surface_base: u32, slack: f64) -> BuiltPart {
        BuiltPart {
            facets: Facets::new(&self.mesh, surface_base, slack),
            prism: self.prism.as_ref().map(|(profile, length, ends)| {
                Prism::new(profile, *length, *ends, &part.place, surface_base, slack)
            }),
        }
    }
}

impl BuiltPart {
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
}
