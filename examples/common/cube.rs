//! The settings that have a range, as points of the unit cube.

use peenpose::problem::Problem;
use peenpose::problem::setting::{Range, Setting, Settings};

/// The unit cube over the settings that have a range.
#[derive(Clone, Debug)]
pub struct Cube {
    axes: Vec<(Setting, Range)>,
    /// Every setting in the middle of its range.
    middle: Settings,
}

impl Cube {
    /// The cube of a contact with an axis for each setting in `free` that has a range.
    pub fn new(problem: &Problem, contact: usize, free: &[Setting]) -> Self {
        let ranges = &problem.ranges;
        let axes = free
            .iter()
            .map(|&setting| {
                let friction = problem.contacts[contact].static_friction;
                (setting, ranges.range(setting).unwrap_or(friction))
            })
            .filter(|(_, range)| !range.is_held())
            .collect();
        let middle = Settings {
            incidence: ranges.incidence.at(0.5),
            azimuth: ranges.azimuth.at(0.5),
            standoff: ranges.standoff.at(0.5),
            speed: ranges.speed.at(0.5),
            aim_along: ranges.aim_along.at(0.5),
            aim_across: ranges.aim_across.at(0.5),
            aim_above: ranges.aim_above.at(0.5),
            contact,
            static_friction: problem.contacts[contact].static_friction.min,
        };
        Self { axes, middle }
    }

    /// Number of axes.
    pub fn dimensions(&self) -> usize {
        self.axes.len()
    }

    /// The settings at a point; what lies outside is moved to the nearest face.
    pub fn settings(&self, point: &[f64]) -> Settings {
        let axes = self.axes.iter().zip(point);
        axes.fold(self.middle, |settings, (&(setting, range), &fraction)| {
            setting.with(&settings, range.at(fraction.clamp(0.0, 1.0)))
        })
    }

    /// A point of a low-discrepancy sequence.
    pub fn sobol(&self, index: u32, seed: u32) -> Vec<f64> {
        let coordinate = |axis| f64::from(sobol_burley::sample(index, axis, seed));
        (0..self.dimensions() as u32).map(coordinate).collect()
    }
}

/// The settings that are searched where the best speed follows from the paths.
pub const ALL_BUT_SPEED: [Setting; 7] = [
    Setting::Incidence,
    Setting::Azimuth,
    Setting::Standoff,
    Setting::AimAlong,
    Setting::AimAcross,
    Setting::AimAbove,
    Setting::StaticFriction,
];
