//! What there is to choose where nothing is.

use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;

/// The choice that a problem leaves when everything is held: the lower end of every range.
pub fn held(scenario: &Scenario) -> Settings {
    let settings = &scenario.problem.ranges;
    let contact = settings.contact[0];
    Settings {
        contact,
        static_friction: scenario.problem.contacts[contact].static_friction.min,
        ..settings.at(0.0)
    }
}
