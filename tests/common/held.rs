//! What there is to choose where nothing is.

use peenpose::problem::setting::Choice;
use peenpose::setup::Setup;

/// The choice that a problem leaves when everything is held: the lower end of every range.
pub fn held(setup: &Setup) -> Choice {
    let settings = &setup.problem.settings;
    let contact = settings.contact[0];
    Choice {
        contact,
        static_friction: setup.problem.contacts[contact].static_friction.min,
        ..settings.at(0.0)
    }
}
