//! `target`: what is to be peened.

use super::coordinates::{self, Coordinates};
use super::scene::Scene;
use super::scope::Scope;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::{Field, Needed};
use crate::problem::file::scene::TargetEntry;
use crate::problem::part::Target;

pub(super) fn check(
    root: &Scope<'_>,
    field: &Needed<TargetEntry>,
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
        .filter(|name| {
            let fault = surface_fault("target.surface", name, scene);
            let sound = fault.is_none();
            fault.into_iter().for_each(|fault| scope.report(fault));
            sound
        });
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
        lengths_in: coordinates.given_unit().unwrap_or_default(),
        surface: surface?.clone(),
        within: within?,
        aim: aim?,
        aim_key: "target.aim",
        along: along?,
        facing: facing?,
    })
}

/// What is wrong with a surface as the target.
fn surface_fault(key: &str, name: &str, scene: &Scene) -> Option<Fault> {
    if !scene.moves_with_nozzle(name) {
        return scene.surface_fault(key, name);
    }
    let message = format!("`{}` moves with the nozzle", crate::units::shortened(name));
    let fault = Fault::at_key(FaultCode::TargetOnNozzle, key, message);
    Some(fault.expecting("a surface of a part that stands in the scene"))
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
