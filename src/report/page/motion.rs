//! How the nozzle travels in the 3-D view, and what stations receive.

use serde::Serialize;

use super::scene::point;
use crate::record::{EvidenceRecord, Record, StationRecord, StrokeRecord};
use crate::report::motion::{Stop, stops};
use crate::report::number::share;
use crate::report::sheet::subject::by_urgency;

/// The way of the nozzle, one value for each waypoint.
#[derive(Serialize)]
pub struct Motion {
    /// From the beginning of the stroke, mm.
    at: Vec<f64>,
    /// mm from the aim point.
    exits: Vec<[f64; 3]>,
    /// Unit vectors of the jet.
    directions: Vec<[f64; 3]>,
    /// The far end of each piece of the nozzle's body from the exit, mm.
    bodies: Vec<Vec<[f64; 3]>>,
    /// Seconds that a pass takes in the view.
    seconds: f64,
    stations: Vec<Station>,
}

/// What a station of the stroke receives.
#[derive(Serialize)]
struct Station {
    /// mm.
    at: f64,
    text: String,
}

/// A pass takes so long in the view, s, whatever its feed.
const SECONDS: f64 = 6.0;
/// The same for each turn.
const SECONDS_A_TURN: f64 = 1.5;

impl Motion {
    /// The motion of a record; `None` for a spot.
    pub fn new(record: &Record, evidence: &EvidenceRecord) -> Option<Self> {
        let stroke = record.stroke.as_ref()?;
        let stops = stops(record);
        let millimetres = |stop: &Stop| {
            let tips = stop.tips.iter().map(|tip| (tip * 1e3).into());
            tips.collect()
        };
        (stops.len() > 1).then(|| Self {
            at: stops.iter().map(|stop| stop.at * 1e3).collect(),
            exits: stops
                .iter()
                .map(|stop| point(&evidence.frame, stop.exit.coords.into()))
                .collect(),
            directions: stops.iter().map(|stop| stop.direction.into()).collect(),
            bodies: stops.iter().map(millimetres).collect(),
            seconds: SECONDS.max(stroke.turns * SECONDS_A_TURN),
            stations: stroke
                .stations
                .iter()
                .map(|it| station(stroke, it))
                .collect(),
        })
    }
}

/// Where a station is, and the verdict that it uses up most.
fn station(stroke: &StrokeRecord, station: &StationRecord) -> Station {
    let verdicts = station.verdicts.iter();
    let worst = verdicts.max_by(|a, b| by_urgency(a, b));
    let place = stroke.place(station.at_m);
    let text = worst.map_or_else(
        || place.clone(),
        |it| {
            let (shown, allowed) = (share(it.share), share(it.allowed));
            let says = if it.passes { "" } else { ": FAIL" };
            format!("{place}: {} {shown} of {allowed}{says}", it.subject)
        },
    );
    Station {
        at: station.at_m * 1e3,
        text,
    }
}
