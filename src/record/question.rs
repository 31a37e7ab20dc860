//! What was asked, as far as reports need it.

use serde::{Deserialize, Serialize};

use super::library::{LibraryContactRecord, MediumRecord};
use crate::printable;
use crate::problem::equipment::Spread;
use crate::problem::setting::{Range, Setting};
use crate::problem::{LengthUnit, Problem, Source};
use crate::units::degrees;

/// The problem behind a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuestionRecord {
    /// Its title.
    pub title: String,
    /// The problem file as it was given on the command line.
    pub file: String,
    /// Radius of the shot, m.
    pub shot_radius_m: f64,
    /// Its density, kg/m3.
    pub shot_density_kg_m3: f64,
    /// Its mass, kg.
    pub shot_mass_kg: f64,
    /// Standard deviation of the radius relative to it.
    pub size_spread: f64,
    /// The medium of the library that the file names; absent where it names none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub medium: Option<MediumRecord>,
    /// The contacts that take numbers from the library.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub library_contacts: Vec<LibraryContactRecord>,
    /// Diameter of the exit, m.
    pub exit_diameter_m: f64,
    /// The unit of the file's coordinates, in which poses are printed.
    #[serde(default)]
    pub lengths_in: LengthUnit,
    /// Half-angle of the cone, deg.
    pub divergence_deg: f64,
    /// `uniform` or `gaussian`.
    pub spread: String,
    /// Standard deviation of the speed relative to it.
    pub speed_spread: f64,
    /// The rows of the calibration, rising; none where the problem has no calibration.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub calibration: Vec<CalibrationRecord>,
    /// The ranges of the settings.
    pub ranges: Vec<RangeRecord>,
    /// The goals.
    pub goals: GoalsRecord,
    /// How exactly a shop can set it.
    pub tolerance: ToleranceRecord,
    /// Impacts after which a path is followed no further.
    pub impacts: usize,
    /// Share of its first energy below which a shot is followed no further.
    pub least_energy: f64,
    /// Accuracy asked for, relative to J.
    pub accuracy: f64,
    /// Seed of all samples.
    pub seed: u64,
}

/// A row of the calibration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CalibrationRecord {
    /// Pressure, Pa.
    #[serde(rename = "pressure_Pa")]
    pub pressure: f64,
    /// Mean speed at the exit, m/s.
    pub speed_m_s: f64,
}

/// The range of a setting; deg for angles, else SI.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RangeRecord {
    /// Key of the setting, with its unit.
    pub setting: String,
    /// Lower end.
    pub min: f64,
    /// Upper end.
    pub max: f64,
}

/// The goals, N s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoalsRecord {
    /// Wanted N*.
    #[serde(rename = "normal_impulse_N_s")]
    pub normal_impulse: f64,
    /// Relative deviation from which a shot breaks that goal.
    pub normal_impulse_tolerance: f64,
    /// Limit of f*; absent when there is none.
    #[serde(rename = "tangential_impulse_N_s")]
    pub tangential_impulse: Option<f64>,
    /// What secondary surfaces may take unless they have limits of their own.
    #[serde(rename = "rebound_N_s")]
    pub rebound: Option<f64>,
}

/// Half-widths of the setup tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToleranceRecord {
    /// deg.
    pub incidence_deg: f64,
    /// deg.
    pub azimuth_deg: f64,
    /// m.
    pub standoff_m: f64,
    /// m.
    pub aim_along_m: f64,
    /// m.
    pub aim_across_m: f64,
    /// m.
    #[serde(default)]
    pub aim_above_m: f64,
    /// Relative.
    pub speed: f64,
    /// Absolute.
    pub restitution: f64,
    /// Relative.
    pub friction: f64,
}

impl ToleranceRecord {
    /// Half-width of a setting in the unit of its key; of the speed and of friction relative to them.
    pub const fn half_width(&self, setting: Setting) -> f64 {
        match setting {
            Setting::Incidence => self.incidence_deg,
            Setting::Azimuth => self.azimuth_deg,
            Setting::Standoff => self.standoff_m,
            Setting::Speed => self.speed,
            Setting::AimAlong => self.aim_along_m,
            Setting::AimAcross => self.aim_across_m,
            Setting::AimAbove => self.aim_above_m,
            Setting::StaticFriction => self.friction,
        }
    }
}

impl QuestionRecord {
    /// The record of a problem.
    pub fn new(problem: &Problem, source: &Source) -> Self {
        let (goals, tolerance) = (&problem.goals, &problem.tolerance);
        Self {
            title: problem.title.clone(),
            file: printable::line(&source.path.display().to_string()).into_owned(),
            shot_radius_m: problem.shot.radius,
            shot_density_kg_m3: problem.shot.density,
            shot_mass_kg: problem.shot.mass(),
            size_spread: problem.shot.size_spread,
            medium: MediumRecord::of(&problem.shot),
            library_contacts: LibraryContactRecord::all(problem),
            exit_diameter_m: problem.jet.exit_diameter,
            lengths_in: problem.target.lengths_in,
            divergence_deg: degrees(problem.jet.divergence),
            spread: match problem.jet.spread {
                Spread::Uniform => "uniform".into(),
                Spread::Gaussian => "gaussian".into(),
            },
            speed_spread: problem.jet.speed_spread,
            calibration: calibration(problem),
            ranges: ranges(problem),
            goals: GoalsRecord {
                normal_impulse: goals.normal_impulse.target,
                normal_impulse_tolerance: goals.normal_impulse.tolerance,
                tangential_impulse: goals.tangential_impulse.map(|goal| goal.limit),
                rebound: goals.rebound.map(|goal| goal.allow),
            },
            tolerance: ToleranceRecord {
                incidence_deg: degrees(tolerance.incidence),
                azimuth_deg: degrees(tolerance.azimuth),
                standoff_m: tolerance.standoff,
                aim_along_m: tolerance.aim_along,
                aim_across_m: tolerance.aim_across,
                aim_above_m: tolerance.aim_above,
                speed: tolerance.speed,
                restitution: tolerance.restitution,
                friction: tolerance.friction,
            },
            impacts: problem.paths.impacts,
            least_energy: problem.paths.least_energy,
            accuracy: problem.accuracy,
            seed: problem.seed,
        }
    }
}

fn calibration(problem: &Problem) -> Vec<CalibrationRecord> {
    let known = problem.calibration.iter();
    let rows = known.flat_map(|calibration| &calibration.rows);
    rows.map(|&(pressure, speed_m_s)| CalibrationRecord {
        pressure,
        speed_m_s,
    })
    .collect()
}

fn ranges(problem: &Problem) -> Vec<RangeRecord> {
    let range = |setting: Setting| {
        let Range { min, max } = problem.ranges.range(setting)?;
        Some(RangeRecord {
            setting: setting.record_key().into(),
            min: setting.to_record(min),
            max: setting.to_record(max),
        })
    };
    Setting::OF_THE_NOZZLE
        .into_iter()
        .filter_map(range)
        .collect()
}
