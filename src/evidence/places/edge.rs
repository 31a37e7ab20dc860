//! Where the region of the target ends that the jet reaches directly.
//!
//! Round the middle of the first hits the target's plane is cut into equal sectors. In each of
//! them the region reaches as far as 99 % of its hits. Where the target goes on beyond that, the
//! region has an edge there; the nearest of all edges is the one to look at. In the shadow of a
//! surface lies what that hides from the middle of the exit; elsewhere the jet just ends.

use std::f64::consts::TAU;

use nalgebra::{Point3, Vector3};

use super::{Place, TargetHit, length};
use crate::elementary::{atan2, hypot};
use crate::jet::Pose;
use crate::scenario::Scenario;
use crate::scene::ray::Ray;
use crate::trace::PathImpact;

const SECTORS: usize = 36;
/// Share of a sector's hits within its reach.
const WITHIN: f64 = 0.99;
/// Fewer hits than this in a sector do not tell how far it reaches.
const LEAST: usize = 32;

struct Edge<'a> {
    /// From the middle of the hits, m.
    reach: f64,
    /// A hit on the edge.
    hit: &'a PathImpact,
    /// A place on the target a little farther out.
    beyond: Point3<f64>,
}

/// The edge that is nearest to the middle of the hits; none where they reach the target's borders
/// everywhere. `radius` is that of the discs in which hits are counted.
pub(super) fn find(
    scenario: &Scenario,
    pose: &Pose,
    hits: &[TargetHit],
    radius: f64,
) -> Option<Place> {
    let frame = &scenario.target.frame;
    let sum: Vector3<f64> = hits.iter().map(|hit| hit.impact.point.coords).sum();
    let middle = Point3::from(sum / hits.len().max(1) as f64);
    let mut sectors: Vec<Vec<(f64, &PathImpact)>> = vec![Vec::new(); SECTORS];
    for hit in hits {
        let from_middle = hit.impact.point - middle;
        let (along, across) = (
            from_middle.dot(&frame.along),
            from_middle.dot(&frame.across),
        );
        let turn = atan2(across, along).rem_euclid(TAU) / TAU;
        let sector = (turn * SECTORS as f64) as usize % SECTORS;
        sectors[sector].push((hypot(along, across), hit.impact));
    }
    let mut nearest: Option<Edge> = None;
    for mut sector in sectors.into_iter().filter(|sector| sector.len() >= LEAST) {
        let rank = (sector.len() as f64 * WITHIN) as usize;
        let (reach, hit) = *sector
            .select_nth_unstable_by(rank, |a, b| a.0.total_cmp(&b.0))
            .1;
        if nearest.as_ref().is_some_and(|edge| edge.reach <= reach) {
            continue;
        }
        if let Some(beyond) = beyond(scenario, &middle, hit, 2.0 * radius) {
            nearest = Some(Edge { reach, hit, beyond });
        }
    }
    let edge = nearest?;
    let why = match in_the_way(scenario, pose, &edge.beyond) {
        Some(name) => format!("beyond, {name} hides the target from the exit"),
        None => "the jet ends here, nothing is in its way".into(),
    };
    Some(Place {
        name: "shadow_edge",
        surface: edge.hit.surface,
        point: edge.hit.point,
        normal: edge.hit.normal,
        value: edge.reach,
        text: format!(
            "nearest edge of what the jet reaches directly, {} from the middle of the hits: {why}",
            length(edge.reach)
        ),
    })
}

/// The place on the target a step outwards from a hit, if it goes on there.
fn beyond(
    scenario: &Scenario,
    middle: &Point3<f64>,
    hit: &PathImpact,
    step: f64,
) -> Option<Point3<f64>> {
    let outwards = hit.point - middle;
    let in_surface = outwards - hit.normal * outwards.dot(&hit.normal);
    let wanted = hit.point + in_surface.try_normalize(0.0)? * step;
    let (foot, _) = scenario
        .scene
        .nearest_on_surface(&wanted, scenario.target.surface)?;
    let goes_on = (foot - wanted).norm() < 0.5 * step;
    (goes_on && scenario.target.covers(&foot)).then_some(foot)
}

/// The surface that hides a place of the target from the middle of the exit. A deflector hides
/// nothing: the jet goes round that corner.
fn in_the_way(scenario: &Scenario, pose: &Pose, place: &Point3<f64>) -> Option<String> {
    let way = place - pose.exit;
    let ray = Ray {
        origin: pose.exit,
        direction: way.normalize(),
    };
    let nozzle_frame = pose.nozzle_frame();
    let first = scenario
        .scene
        .first_contact(&ray, 0.0, None, Some(&nozzle_frame))?;
    let is_hidden = first.distance < way.norm() * (1.0 - 1e-3)
        && !scenario.surfaces[first.surface as usize].deflector;
    is_hidden.then(|| scenario.scene.surfaces()[first.surface as usize].clone())
}
