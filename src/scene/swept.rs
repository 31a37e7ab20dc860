//! What a nozzle sweeps while its settings err within their tolerance, and how near that comes to a part.
//!
//! The exit lies at `aim - standoff d`. Aim points fill a box, standoffs a range, and directions d a patch
//! of the unit sphere, given by a grid. What the body sweeps is taken to be the convex hull of the bodies at
//! all of them: exact along the walls of a bore, and too large towards the aim point by no more than a
//! direction's patch bulges.

mod directions;

use nalgebra::{Point3, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::shape::{Segment, SupportMap};
use wide::f64x4;

use super::Scene;
use super::convex_body::ConvexBody;
pub use directions::Directions;

/// What of the nozzle must not touch a wall, round the exit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Core {
    /// The centre of the exit.
    Exit,
    /// A line from there, m, in a fixed direction or back along the jet.
    Line {
        /// m.
        length: f64,
        /// Unit vector; back along the jet when absent.
        direction: Option<Vector3<f64>>,
    },
    /// The disc of the exit.
    Disc {
        /// m.
        radius: f64,
    },
}

impl Core {
    /// How far it reaches from the exit, m.
    pub fn length(&self) -> f64 {
        match *self {
            Self::Exit => 0.0,
            Self::Line { length, .. } => length,
            Self::Disc { radius } => radius,
        }
    }
}

/// Where the jets of a nozzle are aimed within the tolerance of its settings, and from how far.
#[derive(Clone, Copy, Debug)]
pub struct Aims {
    /// Centre of the aim points, m.
    pub centre: Point3<f64>,
    /// Half the edges of their box, m, and half the way of a stroke.
    pub shifts: [Vector3<f64>; 4],
    /// Smallest and largest standoff, m.
    pub standoff: [f64; 2],
}

impl Aims {
    /// The aim point that is farthest in a direction, m.
    pub(super) fn farthest(&self, toward: &Vector3<f64>) -> Vector3<f64> {
        let shifts = self.shifts.iter().map(|shift| {
            if shift.dot(toward) < 0.0 {
                -shift
            } else {
                *shift
            }
        });
        self.centre.coords + shifts.sum::<Vector3<f64>>()
    }

    /// The standoff in the middle, m.
    pub(super) fn middle_standoff(&self) -> f64 {
        (self.standoff[0] + self.standoff[1]) / 2.0
    }
}

/// All places of the core of a nozzle's body within the tolerance of its settings.
#[derive(Clone, Debug)]
pub struct Swept {
    /// Where the jets are aimed.
    pub aims: Aims,
    /// Directions of the jet.
    pub directions: Directions,
    /// What is swept.
    pub core: Core,
}

impl SupportMap for Swept {
    fn local_support_point(&self, dir: Vector) -> Vector {
        let toward: Vector3<f64> = dir.into();
        let jet = self.directions.farthest(&toward, self.heights(&toward));
        (self.farthest_point(&jet, &toward) + self.aims.farthest(&toward)).into()
    }
}

impl ConvexBody for Swept {
    fn middle(&self) -> Segment {
        let jet = self.directions.mean();
        let exit = self.aims.centre.coords - jet * self.aims.middle_standoff();
        let end = match self.core {
            Core::Line { length, direction } => exit + direction.unwrap_or(-jet) * length,
            Core::Exit | Core::Disc { .. } => exit,
        };
        Segment::new(exit.into(), end.into())
    }

    fn height(&self, toward: Vector) -> f64 {
        let toward: Vector3<f64> = toward.into();
        let beyond = match self.core {
            Core::Line {
                length,
                direction: Some(direction),
            } => (direction.dot(&toward) * length).max(0.0),
            _ => 0.0,
        };
        let highest = self.directions.highest(&toward, self.heights(&toward));
        highest + beyond + self.aims.farthest(&toward).dot(&toward)
    }
}

impl Swept {
    /// How far the cores of jets reach in a direction from where they are aimed, given how far each jet goes ahead in
    /// it; a line in a fixed direction from its exit.
    #[inline(always)]
    fn heights(&self, toward: &Vector3<f64>) -> impl Fn(f64x4) -> f64x4 {
        let [near, far] = self.aims.standoff.map(f64x4::splat);
        let back = move |ahead: f64x4| ahead.simd_gt(f64x4::ZERO).select(near, far) * ahead;
        let square = f64x4::splat(toward.norm_squared());
        let (length, disc) = match self.core {
            Core::Exit
            | Core::Line {
                direction: Some(_), ..
            } => (0.0, None),
            Core::Line { length, .. } => (length, None),
            Core::Disc { radius } => (0.0, Some(radius)),
        };
        move |ahead| {
            let reach = match disc {
                Some(radius) => (square - ahead * ahead).fast_max(f64x4::ZERO).sqrt() * radius,
                None => (-ahead * length).fast_max(f64x4::ZERO),
            };
            reach - back(ahead)
        }
    }

    /// The point of the core of a jet that is farthest in a direction, from where it is aimed.
    fn farthest_point(&self, jet: &Vector3<f64>, toward: &Vector3<f64>) -> Vector3<f64> {
        let ahead = jet.dot(toward);
        let beyond = match self.core {
            Core::Exit => Vector3::zeros(),
            Core::Line { length, direction } => {
                let end = direction.unwrap_or(-jet) * length;
                if end.dot(toward) > 0.0 {
                    end
                } else {
                    Vector3::zeros()
                }
            }
            Core::Disc { radius } => {
                let across = toward - jet * ahead;
                across.try_normalize(0.0).unwrap_or_default() * radius
            }
        };
        let [near, far] = self.aims.standoff;
        beyond - jet * if ahead > 0.0 { near } else { far }
    }
}

impl Scene {
    /// Distance between all places of a nozzle's core and the nearest surface of the parts that stand in
    /// the scene, and that surface; 0 where they meet, `None` when everything is farther than `limit`.
    pub fn distance_to_swept(&self, swept: &Swept, limit: f64) -> Option<(f64, u32)> {
        self.distance_to_convex(swept, limit)
    }
}

#[cfg(test)]
mod tests;
