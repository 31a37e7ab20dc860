//! `shot`: the spheres, by numbers or out of the library.

use super::scope::Scope;
use crate::problem::equipment::Shot;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::equipment::ShotEntry;
use crate::problem::file::quantity::{Density, Length};
use crate::problem::media::{self, Medium};
use crate::units::shortened;

pub(super) fn check(scope: &Scope<'_>, entry: &ShotEntry) -> Option<Shot> {
    let medium = match &entry.medium {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(name) => looked_up(scope, name).map(Some),
    };
    let size_spread = scope.optional("size_spread", &entry.size_spread, 0.0);
    let Some(medium) = medium else {
        // Nothing can be said to be missing, but what is given can be wrong.
        scope.maybe("radius", &entry.radius);
        scope.maybe("density", &entry.density);
        return None;
    };
    let mut entry = entry.clone();
    if let Some(medium) = medium {
        if !entry.radius.is_given() {
            entry.radius = Field::Present(Length(medium.diameter.value / 2.0));
        }
        if !entry.density.is_given() {
            entry.density = Field::Present(Density(medium.density.value));
        }
    }
    let radius = scope.needed_here("radius", &entry.radius);
    let density = scope.needed_here("density", &entry.density);
    Some(Shot {
        radius: radius?,
        density: density?,
        size_spread: size_spread?,
        medium,
    })
}

/// The medium of this name; the fault is on record otherwise.
fn looked_up(scope: &Scope<'_>, name: &str) -> Option<&'static Medium> {
    let known = media::medium(name);
    if known.is_none() {
        let message = format!("the library has no shot `{}`", shortened(name));
        let fault = scope.fault(FaultCode::NotInLibrary, "use", message);
        let fault = fault.expecting("a medium that `peenpose media` lists");
        scope.report(fault.nearest(name, media::media().iter().map(|medium| medium.name)));
    }
    known
}
