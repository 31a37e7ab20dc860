//! The settings that are searched, as points of the unit cube.

use crate::jet::sobol;
use crate::problem::Problem;
use crate::problem::setting::{Range, Setting, Settings};

/// The searched settings of one contact.
#[derive(Clone, Debug)]
pub struct Space {
    axes: Vec<Axis>,
    base: Settings,
}

/// A searched setting.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    setting: Setting,
    pub range: Range,
    /// A full turn of azimuth: both ends are the same direction.
    periodic: bool,
}

impl Axis {
    /// The nearest coordinate within the bounds; a periodic axis has none.
    fn within(&self, coordinate: f64) -> f64 {
        if self.periodic {
            coordinate
        } else {
            coordinate.clamp(0.0, 1.0)
        }
    }

    /// The value at a coordinate, which may go round on a periodic axis and stops at the bounds of any other.
    pub fn value(&self, coordinate: f64) -> f64 {
        let coordinate = self.within(coordinate);
        self.range.at(if self.periodic {
            coordinate.rem_euclid(1.0)
        } else {
            coordinate
        })
    }

    /// The coordinate of a value.
    pub fn coordinate(&self, value: f64) -> f64 {
        (value - self.range.min) / self.range.width()
    }
}

impl Space {
    /// The space of a contact. The speed has an axis only where it cannot be taken out.
    pub fn new(problem: &Problem, contact: usize, search_speed: bool) -> Self {
        let ranges = &problem.ranges;
        let friction = problem.contacts[contact].static_friction;
        let base = Settings {
            contact,
            static_friction: friction.min,
            ..ranges.at(0.0)
        };
        let of_the_nozzle = Setting::OF_THE_NOZZLE
            .into_iter()
            .filter(|&setting| setting != Setting::Speed || search_speed)
            .filter_map(|setting| Some((setting, ranges.range(setting)?)));
        let axes = of_the_nozzle
            .chain([(Setting::StaticFriction, friction)])
            .filter(|(_, range)| !range.is_held())
            .map(|(setting, range)| Axis {
                setting,
                range,
                periodic: setting == Setting::Azimuth
                    && range.width() >= std::f64::consts::TAU * (1.0 - 1e-12),
            })
            .collect();
        Self { axes, base }
    }

    /// One of many points that are spread evenly all over the space.
    pub fn spread(&self, index: u32, seed: u32) -> Vec<f64> {
        let coordinate = |axis| sobol(index, axis as u32, seed);
        (0..self.dimensions()).map(coordinate).collect()
    }

    /// Whether the nozzle stands elsewhere along an axis.
    pub fn moves_nozzle(&self, axis: usize) -> bool {
        !matches!(
            self.axes[axis].setting,
            Setting::Speed | Setting::StaticFriction
        )
    }

    /// The axis of a setting and its index, where the setting is searched.
    pub fn axis(&self, setting: Setting) -> Option<(usize, Axis)> {
        let index = self.axes.iter().position(|axis| axis.setting == setting)?;
        Some((index, self.axes[index]))
    }

    /// Number of searched settings.
    pub fn dimensions(&self) -> usize {
        self.axes.len()
    }

    /// The settings at a point; coordinates outside 0 to 1 go round on a periodic axis and stop at
    /// the bound on any other.
    pub fn settings(&self, point: &[f64]) -> Settings {
        let mut settings = self.base;
        for (axis, &coordinate) in self.axes.iter().zip(point) {
            settings = axis.setting.with(&settings, axis.value(coordinate));
        }
        settings
    }

    /// The nearest point within the bounds.
    pub fn within(&self, point: &[f64]) -> Vec<f64> {
        let pairs = self.axes.iter().zip(point);
        pairs.map(|(axis, &x)| axis.within(x)).collect()
    }

    /// The same point, on the turn of periodic axes that is nearest to another one.
    pub fn near(&self, other: &[f64], point: &[f64]) -> Vec<f64> {
        let pairs = self.axes.iter().zip(point.iter().zip(other));
        let along = pairs.map(|(axis, (x, other))| match axis.periodic {
            true => x - (x - other).round(),
            false => *x,
        });
        along.collect()
    }

    /// The point of some settings.
    pub fn point(&self, settings: &Settings) -> Vec<f64> {
        let coordinate = |axis: &Axis| axis.coordinate(axis.setting.of(settings));
        self.axes.iter().map(coordinate).collect()
    }

    /// Distance between two points: the largest difference along any axis.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let along = self.axes.iter().zip(a.iter().zip(b)).map(|(axis, (a, b))| {
            let straight = (a - b).abs();
            if axis.periodic {
                let wrapped = straight.rem_euclid(1.0);
                wrapped.min(1.0 - wrapped)
            } else {
                straight
            }
        });
        along.fold(0.0, f64::max)
    }
}
