//! `scene` and `target`, as written.

use serde::Deserialize;

use super::{Angle, Length, LengthUnit, Named, Pair, Triple};
use crate::problem::field::Field;

/// One part: exactly one shape, and where it stands.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct PartEntry {
    /// A bore with a groove towards +y.
    pub keyway: Field<KeywayEntry>,
    /// A round hole or pin along z.
    pub bore: Field<BoreEntry>,
    /// An axis-parallel block.
    #[serde(rename = "box")]
    pub block: Field<BoxEntry>,
    /// A cross-section of lines and arcs, along z.
    pub extrude: Field<ExtrudeEntry>,
    /// A file of triangles (STL, OBJ, PLY), relative to the problem file.
    pub mesh: Field<String>,
    /// Unit of this mesh file where it differs from the file's `lengths_in`.
    pub lengths_in: Field<LengthUnit>,
    /// Named boxes that make surfaces of the triangles whose centre they hold.
    pub regions: Field<Named<BoxEntry>>,
    /// Where the part stands; at the origin of the scene where absent.
    pub place: Field<PlaceEntry>,
}

/// A bore with a groove of rectangular section; its axis is z.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct KeywayEntry {
    /// Diameter of the bore.
    pub bore: Field<Length>,
    /// Width of the groove.
    pub width: Field<Length>,
    /// Depth of the groove below the crown of the bore.
    pub depth: Field<Length>,
    /// Length along z.
    pub length: Field<Length>,
    /// Radius between floor and walls; 0 mm where absent.
    pub root_radius: Field<Length>,
}

/// A round hole or pin along z.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct BoreEntry {
    /// Diameter.
    pub diameter: Field<Length>,
    /// Length along z.
    pub length: Field<Length>,
    /// Which ends are closed; none where absent.
    pub ends: Field<EndsEntry>,
}

/// Two opposite corners of an axis-parallel box.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct BoxEntry {
    /// Smallest corner.
    pub min: Field<Triple>,
    /// Largest corner.
    pub max: Field<Triple>,
}

/// A cross-section along z.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct ExtrudeEntry {
    /// Length along z.
    pub length: Field<Length>,
    /// Which ends are closed; none where absent.
    pub ends: Field<EndsEntry>,
    /// Lines and arcs, each from the end of the one before; free space lies to the left.
    pub profile: Field<Vec<Field<SegmentEntry>>>,
}

/// One line or arc of a cross-section.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct SegmentEntry {
    /// Where it starts; the end of the segment before where absent.
    pub from: Field<Pair>,
    /// A straight line to this point.
    pub line_to: Field<Pair>,
    /// A circular arc to this point.
    pub arc_to: Field<Pair>,
    /// A point that the arc passes through on its way.
    pub via: Field<Pair>,
    /// Name of the surface that it becomes.
    pub surface: Field<String>,
}

/// Both ends alike, or each on its own.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "`open`, `closed`, or `{ near: .., far: .. }`")]
pub(in crate::problem) enum EndsEntry {
    /// Both ends alike.
    #[serde(rename = "scalar")]
    Both(End),
    /// Each end on its own; open where absent.
    #[serde(rename = "map")]
    Each(EachEnd),
}

/// The ends of a part along z.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct EachEnd {
    /// The end at z = 0.
    pub near: Field<End>,
    /// The end at z = length.
    pub far: Field<End>,
}

/// Whether an end carries a flat cap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::problem) enum End {
    /// No cap.
    Open,
    /// A flat cap.
    Closed,
}

/// Where a part stands.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "`nozzle`, or `{ on: .., at: .., rotate: .. }`")]
pub(in crate::problem) enum PlaceEntry {
    /// At the origin of this frame.
    #[serde(rename = "scalar")]
    AtOrigin(BaseEntry),
    /// Moved in its frame.
    #[serde(rename = "map")]
    Moved(MoveEntry),
}

/// What a part stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::problem) enum BaseEntry {
    /// The scene.
    Scene,
    /// The nozzle; the part moves with it.
    Nozzle,
}

/// How a part is moved: turned about its origin, then shifted.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct MoveEntry {
    /// In whose frame; the scene's where absent.
    pub on: Field<BaseEntry>,
    /// Position of the part's origin in that frame.
    pub at: Field<Triple>,
    /// Angles about fixed x, then y, then z.
    pub rotate: Field<[Field<Angle>; 3]>,
}

/// What is to be peened.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct TargetEntry {
    /// The surface, `part.surface`.
    pub surface: Field<String>,
    /// Only this box of it; the rest is secondary.
    pub within: Field<BoxEntry>,
    /// Where the jet axis meets it; the centre of the target where absent.
    pub aim: Field<Triple>,
    /// The direction that azimuth 0 means, laid into the target's plane.
    pub along: Field<Triple>,
    /// A direction towards the nozzle's side of the target; the surface's own where absent.
    pub facing: Field<Triple>,
}
