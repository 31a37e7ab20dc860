//! A part as a closed body.

use nalgebra::Point2;

use super::super::geometry::LoadedMesh;
use super::super::mesh::Mesh;
use super::super::profile::Profile;
use super::super::{MeshSource, Walls, tessellate};
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::{Ends, Part, RoundSide, Segment, Shape};

/// A part as a closed body in its place; its fronts look outwards.
pub(super) struct Solid {
    pub mesh: Mesh,
    /// Whether free space is inside.
    pub is_hollow: bool,
    /// What the reader of a mesh file noticed.
    pub warnings: Vec<String>,
    pub file: Option<MeshSource>,
}

/// The surface of what closes an open end: it is gone after the cut.
pub(super) const LID: &str = "";

/// The fault of a part that encloses no volume.
pub(super) fn without_volume(part: &Part, why: &str) -> Fault {
    let message = format!(
        "`{}` {why}, and encloses no volume that can be cut",
        part.name
    );
    Fault::at_key(FaultCode::CutWithoutVolume, format!("scene.{}", part.name), message)
        .expecting("a part that is closed but for its ends along z: one outline that ends where it begins, or a mesh without holes")
}

impl Solid {
    /// # Errors
    /// A part that encloses no volume, and a mesh that cannot be read.
    pub fn of(part: &Part, walls: Walls) -> Result<Self, Box<Fault>> {
        let chord_angle = walls.facet_angle();
        let along_z = |profile: &Profile, length: f64, ends: Ends| {
            let names = [(ends.near_closed, "near"), (ends.far_closed, "far")];
            let caps = names.map(|(is_closed, name)| Some(if is_closed { name } else { LID }));
            tessellate::capped(profile, length, caps, chord_angle)
        };
        let refused = |why: &str| Box::new(without_volume(part, why));
        let (mut warnings, mut file) = (Vec::new(), None);
        let mut is_hollow = None;
        let mesh = match &part.shape {
            Shape::Keyway(keyway) => {
                along_z(&Profile::keyway(keyway), keyway.length, Ends::default())
            }
            Shape::Bore {
                diameter,
                length,
                ends,
                free,
            } => {
                is_hollow = free.map(|side| side == RoundSide::Inside);
                along_z(&Profile::circle(*diameter), *length, *ends)
            }
            Shape::Extrude {
                profile,
                length,
                ends,
            } => {
                if !is_one_loop(profile) {
                    return Err(refused("has an outline that is open, or more than one"));
                }
                along_z(&Profile::outline(profile), *length, *ends)
            }
            Shape::Revolve { profile } => {
                let closed = match is_one_loop(profile) {
                    true => profile.clone(),
                    false => {
                        with_lids(profile).ok_or_else(|| refused("has more than one outline"))?
                    }
                };
                tessellate::revolved(&Profile::outline(&closed), chord_angle)
            }
            Shape::Box { min, max } => tessellate::block(*min, *max),
            Shape::Mesh {
                file: source,
                metres_per_unit,
                regions,
            } => {
                let LoadedMesh {
                    mesh,
                    shells,
                    warnings: noticed,
                    file: read,
                } = LoadedMesh::of(&part.name, source, *metres_per_unit, regions)?;
                warnings = noticed;
                file = Some(read);
                if shells.list.iter().any(|shell| !shell.is_solid) {
                    return Err(refused("is a mesh with holes"));
                }
                mesh
            }
        };
        let topology = mesh.topology();
        if !topology.is_closed() || !topology.is_consistently_wound() {
            return Err(refused("does not close"));
        }
        let looks_inwards = topology.signed_volume < 0.0;
        let mut mesh = tessellate::placed(mesh, &part.place);
        if looks_inwards {
            mesh.triangles
                .iter_mut()
                .for_each(|it| it.corners.swap(1, 2));
        }
        Ok(Self {
            mesh,
            is_hollow: is_hollow.unwrap_or(looks_inwards),
            warnings,
            file,
        })
    }
}

/// Whether an outline ends where it begins, without a second one.
fn is_one_loop(profile: &[Segment]) -> bool {
    is_one_line(profile) && {
        let ends = profile.first().zip(profile.last());
        ends.is_some_and(|(first, last)| last.leads_to(first))
    }
}

fn is_one_line(profile: &[Segment]) -> bool {
    let mut pairs = profile.windows(2);
    pairs.all(|pair| pair[0].leads_to(&pair[1]))
}

/// An outline about an axis with discs across its two ends.
fn with_lids(profile: &[Segment]) -> Option<Vec<Segment>> {
    let (first, last) = (profile.first()?.from, profile.last()?.to);
    let disc = |from: Point2<f64>, to: Point2<f64>| Segment {
        from,
        to,
        via: None,
        surface: LID.to_owned(),
    };
    let on_axis = |at: Point2<f64>| Point2::new(0.0, at.y);
    let discs = [disc(on_axis(first), first), disc(last, on_axis(last))];
    let [before, after] = discs.map(|it| (!it.leads_to(&it)).then_some(it));
    let all = before
        .into_iter()
        .chain(profile.iter().cloned())
        .chain(after);
    is_one_line(profile).then(|| all.collect())
}
