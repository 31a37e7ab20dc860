//! One answer in a record: settings, pose, objective, what every surface receives, verdicts.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::receipt::{ReceiptRecord, TargetRecord, receipts};
use super::room::radius_left;
use crate::evaluate::Evaluation;
use crate::feasibility::{Gap, gap, gap_within_tolerance};
use crate::impact::{Contact, Restitution};
use crate::jet::Pose;
use crate::problem::setting::{Setting, Settings, for_each_setting};
use crate::scenario::Scenario;
use crate::solve::Answer;
use crate::verdict::{Subject, Verdict};

/// Settings for one contact and what they do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnswerRecord {
    /// Name of the contact.
    pub contact: String,
    /// Its coefficients.
    pub contact_values: ContactRecord,
    /// The settings.
    pub settings: SettingsRecord,
    /// The pressure that gives this speed, Pa; absent where the problem has no calibration, or one
    /// that does not reach so far.
    #[serde(
        rename = "pressure_Pa",
        default,
        skip_serializing_if = "Option::is_none"
    )]
    pub pressure: Option<f64>,
    /// The pose that they mean.
    pub pose: PoseRecord,
    /// Whether the nozzle fits.
    pub feasible: bool,
    /// Whether every verdict passes.
    pub passes: bool,
    /// The largest share of shots that break a goal or a limit, over what is allowed: at most 1 where it passes.
    /// Where nothing is allowed, 1 more than the shots that do. Absent in results of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub violation: Option<f64>,
    /// The least J of this contact, where the settings that have it fail and these pass, or fail by less.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_objective: Option<f64>,
    /// Why the nozzle cannot be there; absent where it can.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub infeasible_because: Option<String>,
    /// Distance between nozzle and part as it is set, m; of a nozzle without a body that of its exit, grown
    /// by the radius of a shot.
    pub clearance_m: Option<f64>,
    /// The surface that it is measured to.
    pub clearance_surface: Option<String>,
    /// The least distance within the setup tolerance, m; absent without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clearance_within_tolerance_m: Option<f64>,
    /// The surface that it is measured to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clearance_within_tolerance_surface: Option<String>,
    /// Least distance asked for, m.
    pub clearance_wanted_m: f64,
    /// What would be left of the radius of the body, m, once it is made small enough to fit there:
    /// the least of its pieces; below 0 where not even a line would fit. Absent where the nozzle
    /// fits, and in results of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body_radius_left_m: Option<f64>,
    /// Validation shots behind the figures.
    pub shots: usize,
    /// Boundary samples, which the objective counts as well.
    #[serde(default)]
    pub rim_shots: usize,
    /// The terms of the objective with their weights; absent when the nozzle does not fit.
    pub objective: Option<ObjectiveRecord>,
    /// What the target receives.
    pub target: Option<TargetRecord>,
    /// What each secondary surface receives.
    pub surfaces: BTreeMap<String, ReceiptRecord>,
    /// One verdict for each goal and each secondary surface, then `clearance` and `free_space`.
    pub verdicts: Vec<VerdictRecord>,
}

/// Coefficients of a contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactRecord {
    /// Friction law.
    pub law: String,
    /// Static friction.
    pub mu_s: f64,
    /// Dynamic friction.
    pub mu_d: f64,
    /// Normal restitution, where it was measured if it falls with speed.
    pub restitution: f64,
    /// The normal speed at which it was measured, m/s; absent for a constant.
    pub restitution_at_m_s: Option<f64>,
    /// How steeply it falls; absent for a constant.
    pub restitution_exponent: Option<f64>,
    /// Tangential restitution.
    pub tangential_restitution: f64,
}

macro_rules! settings_record {
    ($($variant:ident $field:ident $key:ident $dimension:ident [$($serde:meta)?] $doc:literal,)+) => {
        /// Settings; angles in deg, else SI.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        pub struct SettingsRecord {
            $(#[doc = $doc] $(#[$serde])? pub $key: f64,)+
        }

        impl SettingsRecord {
            pub(crate) fn new(settings: &Settings) -> Self {
                Self { $($key: Setting::$variant.to_record(settings.$field),)+ }
            }

            /// The value of a setting; `None` for friction, which belongs to the contact.
            pub const fn get(&self, setting: Setting) -> Option<f64> {
                match setting {
                    $(Setting::$variant => Some(self.$key),)+
                    Setting::StaticFriction => None,
                }
            }

            /// The settings, with the first contact.
            pub fn settings(&self) -> Settings {
                Settings { $($field: Setting::$variant.from_record(self.$key),)+ ..Settings::ZERO }
            }
        }
    };
}
for_each_setting!(settings_record);

/// A pose of the nozzle in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PoseRecord {
    /// Centre of the exit, m.
    pub exit_m: [f64; 3],
    /// Unit vector along the jet.
    pub direction: [f64; 3],
    /// Rotation that takes the z axis to the jet's direction.
    pub quaternion_xyzw: [f64; 4],
    /// The same with the exit as the origin, row by row: takes points of the nozzle's frame, m, to
    /// the scene's; absent in results of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub matrix_4x4: Option<[[f64; 4]; 4]>,
}

/// The terms of the objective with their weights.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObjectiveRecord {
    /// J.
    pub total: f64,
    /// First hits on target: squared relative error of N*.
    pub normal_impulse: f64,
    /// First hits on target: squared excess of f*.
    pub tangential_impulse: f64,
    /// Impacts on secondary surfaces.
    pub rebound: f64,
    /// First hits off the target.
    pub miss: f64,
    /// Standard error of the total.
    pub standard_error: f64,
    /// Standard errors of the four terms, in their order.
    pub term_standard_errors: [f64; 4],
}

/// A verdict.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VerdictRecord {
    /// The goal, or the full name of the surface.
    pub subject: String,
    /// Share of shots that break it.
    pub share: f64,
    /// 95 % interval of that share.
    pub interval_95: [f64; 2],
    /// Share that may break it.
    pub allowed: f64,
    /// Shots counted.
    pub counted: usize,
    /// Whether the share is allowed.
    pub passes: bool,
    /// Whether the interval lies on one side of what is allowed.
    pub certain: bool,
    /// Where on a stroke it is worst, from its beginning, m; absent for a spot, and where no place is worse than the whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_m: Option<f64>,
}

impl AnswerRecord {
    /// The least distance between nozzle and part, m, with the worst errors where there is a tolerance.
    pub fn least_clearance(&self) -> Option<f64> {
        self.clearance_within_tolerance_m.or(self.clearance_m)
    }

    /// Whether that is less than wanted, by more than its rounding.
    pub fn is_too_near(&self) -> bool {
        let wanted = self.clearance_wanted_m;
        let least = wanted - 1e-6 * wanted.max(1e-3);
        self.least_clearance().is_some_and(|gap| gap < least)
    }

    /// The record of an answer.
    pub fn new(scenario: &Scenario, answer: &Answer) -> Self {
        let settings = &answer.settings;
        let contact = &scenario.problem.contacts[settings.contact];
        let pose = Pose::new(&scenario.target.frame, settings);
        let nozzle = &scenario.problem.nozzle;
        let calibration = scenario.problem.calibration.as_ref();
        let surface_name = |gap: Gap| scenario.scene.surfaces()[gap.surface as usize].clone();
        let clearance = gap(scenario, settings);
        let worst = scenario
            .problem
            .tolerance
            .moves_nozzle()
            .then(|| gap_within_tolerance(scenario, settings))
            .flatten();
        let evaluation = answer.evaluation.as_ref();
        Self {
            contact: contact.name.clone(),
            contact_values: ContactRecord::new(&contact.at(settings.static_friction)),
            settings: SettingsRecord::new(settings),
            pressure: calibration.and_then(|known| known.pressure_at(settings.speed)),
            pose: PoseRecord::new(&pose),
            feasible: answer.violation <= 0.0,
            passes: answer.passes(),
            violation: Some(answer.largest_violation()),
            least_objective: answer.least_objective,
            infeasible_because: answer.obstacle.map(|it| it.reason(scenario)),
            clearance_m: clearance.map(|gap| gap.distance),
            clearance_surface: clearance.map(surface_name),
            clearance_within_tolerance_m: worst.map(|gap| gap.distance),
            clearance_within_tolerance_surface: worst.map(surface_name),
            clearance_wanted_m: nozzle.clearance,
            body_radius_left_m: (answer.violation > 0.0)
                .then(|| radius_left(scenario, &pose))
                .flatten(),
            shots: evaluation.map_or(0, |evaluation| evaluation.shots),
            rim_shots: evaluation.map_or(0, |evaluation| evaluation.boundary_shots),
            objective: evaluation.map(ObjectiveRecord::new),
            target: evaluation.map(|evaluation| TargetRecord::new(scenario, evaluation)),
            surfaces: evaluation
                .map_or_else(BTreeMap::new, |evaluation| receipts(scenario, evaluation)),
            verdicts: answer
                .verdicts
                .iter()
                .map(|verdict| VerdictRecord::new(scenario, verdict))
                .collect(),
        }
    }
}

impl ContactRecord {
    fn new(contact: &Contact) -> Self {
        let (restitution, at, exponent) = match contact.restitution {
            Restitution::Constant(value) => (value, None, None),
            Restitution::Falling {
                reference,
                speed,
                exponent,
            } => (reference, Some(speed), Some(exponent)),
        };
        Self {
            law: contact.law.name().into(),
            mu_s: contact.static_friction,
            mu_d: contact.dynamic_friction,
            restitution,
            restitution_at_m_s: at,
            restitution_exponent: exponent,
            tangential_restitution: contact.tangential_restitution,
        }
    }
}

impl PoseRecord {
    pub(super) fn new(pose: &Pose) -> Self {
        Self {
            exit_m: pose.exit.coords.into(),
            direction: pose.direction.into(),
            quaternion_xyzw: pose.rotation().coords.into(),
            matrix_4x4: Some(matrix(pose)),
        }
    }
}

/// The frame of the nozzle in the scene, row by row.
fn matrix(pose: &Pose) -> [[f64; 4]; 4] {
    let columns = [pose.up, pose.side, pose.direction, pose.exit.coords];
    let row = |axis: usize| columns.map(|column| column[axis]);
    [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
}

impl ObjectiveRecord {
    pub(super) fn new(evaluation: &Evaluation) -> Self {
        let (terms, errors) = (&evaluation.terms, &evaluation.term_errors);
        Self {
            total: terms.total(),
            normal_impulse: terms.normal_impulse,
            tangential_impulse: terms.tangential_impulse,
            rebound: terms.rebound,
            miss: terms.miss,
            standard_error: evaluation.standard_error,
            term_standard_errors: [
                errors.normal_impulse,
                errors.tangential_impulse,
                errors.rebound,
                errors.miss,
            ],
        }
    }
}

impl VerdictRecord {
    pub(super) fn new(scenario: &Scenario, verdict: &Verdict) -> Self {
        Self {
            subject: subject_name(scenario, verdict.subject),
            share: verdict.share(),
            interval_95: verdict.interval(),
            allowed: verdict.allowed,
            counted: verdict.counted,
            passes: verdict.passes(),
            certain: verdict.is_certain(),
            at_m: verdict
                .place
                .zip(scenario.traverse.as_ref())
                .map(|(place, traverse)| traverse.travelled(place)),
        }
    }
}

/// The goal's key in the problem file, or the full name of the surface.
pub(super) fn subject_name(scenario: &Scenario, subject: Subject) -> String {
    match subject {
        Subject::NormalImpulse => "normal_impulse".into(),
        Subject::TangentialImpulse => "tangential_impulse".into(),
        Subject::Miss => "miss".into(),
        Subject::Surface(index) => scenario.scene.surfaces()[index as usize].clone(),
        Subject::Clearance => "clearance".into(),
        Subject::FreeSpace => "free_space".into(),
    }
}
