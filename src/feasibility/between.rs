//! Whether a nozzle that turns on its way fits between the stations of its stroke, too.
//!
//! Where the nozzle moves straight on, what it sweeps is one convex body. Elsewhere it is looked at in places so near to each
//! other that it cannot come too near to anything on the way from one to the next.

use super::carried::carried_gap;
use super::{Infeasible, cores, gap_as_set, infeasibility, room_for_errors};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::traverse::Traverse;

/// A way on which no point of the nozzle moves farther than this, m, is not looked at: between its ends it may come
/// nearer than the clearance by half of it.
const RESOLUTION: f64 = 1e-4;

/// A place of the stroke, and how far every point of the nozzle may move there before it comes too near to something, m.
#[derive(Clone, Copy)]
struct Stop {
    place: f64,
    room: f64,
}

/// Why settings are infeasible between two stations at which they are feasible; `None` where they are not.
pub(super) fn infeasible_between(scenario: &Scenario, settings: &Settings) -> Option<Infeasible> {
    let between = Between::new(scenario, settings)?;
    let stops = scenario.stations.iter();
    let mut stops: Vec<Stop> = stops
        .map(|it| between.stop(it.place, &it.scenario))
        .collect();
    stops.sort_by(|a, b| a.place.total_cmp(&b.place));
    for place in between.traverse.corners() {
        let after = stops.partition_point(|stop| stop.place < place);
        let is_new = stops.get(after).is_none_or(|stop| stop.place > place);
        if is_new && after > 0 && after < stops.len() {
            stops.insert(after, between.stop(place, &scenario.standing_at(place)));
        }
    }
    let mut pairs = stops.windows(2);
    pairs.find_map(|pair| between.look(pair[0], pair[1]))
}

/// The same on the way from one place of a stroke to another.
pub fn infeasible_on_way(
    scenario: &Scenario,
    settings: &Settings,
    places: [f64; 2],
) -> Option<Infeasible> {
    let between = Between::new(scenario, settings)?;
    let [from, to] = places.map(|place| between.stop(place, &scenario.standing_at(place)));
    between.look(from, to)
}

struct Between<'a> {
    scenario: &'a Scenario,
    settings: &'a Settings,
    traverse: &'a Traverse,
    /// How far from the aim point the nozzle reaches, m.
    reach: f64,
}

impl<'a> Between<'a> {
    /// `None` for a spot.
    fn new(scenario: &'a Scenario, settings: &'a Settings) -> Option<Self> {
        let lengths = cores(scenario).map(|(core, _)| core.length());
        let longest = lengths.fold(scenario.scene.carried_reach(), f64::max);
        Some(Self {
            scenario,
            settings,
            traverse: scenario.traverse.as_ref()?,
            reach: settings.standoff + longest,
        })
    }

    fn stop(&self, place: f64, standing: &Scenario) -> Stop {
        let clearance = standing.problem.nozzle.clearance;
        let gap = gap_as_set(standing, self.settings, f64::INFINITY);
        let gap = gap.map_or(f64::INFINITY, |gap| gap.distance - clearance);
        let gap = gap.min(carried_gap(standing, self.settings));
        Stop {
            place,
            room: (gap - room_for_errors(standing, self.settings)).max(0.0),
        }
    }

    /// Why the nozzle does not fit between two stops.
    fn look(&self, from: Stop, to: Stop) -> Option<Infeasible> {
        let places = [from.place, to.place];
        let straight = match self.scenario.sweep {
            // Round a part that is round it is straight, too.
            Some(half) => Some(half * (to.place - from.place)),
            None => self.traverse.straight_half(places),
        };
        let motion = match straight {
            Some(half) => 2.0 * half.norm(),
            None => self.traverse.motion(places, self.reach),
        };
        if motion <= RESOLUTION || from.room + to.room >= motion {
            return None;
        }
        let place = f64::midpoint(from.place, to.place);
        let mut standing = self.scenario.standing_at(place);
        if straight.is_some() {
            standing.sweep = straight;
            return infeasibility(&standing, self.settings);
        }
        infeasibility(&standing, self.settings).or_else(|| {
            let middle = self.stop(place, &standing);
            self.look(from, middle).or_else(|| self.look(middle, to))
        })
    }
}
