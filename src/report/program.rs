//! The stroke as programs for machines: neutral points with a tool axis and a feed.

mod apt;
mod csv;
mod noether;

use std::io;

use crate::record::{StrokeRecord, WaypointRecord};

/// Files of a stroke, by their names; `exposure` times as long on every place as the sheet says.
///
/// # Errors
/// None is expected: files are written to memory.
pub fn files(stroke: &StrokeRecord, exposure: u32) -> io::Result<Vec<(String, Vec<u8>)>> {
    let moves = moves(stroke, exposure);
    let suffix = match exposure {
        1 => String::new(),
        exposure => format!("_x{exposure}"),
    };
    Ok(vec![
        (
            format!("stroke{suffix}.csv"),
            csv::write(&moves)?.into_bytes(),
        ),
        (
            format!("stroke{suffix}.apt"),
            apt::write(stroke, &moves).into_bytes(),
        ),
        (
            format!("stroke{suffix}.yaml"),
            noether::write(&moves).into_bytes(),
        ),
    ])
}

/// Names of the files without exposure.
pub const NAMES: [&str; 3] = ["stroke.csv", "stroke.apt", "stroke.yaml"];

/// A straight move to a waypoint.
struct Move<'a> {
    to: &'a WaypointRecord,
    /// Pass, from 1.
    pass: u32,
    /// What the spot has travelled since the first waypoint of all passes, m.
    path: f64,
    /// Speed of the spot on the part, m/s; `None` for the first waypoint, and where it is not known.
    at_spot: Option<f64>,
    /// Speed of the nozzle's exit, m/s.
    at_tip: Option<f64>,
}

/// All moves of all passes, there and back by turns.
fn moves(stroke: &StrokeRecord, exposure: u32) -> Vec<Move<'_>> {
    let feed = stroke.feed_m_s.map(|feed| feed / f64::from(exposure));
    let mut moves: Vec<Move> = Vec::new();
    let mut path = 0.0;
    for pass in 1..=stroke.passes.unwrap_or(1) {
        let mut waypoints: Vec<&WaypointRecord> = stroke.waypoints.iter().collect();
        if pass % 2 == 0 {
            waypoints.reverse();
        }
        for to in waypoints {
            let Some(last) = moves.last() else {
                moves.push(Move {
                    to,
                    pass,
                    path,
                    at_spot: None,
                    at_tip: None,
                });
                continue;
            };
            let spot = (to.at_m - last.to.at_m).abs();
            if spot == 0.0 {
                continue;
            }
            path += spot;
            let tip = tip_way(last.to, to);
            moves.push(Move {
                to,
                pass,
                path,
                at_spot: feed,
                at_tip: feed.map(|feed| feed * tip / spot),
            });
        }
    }
    moves
}

/// How far the exit travels between two waypoints in the machine, where a part that turns turns, m.
fn tip_way(from: &WaypointRecord, to: &WaypointRecord) -> f64 {
    let [a, b] = [from, to].map(|it| it.pose.exit_m);
    (0..3)
        .map(|axis| (b[axis] - a[axis]) * (b[axis] - a[axis]))
        .sum::<f64>()
        .sqrt()
}
