//! Targets that look into solid material.

use nalgebra::Vector3;

use crate::problem::warning::{Warning, WarningCode};
use crate::scenario::Scenario;
use crate::scene::ray::Ray;

/// Height above the aim point from which is looked round, for one of the scene's size.
const HEIGHT: f64 = 1e-6;

/// Whoever sees the back of a surface wherever he looks is inside a part.
pub(super) fn warning(scenario: &Scenario) -> Option<Warning> {
    let frame = &scenario.target.frame;
    let (up, along, across) = (frame.normal, frame.along, frame.across);
    let origin = frame.aim + up * (HEIGHT * scenario.scene.size());
    let directions = [up, up + along, up - along, up + across, up - across];
    let back = |direction: Vector3<f64>| {
        let direction = direction.normalize();
        let hit = scenario.scene.first_hit(&Ray { origin, direction }, None)?;
        (!scenario.scene.is_free_side(&hit.hit_id)).then_some(hit.surface)
    };
    let backs: Vec<u32> = directions.into_iter().map(back).collect::<Option<_>>()?;
    let surface = &scenario.scene.surfaces()[backs[0] as usize];
    Some(Warning::new(
        WarningCode::TargetInsideMaterial,
        "target",
        format!(
            "the jet comes from inside solid material: the back of `{surface}` is above the aim point"
        ),
        "compare `aim` and `facing`, parts that overlap, and the side on which the triangles of a mesh have their front",
    ))
}
