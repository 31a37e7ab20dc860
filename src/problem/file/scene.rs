//! `scene` and `target`, as written.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::json;

use super::quantity::{Length, LengthOrZero, Turn};
use super::{Named, Pair, Triple, form};
use crate::problem::LengthUnit;
use crate::problem::field::{Field, Needed};

/// One part: exactly one shape out of `keyway`, `bore`, `box`, `extrude`, `revolve` and `mesh`, and where it
/// stands.
///
/// ```yaml
/// scene:
///   hub: { keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm, root_radius: 0.2 mm } }
///   hole: { bore: { diameter: 12 mm, length: 48 mm, ends: { far: closed } }, place: { at: [40, 0, 0] } }
///   mask: { box: { min: [-20, -15, 45], max: [20, 10, 50] } }
///   slot:
///     extrude:
///       length: 40 mm
///       profile:
///         - { from: [-3, 30], line_to: [-3, 26], surface: wall_neg }
///         - { arc_to: [3, 26], via: [0, 23], surface: floor }
///         - { line_to: [3, 30], surface: wall_pos }
///     place: { at: [-40, 0, 0], rotate: [0 deg, 0 deg, 90 deg] }
///   seat:
///     revolve:
///       profile:
///         - { from: [6, 0], line_to: [6, 20], surface: guide }
///         - { line_to: [9, 23], surface: cone }
///         - { line_to: [9, 40], surface: mouth }
///   shaft: { bore: { diameter: 30 mm, length: 60 mm, free: outside }, cut: [oil_hole], place: { at: [0, 60, 0] } }
///   oil_hole: { bore: { diameter: 4 mm, length: 40 mm }, place: { at: [-20, 60, 30], rotate: [0 deg, 90 deg, 0 deg] } }
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(extend(
    "oneOf" = form::exactly_one_of(&Self::SHAPES),
    "dependentRequired" = json!({ "lengths_in": ["mesh"], "regions": ["mesh"] }),
))]
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
    /// A cross-section of lines and arcs, turned about z.
    pub revolve: Field<RevolveEntry>,
    /// A file of triangles, STL, OBJ or PLY, in the folder of the problem file or below, with `/`
    /// between names. Named groups of an OBJ or solids of an STL become surfaces; without any there
    /// is one, `all`.
    #[schemars(example = &"housing.obj")]
    pub mesh: Field<String>,
    /// Unit of this mesh file; the file's `lengths_in` where absent.
    #[schemars(example = &"in")]
    pub lengths_in: Field<LengthUnit>,
    /// Named regions, in the mesh's own coordinates: the smooth face that a point lies on (`peenpose surfaces`
    /// lists them), or the triangles whose centre lies in a box. They become the surface of that name; later regions win; none
    /// where absent.
    #[schemars(
        example = json!({ "floor": { "at": [0, 18.3, 20] } }),
        extend("propertyNames" = form::names())
    )]
    pub regions: Field<Named<RegionEntry>>,
    /// Where the part stands; at the origin of the scene, unturned, where absent.
    pub place: Field<PlaceEntry>,
    /// Parts whose insides are cut out of this one, such as holes that are drilled into it. Its surfaces end where these open them, and of
    /// their surfaces what lies in its material is left, under their own names; they stand nowhere else in the scene. Both must
    /// enclose a volume, for which open ends count as closed: a `bore` that is cut says which side of it is `free`, outlines are closed, meshes have
    /// no holes. Round walls become facets that turn by 0.5 deg, as those of `revolve` are; nothing is cut where absent.
    #[schemars(example = json!(["hole"]), extend("uniqueItems" = true, "minItems" = 1))]
    pub cut: Field<Vec<Field<String>>>,
}

impl PartEntry {
    /// The keys of which one must be there.
    pub const SHAPES: [&str; 6] = ["keyway", "bore", "box", "extrude", "revolve", "mesh"];
}

/// A bore along z from 0 to `length` with a groove of rectangular section towards
/// +y. The floor lies at y = bore/2 + depth. Surfaces: `floor`, `wall_neg` (x < 0), `wall_pos`,
/// `bore`, and with a root radius `root_neg` and `root_pos`. Both [ends](#ends) are open, without end faces.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct KeywayEntry {
    /// Diameter of the bore.
    #[schemars(example = &"30 mm")]
    pub bore: Needed<Length>,
    /// Width of the groove, below `bore`.
    #[schemars(example = &"8 mm")]
    pub width: Needed<Length>,
    /// Depth of the floor below the crown of the bore.
    #[schemars(example = &"3.3 mm")]
    pub depth: Needed<Length>,
    /// Length along z.
    #[schemars(example = &"40 mm")]
    pub length: Needed<Length>,
    /// Radius between floor and walls, at most half the width and at most the height of the
    /// straight walls.
    #[schemars(example = &"0.2 mm", extend("default" = "0 mm"))]
    pub root_radius: Field<LengthOrZero>,
}

/// A round hole along z from 0 to `length`; a pin when it is seen from outside. Surfaces: `wall`, and
/// `near` (z = 0) and `far` where its [ends](#ends) are closed.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct BoreEntry {
    /// Diameter.
    #[schemars(example = &"12 mm")]
    pub diameter: Needed<Length>,
    /// Length along z.
    #[schemars(example = &"48 mm")]
    pub length: Needed<Length>,
    /// Whether its ends are closed: both alike, or each on its own.
    #[schemars(example = json!({ "far": "closed" }), extend("default" = "open"))]
    pub ends: Field<EndsEntry>,
    /// The side of its wall that is free: `inside`, a hole, or `outside`, a pin; the one that the target, and the way to it, is on where absent.
    #[schemars(example = &"outside")]
    pub free: Field<RoundSideEntry>,
}

/// A side of a round wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
pub(in crate::problem) enum RoundSideEntry {
    /// A hole.
    Inside,
    /// A pin.
    Outside,
}

/// An axis-parallel box by two opposite corners. Surfaces, where it is a part: `x_min`, `x_max`,
/// `y_min`, `y_max`, `z_min`, `z_max`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct BoxEntry {
    /// Smallest corner.
    #[schemars(example = [-20, -15, 45])]
    pub min: Needed<Triple>,
    /// Largest corner, larger along every axis.
    #[schemars(example = [20, 10, 50])]
    pub max: Needed<Triple>,
}

/// A part of a mesh: the smooth face at a point, or what lies in a box.
///
/// A smooth face ends at edges where the normals of neighbours differ by 30 deg or more, with the surface that the file names, and, where
/// it is flat, where it goes over into a fillet. Curved faces that go over into each other without an edge are one.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(extend(
    "oneOf" = json!([{ "required": ["at"] }, { "required": ["min", "max"] }]),
    "dependentRequired" = json!({ "min": ["max"], "max": ["min"] }),
))]
pub(in crate::problem) struct RegionEntry {
    /// A point on the face, not on its edge; a box where absent.
    #[schemars(example = json!([0, 18.3, 20]))]
    pub at: Field<Triple>,
    /// Smallest corner of a box; a face where absent.
    #[schemars(example = [-5, 8, 0])]
    pub min: Field<Triple>,
    /// Largest corner of a box, larger along every axis; a face where absent.
    #[schemars(example = [5, 9, 2])]
    pub max: Field<Triple>,
}

/// A cross-section of lines and arcs, along z from 0 to `length`. Free space lies to the left of its
/// direction. Surfaces: those that its segments name, and `near` (z = 0) and `far` where its
/// [ends](#ends) are closed.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct ExtrudeEntry {
    /// Length along z.
    #[schemars(example = &"40 mm")]
    pub length: Needed<Length>,
    /// Whether its ends are closed, as for `bore`. The outline must be closed where an end is.
    #[schemars(example = &"closed", extend("default" = "open"))]
    pub ends: Field<EndsEntry>,
    /// Its lines and arcs, each from the end of the one before.
    #[schemars(extend("minItems" = 1))]
    pub profile: Needed<Vec<Field<SegmentEntry>>>,
}

/// A cross-section of lines and arcs, turned about the z axis: stepped bores, seats, grooves for rings, shafts. Its points are
/// `[distance from the axis, z]`, and free space lies to the left of its direction: an outline that runs towards +z is a hole. Surfaces:
/// those that its segments name. Its walls are facets that turn by 0.5 deg from one to the next, about the axis and along arcs:
/// they lie off the drawing by at most 1e-5 of the radius, and their normals by 0.25 deg each way.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct RevolveEntry {
    /// Its lines and arcs, each from the end of the one before; a body of its own where it is closed, or begins and ends on the
    /// axis.
    #[schemars(extend("minItems" = 1))]
    pub profile: Needed<Vec<Field<SegmentEntry>>>,
}

/// One line or arc of a cross-section.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(extend(
    "oneOf" = form::exactly_one_of(&["line_to", "arc_to"]),
    "dependentRequired" = json!({ "arc_to": ["via"], "via": ["arc_to"] }),
))]
pub(in crate::problem) struct SegmentEntry {
    /// Where it starts. Needed in the first segment; elsewhere it begins a new outline; the end of
    /// the segment before where absent.
    #[schemars(example = [-3, 30])]
    pub from: Field<Pair>,
    /// A straight line to this point; `arc_to` where absent.
    #[schemars(example = [-3, 26])]
    pub line_to: Field<Pair>,
    /// A circular arc to this point; `line_to` where absent.
    #[schemars(example = [3, 26])]
    pub arc_to: Field<Pair>,
    /// A point that the arc passes through. Needed beside `arc_to`; a line where absent.
    #[schemars(example = [0, 23])]
    pub via: Field<Pair>,
    /// Name of the surface that it becomes; several segments may share one.
    #[schemars(example = &"floor")]
    pub surface: Needed<String>,
}

/// Both ends alike, or each on its own.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename = "`open`, `closed`, or `{ near: .., far: .. }`")]
#[schemars(rename = "EndsEntry", untagged, inline)]
pub(in crate::problem) enum EndsEntry {
    /// Both ends alike.
    #[serde(rename = "scalar")]
    Both(End),
    /// Each end on its own.
    #[serde(rename = "map")]
    Each(EachEnd),
}

/// The ends of a part along z, each on its own.
///
/// A closed end carries a flat face across the cross-section that the outline encloses: the bottom of a blind hole. It looks into the
/// part. An open end has no face, neither across the hole nor round it on the metal: shots that pass it leave the part, or come in by
/// it, and only its rim stands there. Of shots of finite size those that touch the rim hit the wall that ends there; where two walls
/// meet, the one whose normal is nearer to the direction of the contact. Where the end face of the metal matters, place a `box` or a
/// `mesh` there. A `keyway` has open ends, a `bore` and an `extrude` have what `ends` says, a `box` has all six faces, and a
/// `mesh` those in its file.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct EachEnd {
    /// The end at z = 0.
    #[schemars(example = &"closed", extend("default" = "open"))]
    pub near: Field<End>,
    /// The end at z = length.
    #[schemars(example = &"closed", extend("default" = "open"))]
    pub far: Field<End>,
}

/// Whether an end carries a flat cap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
pub(in crate::problem) enum End {
    /// No cap.
    Open,
    /// A flat cap.
    Closed,
}

/// Where a part stands.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename = "`nozzle`, or `{ on: .., at: .., rotate: .. }`")]
#[schemars(rename = "PlaceEntry", untagged, inline)]
pub(in crate::problem) enum PlaceEntry {
    /// At the origin of this frame.
    #[serde(rename = "scalar")]
    AtOrigin(BaseEntry),
    /// Moved in its frame.
    #[serde(rename = "map")]
    Moved(MoveEntry),
}

/// What a part stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
pub(in crate::problem) enum BaseEntry {
    /// The scene.
    Scene,
    /// The nozzle; the part moves with it.
    Nozzle,
}

/// Turns a part about its own origin, then shifts it.
///
/// A part **`on: nozzle`** moves with the nozzle, such as a deflector pin on its lance; `at` and
/// `rotate` are in the frame of the nozzle then. That has its origin in the centre of the exit and z
/// along the jet; y lies in the target's plane, and at azimuth 0 x points away from the target the
/// flatter the jet is. `place: nozzle` puts a part there unmoved. Shots hit such parts like any
/// other, each shot where its own setup error takes the nozzle. They cannot hold the target. With no
/// error of the tolerance may they meet what stands in the scene; `nozzle.clearance` is not measured
/// from them: what of them must keep farther off is a piece of [`nozzle.body`](#nozzle), too.
///
/// ```yaml
/// scene:
///   pin:
///     bore: { diameter: 3 mm, length: 5 mm, ends: closed }
///     place: { on: nozzle, at: [0, 0, 8], rotate: [0 deg, 45 deg, 0 deg] }
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct MoveEntry {
    /// In whose frame.
    #[schemars(example = &"nozzle", extend("default" = "scene"))]
    pub on: Field<BaseEntry>,
    /// Where the part's origin goes in that frame.
    #[schemars(example = [40, 0, 0], extend("default" = [0, 0, 0]))]
    pub at: Field<Triple>,
    /// Angles about fixed x, then y, then z.
    #[schemars(
        example = ["0 deg", "0 deg", "90 deg"],
        extend("default" = ["0 deg", "0 deg", "0 deg"])
    )]
    pub rotate: Field<[Field<Turn>; 3]>,
}

/// What is to be peened.
///
/// ```yaml
/// target:
///   surface: hub.floor
///   within: { min: [-3, 18, 15], max: [3, 19, 25] }
///   aim: [0, 18.3, 20]
///   along: [0, 0, 1]
///   facing: [0, -1, 0]
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct TargetEntry {
    /// The surface, `part.surface`.
    #[schemars(example = &"hub.floor")]
    pub surface: Needed<String>,
    /// Only this box of it; the rest is secondary; all of it where absent.
    #[schemars(example = json!({ "min": [-3, 18, 15], "max": [3, 19, 25] }))]
    pub within: Field<BoxEntry>,
    /// Where the jet axis meets the target; must lie on it; its centre where absent.
    #[schemars(example = json!([0, 18.3, 20]))]
    pub aim: Field<Triple>,
    /// The direction that azimuth 0 means, laid into the target's plane; z, or x on a target that
    /// faces along z, where absent.
    #[schemars(example = [0, 0, 1])]
    pub along: Field<Triple>,
    /// Any direction towards the nozzle's side of the target: for thin sheets, the outside of a bore (a
    /// pin), and open meshes that do not tell which side is free. Parametric parts and closed meshes do:
    /// a nozzle in their material is infeasible, whatever is said here; the free side where absent.
    #[schemars(example = [0, -1, 0])]
    pub facing: Field<Triple>,
}
