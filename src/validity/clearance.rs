//! How near the nozzle comes to the part when it is not set exactly.

use super::Note;
use crate::jet::Pose;
use crate::problem::setting::{Choice, Setting};
use crate::setup::Setup;

/// How near the nozzle comes to the part at the corners of the tolerance box, when that is nearer
/// than it may: the answer keeps the clearance only as it is set.
pub(super) fn within_tolerance(setup: &Setup, choice: &Choice) -> Option<Note> {
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
    if gap(choice).is_some() {
        // It has no room where it is set exactly either: that is said elsewhere.
        return None;
    }
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
                format!("{:.2} mm into", -gap * 1e3)
            } else {
                format!("within {:.2} mm of", gap * 1e3)
            },
            nozzle.clearance * 1e3,
        ),
    })
}
