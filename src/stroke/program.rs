//! What the machine does on a stroke: where the nozzle goes, how fast, how often, and what that covers.

use crate::coverage::{Coverage, DentedBy, Dose};
use crate::jet::Pose;
use crate::problem::stroke::{Feed, Leg, Stroke, WHOLE};
use crate::scenario::Scenario;
use crate::scene::traverse::Traverse;

use super::RunOut;

/// A stroke as a machine runs it.
#[derive(Clone, Debug)]
pub struct Program {
    /// Pieces with settings of their own, in the order of the stroke.
    pub legs: Vec<Leg>,
    /// Length on the part between the ends, m.
    pub length: f64,
    /// How far the aim point travels beyond the beginning and beyond the end.
    pub run_outs: [RunOut; 2],
    /// Poses from one end of the run-out to the other.
    pub waypoints: Vec<Waypoint>,
    /// Turns of the part from the first to the last of them; 0 for a line.
    pub turns: f64,
    /// Passes; `None` where the feed is not known.
    pub passes: Option<u32>,
    /// Speed of the spot over the part, m/s; `None` where it is not known.
    pub feed: Option<f64>,
    /// Its standard error where it follows from the wanted coverage, m/s.
    pub feed_error: Option<f64>,
    /// What feed and passes lack.
    pub missing: Vec<&'static str>,
    /// What the whole stroke covers, where that is asked for.
    pub coverage: Option<Coverage>,
    /// What the shot that is fired dents of the target.
    pub dented: Option<DentedBy>,
    /// How often a shot hits surfaces that should be spared, where it is known how many are fired.
    pub doses: Vec<Dose>,
}

/// A pose that the nozzle passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// How far the spot has travelled from the beginning of the stroke, m; below 0 in the run-out before it.
    pub travelled: f64,
    /// The pose in the machine: a part that turns brings the place before a nozzle that keeps its attitude.
    pub pose: Pose,
    /// By how much the part is turned then, rad.
    pub turn: f64,
}

/// Degrees of turn between two waypoints at most.
const TURN_BETWEEN: f64 = 15.0;

impl Program {
    /// The program of a stroke; `None` for a spot.
    pub fn of(scenario: &Scenario, legs: &[Leg]) -> Option<Self> {
        let traverse = scenario.traverse.as_ref()?;
        let stroke = scenario.problem.stroke.as_ref()?;
        let has_coverage = scenario.problem.coverage.is_some();
        let run_outs = match stroke.run_out {
            Some(length) => [RunOut::of(length); 2],
            None if has_coverage => RunOut::both(scenario, traverse, legs),
            None => [RunOut::of(0.0); 2],
        };
        let ends = [0, 1].map(|end| traverse.beyond(WHOLE[end], run_outs[end].length));
        let coverage = Coverage::of_stroke(scenario, legs, ends);
        let whole = ends[1] - ends[0];
        let way = traverse.length() * whole;
        let turns = traverse.turns() * whole;
        let mut missing = Vec::new();
        if !has_coverage {
            missing.push("coverage");
        }
        if scenario.problem.jet.mass_flow.is_none() {
            missing.push("jet.mass_flow");
        }
        let (passes, feed) = feed(stroke, coverage.as_ref(), (way, turns));
        let mass = passes.zip(feed).zip(scenario.problem.jet.mass_flow);
        let mass = mass.map(|((passes, feed), flow)| flow * f64::from(passes) * way / feed);
        let dented = mass
            .zip(coverage.as_ref())
            .map(|(mass, coverage)| coverage.dented_by(mass));
        Some(Self {
            legs: legs.to_vec(),
            length: traverse.length(),
            run_outs,
            waypoints: waypoints(scenario, traverse, legs, ends),
            turns,
            passes,
            feed,
            feed_error: feed.zip(coverage.as_ref()).and_then(|(feed, coverage)| {
                let is_found = matches!(stroke.feed, Feed::Auto);
                is_found.then(|| feed * coverage.lowest.relative_error())
            }),
            missing,
            doses: match dented {
                Some(_) => Dose::of_stroke(scenario, legs, ends),
                None => Vec::new(),
            },
            dented,
            coverage,
        })
    }

    /// Time, s, where the feed is known.
    pub fn time(&self) -> Option<f64> {
        Some(self.way() * f64::from(self.passes?) / self.feed?)
    }

    /// What the spot travels in a pass, m, on the part.
    pub fn way(&self) -> f64 {
        let ends = self.waypoints.first().zip(self.waypoints.last());
        ends.map_or(0.0, |(first, last)| last.travelled - first.travelled)
    }
}

/// Passes and feed, m/s: as asked for, or as the wanted coverage lets them be.
fn feed(
    stroke: &Stroke,
    coverage: Option<&Coverage>,
    (way, turns): (f64, f64),
) -> (Option<u32>, Option<f64>) {
    let needed = coverage.and_then(|coverage| coverage.time_until_wanted(coverage.lowest));
    let given = match stroke.feed {
        Feed::Auto => None,
        Feed::Speed(speed) => Some(speed),
        Feed::Turns(per_second) => Some(per_second * way / turns),
    };
    match (given, stroke.passes, needed) {
        (Some(feed), Some(passes), _) => (Some(passes), Some(feed)),
        (Some(feed), None, Some(time)) => {
            let passes = (time * feed / way).ceil().max(1.0);
            (Some(passes as u32), Some(feed))
        }
        (Some(feed), None, None) => (Some(1), Some(feed)),
        (None, passes, Some(time)) => {
            let passes = passes.unwrap_or(1);
            (Some(passes), Some(way * f64::from(passes) / time))
        }
        (None, passes, None) => (passes, None),
    }
}

fn waypoints(
    scenario: &Scenario,
    traverse: &Traverse,
    legs: &[Leg],
    ends: [f64; 2],
) -> Vec<Waypoint> {
    let mut places: Vec<f64> = scenario.stations.iter().map(|it| it.place).collect();
    if traverse.turns() > 0.0 {
        let count = (traverse.turns() * 360.0 / TURN_BETWEEN).ceil().max(1.0) as usize;
        places = (0..=count)
            .map(|index| index as f64 / count as f64 - 0.5)
            .collect();
    }
    places.extend(ends);
    // A change of settings happens on the spot: there are two waypoints where legs meet.
    let inner = legs.windows(2).map(|pair| pair[0].span[1]);
    let joints: Vec<f64> = inner.collect();
    places.extend(joints.iter().copied());
    places.sort_by(f64::total_cmp);
    places.dedup();
    let waypoint = |place: f64, leg: &Leg| Waypoint {
        travelled: traverse.travelled(place),
        pose: Pose::new(&traverse.frame_in_machine(place), &leg.settings),
        turn: 0.0 - traverse.angle_at(place),
    };
    let mut waypoints = Vec::new();
    for place in places {
        waypoints.push(waypoint(place, Leg::at(legs, place)));
        if let Some(joint) = joints.iter().position(|&joint| joint == place) {
            waypoints.push(waypoint(place, &legs[joint + 1]));
        }
    }
    waypoints
}
