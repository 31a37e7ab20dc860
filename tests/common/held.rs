//! What there is to choose where nothing is.

use peenpose::problem::setting::Choice;
use peenpose::setup::Setup;

/// The choice that a problem leaves when everything is held: the lower end of every range.
pub fn held(setup: &Setup) -> Choice {
    let settings = &setup.problem.settings;
    let contact = settings.contact[0];
    Choice {
        incidence: settings.incidence.min,
        azimuth: settings.azimuth.min,
        standoff: settings.standoff.min,
        speed: settings.speed.min,
        aim_along: settings.aim_along.min,
        aim_across: settings.aim_across.min,
        aim_above: settings.aim_above.min,
        contact,
        static_friction: setup.problem.contacts[contact].static_friction.min,
    }
}
