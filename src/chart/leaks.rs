//! Rays that slip through a mesh where two triangles meet.

use std::collections::HashMap;

use nalgebra::{Point3, center};
use serde::{Deserialize, Serialize};

use crate::jet::Pose;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::ray::Ray;

/// What became of rays from the nozzle's exit to the middles of edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Leaks {
    /// Rays cast.
    pub aimed: usize,
    /// Those that met nothing up to their edge.
    pub missed: usize,
}

/// Most edges that are aimed at.
const MOST_EDGES: usize = 100_000;
/// Share of the distance to an edge behind which a hit comes too late.
const BEHIND: f64 = 1e-6;

impl Leaks {
    /// Of the mesh of a scene, where it is seen from the nozzle: at edges between two triangles that both face
    /// it, so that a ray cannot pass beside them.
    pub(super) fn of(scenario: &Scenario, settings: &Settings) -> Self {
        let exit = Pose::new(&scenario.target.frame, settings).exit;
        let middles = inner_edges(scenario, &exit);
        let is_missed = |middle: &&Point3<f64>| {
            let way = *middle - exit;
            let ray = Ray {
                origin: exit,
                direction: way.normalize(),
            };
            let hit = scenario.scene.first_hit(&ray, None);
            hit.is_none_or(|hit| hit.distance > way.norm() * (1.0 + BEHIND))
        };
        Self {
            aimed: middles.len(),
            missed: middles.iter().filter(is_missed).count(),
        }
    }
}

/// The middles of edges that two triangles share which face a point, in the order of the triangles.
fn inner_edges(scenario: &Scenario, eye: &Point3<f64>) -> Vec<Point3<f64>> {
    let scene = &scenario.scene;
    let fixed = (0..scene.surfaces().len() as u32)
        .filter(|&surface| !scene.surface_moves_with_nozzle(surface));
    let mut seen = HashMap::new();
    let mut middles = Vec::new();
    for corners in fixed.flat_map(|surface| scene.surface_triangles(surface)) {
        let [a, b, c] = corners;
        let side = (b - a).cross(&(c - a)).dot(&(a - eye)).signum().to_bits();
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let mut ends = [from, to].map(|end| [end.x, end.y, end.z].map(f64::to_bits));
            ends.sort_unstable();
            if seen.insert(ends, side) == Some(side) && middles.len() < MOST_EDGES {
                middles.push(center(&from, &to));
            }
        }
    }
    middles
}
