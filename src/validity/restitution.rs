//! Whether the restitution is known at the speed at which shots arrive.

use super::Note;
use crate::digits::{fixed, plain, significant};
use crate::evaluate::Evaluation;
use crate::impact::Restitution;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// From this factor between the speeds on, the law is no longer a small correction.
const FAR: f64 = 2.0;

pub(super) fn note(
    scenario: &Scenario,
    settings: &Settings,
    evaluation: Option<&Evaluation>,
) -> Note {
    let contact = scenario.contact_on(scenario.target.surface, settings);
    let arriving = evaluation
        .filter(|evaluation| evaluation.target.hits > 0)
        .map(|evaluation| {
            let impulse = evaluation.target.normal_impulse.mean;
            contact
                .restitution
                .approach_speed(impulse / scenario.problem.shot.mass())
        });
    match (contact.restitution, arriving) {
        (Restitution::Constant(value), _) => Note {
            name: "constant_restitution",
            value,
            text: format!(
                "restitution is taken as {} at every speed; on metal it falls as speed rises, and it \
                 turns rebounds more than friction does",
                plain(value)
            ),
        },
        (
            Restitution::Falling {
                reference, speed, ..
            },
            Some(arriving),
        ) => Note {
            name: "restitution_speed",
            value: arriving / speed,
            text: format!(
                "restitution was measured as {} at {} m/s; first hits arrive with a mean normal \
                 speed of {} m/s, {} times as fast, where the law gives {}{}",
                plain(reference),
                plain(speed),
                significant(arriving, 3),
                significant(arriving / speed, 3),
                fixed(contact.restitution.at(arriving), 3),
                if (FAR.recip()..=FAR).contains(&(arriving / speed)) {
                    ""
                } else {
                    ": measure it nearer to that speed"
                },
            ),
        },
        (
            Restitution::Falling {
                reference, speed, ..
            },
            None,
        ) => Note {
            name: "falling_restitution",
            value: reference,
            text: format!(
                "restitution is {} at {} m/s and falls as speed rises",
                plain(reference),
                plain(speed)
            ),
        },
    }
}
