//! `shot`, `jet`, `nozzle`, `contacts`, `surfaces` and `paths`, as written.

use serde::Deserialize;

use super::{Angle, Density, Impulse, Length, MassFlow, Percentage, Pressure, Speed, Triple};
use crate::problem::field::Field;

use super::settings::OneOrRange;

/// The shot: solid spheres.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct ShotEntry {
    /// Mean radius.
    pub radius: Field<Length>,
    /// Density.
    pub density: Field<Density>,
    /// Standard deviation of the radius, cut at two; 0 % where absent.
    pub size_spread: Field<Percentage>,
}

/// How the shots leave the nozzle.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct JetEntry {
    /// Diameter of the exit; 0 mm for a point.
    pub exit_diameter: Field<Length>,
    /// Half-angle of the cone; 0 deg for a parallel jet.
    pub divergence: Field<Angle>,
    /// How directions fill the cone; uniform where absent.
    pub spread: Field<SpreadEntry>,
    /// Standard deviation of the speed, cut at two; 0 % where absent.
    pub speed_spread: Field<Percentage>,
    /// Mass of shot per time; unknown where absent.
    pub mass_flow: Field<MassFlow>,
    /// The machine's calibration, measured with this shot and nozzle: at least two pressures, each
    /// with the mean speed of the shot at the exit, both strictly rising. With it the sheet says
    /// the pressure that belongs to the speed, linear between the two rows beside it and never
    /// beyond the first or the last one. No figure depends on it.
    pub pressure: Field<Vec<Field<CalibrationEntry>>>,
}

/// One row of the calibration.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct CalibrationEntry {
    /// The pressure that is set.
    pub pressure: Field<Pressure>,
    /// The mean speed of the shot at the exit.
    pub speed: Field<Speed>,
}

/// How directions fill the cone.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::problem) enum SpreadEntry {
    /// Uniform in solid angle.
    Uniform,
    /// Denser towards the axis.
    Gaussian,
}

/// The solid body that carries the jet.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct NozzleEntry {
    /// Its pieces; none where absent.
    pub body: Field<Vec<Field<BodyEntry>>>,
    /// Least distance from every surface; 0 mm where absent.
    pub clearance: Field<Length>,
}

/// One piece of the body: exactly one of the keys.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct BodyEntry {
    /// A ball round the exit.
    pub ball: Field<BallEntry>,
    /// A rod with round ends that starts at the exit.
    pub capsule: Field<CapsuleEntry>,
}

/// A ball round the exit.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct BallEntry {
    /// Radius.
    pub radius: Field<Length>,
}

/// A rod with round ends that starts at the exit.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct CapsuleEntry {
    /// Length.
    pub length: Field<Length>,
    /// Radius.
    pub radius: Field<Length>,
    /// Fixed direction in the scene; back along the jet axis where absent.
    pub direction: Field<Triple>,
}

/// One friction choice.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct ContactEntry {
    /// Static friction; a range is searched.
    pub mu_s: Field<OneOrRange<f64>>,
    /// Dynamic friction, at most the static one.
    pub mu_d: Field<f64>,
    /// Dynamic over static friction, instead of `mu_d`.
    pub mu_d_ratio: Field<f64>,
    /// Normal coefficient of restitution.
    pub restitution: Field<RestitutionEntry>,
    /// Tangential coefficient of restitution, -1 to 1; 0 where absent.
    pub tangential_restitution: Field<f64>,
    /// The friction law; `stick_slip` where absent.
    pub law: Field<LawEntry>,
}

/// A coefficient of restitution, constant or falling with speed.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "a number such as 0.25, or `{ value: 0.5, at: 10 m/s, exponent: 0.25 }`")]
pub(in crate::problem) enum RestitutionEntry {
    /// The same at every speed.
    #[serde(rename = "scalar")]
    Constant(f64),
    /// Falling with the normal speed.
    #[serde(rename = "map")]
    Falling(FallingEntry),
}

/// value (speed / at)^(-exponent), at most 1.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct FallingEntry {
    /// The coefficient at the speed at which it was measured.
    pub value: Field<f64>,
    /// That normal speed.
    pub at: Field<Speed>,
    /// How steeply it falls; 0.25 is the plastic limit.
    pub exponent: Field<f64>,
}

/// The friction law of a contact.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::problem) enum LawEntry {
    /// Static friction decides whether it sticks, dynamic friction acts while it slips.
    StickSlip,
    /// Dynamic friction until the slip stops.
    Kinetic,
    /// As stick-slip, for shots that cannot spin.
    Irrotational,
    /// Slip even where it would stick; only to compare with published tables.
    AlwaysSlip,
}

/// Where one surface differs from the others.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct SurfaceEntry {
    /// Normal impulse that it may take.
    pub allow: Field<Impulse>,
    /// Share of all shots that may exceed it.
    pub share: Field<Percentage>,
    /// Weight of its impacts in the objective.
    pub weight: Field<f64>,
    /// Its own contact, whatever contact is chosen.
    pub contact: Field<ContactEntry>,
    /// Standard deviation of the tilt of its normal; 0 deg where absent.
    pub roughness: Field<Angle>,
    /// What a hit on it counts as; `part` where absent.
    pub role: Field<RoleEntry>,
}

/// What a hit on a surface counts as.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
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
/// 1 - exp(-n pi d^2 / 4) for n hits per area (Avrami). The nozzle is taken to stand still, and only
/// first hits count. Times need `jet.mass_flow`. No other figure depends on it.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct CoverageEntry {
    /// Diameter d of the dent that one hit leaves, as measured on a strip.
    pub dent_diameter: Field<Length>,
    /// Share of the area that is to be dented, below 100 %; 98 % where absent.
    pub wanted: Field<Percentage>,
}

/// When a path ends.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::problem) struct PathsEntry {
    /// Most impacts, the first hit included; 6 where absent.
    pub impacts: Field<u64>,
    /// Share of its first energy below which a shot is followed no further; 1 % where absent.
    pub least_energy: Field<Percentage>,
}
