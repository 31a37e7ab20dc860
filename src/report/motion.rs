//! How the nozzle travels on a stroke, in the part's coordinates: a part that turns stands still, and the nozzle goes
//! round it.

use nalgebra::{Point3, Rotation3, Unit, Vector3};

use crate::record::{BodyRecord, Record, StrokeRecord, TurnAxisRecord, WaypointRecord};

/// Where the nozzle is at a waypoint.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// From the beginning of the stroke, m.
    pub at: f64,
    /// Its exit, m.
    pub exit: Point3<f64>,
    /// Unit vector of the jet.
    pub direction: Vector3<f64>,
    /// For each piece of its body, where the far end is from the exit, m; nothing for a ball.
    pub tips: Vec<Vector3<f64>>,
}

/// The stops of the nozzle on a stroke; none for a spot, or without evidence.
pub fn stops(record: &Record) -> Vec<Stop> {
    let Some((stroke, evidence)) = record.stroke.as_ref().zip(record.evidence.as_ref()) else {
        return Vec::new();
    };
    let Some(middle) = middle(stroke) else {
        return Vec::new();
    };
    let drawn = turn(stroke, middle);
    let jet = Vector3::from(record.best.pose.direction);
    // A body that leads back along the jet turns with it; any other keeps its direction in the machine.
    let in_machine = |body: &BodyRecord| match body {
        BodyRecord::Capsule { direction, .. } => {
            let direction = Vector3::from(*direction);
            ((direction + jet).norm() > ALIKE).then(|| drawn.inverse() * direction)
        }
        BodyRecord::Ball { .. } => None,
    };
    let stop = |waypoint: &WaypointRecord| {
        let turn = turn(stroke, waypoint);
        let direction = turn * Vector3::from(waypoint.pose.direction);
        let tip = |body: &BodyRecord| match body {
            BodyRecord::Ball { .. } => Vector3::zeros(),
            BodyRecord::Capsule { length_m, .. } => {
                in_machine(body).map_or(-direction, |fixed| turn * fixed) * *length_m
            }
        };
        Stop {
            at: waypoint.at_m,
            exit: placed(&turn, stroke.axis.as_ref(), waypoint.pose.exit_m),
            direction,
            tips: evidence.nozzle.iter().map(tip).collect(),
        }
    };
    stroke.waypoints.iter().map(stop).collect()
}

/// Directions that differ by less are the same.
const ALIKE: f64 = 1e-6;

/// The waypoint at which the scene is drawn: that in the middle.
fn middle(stroke: &StrokeRecord) -> Option<&WaypointRecord> {
    let off = |waypoint: &WaypointRecord| (waypoint.at_m - stroke.length_m / 2.0).abs();
    let mut waypoints = stroke.waypoints.iter();
    let first = waypoints.next()?;
    Some(waypoints.fold(
        first,
        |best, it| if off(it) < off(best) { it } else { best },
    ))
}

/// From the machine to the part, turned as it is at a waypoint.
fn turn(stroke: &StrokeRecord, waypoint: &WaypointRecord) -> Rotation3<f64> {
    stroke.axis.map_or_else(Rotation3::identity, |axis| {
        let axis = Unit::new_normalize(Vector3::from(axis.axis));
        Rotation3::from_axis_angle(&axis, -waypoint.turn_deg.to_radians())
    })
}

fn placed(turn: &Rotation3<f64>, axis: Option<&TurnAxisRecord>, at: [f64; 3]) -> Point3<f64> {
    let through = axis.map_or_else(Point3::origin, |axis| Point3::from(axis.through_m));
    through + turn * (Point3::from(at) - through)
}
