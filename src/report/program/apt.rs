//! `stroke.apt`: cutter location data. The tool's tip is the exit, its axis points from there back into the nozzle.

use std::fmt::Write as _;

use super::Move;
use crate::record::StrokeRecord;

pub fn write(stroke: &StrokeRecord, moves: &[Move]) -> String {
    let mut text = String::from(
        "$$ tip: centre of the nozzle's exit; axis: from there against the jet; feeds are those of the tip\n\
         UNITS/MM\n",
    );
    if let Some(turns) = stroke.turns_per_s {
        let exposed = moves.iter().find_map(|it| it.at_spot).zip(stroke.feed_m_s);
        let share = exposed.map_or(1.0, |(feed, asked)| feed / asked);
        let _ = writeln!(text, "SPINDL/{}, RPM", turns * share * 60.0);
    }
    let mut before = None;
    for it in moves {
        if it.at_tip != before
            && let Some(feed) = it.at_tip
        {
            let _ = writeln!(text, "FEDRAT/{}, MMPM", feed * 6e4);
            before = it.at_tip;
        }
        let pose = &it.to.pose;
        let exit = pose.exit_m.map(|length| (length * 1e3).to_string());
        let axis = pose.direction.map(|part| (-part).to_string());
        let _ = writeln!(text, "GOTO/{}, {}", exit.join(", "), axis.join(", "));
    }
    text += "FINI\n";
    text
}
