//! The maps of a report: which settings they are drawn over, and how finely.

use super::{Axis, Control, Map, common_shots};
use crate::elementary::power;
use crate::evaluate::LargestImpulses;
use crate::problem::part::Shape;
use crate::problem::setting::{Range, Setting, Settings};
use crate::scenario::Scenario;

/// Shots at each place.
const SHOTS: usize = 1024;
/// Rays between exact walls that a map may take.
const MOST_RAYS: f64 = 3e6;
/// How many times as long a ray takes among triangles.
const AMONG_TRIANGLES: f64 = 5.0;
/// Values along an axis.
const MOST_STEPS: f64 = 41.0;
const FEWEST_STEPS: f64 = 9.0;
/// Least and largest share by which speeds on both sides of the choice are shown.
const LEAST_SPEEDS: f64 = 0.1;
const MOST_SPEEDS: f64 = 0.6;
/// Shots that tell how many rays a shot takes.
const PROBES: usize = 64;

/// The maps of a report at some settings: over incidence and azimuth, over standoff and speed, or
/// over others where these are held. None where fewer than two settings are free.
///
/// The dearer a ray, the coarser they are.
pub fn standard_maps(scenario: &Scenario, settings: &Settings, control: &Control) -> Vec<Map> {
    let rays = rays_at_one_place(scenario, settings);
    let pairs = pairs(&free(scenario, settings));
    let map = |[x, y]: [(Setting, Range); 2]| {
        let is_free =
            |setting| setting == Setting::Speed && scenario.speed_scales_out(settings.contact);
        let paths = [x, y].into_iter().filter(|(setting, _)| !is_free(*setting));
        let affordable = power(MOST_RAYS / rays, 1.0 / paths.count() as f64);
        let traced = affordable.clamp(FEWEST_STEPS, MOST_STEPS).floor();
        let axis = |(setting, range)| {
            let steps = if is_free(setting) { MOST_STEPS } else { traced };
            let shown = if setting == Setting::Speed {
                round_the_speed(scenario, settings, range)
            } else {
                range
            };
            Axis::over(setting, shown, steps as usize)
        };
        Map::of(scenario, settings, axis(x), axis(y), SHOTS, control)
    };
    pairs.into_iter().map(map).collect()
}

/// The speeds worth showing: over a whole range what passes would be too thin a line.
fn round_the_speed(scenario: &Scenario, settings: &Settings, range: Range) -> Range {
    let tolerance = scenario.problem.goals.normal_impulse.tolerance;
    let share = (2.0 * tolerance).clamp(LEAST_SPEEDS, MOST_SPEEDS);
    let near = |sign: f64| (settings.speed * (1.0 + sign * share)).clamp(range.min, range.max);
    let (min, max) = (near(-1.0), near(1.0));
    if min < max { Range { min, max } } else { range }
}

/// The settings that have a range, in the order of the problem file.
fn free(scenario: &Scenario, settings: &Settings) -> Vec<(Setting, Range)> {
    let problem = &scenario.problem;
    let friction = problem.contacts[settings.contact].static_friction;
    let range = |setting| Some((setting, problem.ranges.range(setting)?));
    let of_the_nozzle = Setting::OF_THE_NOZZLE.into_iter().filter_map(range);
    of_the_nozzle
        .chain([(Setting::StaticFriction, friction)])
        .filter(|(_, range)| !range.is_held())
        .collect()
}

/// Pairs of free settings: first those that belong together, then what is left.
fn pairs(free: &[(Setting, Range)]) -> Vec<[(Setting, Range); 2]> {
    let mut left = free.to_vec();
    let mut pairs = Vec::new();
    for together in [
        [Setting::Incidence, Setting::Azimuth],
        [Setting::Standoff, Setting::Speed],
    ] {
        let belongs = |(setting, _): &(Setting, Range)| together.contains(setting);
        let both: Vec<_> = left.iter().copied().filter(belongs).collect();
        if let [x, y] = both[..] {
            pairs.push([x, y]);
            left.retain(|setting| !belongs(setting));
        }
    }
    while pairs.len() < 2 && !left.is_empty() {
        let x = left.remove(0);
        if !left.is_empty() {
            pairs.push([x, left.remove(0)]);
        } else if let Some(&partner) = free.iter().find(|setting| **setting != x) {
            let mut pair = [partner, x];
            pair.sort_by_key(|(setting, _)| *setting);
            pairs.push(pair);
        }
    }
    pairs
}

/// What one place of a map costs, in rays between exact walls.
fn rays_at_one_place(scenario: &Scenario, settings: &Settings) -> f64 {
    let probes = common_shots(&scenario.problem, PROBES);
    let shots = if probes.len() < PROBES { 1 } else { SHOTS };
    let rays = LargestImpulses::of(scenario, settings, &probes).rays_per_shot() * shots as f64;
    let has_triangles = |shape: &Shape| matches!(shape, Shape::Mesh { .. } | Shape::Box { .. });
    if scenario
        .problem
        .parts
        .iter()
        .any(|part| has_triangles(&part.shape))
    {
        rays * AMONG_TRIANGLES
    } else {
        rays
    }
}
