//! By how much facets turn rebounds from the smooth surface that they approximate.

use std::f64::consts::PI;

use super::Note;
use crate::digits::fixed;
use crate::problem::part::{Part, Shape};
use crate::scenario::Scenario;
use crate::scene::mesh::Mesh;

/// Neighbours whose normals differ by less belong to one smooth surface, rad; others meet in an edge.
const SMOOTH: f64 = 30.0 / 180.0 * PI;
/// Angles below this are rounding of the file's coordinates, rad.
const FLAT: f64 = 0.01 / 180.0 * PI;

/// The largest angle between neighbouring facets of a smooth surface, deg.
pub(super) fn note(scenario: &Scenario) -> Option<Note> {
    let parts = scenario.problem.parts.iter();
    let faceted = parts.filter(|part| has_facets(part, scenario));
    let angles = faceted.filter_map(|part| {
        let angle = mesh_of(scenario, &part.name).largest_smooth_angle(SMOOTH)?;
        Some((angle, part.name.as_str()))
    });
    let (angle, part) = angles.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (angle > FLAT).then(|| Note {
        name: "facets",
        value: angle.to_degrees(),
        text: format!(
            "the facets of `{part}` turn by up to {} deg from one to the next where it looks smooth \
             (by less than {} deg): rebounds there are turned by up to that angle",
            fixed(angle.to_degrees(), 2),
            fixed(SMOOTH.to_degrees(), 0),
        ),
    })
}

/// Whether shots meet triangles where a part is round.
fn has_facets(part: &Part, scenario: &Scenario) -> bool {
    matches!(part.shape, Shape::Mesh { .. } | Shape::Revolve { .. })
        || !part.cut.is_empty()
        || part.is_cut_out(&scenario.problem.parts)
}

/// The triangles of a part in their place; corners at the same point are one.
fn mesh_of(scenario: &Scenario, part: &str) -> Mesh {
    let prefix = format!("{part}.");
    let surfaces = (0..).zip(scenario.scene.surfaces());
    let own = surfaces.filter(|(_, name)| name.starts_with(&prefix));
    Mesh::joined(own.flat_map(|(surface, _)| scenario.scene.surface_triangles(surface)))
}
