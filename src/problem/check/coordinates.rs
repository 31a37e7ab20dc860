//! Bare coordinates: lists of numbers in `lengths_in`, and directions.

use std::cell::Cell;

use nalgebra::{Point2, Point3, Vector3};

use super::scope::Scope;
use crate::problem::LengthUnit;
use crate::problem::Limit;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::scene::BoxEntry;
use crate::problem::file::{Pair, Triple};

/// How bare coordinates become metres.
pub(super) struct Coordinates<'a> {
    root: Scope<'a>,
    unit: Option<LengthUnit>,
    /// Whether a missing unit is still to be reported, at its first use.
    unreported: Cell<bool>,
}

impl<'a> Coordinates<'a> {
    pub fn new(root: &Scope<'a>, unit: &Field<LengthUnit>) -> Self {
        Self {
            root: root.clone(),
            unit: unit.value().copied(),
            unreported: Cell::new(!unit.is_given()),
        }
    }

    /// The unit that the file gives, if it does: one without coordinates needs none.
    pub fn given_unit(&self) -> Option<LengthUnit> {
        self.unit
    }

    /// The unit of coordinate lists and mesh files.
    pub fn unit(&self) -> Option<LengthUnit> {
        if self.unreported.replace(false) {
            self.root.required_here(
                "lengths_in",
                &Field::<LengthUnit>::Missing,
                "um, mm, cm, m or in, as the file has coordinates or a mesh",
            );
        }
        self.unit
    }

    /// A point of the scene in m.
    pub fn point(&self, scope: &Scope<'_>, triple: &Triple) -> Option<Point3<f64>> {
        self.point_in(scope, triple, self.unit())
    }

    /// A point in a cross-section in m.
    pub fn flat_point(&self, scope: &Scope<'_>, pair: &Pair) -> Option<Point2<f64>> {
        scaled(scope, pair, self.unit()).map(|[x, y]| Point2::new(x, y))
    }

    /// A point in m, where the unit may differ from that of the file.
    pub fn point_in(
        &self,
        scope: &Scope<'_>,
        triple: &Triple,
        unit: Option<LengthUnit>,
    ) -> Option<Point3<f64>> {
        scaled(scope, triple, unit).map(Point3::from)
    }

    /// Two opposite corners in m, the smaller one first.
    pub fn corners(
        &self,
        scope: &Scope<'_>,
        entry: &BoxEntry,
        unit: Option<LengthUnit>,
    ) -> Option<(Point3<f64>, Point3<f64>)> {
        self.corners_of(scope, [&entry.min, &entry.max], unit)
    }

    /// The same of fields that need not be there for themselves.
    pub fn corners_of(
        &self,
        scope: &Scope<'_>,
        [min, max]: [&Field<Triple>; 2],
        unit: Option<LengthUnit>,
    ) -> Option<(Point3<f64>, Point3<f64>)> {
        let corner = |name: &str, field: &Field<Triple>| {
            let triple = scope.required_here(name, field, "a corner `[x, y, z]`")?;
            self.point_in(&scope.of(name), triple, unit)
        };
        let (min, max) = (corner("min", min), corner("max", max));
        let (min, max) = (min?, max?);
        let axes = ["x", "y", "z"].into_iter().enumerate();
        let flat: Vec<&str> = axes
            .filter(|(axis, _)| min[*axis] >= max[*axis])
            .map(|(_, name)| name)
            .collect();
        if flat.is_empty() {
            return Some((min, max));
        }
        let flat = flat.join(" and ");
        let message = format!("the box has no extent along {flat}");
        let fault = scope.fault(FaultCode::FlatBox, "max", message);
        scope.report(fault.expecting(format!("a larger {flat} than in `min`")));
        None
    }
}

/// A direction of any length but 0, made a unit vector.
pub(super) fn direction(scope: &Scope<'_>, triple: &Triple) -> Option<Vector3<f64>> {
    let vector = Vector3::from(numbers(scope, triple)?);
    let unit = vector
        .try_normalize(f64::MIN_POSITIVE)
        // The square of a very long or very short vector is no number to divide by.
        .filter(|unit| (unit.norm() - 1.0).abs() < 1e-9);
    if unit.is_none() {
        scope.report(
            scope
                .own_fault(FaultCode::NotADirection, "is not a direction")
                .expecting("a list such as `[0, 0, 1]`"),
        );
    }
    unit
}

/// The numbers of a list, all of which must be there.
fn numbers<const N: usize>(scope: &Scope<'_>, list: &[Field<f64>; N]) -> Option<[f64; N]> {
    let mut values = [0.0; N];
    let mut sound = true;
    for (index, field) in list.iter().enumerate() {
        match field {
            Field::Present(value) => values[index] = *value,
            Field::Faulty => sound = false,
            Field::Missing => {
                let item = scope.item(index);
                item.report(
                    item.own_fault(FaultCode::Missing, "is missing")
                        .expecting("a number"),
                );
                sound = false;
            }
        }
    }
    sound.then_some(values)
}

fn scaled<const N: usize>(
    scope: &Scope<'_>,
    list: &[Field<f64>; N],
    unit: Option<LengthUnit>,
) -> Option<[f64; N]> {
    let values = numbers(scope, list)?;
    let unit = unit?;
    let values = values.map(|value| unit.metres(value));
    let mut sound = true;
    for (index, value) in values.iter().enumerate() {
        sound &= scope.item(index).within_own(*value, Limit::SHIFT).is_some();
    }
    sound.then_some(values)
}
