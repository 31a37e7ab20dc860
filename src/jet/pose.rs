//! The pose of the nozzle for some settings.

use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

use super::shot_sample::ShotSample;
use crate::elementary::sin_cos;
use crate::problem::setting::Settings;
use crate::scene::nozzle_frame::NozzleFrame;
use crate::scene::patch::Frame;
use crate::scene::ray::Ray;

/// Where the exit is and how the jet points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Centre of the exit disc, m.
    pub exit: Point3<f64>,
    /// d: unit vector along the jet.
    pub direction: Vector3<f64>,
    /// Unit vector across the jet, in the target's plane.
    pub side: Vector3<f64>,
    /// Unit vector across both.
    pub up: Vector3<f64>,
}

impl Pose {
    /// The pose of some settings: d = cos(inc) (cos(az) a + sin(az) b) - sin(inc) n, and the
    /// exit at the aim point minus standoff times d.
    pub fn new(frame: &Frame, settings: &Settings) -> Self {
        Aim::new(settings).pose(frame)
    }

    /// Rotation that takes the z axis to the jet's direction and the x axis across it.
    pub fn rotation(&self) -> UnitQuaternion<f64> {
        let axes = Matrix3::from_columns(&[self.up, self.side, self.direction]);
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes))
    }

    /// The frame of the nozzle, for the parts that move with it.
    pub fn nozzle_frame(&self) -> NozzleFrame {
        NozzleFrame::new([self.up, self.side, self.direction], self.exit)
    }

    /// The ray of a shot from this pose.
    #[inline]
    pub(crate) fn shot(&self, sample: &ShotSample) -> Ray {
        let [x, y] = sample.exit;
        let [across, upward, forward] = sample.cone;
        Ray {
            origin: self.exit + self.side * x + self.up * y,
            direction: self.side * across + self.up * upward + self.direction * forward,
        }
    }
}

/// The settings of a pose with the sines and cosines of its angles, so that every shot of a jet
/// with a setup tolerance gets its own pose without a trigonometric function.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    incidence: [f64; 2],
    azimuth: [f64; 2],
    standoff: f64,
    along: f64,
    across: f64,
    above: f64,
}

impl Aim {
    pub fn new(settings: &Settings) -> Self {
        Self {
            incidence: sin_cos(settings.incidence).into(),
            azimuth: sin_cos(settings.azimuth).into(),
            standoff: settings.standoff,
            along: settings.aim_along,
            across: settings.aim_across,
            above: settings.aim_above,
        }
    }

    /// The ray of a shot from the pose that was really set for it.
    #[inline]
    pub fn shot(&self, frame: &Frame, sample: &ShotSample) -> Ray {
        self.pose_set_for(frame, sample).shot(sample)
    }

    /// The pose that was really set for a shot.
    #[inline]
    pub fn pose_set_for(&self, frame: &Frame, sample: &ShotSample) -> Pose {
        self.perturbed(sample).pose(frame)
    }

    fn perturbed(&self, sample: &ShotSample) -> Self {
        Self {
            incidence: add_angle(self.incidence, sample.incidence),
            azimuth: add_angle(self.azimuth, sample.azimuth),
            standoff: self.standoff + sample.standoff,
            along: self.along + sample.aim[0],
            across: self.across + sample.aim[1],
            above: self.above + sample.aim[2],
        }
    }

    #[inline]
    fn pose(&self, frame: &Frame) -> Pose {
        let [sin_incidence, cos_incidence] = self.incidence;
        let [sin_azimuth, cos_azimuth] = self.azimuth;
        let heading = frame.along * cos_azimuth + frame.across * sin_azimuth;
        let side = frame.across * cos_azimuth - frame.along * sin_azimuth;
        let direction = heading * cos_incidence - frame.normal * sin_incidence;
        let aim = frame.aim
            + frame.along * self.along
            + frame.across * self.across
            + frame.normal * self.above;
        Pose {
            exit: aim - direction * self.standoff,
            direction,
            side,
            up: side.cross(&direction),
        }
    }
}

/// Sine and cosine of the sum of two angles given by theirs.
#[inline]
fn add_angle([sin_a, cos_a]: [f64; 2], [sin_b, cos_b]: [f64; 2]) -> [f64; 2] {
    [sin_a * cos_b + cos_a * sin_b, cos_a * cos_b - sin_a * sin_b]
}
