//! What the model leaves out, and how much that could matter at the answer.

use crate::impact::Restitution;
use crate::jet::Pose;
use crate::problem::setting::{Choice, Setting};
use crate::setup::Setup;

/// Something that the model leaves out or that the user should know, with its number.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// A short fixed name for programs.
    pub name: &'static str,
    /// The number behind it, in the unit that the text gives.
    pub value: f64,
    /// What it means, for people.
    pub text: String,
}

/// Air at 20 deg C and 1013 hPa: density, kg/m3, and dynamic viscosity, Pa s (ISO 2533 values).
const AIR: (f64, f64) = (1.204, 1.81e-5);
/// Standard gravity, m/s2.
const GRAVITY: f64 = 9.806_65;

/// The notes on an answer.
pub fn notes(setup: &Setup, choice: &Choice) -> Vec<Note> {
    let mut notes = vec![
        shot_size(setup),
        gravity(choice),
        drag(setup, choice),
        restitution(setup, choice),
    ];
    if setup.problem.tolerance == Default::default() {
        notes.push(Note {
            name: "no_tolerance",
            value: 0.0,
            text: "the file has no tolerance: the answer holds for a nozzle that is set exactly"
                .into(),
        });
    }
    notes.extend(nearest_within_tolerance(setup, choice));
    notes.extend(setup.scene.warnings().iter().map(|warning| Note {
        name: "mesh",
        value: 0.0,
        text: warning.clone(),
    }));
    notes
}

fn shot_size(setup: &Setup) -> Note {
    let radius = setup.problem.shot.radius;
    Note {
        name: "point_shots",
        value: radius,
        text: format!(
            "shots fly as points: a real one touches a wall {:.3} mm before its centre would, which \
             matters where that is not small against the groove",
            radius * 1e3
        ),
    }
}

/// How near the nozzle comes to the part at the corners of the tolerance box, when that is nearer
/// than it may: the answer keeps the clearance only as it is set.
fn nearest_within_tolerance(setup: &Setup, choice: &Choice) -> Option<Note> {
    let tolerance = &setup.problem.tolerance;
    let nozzle = &setup.problem.nozzle;
    let errors = [
        (Setting::Incidence, tolerance.incidence),
        (Setting::Azimuth, tolerance.azimuth),
        (Setting::Standoff, tolerance.standoff),
        (Setting::AimAlong, tolerance.aim_along),
        (Setting::AimAcross, tolerance.aim_across),
        (Setting::AimAbove, tolerance.aim_above),
    ];
    let mut corners = vec![*choice];
    for (setting, error) in errors.into_iter().filter(|(_, error)| *error > 0.0) {
        let both = |corner: &Choice| {
            let value = setting.of(corner);
            [
                setting.with(corner, value - error),
                setting.with(corner, value + error),
            ]
        };
        corners = corners.iter().flat_map(both).collect();
    }
    let gap = |corner: &Choice| {
        let pose = Pose::new(&setup.target.frame, corner);
        let scene = &setup.scene;
        scene.clearance(nozzle, &pose.exit, &pose.direction, nozzle.clearance)
    };
    let nearest = corners.iter().filter_map(gap);
    let (gap, surface) = nearest.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let surface = &setup.scene.surfaces()[surface as usize];
    Some(Note {
        name: "clearance_within_tolerance",
        value: gap,
        text: format!(
            "within the setup tolerance the nozzle comes {} {surface}, where {:.2} mm are wanted: \
             the clearance holds only for a nozzle that is set exactly",
            if gap < 0.0 {
                format!("{:.2} mm too far into", -gap * 1e3)
            } else {
                format!("within {:.2} mm of", gap * 1e3)
            },
            nozzle.clearance * 1e3,
        ),
    })
}

fn gravity(choice: &Choice) -> Note {
    let time = choice.standoff / choice.speed;
    let drop = 0.5 * GRAVITY * time * time;
    Note {
        name: "gravity",
        value: drop,
        text: format!(
            "gravity is left out: a shot falls {:.2} um on its way to the target",
            drop * 1e6
        ),
    }
}

/// Share of the speed lost on the way to the target, by the drag of Schiller and Naumann.
fn drag(setup: &Setup, choice: &Choice) -> Note {
    let (density, viscosity) = AIR;
    let shot = setup.problem.shot;
    let diameter = 2.0 * shot.radius;
    let reynolds = density * choice.speed * diameter / viscosity;
    let coefficient = if reynolds < 1000.0 {
        24.0 / reynolds * (1.0 + 0.15 * reynolds.powf(0.687))
    } else {
        0.44
    };
    let decay = 0.75 * coefficient * density / shot.density / diameter;
    let loss = -(-decay * choice.standoff).exp_m1();
    Note {
        name: "drag",
        value: loss,
        text: format!(
            "drag is left out: in air at rest a shot loses {:.2} % of its speed before the target",
            loss * 100.0
        ),
    }
}

fn restitution(setup: &Setup, choice: &Choice) -> Note {
    let contact = setup.problem.contacts[choice.contact].contact;
    match contact.restitution {
        Restitution::Constant(value) => Note {
            name: "constant_restitution",
            value,
            text: format!(
                "restitution is taken as {value} at every speed; on metal it falls as speed rises, and it \
                 turns rebounds more than friction does"
            ),
        },
        Restitution::Falling {
            reference, speed, ..
        } => Note {
            name: "falling_restitution",
            value: reference,
            text: format!("restitution is {reference} at {speed} m/s and falls as speed rises"),
        },
    }
}
