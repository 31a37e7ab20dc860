//! `target`: what is to be peened.

use super::coordinates::{self, Coordinates};
use super::scene::Scene;
use super::scope::Scope;
use crate::problem::field::Field;
use crate::problem::file::scene::TargetEntry;
use crate::problem::part::Target;

pub(super) fn check(
    root: &Scope<'_>,
    field: &Field<TargetEntry>,
    scene: &Scene,
    coordinates: &Coordinates<'_>,
) -> Option<Target> {
    let entry = root.required("target", field, "`{ surface: part.surface }`")?;
    let scope = root.of("target");
    let surface = scope
        .required(
            "surface",
            &entry.surface,
            "the name of a surface, `part.surface`",
        )
        .filter(
            |name| match scene.surface_fault(scope.fault("surface", ""), name) {
                Some(fault) => {
                    scope.report(fault);
                    false
                }
                None => true,
            },
        );
    let within = optional(&entry.within, |corners| {
        coordinates.corners(&scope.of("within"), corners, coordinates.unit())
    });
    let aim = optional(&entry.aim, |aim| coordinates.point(&scope.of("aim"), aim));
    let along = optional(&entry.along, |along| {
        coordinates::direction(&scope.of("along"), along)
    });
    let facing = optional(&entry.facing, |facing| {
        coordinates::direction(&scope.of("facing"), facing)
    });
    Some(Target {
        surface: surface?.clone(),
        within: within?,
        aim: aim?,
        along: along?,
        facing: facing?,
    })
}

/// What `check` makes of a key that may be absent; the outer `None` stands for a fault.
#[expect(clippy::option_option, reason = "absent and faulty differ")]
fn optional<T, U>(field: &Field<T>, check: impl FnOnce(&T) -> Option<U>) -> Option<Option<U>> {
    match field {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(value) => check(value).map(Some),
    }
}
