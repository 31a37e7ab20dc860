//! The coordinates in which a descent moves.
//!
//! Near the normal of the target incidence and azimuth are polar coordinates: what is straight there, as the bound to
//! where a lance touches the wall beside it, is a sharp curve in them, along which a simplex creeps, and at the normal
//! itself the azimuth means nothing. A descent that starts there moves in Cartesian coordinates of the tilt instead.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::space::{Axis, Space};
use crate::elementary::{atan2, hypot, sin_cos};
use crate::problem::setting::Setting;

/// Coordinates for a descent.
pub(super) enum Coordinates {
    /// Those of the unit cube.
    Cube,
    /// The tilt from the normal, in units of the range of incidence, along the azimuth 0 and across it, in place of
    /// incidence and azimuth.
    Tilt {
        incidence: (usize, Axis),
        azimuth: (usize, Axis),
    },
}

impl Coordinates {
    /// Those for a descent from a point.
    pub fn near(space: &Space, point: &[f64]) -> Self {
        let [Some(incidence), Some(azimuth)] =
            [Setting::Incidence, Setting::Azimuth].map(|setting| space.axis(setting))
        else {
            return Self::Cube;
        };
        let tilt = FRAC_PI_2 - incidence.1.range.at(point[incidence.0]);
        if tilt > STEEPEST || azimuth.1.range.width() < NARROWEST {
            return Self::Cube;
        }
        Self::Tilt { incidence, azimuth }
    }

    /// The coordinates of a point of the unit cube.
    pub fn of(&self, point: &[f64]) -> Vec<f64> {
        let mut at = point.to_vec();
        if let Self::Tilt { incidence, azimuth } = self {
            let tilt = FRAC_PI_2 - incidence.1.value(point[incidence.0]);
            let (sine, cosine) = sin_cos(azimuth.1.value(point[azimuth.0]));
            let share = tilt / incidence.1.range.width();
            (at[incidence.0], at[azimuth.0]) = (share * cosine, share * sine);
        }
        at
    }

    /// The point of the unit cube, or outside of it, at some coordinates.
    pub fn point(&self, at: &[f64]) -> Vec<f64> {
        let mut point = at.to_vec();
        if let Self::Tilt { incidence, azimuth } = self {
            let (along, across) = (at[incidence.0], at[azimuth.0]);
            let tilt = hypot(along, across) * incidence.1.range.width();
            let middle = azimuth.1.range.at(0.5);
            let turned = atan2(across, along) - middle;
            // Of all whole turns the one that leads into the range, or nearest to it.
            let angle = middle + turned - TAU * (turned / TAU).round();
            point[incidence.0] = incidence.1.coordinate(FRAC_PI_2 - tilt);
            point[azimuth.0] = azimuth.1.coordinate(angle);
        }
        point
    }
}

/// From farther off the normal than this, rad, the polar coordinates are straight enough.
const STEEPEST: f64 = 30.0 / 180.0 * std::f64::consts::PI;
/// In a narrower range of azimuths than this, rad, too.
const NARROWEST: f64 = 60.0 / 180.0 * std::f64::consts::PI;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::setting::Range;
    use crate::study::Study;

    /// A space with these ranges of incidence and azimuth, deg.
    fn space(incidence: [f64; 2], azimuth: [f64; 2]) -> Space {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
        let study = Study::open(&folder.join("keyway.yaml")).expect("it is sound");
        let mut problem = study.problem().clone();
        let range = |[min, max]: [f64; 2]| Range {
            min: min.to_radians(),
            max: max.to_radians(),
        };
        problem.ranges.incidence = range(incidence);
        problem.ranges.azimuth = range(azimuth);
        Space::new(&problem, 0, false)
    }

    fn is_tilt(space: &Space, incidence: f64) -> bool {
        let (axis, range) = space.axis(Setting::Incidence).expect("it is searched");
        let mut point = vec![0.5; space.dimensions()];
        point[axis] = range.coordinate(incidence.to_radians());
        matches!(Coordinates::near(space, &point), Coordinates::Tilt { .. })
    }

    #[test]
    fn only_near_the_normal_is_the_tilt_searched() {
        let wide = space([20.0, 90.0], [-90.0, 90.0]);
        assert!(is_tilt(&wide, 89.0) && is_tilt(&wide, 61.0));
        assert!(!is_tilt(&wide, 59.0));
        assert!(!is_tilt(&space([20.0, 90.0], [-20.0, 20.0]), 89.0));
        // One of both is held.
        let held = space([20.0, 90.0], [0.0, 0.0]);
        assert!(!is_tilt(&held, 89.0));
    }

    #[test]
    fn points_lead_to_coordinates_and_back() {
        for azimuth in [
            [-90.0, 90.0],
            [0.0, 360.0],
            [150.0, 350.0],
            [-400.0, -300.0],
        ] {
            let space = space([40.0, 90.0], azimuth);
            let top = vec![0.9; space.dimensions()];
            let coordinates = Coordinates::near(&space, &top);
            for index in 0..200 {
                let mut point = space.spread(index, 3);
                point[0] = point[0].min(0.99);
                let back = coordinates.point(&coordinates.of(&point));
                let pairs = point.iter().zip(&back);
                assert!(
                    pairs.clone().all(|(a, b)| (a - b).abs() < 1e-9),
                    "{point:?} {back:?}"
                );
            }
        }
    }

    #[test]
    fn across_the_normal_the_azimuth_turns_by_half() {
        let space = space([40.0, 90.0], [0.0, 360.0]);
        let coordinates = Coordinates::near(&space, &vec![1.0; space.dimensions()]);
        let at = |along: f64, across: f64| {
            let mut at = vec![0.5; space.dimensions()];
            (at[0], at[1]) = (along, across);
            let settings = space.settings(&coordinates.point(&at));
            [settings.incidence, settings.azimuth].map(|it| it.to_degrees().round())
        };
        assert_eq!(at(0.1, 0.0), [85.0, 0.0]);
        assert_eq!(at(-0.1, 0.0), [85.0, 180.0]);
        assert_eq!(at(0.0, 0.2), [80.0, 90.0]);
        assert_eq!(at(0.0, 0.0), [90.0, 0.0]);
    }
}
