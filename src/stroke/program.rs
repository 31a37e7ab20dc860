//! What the machine does on a stroke: where the nozzle goes, how fast, how often, and what that covers.

use crate::coverage::{Coverage, DentedBy, Dose};
use crate::feasibility::infeasibility;
use crate::jet::Pose;
use crate::problem::stroke::{Feed, Leg, Stroke};
use crate::scenario::Scenario;
use crate::scene::traverse::Traverse;
use crate::verdict::{StationVerdicts, Subject, Verdict};

use super::Spot;

/// A stroke as a machine runs it.
#[derive(Clone, Debug)]
pub struct Program {
    /// Pieces with settings of their own, in the order of the stroke.
    pub legs: Vec<Leg>,
    /// Length on the part between the ends, m.
    pub length: f64,
    /// How far the aim point travels beyond both ends, m.
    pub run_out: f64,
    /// Poses from one end of the run-out to the other.
    pub waypoints: Vec<Waypoint>,
    /// Turns of the part from the first to the last of them; 0 for a line.
    pub turns: f64,
    /// Passes; `None` where the feed is not known.
    pub passes: Option<u32>,
    /// Speed of the spot over the part, m/s; `None` where it is not known.
    pub feed: Option<f64>,
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

/// Into how many parts the longest run-out is cut, so as to find one that fits.
const RUN_OUTS: u32 = 8;
/// Degrees of turn between two waypoints at most.
const TURN_BETWEEN: f64 = 15.0;

impl Program {
    /// The program of a stroke; `None` for a spot.
    pub fn of(scenario: &Scenario, legs: &[Leg]) -> Option<Self> {
        let traverse = scenario.traverse.as_ref()?;
        let stroke = scenario.problem.stroke.as_ref()?;
        let has_coverage = scenario.problem.coverage.is_some();
        let run_out = match stroke.run_out {
            Some(run_out) => run_out,
            None if has_coverage => Self::run_out(scenario, traverse, legs),
            None => 0.0,
        };
        let beyond = traverse.places_in(run_out);
        let coverage = Coverage::of_stroke(scenario, legs, beyond);
        let whole = 1.0 + 2.0 * beyond;
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
            run_out,
            waypoints: waypoints(scenario, traverse, legs, beyond),
            turns,
            passes,
            feed,
            missing,
            doses: match dented {
                Some(_) => Dose::of_stroke(scenario, legs, beyond),
                None => Vec::new(),
            },
            dented,
            coverage,
        })
    }

    /// As far as there is target left beyond an end and the spot reaches back from there, or less where the nozzle
    /// does not fit or other surfaces receive too much.
    fn run_out(scenario: &Scenario, traverse: &Traverse, legs: &[Leg]) -> f64 {
        let ends = [(-1.0, false), (1.0, true)];
        let settings = |sign: f64| &Leg::at(legs, sign).settings;
        let (target, _) = scenario.target.cut_out(&scenario.scene);
        let reach = ends.iter().map(|&(sign, at_end)| {
            let onwards = traverse.onwards(at_end);
            let end = traverse.frame_at(sign * 0.5).aim;
            let corners = target.iter().flatten();
            let left = corners.map(|corner| (corner - end).dot(&onwards));
            let spot = Spot::of(scenario, settings(sign));
            left.fold(0.0, f64::max) + spot.map_or(0.0, |spot| spot.reach(&-onwards))
        });
        let longest = reach.fold(0.0, f64::max);
        let is_spared =
            |verdict: &Verdict| !matches!(verdict.subject, Subject::Surface(_)) || verdict.passes();
        let fits = |run_out: f64| {
            ends.iter().all(|&(sign, _)| {
                let place = sign * (0.5 + traverse.places_in(run_out));
                let station = scenario.station(place);
                let settings = settings(sign);
                infeasibility(&station.scenario, settings).is_none()
                    && StationVerdicts::at(&[&station], &scenario.problem, settings)
                        .iter()
                        .flat_map(|station| &station.verdicts)
                        .all(is_spared)
            })
        };
        let parts = (1..=RUN_OUTS).rev().map(f64::from);
        let mut tried = parts.map(|part| longest * part / f64::from(RUN_OUTS));
        tried.find(|&run_out| fits(run_out)).unwrap_or(0.0)
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

fn waypoints(scenario: &Scenario, traverse: &Traverse, legs: &[Leg], beyond: f64) -> Vec<Waypoint> {
    let mut places: Vec<f64> = scenario.stations.iter().map(|it| it.place).collect();
    if traverse.turns() > 0.0 {
        let count = (traverse.turns() * 360.0 / TURN_BETWEEN).ceil().max(1.0) as usize;
        places = (0..=count)
            .map(|index| index as f64 / count as f64 - 0.5)
            .collect();
    }
    if beyond > 0.0 {
        places.insert(0, -0.5 - beyond);
        places.push(0.5 + beyond);
    }
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
