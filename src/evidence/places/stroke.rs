//! Where to put test strips along a stroke: where it begins, in its middle, where it ends, and where it dents least.

use nalgebra::Point3;

use super::{Place, length};
use crate::digits::fixed;
use crate::scenario::Scenario;

const ALONG: [(&str, f64, &str); 3] = [
    ("beginning_of_stroke", -0.5, "beginning"),
    ("middle_of_stroke", 0.0, "middle"),
    ("end_of_stroke", 0.5, "end"),
];

/// Where the aim point begins, is half-way and ends; none for a spot.
pub(super) fn along(scenario: &Scenario) -> Vec<Place> {
    let Some(traverse) = &scenario.traverse else {
        return Vec::new();
    };
    let whole = length(traverse.length());
    let place = |(name, place, words): (&'static str, f64, &str)| {
        let travelled = traverse.travelled(place);
        let text = format!("{words} of the stroke, {} of {whole}", length(travelled));
        on_target(
            scenario,
            name,
            &traverse.frame_at(place).aim,
            travelled,
            text,
        )
    };
    ALONG.into_iter().filter_map(place).collect()
}

/// The place of a stroke that is dented least: along the stroke from its beginning and across it, m, and the share that
/// is dented there.
pub(crate) fn least_dented(scenario: &Scenario, at: [f64; 2], share: f64) -> Option<Place> {
    let traverse = scenario.traverse.as_ref()?;
    let text = format!(
        "dented least, {} % of a cell of the map",
        fixed(100.0 * share, 1)
    );
    on_target(scenario, "least_dented", &traverse.rolled(at), share, text)
}

/// A place at the point of the target that is nearest.
fn on_target(
    scenario: &Scenario,
    name: &'static str,
    near: &Point3<f64>,
    value: f64,
    text: String,
) -> Option<Place> {
    let target = &scenario.target;
    let (point, normal) = target.nearest(&scenario.scene, near)?;
    Some(Place {
        name,
        surface: target.surface,
        point,
        normal,
        value,
        text,
    })
}
