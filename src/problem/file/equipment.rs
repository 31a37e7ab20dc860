//! `shot`, `jet`, `nozzle`, `surfaces` and `paths`, as written.

use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::json;

use super::contact::ContactEntry;
use super::quantity::{
    BelowAll, Density, Divergence, Hardness, Impacts, Impulse, Incidence, Length, LengthOrZero,
    MassFlow, Pressure, Roughness, Share, Speed, Spread, Wanted, Weight,
};
use super::{Triple, form};
use crate::problem::field::{Field, Needed};

/// The shot: solid spheres. Either both numbers are given, or a medium of the library, such as S110 or
/// CW-14, stands in for those that are not.
///
/// ```yaml
/// shot: { radius: 0.5 mm, density: 7000 kg/m3 }
/// # or
/// shot: { use: S110, size_spread: 8 % }
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(extend("anyOf" = json!([
    { "required": ["use"] },
    { "required": ["radius", "density"] },
])))]
pub(in crate::problem) struct ShotEntry {
    /// A medium of the library, `peenpose media`; nothing from the library where absent.
    #[serde(rename = "use")]
    #[schemars(with = "Field<form::MediumName>", example = &"S110")]
    pub medium: Field<String>,
    /// Mean radius; that of `use` where absent.
    #[schemars(example = &"0.5 mm")]
    pub radius: Field<Length>,
    /// Density; that of `use` where absent.
    #[schemars(example = &"7000 kg/m3")]
    pub density: Field<Density>,
    /// Standard deviation of the radius, cut at two.
    #[schemars(example = &"5 %", extend("default" = "0 %"))]
    pub size_spread: Field<Spread>,
}

/// How the shots leave the nozzle.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct JetEntry {
    /// Diameter of the exit; 0 mm is a point.
    #[schemars(example = &"1.5 mm")]
    pub exit_diameter: Needed<LengthOrZero>,
    /// Half-angle of the cone; 0 deg is a parallel jet.
    #[schemars(example = &"4 deg")]
    pub divergence: Needed<Divergence>,
    /// How directions fill the cone: `uniform` in solid angle, or `gaussian`, with half the
    /// half-angle as the standard deviation, cut at the half-angle.
    #[schemars(example = &"gaussian", extend("default" = "uniform"))]
    pub spread: Field<SpreadEntry>,
    /// Standard deviation of the speed before it is cut at two.
    #[schemars(example = &"5 %", extend("default" = "0 %"))]
    pub speed_spread: Field<Spread>,
    /// Mass of shot per time. Changes no figure; with it the sheet says whether
    /// shots get into each other's way, see [model.md](model.md#what-the-model-leaves-out); unknown where
    /// absent.
    #[schemars(example = &"5 kg/min")]
    pub mass_flow: Field<MassFlow>,
    /// Speed of the air between exit and target; that of an air nozzle is 200 to 300
    /// m/s. Changes no figure; with it the sheet says how much faster the shot gets on its way, see
    /// [model.md](model.md#what-the-model-leaves-out); taken to be at rest where absent.
    #[schemars(example = &"250 m/s")]
    pub air_speed: Field<Speed>,
    /// The machine's calibration, measured with this shot and nozzle: at least two pressures, each
    /// with the mean speed of the shot at the exit, both strictly rising. With it the sheet says
    /// the pressure that belongs to the speed, linear between the two rows beside it and never
    /// beyond the first or the last one. No figure depends on it; unknown where absent.
    #[schemars(
        length(min = 2),
        example = json!([
            { "pressure": "2 bar", "speed": "22 m/s" },
            { "pressure": "4 bar", "speed": "36 m/s" },
        ])
    )]
    pub pressure: Field<Vec<Field<CalibrationEntry>>>,
}

/// One row of the calibration.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct CalibrationEntry {
    /// The pressure that is set.
    #[schemars(example = &"2 bar")]
    pub pressure: Needed<Pressure>,
    /// The mean speed of the shot at the exit.
    #[schemars(example = &"22 m/s")]
    pub speed: Needed<Speed>,
}

/// How directions fill the cone.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
pub(in crate::problem) enum SpreadEntry {
    /// Uniform in solid angle.
    Uniform,
    /// Denser towards the axis.
    Gaussian,
}

/// The solid body, which must stay clear of every surface. Nothing is ever shaded or hit by it, but
/// for [parts placed `on: nozzle`](#place).
///
/// ```yaml
/// nozzle:
///   body:
///     - { ball: { radius: 3 mm } }
///     - { capsule: { length: 60 mm, radius: 2 mm } }
///     - { capsule: { length: 60 mm, radius: 3 mm, direction: [0, 0, -1] } }
///   clearance: 0.5 mm
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct NozzleEntry {
    /// Its pieces; the disc of the exit grown by the radius of a shot where absent.
    pub body: Field<Vec<Field<BodyEntry>>>,
    /// Least distance to every surface, for every pose within the [tolerance](#tolerance).
    #[schemars(example = &"0.5 mm", extend("default" = "0 mm"))]
    pub clearance: Field<LengthOrZero>,
}

/// One piece of the body: exactly one of these keys.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(extend("oneOf" = form::exactly_one_of(&Self::SHAPES)))]
pub(in crate::problem) struct BodyEntry {
    /// A ball around the exit.
    pub ball: Field<BallEntry>,
    /// A rod with round ends that starts at the exit.
    pub capsule: Field<CapsuleEntry>,
}

impl BodyEntry {
    /// The keys of which one must be there.
    pub const SHAPES: [&str; 2] = ["ball", "capsule"];
}

/// A ball around the exit.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct BallEntry {
    /// Radius.
    #[schemars(example = &"3 mm")]
    pub radius: Needed<Length>,
}

/// A rod with round ends that starts at the exit.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct CapsuleEntry {
    /// Length.
    #[schemars(example = &"60 mm")]
    pub length: Needed<Length>,
    /// Radius.
    #[schemars(example = &"2 mm")]
    pub radius: Needed<Length>,
    /// A fixed direction in the scene: a lance that keeps it whatever the jet does; back along the
    /// jet where absent.
    #[schemars(example = [0, 0, -1])]
    pub direction: Field<Triple>,
}

/// Where one surface differs from the others.
///
/// ```yaml
/// surfaces:
///   hub.bore: { allow: 5 uN.s, share: 0.1 %, weight: 2 }
///   mask.z_min: { contact: { mu_s: 0.8, mu_d: 0.7, restitution: 0.4 } }
///   hole.wall: { role: deflector }
///   slot.floor: { roughness: 3 deg }
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct SurfaceEntry {
    /// Normal impulse of one impact that it may take; that of `goals.rebound` where absent.
    #[schemars(example = &"5 uN.s")]
    pub allow: Field<Impulse>,
    /// Share of all shots that may exceed it; that of `goals.rebound` where absent.
    #[schemars(example = &"0.1 %")]
    pub share: Field<Share>,
    /// Weight of its impacts in the objective; that of `goals.rebound` where absent.
    #[schemars(example = 2)]
    pub weight: Field<Weight>,
    /// Its own contact, whatever contact is chosen; the chosen one where absent.
    pub contact: Field<ContactEntry>,
    /// Standard deviation of the tilt of its normal about each direction in it.
    #[schemars(example = &"3 deg", extend("default" = "0 deg"))]
    pub roughness: Field<Roughness>,
    /// What a hit on it counts as. With `deflector` it belongs to the flight, and is neither first
    /// hit nor rebound: not for the target, and not beside `allow`, `share` or `weight`.
    #[schemars(example = &"deflector", extend("default" = "part"))]
    pub role: Field<RoleEntry>,
}

/// What a hit on a surface counts as.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
pub(in crate::problem) enum RoleEntry {
    /// First hit or rebound, as any surface.
    Part,
    /// Part of the flight.
    Deflector,
}

/// What is to be said about coverage: how densely first hits fall on the target, and how much shot
/// and time it takes until the share `wanted` of it is dented, on the mean and where hits are few.
///
/// Dents are taken to fall at random with the density of the place: coverage is then
/// 1 - exp(-n pi d^2 / 4) for n hits per area (Avrami). That of the whole target is the mean over it; where
/// nothing hits a part of it, the wanted share may never be reached. The nozzle is taken to stand still, and only
/// first hits count. Times need `jet.mass_flow`. No other figure depends on it.
///
/// ```yaml
/// coverage: { dent_diameter: 0.2 mm, wanted: 95 % }
/// # or
/// coverage: { dent_diameter: 0.2 mm, measured_at: { speed: 27 m/s, incidence: 90 deg }, wanted: 200 % }
/// # or
/// coverage: { hardness: 300 HB }
/// ```
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(extend(
    "oneOf" = form::exactly_one_of(&["dent_diameter", "hardness"]),
    "dependentRequired" = json!({ "measured_at": ["dent_diameter"] }),
))]
pub(in crate::problem) struct CoverageEntry {
    /// Diameter d of the dent that one hit leaves, as measured on a strip.
    #[schemars(example = &"0.2 mm")]
    pub dent_diameter: Field<Length>,
    /// The hit that left it: d then grows with the root of the normal speed of each hit, and with the shot; the same dent
    /// for every hit where absent.
    pub measured_at: Field<DentHitEntry>,
    /// Hardness of the target: the volume of a dent is the work that the hit loses over the dynamic
    /// hardness, taken to be 9.81 MPa for each HB; what `dent_diameter` says where absent.
    #[schemars(example = &"300 HB")]
    pub hardness: Field<Hardness>,
    /// Share of the area that is to be dented; above 100 % so many times the shot that dents 98 %: 200 % is twice that.
    #[schemars(example = &"95 %", extend("default" = "98 %"))]
    pub wanted: Field<Wanted>,
}

/// The hit that left a dent which was measured, of the shot of the problem.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct DentHitEntry {
    /// Its speed.
    #[schemars(example = &"27 m/s")]
    pub speed: Needed<Speed>,
    /// Its angle from the surface.
    #[schemars(example = &"90 deg", extend("default" = "90 deg"))]
    pub incidence: Field<Incidence>,
}

/// When a path ends.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct PathsEntry {
    /// Most impacts that are followed, the first hit included.
    #[schemars(example = 2, extend("default" = 6))]
    pub impacts: Field<Impacts>,
    /// Share of its energy at the exit below which a shot is followed no further.
    #[schemars(example = &"0.1 %", extend("default" = "1 %"))]
    pub least_energy: Field<BelowAll>,
}
